// The messages of objects that hang on a parent and take pose commands in its frame (cameras, lights): all have the
// same fields. For ObjectEndpoint and the Step service. Private to ros_comm. C++17.
#pragma once

#include <string>
#include <vector>

#include "ros_comm/endpoints/conversions.h"

namespace ambf::ros_comm {

// Infos and States: the kind's tables in the structure and in frames; Pose: the pose in the parent's frame, within a
// state.
template <class StateMessage, class CommandMessage, auto Infos, auto States, auto Pose>
struct PlacedMessages {
  using State = StateMessage;
  using Command = CommandMessage;

  static void fill_names(const state::Structure& structure, std::uint32_t slot, State& message) {
    const auto& info = (structure.*Infos)[slot];
    message.name.data = structure.objects[info.object].local_name;
    message.identifier.data = structure.objects[info.object].identifier;
    message.parent_name.data = name_of(structure, info.parent_object);
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
