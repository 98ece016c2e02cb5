// A subscriber that accepts any message type and hands its bytes on: arms publish the same topic as PoseStamped or
// TransformStamped, depending on their release. Callbacks run on the thread of `queue` until this object is destroyed,
// which waits for the one running. Private to dvrk_arm. C++17.
#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <functional>
#include <memory>
#include <string>

#include "dvrk_arm/arm_messages.h"
#include "ros_comm/node.h"
#include "ros_comm/services/gate.h"

namespace ambf::dvrk_arm {

class AnySubscriber {
 public:
  using Callback = std::function<void(const Message&)>;

  // Throws when ROS does not accept the topic.
  AnySubscriber(ros_comm::Node& node, ros::CallbackQueue& queue, const std::string& topic, Callback callback);
  ~AnySubscriber();
  AnySubscriber(const AnySubscriber&) = delete;
  AnySubscriber& operator=(const AnySubscriber&) = delete;

  unsigned publishers() const { return subscriber_.getNumPublishers(); }
  const std::string& topic() const { return registered_.name(); }

 private:
  const std::shared_ptr<ros_comm::Gate> gate_ = std::make_shared<ros_comm::Gate>();
  const ros_comm::Registered registered_;
  ros::Subscriber subscriber_;
};

}  // namespace ambf::dvrk_arm
