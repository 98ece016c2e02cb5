// Input devices on ROS: the topics of each one, which go on at its own rate while the simulation waits;
// World/DeviceRates; the services World/Devices and World/SetDevice. Opened and closed with the world's topics. Private
// to ros_comm. C++17.
#pragma once

#include <ambf_msgs/Devices.h>
#include <ambf_msgs/SetDevice.h>
#include <ambf_msgs/WorldDeviceRates.h>

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "exchange/broadcast.h"
#include "ros_comm/devices/device_endpoint.h"
#include "ros_comm/endpoints/topics.h"
#include "ros_comm/services/gate.h"
#include "ros_comm/services/offered_service.h"
#include "state/frame.h"

namespace ambf::ros_comm {

class DeviceTopics {
 public:
  // A device's topics are <namespace of the world>/physical_device_<n>/<name>/...; n counts from 0, as -i. `devices`
  // must outlive this.
  DeviceTopics(Node& node, const std::string& world_topic, state::DeviceAbility& devices);
  ~DeviceTopics();
  DeviceTopics(const DeviceTopics&) = delete;
  DeviceTopics& operator=(const DeviceTopics&) = delete;

  // The publisher thread's: for each frame, and as often as DeviceRates is published at most.
  void watch(const state::Frame& frame);
  bool has_subscribers() const { return rates_.subscribers() > 0; }
  void publish_rates(const state::Frame& frame);

 private:
  void publish_until_stopped();
  bool list(ambf_msgs::Devices::Request& request, ambf_msgs::Devices::Response& response);
  bool set(ambf_msgs::SetDevice::Request& request, ambf_msgs::SetDevice::Response& response);
  // count() when there is none of this name.
  unsigned find(const std::string& name) const;

  Node& node_;
  state::DeviceAbility& devices_;
  std::vector<std::unique_ptr<DeviceEndpoint>> endpoints_;  // one a device; null: ROS rejected its topic
  exchange::Broadcast<WorldTime> time_;
  ambf_msgs::WorldDeviceRates rates_message_;  // publisher thread, as the next
  std::int64_t rates_published_ns_ = 0;
  TopicPublisher<ambf_msgs::WorldDeviceRates> rates_;
  const std::shared_ptr<Gate> gate_ = std::make_shared<Gate>();
  OfferedService<ambf_msgs::Devices> list_;
  OfferedService<ambf_msgs::SetDevice> set_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;  // last: uses all of the above
};

// The topic of a device's State without "/State". `world_topic` ends with the world's name.
std::string device_topic(const std::string& world_topic, unsigned device, const std::string& name);

}  // namespace ambf::ros_comm
