// The State/Command pair of all sensors but contact sensors, for ObjectEndpoint and the Step service. Private to
// ros_comm. C++17.
#pragma once

#include <ambf_msgs/SensorCmd.h>
#include <ambf_msgs/SensorState.h>

#include <string>

#include "ros_comm/endpoints/placed_messages.h"
#include "state/sensors.h"

namespace ambf::ros_comm {

struct SensorMessages {
  using State = ambf_msgs::SensorState;
  using Command = ambf_msgs::SensorCmd;

  static void fill_names(const state::Structure& structure, std::uint32_t slot, State& message);
  static void fill(const state::Frame& frame, std::uint32_t slot, State& message);
  // The original's `actuate` never had an effect on a sensor.
  static std::string read(const Command&, state::Command& out) {
    out = state::KindCommand{state::SensorCommand{}};
    return {};
  }
};

}  // namespace ambf::ros_comm
