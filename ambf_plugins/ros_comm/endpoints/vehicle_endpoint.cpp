// Vehicles on ROS: where chassis and wheels are, and how they are steered, driven and braked.
#include <ambf_msgs/VehicleCmd.h>
#include <ambf_msgs/VehicleState.h>

#include "ros_comm/endpoints/conversions.h"
#include "ros_comm/endpoints/object_endpoint.h"
#include "ros_comm/services/step_lists.h"
#include "state/vehicles.h"

namespace ambf::ros_comm {

namespace {

struct Messages {
  using State = ambf_msgs::VehicleState;
  using Command = ambf_msgs::VehicleCmd;

  static state::ObjectKind kind() { return state::vehicle_kind().kind; }

  static void fill_names(const state::Structure& structure, std::uint32_t slot, State& message) {
    const state::VehicleInfo& vehicle = state::vehicles(structure)[slot];
    message.name.data = structure.objects[vehicle.object].local_name;
    message.identifier.data = structure.objects[vehicle.object].identifier;
    message.wheel_count = static_cast<std::int8_t>(vehicle.wheels.size());
    message.wheel_offsets.resize(vehicle.wheels.size());
    message.mass = 0.0F;
    message.pInertia = {};
    if (vehicle.parent_object == state::kNone) return;
    const state::ObjectInfo& parent = structure.objects[vehicle.parent_object];
    if (!state::info_of(parent.kind).has_mass) return;
    const state::BodyInfo& chassis = structure.bodies[parent.slot];
    message.mass = static_cast<float>(chassis.mass);
    message.pInertia.x = chassis.inertia.x, message.pInertia.y = chassis.inertia.y;
    message.pInertia.z = chassis.inertia.z;
  }
  static void fill(const state::Frame& frame, std::uint32_t slot, State& message) {
    const state::VehicleState& vehicle = state::rows(frame, state::vehicle_kind().column)[slot];
    fill_times(frame, message);
    message.pose = to_ros(vehicle.T_world_object);
    const state::WheelRange wheels = state::wheels_of(frame, slot);
    for (std::size_t i = 0; i < wheels.size(); ++i) message.wheel_offsets[i] = to_ros(wheels[i].T_chassis_wheel);
  }
  static std::string read(const Command& message, state::Command& out) {
    state::VehicleCommand command;
    command.wrench_world = {from_ros(message.chassis_wrench.force), from_ros(message.chassis_wrench.torque)};
    command.steering.assign(message.wheel_steering.begin(), message.wheel_steering.end());
    command.drive.assign(message.wheel_power.begin(), message.wheel_power.end());
    command.brake.assign(message.wheel_brake.begin(), message.wheel_brake.end());
    command.handbrake = message.brake != 0;
    std::string refusal = state::check(command);
    out = state::KindCommand{std::move(command)};
    return refusal;
  }
};

}  // namespace

EndpointKind vehicle_endpoint_kind() {
  static const StepListsOf<Messages> lists(&StepRequest::vehicle_names, &StepRequest::vehicle_cmds,
                                           &StepResponse::vehicles);
  EndpointKind kind;
  kind.open = make_endpoint<ObjectEndpoint<Messages>>;
  kind.step = &lists;
  return kind;
}

}  // namespace ambf::ros_comm
