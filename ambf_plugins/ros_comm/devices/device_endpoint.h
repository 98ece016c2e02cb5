// The topics of one input device: State, Command and Mapping. Private to ros_comm. C++17.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "ros_comm/devices/device_messages.h"
#include "ros_comm/endpoints/topics.h"
#include "state/abilities/devices.h"

namespace ambf::ros_comm {

class DeviceEndpoint {
 public:
  // Throws when ROS rejects the topic. `devices` must outlive it.
  DeviceEndpoint(Node& node, state::DeviceAbility& devices, unsigned device, const std::string& topic);
  DeviceEndpoint(const DeviceEndpoint&) = delete;
  DeviceEndpoint& operator=(const DeviceEndpoint&) = delete;

  const std::string& topic() const { return topic_; }

  // Publishes the newest cycle of the device's thread, once, where there are subscribers. One thread.
  void publish(const WorldTime& time);
  bool has_subscribers() const { return states_.subscribers() + mappings_.subscribers() > 0; }
  // Of the device's thread; 0: nothing was to be published yet.
  double rate_hz() const { return info_ == nullptr ? 0.0 : info_->rate_hz; }

 private:
  void renew_info(std::int64_t now_ns);
  void on_command(const ambf_msgs::ObjectCmd& message);

  Node& node_;
  state::DeviceAbility& devices_;
  const unsigned device_;
  const std::string topic_;
  // The publishing thread's.
  std::shared_ptr<const state::DeviceInfo> info_;  // the names in the messages are its
  std::int64_t renew_info_ns_ = 0;
  state::DeviceStatus status_;
  std::uint64_t published_ = 0;  // cycle
  ambf_msgs::ObjectState state_;
  ambf_msgs::DeviceMapping mapping_;
  TopicPublisher<ambf_msgs::ObjectState> states_;
  TopicPublisher<ambf_msgs::DeviceMapping> mappings_;
  CommandSubscriber<ambf_msgs::ObjectCmd> commands_;  // last: callbacks use all of the above
};

}  // namespace ambf::ros_comm
