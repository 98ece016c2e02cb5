// A device behind ROS topics. Messages are read on a thread of its own and handed over wait-free; the device's thread
// never enters ROS. Private to dvrk_arm. C++17.
#pragma once

#include <ros/callback_queue.h>
#include <std_msgs/Bool.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "base/log.h"
#include "dvrk_arm/any_subscriber.h"
#include "dvrk_arm/force_sender.h"
#include "dvrk_arm/ros_host.h"
#include "dvrk_arm/ros_topics.h"
#include "exchange/latest_slot.h"

namespace ambf::dvrk_arm {

class RosDriver final : public devices::Driver {
 public:
  RosDriver(RosHost& host, base::Log& log, RosTopics topics);
  ~RosDriver() override;

  const devices::DriverTraits& traits() const override { return topics_.traits; }
  std::string open() override;
  devices::Reading read(devices::Sample& sample, double max_wait_s) override;
  void write(const math::Wrench& wrench_u) override;
  void close() override;
  // By the host, before the node ends: closes all that is ROS's. The device is lost then.
  void end_session();

 private:
  // All that has arrived, as of one message.
  struct Input {
    math::Pose T_base_tip;
    std::uint64_t poses = 0;
    std::int64_t pose_ns = 0;  // steady clock, on arrival
    devices::Deflections deflections{};
    std::int64_t twist_ns = 0;
    double jaw = 0.0;
    bool has_jaw = false;
    std::uint64_t buttons = 0;
    bool presence_known = false, present = false;
    const char* not_ready = "";
    bool has_joints = false;
    MtmJoints joints{}, joint_velocities{};
  };
  using Publisher = ros_comm::TopicPublisher<std_msgs::Bool>;

  std::string open_topics(ros_comm::Node& node);
  std::string open_forces();
  void start_afresh();
  void start_thread();
  std::string wait_for_poses();
  void mention_rate();
  void subscribe(const std::string& topic, AnySubscriber::Callback callback);
  void on_pose(const Message& message);
  void on_twist(const Message& message);
  void on_joy(const Message& message);
  void on_button(unsigned number, const Message& message);
  void post(const std::string& problem, const Message& message);
  bool source_has_publisher() const;
  void fill_ready(const Input& input, devices::Sample& sample) const;
  MtmJoints efforts_of(const math::Wrench& wrench_base) const;

  RosHost& host_;
  base::Log& log_;
  RosTopics topics_;

  ros_comm::Node* node_ = nullptr;  // of the session; null: none is open
  ros::CallbackQueue queue_;
  std::vector<std::unique_ptr<AnySubscriber>> subscribers_;  // the first one moves the hand
  std::vector<std::unique_ptr<AnySubscriber>> presence_;
  std::vector<std::unique_ptr<Publisher>> switches_;
  std::unique_ptr<ForceSender> sender_;
  std::thread thread_;
  std::atomic<bool> stop_{false}, gone_{true};
  std::atomic<unsigned> unstamped_{0}, refused_{0};
  std::atomic<std::uint64_t> arrived_{0};  // poses

  Input input_;                       // the reading thread's
  std::int64_t newest_stamp_ns_ = 0;  // the same
  exchange::LatestSlot<Input> slot_;
  exchange::LatestSlot<Force> forces_;

  // The device's thread.
  std::uint64_t seen_ = 0;
  math::Quat R_base_tip_;
  bool ready_ = false;  // of the newest sample
  devices::RatePose hand_;
  bool console_ = false;  // somebody publishes whether an operator is present
};

}  // namespace ambf::dvrk_arm
