// The messages of objects that hang on a parent. Their names are in the same fields for every kind; objects that take
// pose commands in the parent's frame (cameras, lights) have all fields in common. For ObjectEndpoint and the Step
// service. C++17.
#pragma once

#include <string>
#include <vector>

#include "ros_comm/endpoints/conversions.h"

namespace ambf::ros_comm {

// ObjectEndpoint's fill_names for the object with this row of the structure.
template <class State>
void fill_placed_names(const state::Structure& structure, const state::PlacedInfo& info, State& message) {
  message.name.data = structure.objects[info.object].local_name;
  message.identifier.data = structure.objects[info.object].identifier;
  message.parent_name.data = name_of(structure, info.parent_object);
}

// Infos and States: the kind's tables in the structure and in frames; Pose: the pose in the parent's frame, within a
// state.
template <class StateMessage, class CommandMessage, auto Infos, auto States, auto Pose>
struct PlacedMessages {
  using State = StateMessage;
  using Command = CommandMessage;

  static void fill_names(const state::Structure& structure, std::uint32_t slot, State& message) {
    fill_placed_names(structure, (structure.*Infos)[slot], message);
  }
  static void fill(const state::Frame& frame, std::uint32_t slot, State& message) {
    fill_times(frame, message);
    message.pose = to_ros((frame.*States)[slot].*Pose);
  }
  static std::string read(const Command& message, state::Command& out) {
    state::PoseCommand command;
    std::string refusal = read_pose_command(message.enable_position_controller != 0, message.pose, command);
    out = command;
    return refusal;
  }
};

}  // namespace ambf::ros_comm
