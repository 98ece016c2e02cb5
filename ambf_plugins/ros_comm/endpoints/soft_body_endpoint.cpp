// Soft bodies on ROS: the pose of the centre, a wrench on all of them, a pose that carries their fixed nodes.
#include <ambf_msgs/SoftBodyCmd.h>
#include <ambf_msgs/SoftBodyState.h>

#include "ros_comm/endpoints/conversions.h"
#include "ros_comm/endpoints/object_endpoint.h"
#include "state/soft_bodies.h"

namespace ambf::ros_comm {

namespace {

struct Messages {
  using State = ambf_msgs::SoftBodyState;
  using Command = ambf_msgs::SoftBodyCmd;

  static state::ObjectKind kind() { return state::soft_body_kind().kind; }

  static void fill_names(const state::Structure& structure, std::uint32_t slot, State& message) {
    const state::SoftBodyInfo& body = state::soft_bodies(structure)[slot];
    message.name.data = structure.objects[body.object].local_name;
    message.identifier.data = structure.objects[body.object].identifier;
    message.mass = static_cast<float>(body.mass);
  }
  static void fill(const state::Frame& frame, std::uint32_t slot, State& message) {
    fill_times(frame, message);
    message.pose = to_ros(state::rows(frame, state::soft_body_kind().column)[slot].T_world_object);
  }
  static std::string read(const Command& message, state::Command& out) {
    state::SoftBodyCommand command;
    command.carries = message.enable_position_controller != 0;
    if (command.carries) {
      command.T_world_body = from_ros(message.pose);
    } else {
      command.wrench_world = {from_ros(message.wrench.force), from_ros(message.wrench.torque)};
    }
    std::string refusal = state::check(command);
    out = state::KindCommand{command};
    return refusal;
  }
};

}  // namespace

EndpointKind soft_body_endpoint_kind() {
  EndpointKind kind;
  kind.open = make_endpoint<ObjectEndpoint<Messages>>;
  return kind;
}

}  // namespace ambf::ros_comm
