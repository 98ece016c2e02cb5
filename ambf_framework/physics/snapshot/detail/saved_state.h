// A world's state as bytes: a header, then every body, every joint, and every grasp that holds. Private to physics/.
// Any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace ambf::physics::detail {

inline constexpr std::uint32_t kSavedMagic = 0x50464d41;  // "AMFP"
inline constexpr std::uint32_t kSavedVersion = 3;

// Plain copies of everything that a step reads and may change. No padding may reach the file, so every field is 8
// bytes.
struct SavedBody {
  double basis[9], origin[3];
  double linear[3], angular[3], instant_twist;
  double force[3], torque[3];
  double gravity[3], has_gravity;
  double given_pose[7], move_target[7], moving_to;
  double rest_basis[9], rest_origin[3], rest_time;
  double activation, may_sleep, frozen;
  double inverse_inertia[3], stiffened;
};

struct SavedJoint {
  double drive, motor_velocity, motor_max_impulse, drive_effort;
  double servo[6];
  double limits[2], has_limits, damping, erp, cfm, enabled;
  double turns_reference, sleep_reference, sleep_reference_settled;
  double feedback[12], step_axis[3], step_lever[3], step_effort, step_force[3], step_torque_a[3], step_torque_b[3];
};

// A grasp that holds: which one, and the indices of its bodies.
struct SavedGrasp {
  std::uint64_t grasp, holder, held;
  double holder_basis[9], holder_origin[3];  // its frame in the COM frame of each
  double held_basis[9], held_origin[3];
  SavedJoint joint;
};

struct SavedHeader {
  std::uint32_t magic, version;
  std::uint64_t bodies, joints, grasps, steps, moving;
  double step, gravity[3];
};

// The next of them; there must be enough left.
template <class T>
T take(std::span<const std::byte>& from) {
  T value;
  std::memcpy(&value, from.data(), sizeof(T));
  from = from.subspan(sizeof(T));
  return value;
}

}  // namespace ambf::physics::detail
