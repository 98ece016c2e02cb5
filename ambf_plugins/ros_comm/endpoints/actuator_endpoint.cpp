// Actuators on ROS: their place in their parent, whether they hold something, and which body they are to hold. Names
// are looked up here, on arrival.
#include <ambf_msgs/ActuatorCmd.h>
#include <ambf_msgs/ActuatorForces.h>
#include <ambf_msgs/ActuatorState.h>

#include "base/bounds.h"
#include "ros_comm/endpoints/object_endpoint.h"
#include "ros_comm/endpoints/placed_messages.h"
#include "ros_comm/services/step_lists.h"
#include "state/actuators.h"
#include "state/kinds.h"
#include "state/sensors.h"
#include "state/soft_bodies.h"

namespace ambf::ros_comm {

namespace {

std::uint32_t find_body(const state::Structure& structure, const std::string& name) {
  std::uint32_t found = state::kNone;
  state::for_each_kind([&](state::ObjectKind kind, const state::KindInfo& info) {
    if (info.has_mass && !name.empty() && found == state::kNone) found = find(structure, name, kind);
  });
  if (found == state::kNone && !name.empty()) found = find(structure, name, state::soft_body_kind().kind);
  return found;
}

struct Messages {
  using State = ambf_msgs::ActuatorState;
  using Command = ambf_msgs::ActuatorCmd;

  static state::ObjectKind kind() { return state::actuator_kind().kind; }

  static void fill_names(const state::Structure& structure, std::uint32_t slot, State& message) {
    const state::ActuatorInfo& actuator = state::actuators(structure)[slot];
    fill_placed_names(structure, actuator, message);
    message.type.data = state::name_of(actuator.type);
  }
  static void fill(const state::Frame& frame, std::uint32_t slot, State& message) {
    const state::ActuatorState& actuator = state::rows(frame, state::actuator_kind().column)[slot];
    fill_times(frame, message);
    message.pose = to_ros(actuator.T_parent_object);
    message.actuated = actuator.actuated();
  }
  static std::string read(const Command& message, const state::Structure& structure, std::uint32_t object,
                          state::Command& out) {
    state::ActuatorCommand command;
    command.actuate = message.actuate != 0;
    const state::ActuatorType type = state::actuators(structure)[structure.objects[object].slot].type;
    if (command.actuate && type == state::ActuatorType::needle) {
      const std::string& what = message.body_name.data;
      if (!what.empty() && what != "tie" && what != "untie") return "a needle's body_name is tie or untie";
      command.use_sensor = what == "untie";
    } else if (command.actuate && message.use_sensor_data) {
      const std::string& name = message.sensor_identifier.data;
      if (name.size() > base::kMaxPath) return "sensor_identifier is too long";
      command.use_sensor = true;
      if (!name.empty()) {
        const std::uint32_t sensor = find(structure, name, state::sensor_kind().kind);
        if (sensor == state::kNone) return "there is no sensor '" + name + "' (or several fit)";
        command.sensor = structure.objects[sensor].id;
      }
    } else if (command.actuate && type == state::ActuatorType::constraint) {
      const std::string& name = message.body_name.data;
      if (name.size() > base::kMaxPath) return "body_name is too long";
      if (name == structure.world_name) return "it cannot hold the world";
      const std::uint32_t body = find_body(structure, name);
      if (body == state::kNone) return "there is no body '" + name + "' (or several fit)";
      command.body = structure.objects[body].id;
      command.use_offset = message.use_offset != 0;
      if (command.use_offset) command.T_held_grasp = from_ros(message.body_offset);
    }
    std::string refusal = state::check(command, structure, object);
    out = state::KindCommand{command};
    return refusal;
  }
};

void fill_forces(const state::Frame& frame, std::uint32_t slot, ambf_msgs::ActuatorForces& message) {
  const state::ActuatorState& actuator = state::rows(frame, state::actuator_kind().column)[slot];
  fill_times(frame, message);
  message.force = to_ros(actuator.force_world);
  message.bodies = actuator.held_count;
  message.nodes = actuator.held_nodes;
  message.bites = actuator.bites;
  message.stitches = actuator.stitches;
  message.tied = actuator.tied;
}

// A further topic, NAME/forces: State is frozen, and says no more than whether it holds anything.
class ActuatorEndpoint final : public ObjectEndpoint<Messages> {
 public:
  ActuatorEndpoint(const EndpointParts& parts, const state::ObjectInfo& object, const std::string& topic)
      : ObjectEndpoint(parts, object, topic), forces_(parts.node, topic + "/forces") {}

  bool has_subscribers() const override { return ObjectEndpoint::has_subscribers() || forces_.subscribers() > 0; }
  void publish(const state::Frame& frame, std::uint32_t slot) override {
    if (ObjectEndpoint::has_subscribers() || step_interval() > 0) ObjectEndpoint::publish(frame, slot);
    if (forces_.subscribers() == 0) return;
    fill_forces(frame, slot, message_);
    forces_.publish(message_);
  }

 private:
  ambf_msgs::ActuatorForces message_;  // publisher thread
  StatePublisher<ambf_msgs::ActuatorForces> forces_;
};

}  // namespace

EndpointKind actuator_endpoint_kind() {
  static const StepListsOf<Messages> lists(&StepRequest::actuator_names, &StepRequest::actuator_cmds,
                                           &StepResponse::actuators);
  EndpointKind kind;
  kind.open = make_endpoint<ActuatorEndpoint>;
  kind.step = &lists;
  return kind;
}

}  // namespace ambf::ros_comm
