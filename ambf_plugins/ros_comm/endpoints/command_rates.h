// From frames to the CommandRates topic. Publisher thread. Private to ros_comm. C++17.
#pragma once

#include <ambf_msgs/WorldCommandRates.h>

#include <cstdint>

#include "state/frame.h"

namespace ambf::ros_comm {

class CommandRates {
 public:
  bool due(std::int64_t now_ns) const;
  const ambf_msgs::WorldCommandRates& measure(const state::Frame& frame);

 private:
  ambf_msgs::WorldCommandRates message_;
  std::int64_t last_ns_ = 0;
};

}  // namespace ambf::ros_comm
