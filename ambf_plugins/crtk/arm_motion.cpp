#include "crtk/arm_motion.h"

#include <algorithm>
#include <cmath>

#include "crtk/joint_motion.h"

namespace ambf::crtk {

namespace {

constexpr double kReachedAngle = 5e-3, kReachedDistance = 1e-3;  // of the measured joints from their goals
constexpr double kSettle_s = 0.5;                                // simulated time that they are given for it

struct Range {
  std::size_t first, last;
};
Range joints_of(const ArmLimits& limits) { return {0, limits.joints}; }
Range jaw_of(const ArmLimits& limits) { return {limits.joints, limits.joints + (limits.has_jaw ? 1 : 0)}; }

double inside(const AxisLimits& axis, double position) { return std::clamp(position, axis.lower, axis.upper); }

bool holds_positions(Mode mode) { return mode == Mode::position || mode == Mode::move || mode == Mode::velocity; }

void keep(ArmMotion& motion, std::size_t axis, double position) {
  motion.position[axis] = motion.goal[axis] = position;
  motion.velocity[axis] = 0.0;
}

void obey(ArmMotion& motion, GroupMotion& group, Range range, const ArmLimits& limits, const Order& order,
          const ArmCommand& command, const Axes& measured) {
  if (order.number <= group.order.number) return;
  const bool held = holds_positions(group.order.mode);
  if (group.moves && order.mode != Mode::move) {
    group.moves = group.reached = false;
  }
  group.order = order;
  for (std::size_t i = range.first; i < range.last; ++i) {
    const AxisLimits& axis = limits.axes[i];
    const double now = inside(axis, measured[i]);
    switch (order.mode) {
      case Mode::off: motion.velocity[i] = 0.0; break;
      case Mode::rest: keep(motion, i, now); break;
      case Mode::hold: keep(motion, i, held ? motion.position[i] : now); break;
      case Mode::position: keep(motion, i, inside(axis, command.values[i])); break;
      case Mode::move:
        if (!held) keep(motion, i, now);
        motion.goal[i] = inside(axis, command.values[i]);
        break;
      case Mode::velocity:
        if (!held) keep(motion, i, now);
        motion.velocity[i] = std::clamp(command.values[i], -axis.max_velocity, axis.max_velocity);
        break;
      case Mode::effort:
        motion.velocity[i] = 0.0;
        if ((command.efforts >> i & 1u) != 0) {
          motion.effort[i] = command.values[i];
        } else {
          keep(motion, i, inside(axis, command.values[i]));
        }
        break;
    }
  }
  if (order.mode == Mode::rest || order.mode == Mode::hold) group.order.mode = Mode::position;
  if (order.mode == Mode::effort) motion.efforts = command.efforts;
  if (order.mode == Mode::move) {
    group.moves = true;
    group.settling_s = 0.0;
  }
}

bool near_goal(const ArmMotion& motion, Range range, const ArmLimits& limits, const Axes& measured) {
  for (std::size_t i = range.first; i < range.last; ++i) {
    const double tolerance = limits.axes[i].prismatic ? kReachedDistance : kReachedAngle;
    if (std::abs(measured[i] - motion.goal[i]) > tolerance) return false;
  }
  return true;
}

void advance(ArmMotion& motion, GroupMotion& group, Range range, const ArmLimits& limits, const Axes& measured,
             double h_s) {
  if (group.order.mode == Mode::velocity) {
    for (std::size_t i = range.first; i < range.last; ++i) {
      motion.position[i] = motion.goal[i] = inside(limits.axes[i], motion.position[i] + motion.velocity[i] * h_s);
    }
    return;
  }
  if (!group.moves) return;
  bool rests = true;
  for (std::size_t i = range.first; i < range.last; ++i) {
    const AxisLimits& axis = limits.axes[i];
    JointMotion joint{motion.position[i], motion.velocity[i]};
    rests &= ambf::crtk::advance(
        joint, motion.goal[i],
        {axis.max_velocity * motion.ratio_velocity, axis.max_acceleration * motion.ratio_acceleration}, h_s);
    motion.position[i] = inside(axis, joint.position);
    motion.velocity[i] = joint.velocity;
  }
  if (!rests) {
    group.settling_s = 0.0;
    return;
  }
  group.reached = near_goal(motion, range, limits, measured);
  if (!group.reached && group.settling_s < kSettle_s) {
    group.settling_s += h_s;
    return;
  }
  group.moves = false;
  group.order.mode = Mode::position;
}

void start_afresh(ArmMotion& motion, GroupMotion& group, Range range, const ArmLimits& limits, const Axes& measured) {
  group.moves = group.reached = false;
  if (group.order.mode != Mode::off) group.order.mode = Mode::position;
  for (std::size_t i = range.first; i < range.last; ++i) keep(motion, i, inside(limits.axes[i], measured[i]));
}

}  // namespace

void obey(ArmMotion& motion, const ArmLimits& limits, const ArmCommand& command, const Axes& measured) {
  motion.ratio_velocity = command.ratio_velocity;
  motion.ratio_acceleration = command.ratio_acceleration;
  motion.note = command.note;
  obey(motion, motion.arm, joints_of(limits), limits, command.arm, command, measured);
  obey(motion, motion.jaw, jaw_of(limits), limits, command.jaw, command, measured);
}

void advance(ArmMotion& motion, const ArmLimits& limits, const Axes& measured, double h_s) {
  advance(motion, motion.arm, joints_of(limits), limits, measured, h_s);
  advance(motion, motion.jaw, jaw_of(limits), limits, measured, h_s);
}

void start_afresh(ArmMotion& motion, const ArmLimits& limits, const Axes& measured) {
  start_afresh(motion, motion.arm, joints_of(limits), limits, measured);
  start_afresh(motion, motion.jaw, jaw_of(limits), limits, measured);
}

bool exerts(const ArmMotion& motion, const ArmLimits& limits, std::size_t axis) {
  const bool is_jaw = axis >= limits.joints;
  const GroupMotion& group = is_jaw ? motion.jaw : motion.arm;
  return group.order.mode == Mode::effort && (is_jaw || (motion.efforts >> axis & 1u) != 0);
}

}  // namespace ambf::crtk
