#include "state/command.h"

#include <cmath>

#include "base/bounds.h"
#include "math/rotation.h"

namespace ambf::state {

namespace {

// Beyond these a command is a mistake, not a wish: 1 GN, 1000 km, 1000 km/s would throw any body out of the world in
// one step.
constexpr double kMaxForce = base::kMaxForce;
constexpr double kMaxLength = base::kMaxLength_m;
constexpr double kMaxSpeed = base::kMaxSpeed;

bool within(const math::Vec3& v, double limit) {
  return std::abs(v.x) <= limit && std::abs(v.y) <= limit && std::abs(v.z) <= limit;  // false for NaN
}

std::string check_pose(math::Pose& pose) {
  if (!within(pose.position, kMaxLength)) return "position is not finite or beyond 1e6 m";
  if (!math::is_finite(pose.orientation)) return "orientation is not finite";
  const double length = math::norm(pose.orientation);
  if (length < 0.9 || length > 1.1) return "orientation is not a unit quaternion";
  pose.orientation = math::normalized(pose.orientation);
  return {};
}

}  // namespace

std::string check(RigidBodyCommand& command) {
  switch (command.type) {
    case CartesianCommandType::none: break;
    case CartesianCommandType::force:
      if (!within(command.wrench_world.force, kMaxForce) || !within(command.wrench_world.torque, kMaxForce)) {
        return "wrench is not finite or beyond 1e9 N";
      }
      break;
    case CartesianCommandType::position:
      if (std::string why = check_pose(command.T_world_body); !why.empty()) return why;
      break;
    case CartesianCommandType::velocity:
      if (!within(command.twist_world.linear, kMaxSpeed) || !within(command.twist_world.angular, kMaxSpeed)) {
        return "twist is not finite or beyond 1e6 m/s";
      }
      break;
  }
  for (const JointCommand& joint : command.joints) {
    if (joint.type != JointCommandType::none && !(std::abs(joint.value) <= kMaxForce)) {
      return "joint command is not finite or beyond 1e9";
    }
  }
  return {};
}

std::string check(PoseCommand& command) {
  return command.enabled ? check_pose(command.T_parent_object) : std::string();
}

const char* name_of(Source source) {
  switch (source) {
    case Source::ros: return "topic";
    case Source::step_service: return "step service";
    case Source::pointer: return "pointer";
    case Source::panel: return "panel";
    case Source::plugin: return "plugin";
    default: return "device";
  }
}

}  // namespace ambf::state
