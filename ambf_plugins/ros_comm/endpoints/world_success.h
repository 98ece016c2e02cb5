// The topic World/Success. Publisher thread. Private to ros_comm. C++17.
#pragma once

#include <ambf_msgs/WorldSuccess.h>

#include <string>

#include "ros_comm/endpoints/topics.h"
#include "state/frame.h"

namespace ambf::ros_comm {

class WorldSuccess {
 public:
  WorldSuccess(Node& node, const std::string& topic);
  // Publishes, latched, when there are other tasks than in the frame before or one of them is done or is so no more.
  void watch(const state::Frame& frame);

 private:
  TopicPublisher<ambf_msgs::WorldSuccess> publisher_;
  ambf_msgs::WorldSuccess message_;
  std::uint64_t structure_version_ = ~std::uint64_t{0};
  std::vector<std::uint32_t> slots_;  // of the sensors with tasks, as the message lists them
};

}  // namespace ambf::ros_comm
