// ArmControl: what it makes of frames, the ends of moves, and the jaw.
#include <algorithm>
#include <cmath>

#include "crtk/arm_control.h"
#include "math/rotation.h"

namespace ambf::crtk {

// As the simulation has it, or will have it with its next step.
double ArmControl::set_axis(std::size_t axis) const {
  const bool is_jaw = axis >= size();
  const Order& ordered = is_jaw ? command_.jaw : command_.arm;
  const GroupMotion& group = is_jaw ? measured_.motion.jaw : measured_.motion.arm;
  const bool pending = ordered.number > group.order.number;
  if (pending && ordered.mode == Mode::position) return command_.values[axis];
  const Mode mode = group.order.mode;
  const bool has_one = mode == Mode::position || mode == Mode::move || mode == Mode::velocity;
  if (!has_one || (pending && ordered.mode == Mode::rest)) return measured_.position[axis];
  return measured_.motion.position[axis];
}

Joints ArmControl::set_position() const {
  Joints made(size());
  for (std::size_t i = 0; i < size(); ++i) made[i] = set_axis(i);
  return made;
}

Joints ArmControl::set_velocity() const {
  return {measured_.motion.velocity.begin(), measured_.motion.velocity.begin() + static_cast<std::ptrdiff_t>(size())};
}

Joints ArmControl::goal() const { return goal_follows_ ? set_position() : goal_; }

void ArmControl::update(const Measured& measured, std::int64_t now_ns) {
  now_ns_ = now_ns;
  const bool restarted = measured_.valid && measured.epoch != measured_.epoch;
  const double passed_s = measured_.valid && !restarted ? std::max(0.0, measured.sim_time - measured_.sim_time) : 0.0;
  const bool works = state_ == OperatingState::enabled || state_ == OperatingState::paused;
  const bool lost = works && !restarted && measured_.active && !measured.active;
  measured_ = measured;
  if (restarted) take_over(measured.motion);
  if (lost) {
    warn("the simulation let go of the arm: it heard nothing of this program's part for too long, or diverged");
    end_arm_move(), end_jaw_move();
    rest();
  }
  if (state_ != OperatingState::enabled) return;
  if (busy() || way_ == Way::velocity) set_point_ns_ = measured.stamp_ns;
  finish_moves();
  if (way_ == Way::velocity) {
    twist_left_s_ -= passed_s;
    if (twist_left_s_ > 0.0) {
      exert();
    } else {
      hold();
    }
  } else if (way_ == Way::wrench || way_ == Way::impedance || (way_ == Way::effort && locked_)) {
    exert();
  }
}

void ArmControl::finish_moves() {
  const GroupMotion &arm = measured_.motion.arm, &jaw = measured_.motion.jaw;
  bool ended = false;
  if ((arm_moves_ || homing_) && arm.order.number == command_.arm.number && !arm.moves) {
    if (!arm.reached) warn("the arm is held up: it did not get to its goal");
    if (homing_) homed_ = arm.reached;
    arm_moves_ = homing_ = false;
    report(Event::Kind::goal_reached, {}, arm.reached);
    ended = true;
  }
  if (jaw_moves_ && jaw.order.number == command_.jaw.number && !jaw.moves) {
    if (!jaw.reached) warn("the jaw is held up: it did not get to its goal");
    jaw_moves_ = false;
    report(Event::Kind::goal_reached, {}, jaw.reached);
    ended = true;
  }
  if (ended) tell_state();
}

// The world was reset or restored: what the arm does is what the simulation says.
void ArmControl::take_over(const ArmMotion& motion) {
  const bool was_busy = busy();
  state_ = static_cast<OperatingState>(std::min<std::uint32_t>(motion.note & 3u, 2u));
  homed_ = (motion.note & 4u) != 0 || !arm_.homing_moves;
  homing_ = (motion.note & 8u) != 0 && motion.arm.moves;
  arm_moves_ = motion.arm.moves && !homing_;
  jaw_moves_ = motion.jaw.moves;
  const Mode mode = motion.arm.order.mode;
  way_ = mode == Mode::effort ? Way::effort : mode == Mode::velocity ? Way::velocity : Way::position;
  twist_left_s_ = 0.0;
  effort_.assign(motion.effort.begin(), motion.effort.begin() + static_cast<std::ptrdiff_t>(size()));
  jaw_effort_.reset();
  if (motion.jaw.order.mode == Mode::effort) jaw_effort_ = motion.effort[size()];
  goal_.assign(motion.goal.begin(), motion.goal.begin() + static_cast<std::ptrdiff_t>(size()));
  goal_follows_ = false;
  command_.arm = motion.arm.order;
  command_.jaw = motion.jaw.order;
  command_.values = motion.goal;
  command_.efforts = motion.efforts;
  command_.ratio_velocity = motion.ratio_velocity, command_.ratio_acceleration = motion.ratio_acceleration;
  command_.note = motion.note;
  changed_ = false;
  note_state();
  if (state_ != OperatingState::disabled) {
    set_point_ns_ = measured_.stamp_ns;
    say("the world was reset or restored: the arm goes on from there");
  }
  if (was_busy && !busy()) report(Event::Kind::goal_reached, {}, false);
  tell_state();
}

void ArmControl::bound() {
  measured_.motion = {};
  measured_.active = false;
  changed_ = last_number_ > 0;
}

void ArmControl::fault(const std::string& reason) {
  measured_ = {};
  for (Joints* each : {&measured_.position, &measured_.velocity, &measured_.effort}) each->resize(size() + 1, 0.0);
  arm_moves_ = jaw_moves_ = homing_ = false;
  next_tool_.clear();
  way_ = Way::position;
  jaw_effort_.reset();
  goal_follows_ = true;
  order_arm(Mode::off);
  if (arm_.has_jaw()) order_jaw(Mode::off);
  state_ = OperatingState::fault;
  report(Event::Kind::error, reason);
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
  end_jaw_move();
  jaw_effort_.reset();
  command_.values[size()] = clipped_jaw(opening);
  order_jaw(Mode::position);
  set_point_ns_ = measured_.stamp_ns;
  return {};
}

std::string ArmControl::jaw_servo_jf(double effort) {
  std::string why = not_ready();
  if (why.empty() && !std::isfinite(effort)) why = "a value is not finite";
  if (!why.empty()) return refuse("jaw/servo_jf", why);
  end_jaw_move();
  jaw_effort_ = effort;
  command_.values[size()] = effort;
  order_jaw(Mode::effort);
  set_point_ns_ = measured_.stamp_ns;
  return {};
}

std::string ArmControl::jaw_move_jp(double opening) {
  std::string why = not_ready();
  if (why.empty() && !std::isfinite(opening)) why = "a value is not finite";
  if (!why.empty()) return refuse("jaw/move_jp", why, true);
  jaw_effort_.reset();
  command_.values[size()] = clipped_jaw(opening);
  order_jaw(Mode::move);
  jaw_moves_ = true;
  set_point_ns_ = measured_.stamp_ns;
  tell_state();
  return {};
}

std::string ArmControl::set_base_frame(const math::Pose& T_frame_base) {
  if (!math::is_finite(T_frame_base) || std::abs(math::norm(T_frame_base.orientation) - 1.0) > 0.1) {
    return refuse("set_base_frame", "it is no pose");
  }
  view_refused_ = true;
  view_lost_ = false;
  frame_ = arm_.frame;
  T_frame_base_ = T_frame_base;
  T_frame_base_.orientation = math::normalized(T_frame_base_.orientation);
  return {};
}

void ArmControl::see_from(const std::string& frame, const std::optional<math::Pose>& T_view_base) {
  if (view_refused_) return;
  frame_ = frame;
  view_lost_ = !T_view_base;
  if (T_view_base) T_frame_base_ = *T_view_base;
}

std::string ArmControl::set_ratio(bool velocity, bool acceleration, double ratio) {
  if (!(ratio > 0.0 && ratio <= 1.0)) return refuse("trajectory_j/set_ratio", "a ratio is above 0 and at most 1");
  if (velocity) command_.ratio_velocity = ratio;
  if (acceleration) command_.ratio_acceleration = ratio;
  changed_ = true;
  return {};
}

}  // namespace ambf::crtk
