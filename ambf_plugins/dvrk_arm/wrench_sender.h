// Sends the forces of one device to its topic from a thread of its own, so that the device's thread never enters ROS:
// the newest wrench once a millisecond, zero when it is older than 0.1 s. A guard program (guard_main.cpp) sends zero
// when this process dies, however that comes about. C++17.
#pragma once

#include <geometry_msgs/WrenchStamped.h>

#include <atomic>
#include <string>
#include <thread>

#include "exchange/latest_slot.h"
#include "math/types.h"
#include "ros_comm/child_program.h"
#include "ros_comm/endpoints/topics.h"

namespace ambf::dvrk_arm {

class WrenchSender {
 public:
  // Throws when ROS does not accept the topic. `problem`: why there is no guard; empty: there is one.
  WrenchSender(ros_comm::Node& node, const std::string& topic, std::string& problem);
  ~WrenchSender();  // sends zero
  WrenchSender(const WrenchSender&) = delete;
  WrenchSender& operator=(const WrenchSender&) = delete;

  // The device's thread: neither locks nor allocates. In the axes that the topic wants.
  void post(const math::Wrench& wrench, std::int64_t now_ns) { newest_.post(wrench, now_ns); }

 private:
  void run();
  void publish(const math::Wrench& wrench);

  ros_comm::TopicPublisher<geometry_msgs::WrenchStamped> publisher_;
  ros_comm::ChildProgram guard_;
  exchange::LatestSlot<math::Wrench> newest_;
  geometry_msgs::WrenchStamped message_;  // the thread's
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace ambf::dvrk_arm
