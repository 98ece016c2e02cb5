#include "state/vehicles.h"

#include <cmath>

#include "base/bounds.h"
#include "state/detail/built_in_kinds.h"

namespace ambf::state {
namespace {

PlacedKind<VehicleState> registered_kind;
ColumnId<WheelState> registered_wheels;

std::size_t count_wheels(const Structure& structure) {
  const std::vector<VehicleInfo>& all = vehicles(structure);
  return all.empty() ? 0 : all.back().first_wheel + all.back().wheels.size();
}

bool within(const math::Vec3& v, double limit) {
  return std::abs(v.x) <= limit && std::abs(v.y) <= limit && std::abs(v.z) <= limit;  // false for NaN
}

}  // namespace

void register_vehicle_kind() {
  KindInfo info;
  info.name = "vehicle";
  info.label = "vehicle";
  info.plural = "vehicles";
  registered_kind = register_placed_kind<VehicleInfo, VehicleState>(std::move(info));
  ColumnTraits traits;
  traits.name = "vehicle_wheels";
  traits.hashed = true;
  traits.while_diverged = WhileDiverged::last_good_structure;
  traits.rows_of = count_wheels;
  registered_wheels = register_column<WheelState>(std::move(traits));
}

const PlacedKind<VehicleState>& vehicle_kind() {
  register_built_in_kinds();
  return registered_kind;
}

const std::vector<VehicleInfo>& vehicles(const Structure& structure) {
  static const std::vector<VehicleInfo> none;
  const auto number = static_cast<std::size_t>(vehicle_kind().kind);
  const bool has_table = number < structure.registered.size() && structure.registered[number].has_value();
  return has_table ? table<VehicleInfo>(structure, vehicle_kind().kind) : none;
}

WheelRange wheels_of(const Frame& frame, std::uint32_t vehicle_slot) {
  const VehicleInfo& vehicle = vehicles(*frame.structure)[vehicle_slot];
  const std::vector<WheelState>& all = rows(frame, registered_wheels);
  if (vehicle.first_wheel + vehicle.wheels.size() > all.size()) return {};
  return {all.data() + vehicle.first_wheel, all.data() + vehicle.first_wheel + vehicle.wheels.size()};
}

std::vector<WheelState>& vehicle_wheels(Frame& frame) { return rows(frame, registered_wheels); }

std::string check(const VehicleCommand& command) {
  const auto sound = [](const std::vector<double>& values, double limit) {
    if (values.size() > kMaxWheels) return false;
    for (const double value : values)
      if (!(std::abs(value) <= limit)) return false;  // NaN, too
    return true;
  };
  if (!within(command.wrench_world.force, base::kMaxForce) || !within(command.wrench_world.torque, base::kMaxForce))
    return "chassis_wrench is not finite or beyond 1e9 N";
  constexpr double kMaxAngle = 1e3;  // rad
  if (!sound(command.steering, kMaxAngle)) return "wheel_steering is not finite, beyond 1000 rad or beyond 127 wheels";
  if (!sound(command.drive, base::kMaxForce)) return "wheel_power is not finite, beyond 1e9 N or beyond 127 wheels";
  if (!sound(command.brake, base::kMaxForce)) return "wheel_brake is not finite, beyond 1e9 N or beyond 127 wheels";
  return {};
}

}  // namespace ambf::state
