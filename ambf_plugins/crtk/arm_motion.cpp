// ArmControl: how set-points move, what is asked of the joints, and the jaw.
#include <algorithm>
#include <cmath>

#include "crtk/arm_control.h"
#include "math/rotation.h"

namespace ambf::crtk {

namespace {

constexpr double kReachedAngle = 5e-3, kReachedDistance = 1e-3;  // of the measured joints from their goals
constexpr double kSettle_s = 0.5;                                // simulated time that they are given for it
constexpr int kMaxSteps = 10'000;                                // of one frame: more are a jump in time

}  // namespace

Joints ArmControl::set_position() const {
  Joints made(size());
  for (std::size_t i = 0; i < size(); ++i) made[i] = motion_[i].position;
  return made;
}

Joints ArmControl::set_velocity() const {
  Joints made(size());
  for (std::size_t i = 0; i < size(); ++i) made[i] = motion_[i].velocity;
  return made;
}

Joints ArmControl::goal() const { return {goal_.begin(), goal_.end() - 1}; }

Joints ArmControl::measured_joints() const {
  return {measured_.position.begin(), measured_.position.begin() + static_cast<std::ptrdiff_t>(size())};
}

Joints ArmControl::measured_velocities() const {
  return {measured_.velocity.begin(), measured_.velocity.begin() + static_cast<std::ptrdiff_t>(size())};
}

Joints ArmControl::set_effort() const {
  if (mode_ != Mode::wrench) return effort_;
  math::Wrench wrench = wrench_;
  const WrenchFrame frame = wrench_absolute_ ? WrenchFrame::spatial : wrench_frame_;
  const std::vector<double> matrix = jacobian(frame);
  const double w[6] = {wrench.force.x,  wrench.force.y,  wrench.force.z,
                       wrench.torque.x, wrench.torque.y, wrench.torque.z};
  Joints effort(size(), 0.0);
  for (std::size_t row = 0; row < 6; ++row) {
    for (std::size_t i = 0; i < size(); ++i) effort[i] += matrix[row * size() + i] * w[row];
  }
  return effort;
}

std::vector<double> ArmControl::jacobian(WrenchFrame frame) const {
  const auto kind = frame == WrenchFrame::body ? kinematics::JacobianFrame::body : kinematics::JacobianFrame::spatial;
  std::vector<double> matrix = kinematics::jacobian(arm_.kinematics, measured_joints(), kind);
  if (frame == WrenchFrame::body) return matrix;
  const std::size_t n = size();
  for (std::size_t half = 0; half < 2; ++half) {
    for (std::size_t i = 0; i < n; ++i) {
      double* const column = matrix.data() + half * 3 * n + i;
      const math::Vec3 turned = math::rotate(T_frame_base_.orientation, {column[0], column[n], column[2 * n]});
      column[0] = turned.x, column[n] = turned.y, column[2 * n] = turned.z;
    }
  }
  return matrix;
}

std::vector<Target> ArmControl::targets() const {
  std::vector<Target> made;
  if (!measured_.valid || (state_ != OperatingState::enabled && state_ != OperatingState::paused)) return made;
  if (mode_ == Mode::position) {
    for (std::size_t i = 0; i < size(); ++i) made.push_back({state::JointCommandType::position, motion_[i].position});
  } else {
    for (const double effort : set_effort()) made.push_back({state::JointCommandType::effort, effort});
  }
  if (jaw_effort_mode_) {
    made.push_back({state::JointCommandType::effort, jaw_effort_});
  } else {
    made.push_back({state::JointCommandType::position, motion_.back().position});
  }
  return made;
}

void ArmControl::update(const Measured& measured, std::int64_t now_ns) {
  now_ns_ = now_ns;
  const bool restarted = measured_.valid && measured.epoch != measured_.epoch;
  const double passed = measured_.valid && !restarted ? measured.sim_time - measured_.sim_time : 0.0;
  const bool was_busy = busy();
  measured_ = measured;
  if (restarted && (state_ == OperatingState::enabled || state_ == OperatingState::paused)) {
    preempt_arm(), preempt_jaw();
    rest_at_measured();
    events_.push_back({Event::Kind::status, {}, false, false, false, "the world was reset: the arm rests where it is"});
  }
  if (!was_busy || state_ != OperatingState::enabled) return;
  const double h_s = measured.step_s > 0.0 ? measured.step_s : 1e-3;
  const long steps = std::clamp(std::lround(passed / h_s), 0L, static_cast<long>(kMaxSteps));
  for (long i = 0; i < steps; ++i) advance_step(h_s);
  if (steps > 0) stamp();
  finish_moves(static_cast<double>(steps) * h_s);
}

void ArmControl::advance_step(double h_s) {
  const auto step = [&](std::size_t i) {
    const MotionLimits limits{limits_[i].velocity * ratio_velocity_, limits_[i].acceleration * ratio_acceleration_};
    advance(motion_[i], goal_[i], limits, h_s);
    if (i < size()) {
      motion_[i].position = std::clamp(motion_[i].position, arm_.kinematics.lower[i], arm_.kinematics.upper[i]);
    }
  };
  for (std::size_t i = 0; (arm_moves_ || homing_) && i < size(); ++i) step(i);
  if (jaw_moves_) step(size());
}

bool ArmControl::near_goal(std::size_t first, std::size_t last) const {
  for (std::size_t i = first; i < last; ++i) {
    const double tolerance = i < size() && arm_.kinematics.prismatic[i] ? kReachedDistance : kReachedAngle;
    if (std::abs(measured_.position[i] - goal_[i]) > tolerance) return false;
  }
  return true;
}

// A move ends once the set-point rests at the goal and the joints have followed, or had the time to.
void ArmControl::finish_moves(double passed_s) {
  const auto rests = [&](std::size_t i) { return motion_[i].position == goal_[i] && motion_[i].velocity == 0.0; };
  const auto all_rest = [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      if (!rests(i)) return false;
    }
    return true;
  };
  bool waits = false;
  const auto finish = [&](std::size_t first, std::size_t last, const char* who) {
    if (!all_rest(first, last)) return false;
    const bool near = near_goal(first, last);
    if (!near && settling_s_ < kSettle_s) {
      waits = true;
      return false;
    }
    if (!near) warn(std::string(who) + " is held up: it did not get to its goal");
    tell_reached(near);
    return true;
  };
  bool ended = false;
  if ((arm_moves_ || homing_) && finish(0, size(), "the arm")) {
    if (homing_) homed_ = near_goal(0, size());
    arm_moves_ = homing_ = false;
    ended = true;
  }
  if (jaw_moves_ && finish(size(), size() + 1, "the jaw")) {
    jaw_moves_ = false;
    ended = true;
  }
  settling_s_ = waits ? settling_s_ + passed_s : 0.0;
  if (ended) tell_state();
}

void ArmControl::fault(const std::string& reason) {
  measured_.valid = false;
  arm_moves_ = jaw_moves_ = homing_ = false;
  state_ = OperatingState::fault;
  events_.push_back({Event::Kind::error, {}, false, false, false, reason});
  tell_state();
}

double ArmControl::clipped_jaw(double opening) {
  const kinematics::Jaw& jaw = *arm_.kinematics.jaw;
  const double inside = std::clamp(opening, jaw.lower, jaw.upper);
  if (inside != opening) warn("a command of the jaw was clipped to its limits");
  return inside;
}

std::string ArmControl::jaw_servo_jp(double opening) {
  std::string why = not_ready();
  if (why.empty() && !std::isfinite(opening)) why = "a value is not finite";
  if (!why.empty()) return refuse("jaw/servo_jp", why);
  preempt_jaw();
  jaw_effort_mode_ = false;
  motion_.back() = {clipped_jaw(opening), 0.0};
  goal_.back() = motion_.back().position;
  stamp();
  return {};
}

std::string ArmControl::jaw_servo_jf(double effort) {
  std::string why = not_ready();
  if (why.empty() && !std::isfinite(effort)) why = "a value is not finite";
  if (!why.empty()) return refuse("jaw/servo_jf", why);
  preempt_jaw();
  jaw_effort_mode_ = true;
  jaw_effort_ = effort;
  stamp();
  return {};
}

std::string ArmControl::jaw_move_jp(double opening) {
  std::string why = not_ready();
  if (why.empty() && !std::isfinite(opening)) why = "a value is not finite";
  if (!why.empty()) return refuse("jaw/move_jp", why, true);
  if (jaw_effort_mode_) motion_.back() = {measured_.position.back(), 0.0};
  jaw_effort_mode_ = false;
  goal_.back() = clipped_jaw(opening);
  jaw_moves_ = true;
  settling_s_ = 0.0;
  stamp();
  tell_state();
  return {};
}

std::string ArmControl::set_base_frame(const math::Pose& T_frame_base) {
  if (!math::is_finite(T_frame_base) || std::abs(math::norm(T_frame_base.orientation) - 1.0) > 0.1) {
    return refuse("set_base_frame", "it is no pose");
  }
  T_frame_base_ = T_frame_base;
  T_frame_base_.orientation = math::normalized(T_frame_base_.orientation);
  return {};
}

std::string ArmControl::set_ratio(bool velocity, bool acceleration, double ratio) {
  if (!(ratio > 0.0 && ratio <= 1.0)) return refuse("trajectory_j/set_ratio", "a ratio is above 0 and at most 1");
  if (velocity) ratio_velocity_ = ratio;
  if (acceleration) ratio_acceleration_ = ratio;
  return {};
}

}  // namespace ambf::crtk
