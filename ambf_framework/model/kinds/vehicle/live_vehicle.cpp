#include "model/kinds/vehicle/detail/live_vehicle.h"

#include <algorithm>

#include "math/rotation.h"
#include "model/detail/command_bounds.h"
#include "physics/mounted_bodies.h"

namespace ambf::model {

physics::Body* chassis_of(const LiveWorld::Impl& live, std::uint32_t slot) {
  const std::uint32_t parent = state::vehicles(*live.structure)[slot].parent_object;
  if (parent == state::kNone) return nullptr;
  const state::ObjectInfo& info = live.structure->objects[parent];
  return state::info_of(info.kind).has_mass ? live.tables.bodies()[info.slot].body.get() : nullptr;
}

void LiveVehicle::want(const state::VehicleCommand& command, const state::VehicleInfo& info) {
  const auto entry = [](const std::vector<double>& values, std::size_t i) {
    return i < values.size() ? values[i] : 0.0;
  };
  wrench_world_ = command.wrench_world;
  handbrake = command.handbrake;
  for (std::size_t i = 0; i < wanted_.size(); ++i) {
    const state::VehicleWheel& wheel = info.wheels[i];
    wanted_[i].steering = std::clamp(entry(command.steering, i), wheel.steering_low, wheel.steering_high);
    wanted_[i].drive = std::clamp(entry(command.drive, i), -wheel.max_drive_N, wheel.max_drive_N);
    wanted_[i].brake = std::clamp(entry(command.brake, i), 0.0, wheel.max_brake_N);
  }
}

void LiveVehicle::want_nothing() {
  wrench_world_ = {};
  std::fill(wanted_.begin(), wanted_.end(), physics::WheelOrder{});
}

void LiveVehicle::act(const LiveWorld::Impl& live, std::uint32_t slot, double h_s) {
  physics::Body* chassis = chassis_of(live, slot);
  if (chassis == nullptr || chassis->is_static() || chassis->frozen() || physics::is_mounted(*chassis)) return;
  CommandBound bound(live.tables.bodies()[chassis->user_index()], h_s);
  chassis->apply_wrench(bound.wrench(wrench_world_));
  const state::VehicleInfo& info = state::vehicles(*live.structure)[slot];
  for (std::size_t i = 0; i < orders_.size(); ++i) {
    orders_[i] = wanted_[i];
    orders_[i].present = info.wheels[i].body != state::kNone;
    if (!handbrake) continue;
    orders_[i].drive = 0.0;
    orders_[i].brake = info.wheels[i].max_brake_N;
  }
  wheels.act(*live.physics, *chassis, orders_);
}

void LiveVehicle::follow(const LiveWorld::Impl& live, std::uint32_t slot) {
  const physics::Body* chassis = chassis_of(live, slot);
  if (chassis == nullptr || chassis->asleep()) return;
  wheels.advance(*live.physics, *chassis);
  place(live, slot, *chassis);
}

void LiveVehicle::settle(const LiveWorld::Impl& live, std::uint32_t slot) {
  const physics::Body* chassis = chassis_of(live, slot);
  if (chassis == nullptr) return;
  wheels.look(*live.physics, *chassis);
  place(live, slot, *chassis);
}

void LiveVehicle::place(const LiveWorld::Impl& live, std::uint32_t slot, const physics::Body& chassis) const {
  const state::VehicleInfo& info = state::vehicles(*live.structure)[slot];
  const math::Pose T_world_com = chassis.com_pose();
  for (std::size_t i = 0; i < info.wheels.size(); ++i) {
    if (info.wheels[i].body == state::kNone) continue;
    const math::Pose T_world_hub = T_world_com * wheels.T_chassis_hub(i);
    const math::Vec3 spin = wheels.wheel(i).axle * -wheels.motions()[i].rate;
    physics::place_mounted(*live.tables.bodies()[info.wheels[i].body].body, T_world_hub,
                           {chassis.velocity_at(T_world_hub.position),
                            chassis.twist().angular + math::rotate(T_world_hub.orientation, spin)});
  }
}

state::WheelState LiveVehicle::wheel_state(std::size_t i, const state::VehicleWheel& info,
                                           const math::Pose& T_body_com) const {
  const physics::WheelContact& contact = wheels.contact(i);
  const physics::WheelMotion& motion = wheels.motions()[i];
  state::WheelState row;
  row.T_chassis_wheel = T_body_com * wheels.T_chassis_hub(i);
  row.steering = motion.steering;
  row.rate = motion.rate;
  row.suspension_m = contact.length;
  row.present = info.body != state::kNone;
  if (!row.present || contact.ground == nullptr) return row;
  row.ground = contact.ground->user_index();
  row.point_world = contact.point;
  row.normal_world = contact.normal;
  row.force_world = contact.force;
  return row;
}

}  // namespace ambf::model
