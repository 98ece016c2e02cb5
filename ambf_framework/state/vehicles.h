// Vehicles as all threads see them: a chassis, which is the body that they hang on, and wheels, each a row of the
// column of wheels. Plain data, read by any thread. C++17.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "state/command.h"
#include "state/kind_rows.h"

namespace ambf::state {

// VehicleState counts them in an int8.
inline constexpr std::size_t kMaxWheels = 127;

struct VehicleWheel {
  std::uint32_t body = kNone;  // slot of the body that is this wheel; kNone: it is not there yet, and nor is the wheel
  bool front = false;
  double radius_m = 0.0;
  double steering_low = 0.0, steering_high = 0.0;  // rad
  double max_drive_N = 0.0, max_brake_N = 0.0;
};

struct VehicleInfo : PlacedInfo {
  std::vector<VehicleWheel> wheels;
  std::uint32_t first_wheel = 0;  // its row in the column of wheels
};

// Its pose is that of the chassis' body frame.
struct VehicleState : PlacedState {
  double speed = 0.0;      // m/s, of the chassis' COM along the heading of its unsteered wheels
  bool handbrake = false;  // the last command's `brake`; stays when the command ends
};

struct WheelState {
  math::Pose T_chassis_wheel;            // in the chassis' body frame: the hub, steered and rolled
  double steering = 0.0, rate = 0.0;     // rad, rad/s
  double suspension_m = 0.0;             // its length now
  bool present = false;                  // false: its body is not there
  std::uint32_t ground = kNone;          // slot of the body that it stands on; kNone: in the air
  math::Vec3 point_world, normal_world;  // where it stands
  math::Vec3 force_world;                // N, of the ground on the chassis through it, in the last step
};

template <class Visit>
void visit_computed(VehicleState& row, Visit& visit) {
  visit(row.T_parent_object), visit(row.T_world_object), visit(row.speed);
}

template <class Visit>
void visit_computed(WheelState& row, Visit& visit) {
  visit(row.T_chassis_wheel), visit(row.steering), visit(row.rate), visit(row.suspension_m);
  visit(row.point_world), visit(row.normal_world), visit(row.force_world);
}

// In force until replaced, or ended by its watchdog: then it drives, steers and brakes no more, but `handbrake` stays.
// Entry i is that of wheel i; a wheel without an entry has 0, entries beyond the wheels are ignored. Values are cut to
// what the wheel can do.
struct VehicleCommand {
  math::Wrench wrench_world;     // on the chassis at its COM
  std::vector<double> steering;  // rad
  std::vector<double> drive;     // N
  std::vector<double> brake;     // N
  bool handbrake = false;        // no drive, and all wheels braked as hard as they can
};

// Why a command is refused, or empty: values that are not finite or beyond all measure, absurdly long lists.
std::string check(const VehicleCommand& command);

const PlacedKind<VehicleState>& vehicle_kind();

const std::vector<VehicleInfo>& vehicles(const Structure& structure);

// The wheels of the vehicle of this slot, begin and end; empty where the frame's list belongs to another structure (a
// diverged world).
struct WheelRange {
  const WheelState* first = nullptr;
  const WheelState* last = nullptr;
  const WheelState* begin() const { return first; }
  const WheelState* end() const { return last; }
  const WheelState& operator[](std::size_t i) const { return first[i]; }
  std::size_t size() const { return static_cast<std::size_t>(last - first); }
};
WheelRange wheels_of(const Frame& frame, std::uint32_t vehicle_slot);

// All rows, for the physics thread to fill: as many as there are wheels.
std::vector<WheelState>& vehicle_wheels(Frame& frame);

}  // namespace ambf::state
