// What a saved state must look like before any of it is let into a world.
#include <cmath>

#include "physics/snapshot/detail/saved_state.h"
#include "physics/world.h"

namespace ambf::physics {
namespace {

using detail::SavedBody;
using detail::SavedGrasp;
using detail::SavedHeader;
using detail::SavedJoint;

constexpr double kFarthest = 1e12;  // m, and whatever else is no wish but damage beyond it
constexpr double kLargest = 1e30;   // forces and readings: anything whose square is a number
constexpr double kRotationError = 1e-6;
constexpr std::uint64_t kMaxSteps = std::uint64_t{1} << 53;
constexpr int kLastDrive = 3;            // detail::Drive::servo
constexpr int kLastActivationState = 3;  // active, asleep, about to sleep (Bullet): no body of ours has another

// Every comparison is false for NaN, so each is asked the right way round.
bool within(double value, double least, double most) { return value >= least && value <= most; }

template <std::size_t N>
bool all_within(const double (&values)[N], double limit) {
  for (const double value : values)
    if (!within(value, -limit, limit)) return false;
  return true;
}

bool is_flag(double value) { return value == 0.0 || value == 1.0; }
bool is_number_of(double value, int least, int most) {
  return within(value, least, most) && value == std::floor(value);
}

bool is_rotation(const double (&m)[9]) {
  if (!all_within(m, 2.0)) return false;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      const double product = m[3 * i] * m[3 * j] + m[3 * i + 1] * m[3 * j + 1] + m[3 * i + 2] * m[3 * j + 2];
      if (!(std::abs(product - (i == j ? 1.0 : 0.0)) <= kRotationError)) return false;
    }
  const double determinant =
      m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) + m[2] * (m[3] * m[7] - m[4] * m[6]);
  return determinant > 0.0;
}

// Position, and a quaternion that is about one long: who sets poses need not normalise.
bool is_pose(const double (&p)[7]) {
  if (!all_within(p, kFarthest)) return false;
  return within(p[3] * p[3] + p[4] * p[4] + p[5] * p[5] + p[6] * p[6], 0.81, 1.21);
}

bool is_speed(const double (&v)[3], double limit) {
  return all_within(v, limit) && v[0] * v[0] + v[1] * v[1] + v[2] * v[2] <= limit * limit;
}

const char* fault_of(const SavedBody& body, bool is_static) {
  const SpeedLimits limits;
  if (!is_rotation(body.basis)) return "its orientation must be a rotation";
  if (!all_within(body.origin, kFarthest)) return "its position must be finite, at most 1e12 m";
  if (!is_speed(body.linear, limits.linear) || !is_speed(body.angular, limits.angular))
    return "its speed must be at most 1e4 m/s and 1e4 rad/s";
  if (!is_flag(body.instant_twist)) return "its twist must be that of an instant or of a step";
  if (!all_within(body.force, kLargest) || !all_within(body.torque, kLargest)) return "forces on it must be finite";
  if (!is_flag(body.has_gravity) || !all_within(body.gravity, kFarthest)) return "its gravity must be finite";
  if (!is_pose(body.given_pose) || !is_pose(body.move_target)) return "where it is carried to must be a pose";
  if (!is_flag(body.moving_to) || (body.moving_to != 0.0 && !is_static)) return "only what is static is carried";
  if (!is_rotation(body.rest_basis) || !all_within(body.rest_origin, kFarthest))
    return "where it came to rest must be a pose";
  if (!within(body.rest_time, 0.0, kFarthest)) return "how long it has rested must be 0 or more";
  if (!is_number_of(body.activation, 1, kLastActivationState) || !is_flag(body.may_sleep))
    return "whether it sleeps must be one of the known states";
  if (!is_flag(body.frozen) || (body.frozen != 0.0 && is_static)) return "only what moves may be frozen";
  if (!is_flag(body.stiffened) || (body.stiffened != 0.0 && (is_static || body.frozen != 0.0)))
    return "only what moves may be stiffened";
  for (const double inverse : body.inverse_inertia)
    if (!within(inverse, 0.0, kLargest)) return "its inertia must be finite";
  if (body.frozen != 0.0 && (!is_speed(body.linear, 0.0) || !is_speed(body.angular, 0.0)))
    return "while it is frozen, its speed must be 0";
  return nullptr;
}

const char* fault_of(const SavedJoint& joint) {
  if (!is_number_of(joint.drive, 0, kLastDrive)) return "its drive must be one of the known ones";
  if (!within(joint.motor_velocity, -kFarthest, kFarthest) || !within(joint.motor_max_impulse, 0.0, kLargest))
    return "its motor must have a finite velocity and a bound of 0 or more";
  if (!within(joint.drive_effort, -kFarthest, kFarthest)) return "its effort must be finite, at most 1e12";
  if (!all_within(joint.servo, kLargest) || !within(joint.servo[5], 0.0, kLargest))
    return "its servo's values must be finite";
  if (!is_flag(joint.has_limits) || !all_within(joint.limits, kFarthest) || !(joint.limits[0] <= joint.limits[1]))
    return "its limits must be finite, the lower one first";
  if (!within(joint.damping, 0.0, kFarthest)) return "its damping must be 0 or more";
  if (!within(joint.erp, 0.0, kFarthest) || !within(joint.cfm, 0.0, kFarthest)) return "erp and cfm must be 0 or more";
  if (!is_flag(joint.enabled) || !is_flag(joint.sleep_reference_settled)) return "its switches must be 0 or 1";
  if (!within(joint.turns_reference, -kFarthest, kFarthest) || !within(joint.sleep_reference, -kLargest, kLargest))
    return "what its coordinate is counted from must be finite";
  if (!all_within(joint.feedback, kLargest) || !all_within(joint.step_axis, kLargest) ||
      !all_within(joint.step_lever, kLargest) || !within(joint.step_effort, -kLargest, kLargest) ||
      !all_within(joint.step_force, kLargest) || !all_within(joint.step_torque_a, kLargest) ||
      !all_within(joint.step_torque_b, kLargest))
    return "what it read in the last step must be finite";
  return nullptr;
}

// `first`: the least number that it may have.
const char* fault_of(const SavedGrasp& grasp, std::uint64_t first, const StateLayout& layout) {
  if (grasp.grasp < first || grasp.grasp >= layout.grasps) return "it must be one of the grasps, each once";
  if (grasp.holder >= layout.is_static.size() || grasp.held >= layout.is_static.size() || grasp.holder == grasp.held)
    return "it must hold one body on another";
  if (layout.is_static[grasp.holder] && layout.is_static[grasp.held]) return "one of its bodies must move";
  if (!is_rotation(grasp.holder_basis) || !is_rotation(grasp.held_basis)) return "its frames must be rotations";
  if (!all_within(grasp.holder_origin, kFarthest) || !all_within(grasp.held_origin, kFarthest))
    return "its frames must be finite, at most 1e12 m away";
  return fault_of(grasp.joint);
}

}  // namespace

std::optional<StateFault> World::check_state(std::span<const std::byte> state, const StateLayout& layout) {
  const auto whole = [](const char* message) { return StateFault{StateFault::Of::whole, 0, message}; };
  if (state.size() < sizeof(SavedHeader)) return whole("physics' part is cut short");
  const auto header = detail::take<SavedHeader>(state);
  if (header.magic != detail::kSavedMagic || header.version != detail::kSavedVersion)
    return whole("physics' part is none of this version");
  if (header.bodies != layout.is_static.size() || header.joints != layout.joints || header.grasps > layout.grasps ||
      state.size() !=
          header.bodies * sizeof(SavedBody) + header.joints * sizeof(SavedJoint) + header.grasps * sizeof(SavedGrasp))
    return whole("it has another number of bodies, joints or grasps");
  if (header.step != layout.step) return whole("it was made with steps of another length");
  if (header.steps > kMaxSteps || header.moving > 1) return whole("its count of steps is beyond 2^53");
  if (!all_within(header.gravity, kFarthest)) return whole("gravity must be finite");
  for (std::size_t i = 0; i < layout.is_static.size(); ++i) {
    if (const char* fault = fault_of(detail::take<SavedBody>(state), layout.is_static[i]))
      return StateFault{StateFault::Of::body, i, fault};
  }
  for (std::size_t i = 0; i < layout.joints; ++i)
    if (const char* fault = fault_of(detail::take<SavedJoint>(state)))
      return StateFault{StateFault::Of::joint, i, fault};
  for (std::uint64_t i = 0, first = 0; i < header.grasps; ++i) {
    const auto grasp = detail::take<SavedGrasp>(state);
    if (const char* fault = fault_of(grasp, first, layout))
      return StateFault{StateFault::Of::grasp, static_cast<std::size_t>(i), fault};
    first = grasp.grasp + 1;
  }
  return std::nullopt;
}

}  // namespace ambf::physics
