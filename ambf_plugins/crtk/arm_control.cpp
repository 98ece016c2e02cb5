#include "crtk/arm_control.h"

#include <algorithm>
#include <cmath>

#include "crtk/arm_layout.h"
#include "math/rotation.h"

namespace ambf::crtk {

namespace {

constexpr std::int64_t kWarnEvery_ns = 2'000'000'000;
constexpr double kUnitTolerance = 0.1;  // of a quaternion's norm

bool all_finite(const Joints& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

std::string listed(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  return all;
}

}  // namespace

const char* to_string(OperatingState state) {
  static constexpr const char* kNames[] = {"DISABLED", "ENABLED", "PAUSED", "FAULT"};
  return kNames[static_cast<std::size_t>(state)];
}

ArmControl::ArmControl(const adf::CrtkArm& arm)
    : arm_(arm),
      homed_(!arm.homing_moves),
      T_frame_base_(arm.T_frame_base),
      frame_(arm.frame),
      goal_(arm.kinematics.size(), 0.0),
      effort_(arm.kinematics.size(), 0.0),
      endoscope_(arm.is_endoscope() ? "HD_" + arm.kinematics.tool : std::string()) {
  for (Joints* each : {&measured_.position, &measured_.velocity, &measured_.effort}) each->resize(size() + 1, 0.0);
  tell_state();
}

std::string ArmControl::not_ready() const {
  if (state_ != OperatingState::enabled) return std::string("the arm is ") + to_string(state_) + ", not ENABLED";
  if (homing_) return "the arm is homing";
  if (exchanging()) return "its tool is being exchanged";
  return homed_ ? "" : "the arm is not homed: send the state command home";
}

void ArmControl::report(Event::Kind kind, const std::string& text, bool yes) {
  events_.push_back({kind, state_, homed_, busy(), yes, text});
}

void ArmControl::warn(const std::string& text) {
  const auto [found, first] = warned_ns_.emplace(text.substr(0, 40), now_ns_);
  if (!first && now_ns_ - found->second < kWarnEvery_ns) return;
  found->second = now_ns_;
  report(Event::Kind::warning, text);
}

std::string ArmControl::refuse(const std::string& command, const std::string& why, bool move) {
  warn(command + " was ignored: " + why);
  if (move) {
    tell_state(true);
    report(Event::Kind::goal_reached, {}, false);
    tell_state();
  }
  return why;
}

// The simulation keeps the state with the arm, so that saved states have it.
void ArmControl::note_state() {
  const std::uint32_t note = static_cast<std::uint32_t>(state_) | (homed_ ? 4u : 0u) | (homing_ ? 8u : 0u) |
                             (exchanging() ? kKeepsOthers : 0u);
  changed_ |= note != command_.note;
  command_.note = note;
}

void ArmControl::tell_state(bool busy) {
  note_state();
  events_.push_back({Event::Kind::state, state_, homed_, busy});
}

std::vector<Event> ArmControl::take_events() {
  std::vector<Event> taken;
  taken.swap(events_);
  return taken;
}

std::optional<ArmCommand> ArmControl::take_command() {
  if (!changed_) return std::nullopt;
  changed_ = false;
  return command_;
}

void ArmControl::enable() {
  state_ = OperatingState::enabled;
  rest();
}

void ArmControl::rest() {
  way_ = Way::position;
  jaw_effort_.reset();
  goal_follows_ = true;
  order_arm(Mode::rest);
  if (arm_.has_jaw()) order_jaw(Mode::rest);
  set_point_ns_ = measured_.stamp_ns;
}

void ArmControl::end_arm_move() {
  const bool moved = arm_moves_ || homing_;
  arm_moves_ = homing_ = false;
  if (!moved) return;
  report(Event::Kind::goal_reached, {}, false);
  tell_state();
}

void ArmControl::end_jaw_move() {
  const bool moved = jaw_moves_;
  jaw_moves_ = false;
  if (!moved) return;
  report(Event::Kind::goal_reached, {}, false);
  tell_state();
}

std::string ArmControl::state_command(const std::string& command) {
  const OperatingState before = state_;
  const auto invalid = [&] {
    return refuse("state_command " + command, std::string("the arm is ") + to_string(state_));
  };
  const auto stand_still = [&](Mode mode) {
    end_arm_move(), end_jaw_move();
    way_ = Way::position;
    jaw_effort_.reset();
    goal_follows_ = true;
    order_arm(mode);
    if (arm_.has_jaw()) order_jaw(mode);
  };
  if (exchanging() && (command == "enable" || command == "home")) {
    return refuse("state_command " + command, "its tool is being exchanged");
  }
  if (command == "enable") {
    if (state_ == OperatingState::paused) return invalid();
    if (!measured_.valid) return refuse("state_command enable", "its joints are not in the scene");
    if (state_ != OperatingState::enabled) enable();
  } else if (command == "disable") {
    if (state_ != OperatingState::disabled) stand_still(arm_.brakes ? Mode::hold : Mode::off);
    state_ = OperatingState::disabled;
    if (locked_) unlock_orientation();
  } else if (command == "pause") {
    if (state_ != OperatingState::enabled && state_ != OperatingState::paused) return invalid();
    if (state_ == OperatingState::enabled) stand_still(Mode::hold);
    state_ = OperatingState::paused;
  } else if (command == "resume") {
    if (state_ != OperatingState::paused) return invalid();
    state_ = OperatingState::enabled;
  } else if (command == "home") {
    if (state_ != OperatingState::enabled && state_ != OperatingState::disabled) return invalid();
    if (!measured_.valid) return refuse("state_command home", "its joints are not in the scene");
    if (state_ == OperatingState::disabled) enable();
    start_homing();
    return {};
  } else if (command == "unhome") {
    if (homed_ || homing_) {
      homed_ = false;
      const bool moves = busy();
      if (moves && state_ == OperatingState::enabled) stand_still(Mode::hold);
      if (!moves) tell_state();
    }
    return {};
  } else {
    return refuse("state_command " + command.substr(0, 40),
                  "it is unknown; known: enable, disable, pause, resume, home, unhome");
  }
  if (state_ != before) tell_state();
  return {};
}

void ArmControl::start_homing() {
  if (homing_) return;
  leave_effort();
  const bool moves = !homed_ && arm_.homing_moves;
  goal_ = moves ? arm_.kinematics.home : goal();
  goal_follows_ = false;
  homing_ = true;
  way_ = Way::position;
  std::copy(goal_.begin(), goal_.end(), command_.values.begin());
  order_arm(Mode::move);
  tell_state();
}

// What set-points start from, should the arm leave what it exerts: where it is.
void ArmControl::leave_effort() {
  if (way_ == Way::position || way_ == Way::velocity) return;
  goal_ = measured_joints();
  for (std::size_t i = 0; i < size(); ++i) {
    goal_[i] = std::clamp(goal_[i], arm_.kinematics.lower[i], arm_.kinematics.upper[i]);
  }
  goal_follows_ = false;
}

std::string ArmControl::check(const char* command, const Joints& values, bool move) {
  std::string why = not_ready();
  if (why.empty() && values.size() != size()) {
    why = "it has " + std::to_string(values.size()) + " values; expected " + std::to_string(size()) + ": " +
          listed(arm_.kinematics.names);
  }
  if (why.empty() && !all_finite(values)) why = "a value is not finite";
  return why.empty() ? why : refuse(command, why, move);
}

std::string ArmControl::check(const char* command, const math::Pose& pose, bool move) {
  std::string why = not_ready();
  if (why.empty() && !math::is_finite(pose)) why = "a value is not finite";
  if (why.empty() && std::abs(math::norm(pose.orientation) - 1.0) > kUnitTolerance) {
    why = "the orientation is no unit quaternion";
  }
  return why.empty() ? why : refuse(command, why, move);
}

Joints ArmControl::clipped(const char* command, Joints position) {
  for (std::size_t i = 0; i < size(); ++i) {
    const double inside = std::clamp(position[i], arm_.kinematics.lower[i], arm_.kinematics.upper[i]);
    if (inside != position[i]) warn(std::string(command) + " was clipped to the limits of " + arm_.kinematics.names[i]);
    position[i] = inside;
  }
  return position;
}

void ArmControl::set(const Joints& position) {
  end_arm_move();
  way_ = Way::position;
  goal_ = position;
  goal_follows_ = false;
  std::copy(position.begin(), position.end(), command_.values.begin());
  order_arm(Mode::position);
  set_point_ns_ = measured_.stamp_ns;
}

void ArmControl::start_move(const Joints& position) {
  way_ = Way::position;
  goal_ = position;
  goal_follows_ = false;
  homing_ = false;
  std::copy(position.begin(), position.end(), command_.values.begin());
  order_arm(Mode::move);
  arm_moves_ = true;
  set_point_ns_ = measured_.stamp_ns;
  tell_state();
}

std::string ArmControl::servo_jp(const Joints& position) {
  if (std::string why = check("servo_jp", position, false); !why.empty()) return why;
  set(clipped("servo_jp", position));
  return {};
}

std::string ArmControl::servo_jr(const Joints& change) {
  if (std::string why = check("servo_jr", change, false); !why.empty()) return why;
  leave_effort();
  Joints position = goal();
  for (std::size_t i = 0; i < size(); ++i) position[i] += change[i];
  set(clipped("servo_jr", position));
  return {};
}

std::string ArmControl::hold() {
  if (std::string why = not_ready(); !why.empty()) return refuse("hold", why);
  end_arm_move();
  way_ = Way::position;
  goal_follows_ = true;
  order_arm(Mode::hold);
  set_point_ns_ = measured_.stamp_ns;
  return {};
}

std::string ArmControl::free() { return servo_jf(Joints(size(), 0.0)); }

std::string ArmControl::move_jp(const Joints& position) {
  if (std::string why = check("move_jp", position, true); !why.empty()) return why;
  start_move(clipped("move_jp", position));
  return {};
}

std::string ArmControl::move_jr(const Joints& change) {
  if (std::string why = check("move_jr", change, true); !why.empty()) return why;
  leave_effort();
  Joints position = goal();
  for (std::size_t i = 0; i < size(); ++i) position[i] += change[i];
  start_move(clipped("move_jr", position));
  return {};
}

math::Pose ArmControl::set_pose() const { return T_frame_base_ * local_pose(goal()); }

std::string ArmControl::go_to(const char* command, const math::Pose& pose, bool move) {
  math::Pose wanted = pose;
  wanted.orientation = math::normalized(wanted.orientation);
  const kinematics::Answer answer =
      kinematics::inverse(arm_.kinematics, math::inverse(T_frame_base_) * wanted, set_position());
  if (answer.reached() || (!move && answer.status == kinematics::Status::out_of_limits)) {
    if (!answer.reached()) {
      warn(std::string(command) + " was clipped to the limits of " +
           arm_.kinematics.names[static_cast<std::size_t>(std::max(answer.joint, 0))]);
    }
    move ? start_move(answer.joints) : set(answer.joints);
    return {};
  }
  if (answer.status == kinematics::Status::out_of_limits) {
    return refuse(command,
                  "joint " + arm_.kinematics.names[static_cast<std::size_t>(std::max(answer.joint, 0))] +
                      " would leave its limits by " + std::to_string(answer.excess),
                  move);
  }
  return refuse(command,
                "the pose cannot be reached; the nearest one is " + std::to_string(answer.distance) + " m away", move);
}

std::string ArmControl::servo_cp(const math::Pose& pose) {
  if (std::string why = check("servo_cp", pose, false); !why.empty()) return why;
  if (view_lost_) return refuse("servo_cp", kNoView);
  leave_effort();
  return go_to("servo_cp", pose, false);
}

std::string ArmControl::servo_cr(const math::Pose& change) {
  if (std::string why = check("servo_cr", change, false); !why.empty()) return why;
  leave_effort();
  return go_to("servo_cr", set_pose() * change, false);
}

std::string ArmControl::move_cp(const math::Pose& pose) {
  if (std::string why = check("move_cp", pose, true); !why.empty()) return why;
  if (view_lost_) return refuse("move_cp", kNoView, true);
  leave_effort();
  return go_to("move_cp", pose, true);
}

std::string ArmControl::move_cr(const math::Pose& change) {
  if (std::string why = check("move_cr", change, true); !why.empty()) return why;
  leave_effort();
  return go_to("move_cr", set_pose() * change, true);
}

}  // namespace ambf::crtk
