// Beacons on ROS: phase and rate as a sensor's measurement and range; a number commands the rate.
#include <ambf_msgs/SensorState.h>
#include <std_msgs/Float64.h>

#include "beacon.h"
#include "ros_comm/endpoints/object_endpoint.h"
#include "ros_comm/endpoints/placed_messages.h"

namespace ambf::test {
namespace {

struct Messages {
  using State = ambf_msgs::SensorState;
  using Command = std_msgs::Float64;

  static void fill_names(const state::Structure& structure, std::uint32_t slot, State& message) {
    const auto& infos = state::table<BeaconInfo>(structure, beacon_kind().kind);
    ros_comm::fill_placed_names(structure, infos[slot], message);
    message.type.data = "beacon";
    message.count = 1;
  }
  static void fill(const state::Frame& frame, std::uint32_t slot, State& message) {
    const BeaconState& beacon = state::rows(frame, beacon_kind().column)[slot];
    ros_comm::fill_times(frame, message);
    message.pose = ros_comm::to_ros(beacon.T_parent_object);
    message.measurement = {static_cast<float>(beacon.phase)};
    message.range = {static_cast<float>(beacon.rate_hz)};
  }
  static std::string read(const Command& message, state::Command& out) {
    if (!(message.data >= 0.0 && message.data <= kMaxBeaconRate_hz)) return "the rate is not within 0 .. 1000 Hz";
    out = state::KindCommand{BeaconCommand{message.data}};
    return {};
  }
};

const bool kRegistered = [] {
  ros_comm::EndpointKind entry;
  entry.open = ros_comm::make_endpoint<ros_comm::ObjectEndpoint<Messages>>;
  ros_comm::add_endpoint_kind(beacon_kind().kind, entry);
  return true;
}();

}  // namespace
}  // namespace ambf::test
