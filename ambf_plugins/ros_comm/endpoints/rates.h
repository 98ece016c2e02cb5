// Gathers what the Rates topic says: the state of the run in the frame, the traffic, and how the threads of this
// process stand. Publisher thread. Private to ros_comm. C++17.
#pragma once

#include <ambf_msgs/WorldRates.h>

#include <cstdint>
#include <map>
#include <string>

#include "ros_comm/node.h"
#include "state/abilities/devices.h"
#include "state/frame.h"

namespace ambf::ros_comm {

class Rates {
 public:
  // `devices`: null where there are none.
  Rates(Node& node, const state::DeviceAbility* devices) : node_(node), devices_(devices) {}

  bool due(std::int64_t now_ns) const;
  const ambf_msgs::WorldRates& measure(const state::Frame& frame);

 private:
  void fill_run(const state::Frame& frame);
  void fill_traffic(double seconds);
  void fill_pictures(double seconds);
  void fill_threads(const state::RunState& run, double seconds);
  void fill_device_thread(ambf_msgs::ThreadRates& rates) const;

  Node& node_;
  const state::DeviceAbility* const devices_;
  ambf_msgs::WorldRates message_;
  std::int64_t last_ns_ = 0, last_threads_ns_ = 0;
  std::uint64_t last_states_ = 0;
  std::map<int, std::int64_t> last_cpu_ns_;             // by thread
  std::map<std::string, std::uint64_t> last_pictures_;  // by topic
};

}  // namespace ambf::ros_comm
