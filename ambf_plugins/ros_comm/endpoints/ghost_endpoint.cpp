// Ghost objects on ROS: where they are and what they feel (AMBF3 1.4, 1.5).
#include <ambf_msgs/GhostObjectCmd.h>
#include <ambf_msgs/GhostObjectState.h>

#include "ros_comm/endpoints/object_endpoint.h"
#include "ros_comm/endpoints/placed_messages.h"
#include "state/ghosts.h"

namespace ambf::ros_comm {

namespace {

struct Messages {
  using State = ambf_msgs::GhostObjectState;
  using Command = ambf_msgs::GhostObjectCmd;

  static void fill_names(const state::Structure& structure, std::uint32_t slot, State& message) {
    const state::GhostInfo& ghost = state::ghosts(structure)[slot];
    fill_placed_names(structure, ghost, message);
    message.parent_name.data = ghost.parent_name;
  }

  static void fill(const state::Frame& frame, std::uint32_t slot, State& message) {
    fill_times(frame, message);
    message.pose = to_ros(state::rows(frame, state::ghost_kind().column)[slot].T_parent_object);
    message.sensed_objects.clear();
    for (const state::GhostTouch& touch : state::touches_of(frame, slot)) {
      message.sensed_objects.emplace_back();
      message.sensed_objects.back().data = frame.structure->objects[touch.object].identifier;
    }
  }

  static std::string read(const Command&, state::Command& out) {
    out = state::PoseCommand{};
    return {};
  }
};

}  // namespace

EndpointKind ghost_endpoint_kind() {
  EndpointKind kind;
  kind.open = make_endpoint<ObjectEndpoint<Messages>>;
  return kind;
}

}  // namespace ambf::ros_comm
