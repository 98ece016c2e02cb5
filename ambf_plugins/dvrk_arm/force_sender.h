// Sends the forces of one device to its topic from a thread of its own, so that the device's thread never enters ROS:
// the newest once a millisecond, zero when it is older than 0.1 s. A guard program (guard_main.cpp) sends zero when
// this process dies, however that comes about. C++17.
#pragma once

#include <geometry_msgs/WrenchStamped.h>
#include <sensor_msgs/JointState.h>

#include <atomic>
#include <memory>
#include <string>
#include <thread>

#include "dvrk_arm/mtm.h"
#include "exchange/latest_slot.h"
#include "math/types.h"
#include "ros_comm/child_program.h"
#include "ros_comm/endpoints/topics.h"

namespace ambf::dvrk_arm {

// As the topic wants it: a wrench in its axes, or efforts of joints.
struct Force {
  math::Wrench wrench;
  MtmJoints efforts{};
};

class ForceSender {
 public:
  enum class Kind { wrench, efforts };

  // `newest` outlives it: the device's thread posts there, whether this exists or not. Throws when ROS does not accept
  // the topic. `problem`: why there is no guard; empty: there is one.
  ForceSender(ros_comm::Node& node, const std::string& topic, Kind kind, exchange::LatestSlot<Force>& newest,
              std::string& problem);
  ~ForceSender();  // sends zero
  ForceSender(const ForceSender&) = delete;
  ForceSender& operator=(const ForceSender&) = delete;

 private:
  template <class Message>
  using Publisher = std::unique_ptr<ros_comm::TopicPublisher<Message>>;

  void run();
  void publish(const Force& force);

  Publisher<geometry_msgs::WrenchStamped> wrenches_;  // one of them, by the kind
  Publisher<sensor_msgs::JointState> efforts_;
  ros_comm::ChildProgram guard_;
  exchange::LatestSlot<Force>& newest_;
  geometry_msgs::WrenchStamped wrench_message_;  // this and the next: the thread's
  sensor_msgs::JointState effort_message_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace ambf::dvrk_arm
