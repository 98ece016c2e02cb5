// What one arm does: its operating state, its set-points, its trajectories (docs/crtk.md). Knows neither ROS nor the
// simulation: it is given what is measured, and asked for what the joints shall do. One thread at a time. C++17.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "adf/crtk_arms.h"
#include "crtk/joint_motion.h"
#include "state/frame.h"

namespace ambf::crtk {

using kinematics::Joints;

enum class OperatingState { disabled, enabled, paused, fault };
const char* to_string(OperatingState state);  // "DISABLED" ...

// News for others, in this order.
struct Event {
  enum class Kind { state, goal_reached, status, warning, error } kind = Kind::state;
  OperatingState state = OperatingState::disabled;
  bool homed = false, busy = false;
  bool reached = false;
  std::string text;
};

// An arm as of one frame. Lists are by joint of the kinematics, then the opening of the jaw if there is one.
struct Measured {
  bool valid = false;
  Joints position, velocity;
  double sim_time = 0.0, step_s = 1e-3;
  std::uint64_t epoch = 0;
  std::int64_t stamp_ns = 0;  // system clock
};

// What a joint shall do: keep a position, or exert an effort (Nm, N).
struct Target {
  state::JointCommandType type = state::JointCommandType::none;
  double value = 0.0;
};

enum class WrenchFrame { body, spatial };

class ArmControl {
 public:
  explicit ArmControl(const adf::CrtkArm& arm);

  // Each of these returns why nothing was done, or "". A refused move shows as busy for a moment, for clients wait for
  // that. Poses are those of the tip in the arm's frame (T_frame_base); relative ones are in the tip's frame.
  std::string state_command(const std::string& command);
  std::string servo_jp(const Joints& position);
  std::string servo_jr(const Joints& change);
  std::string servo_jf(const Joints& effort);
  std::string servo_cp(const math::Pose& pose);
  std::string servo_cr(const math::Pose& change);
  std::string servo_cf(WrenchFrame frame, const math::Wrench& wrench);
  std::string move_jp(const Joints& position);
  std::string move_jr(const Joints& change);
  std::string move_cp(const math::Pose& pose);
  std::string move_cr(const math::Pose& change);
  std::string hold();
  std::string free();
  std::string jaw_servo_jp(double opening);
  std::string jaw_servo_jf(double effort);
  std::string jaw_move_jp(double opening);
  std::string set_base_frame(const math::Pose& T_frame_base);
  // Share of the trajectory limits, ]0, 1].
  std::string set_ratio(bool velocity, bool acceleration, double ratio);
  void set_wrench_axes_absolute(bool absolute) { wrench_absolute_ = absolute; }

  // A command that was never fit to act on; returns `why`. `move`: its sender waits for an end.
  std::string refuse(const std::string& command, const std::string& why, bool move = false);
  // On the topic `status`.
  void say(const std::string& text) { events_.push_back({Event::Kind::status, {}, false, false, false, text}); }
  // The present state, for who comes later.
  Event state_event() const { return {Event::Kind::state, state_, homed_, busy(), false, {}}; }

  // A newer frame: trajectories advance by the time that was simulated since the last one.
  void update(const Measured& measured, std::int64_t now_ns);
  // Its joints are gone; `reason` goes to all.
  void fault(const std::string& reason);

  const adf::CrtkArm& description() const { return arm_; }
  const Measured& measured() const { return measured_; }
  OperatingState state() const { return state_; }
  bool homed() const { return homed_; }
  bool busy() const { return arm_moves_ || jaw_moves_ || homing_; }
  double ratio_velocity() const { return ratio_velocity_; }
  double ratio_acceleration() const { return ratio_acceleration_; }

  bool has_set_point() const { return set_point_ns_ != 0; }
  std::int64_t set_point_ns() const { return set_point_ns_; }  // system clock; 0: never enabled
  bool holds_position() const { return mode_ == Mode::position; }
  bool jaw_holds_position() const { return !jaw_effort_mode_; }
  bool arm_moves() const { return arm_moves_; }
  Joints set_position() const;  // of the arm's joints, as are the next three
  Joints set_velocity() const;
  Joints set_effort() const;
  Joints goal() const;
  double jaw_position() const { return motion_.back().position; }
  double jaw_velocity() const { return motion_.back().velocity; }
  double jaw_effort() const { return jaw_effort_; }

  math::Pose base_frame() const { return T_frame_base_; }
  math::Pose local_pose(const Joints& joints) const { return kinematics::forward(arm_.kinematics, joints); }
  Joints measured_joints() const;
  Joints measured_velocities() const;
  // 6 x n, row-major; spatial: along the axes of the arm's frame.
  std::vector<double> jacobian(WrenchFrame frame) const;

  // By joint, then the jaw; empty: the arm exerts nothing.
  std::vector<Target> targets() const;
  std::vector<Event> take_events();

 private:
  enum class Mode { position, effort, wrench };

  std::size_t size() const { return arm_.kinematics.size(); }
  std::string not_ready() const;
  void warn(const std::string& text);
  void tell_state(bool busy);
  void tell_state() { tell_state(busy()); }
  void tell_reached(bool reached);
  void enable();
  void start_homing();
  void preempt_arm();
  void preempt_jaw();
  void rest_at_measured();
  void leave_effort();
  std::string check(const char* command, const Joints& values, bool move);
  std::string check(const char* command, const math::Pose& pose, bool move);
  void set(const Joints& position);
  void start_move(const Joints& position);
  Joints clipped(const char* command, Joints position);
  double clipped_jaw(double opening);
  bool solve(const math::Pose& pose, kinematics::Answer& answer) const;
  std::string go_to(const char* command, const math::Pose& pose, bool move);
  math::Pose set_pose() const;
  void advance_step(double h_s);
  void finish_moves(double passed_s);
  bool near_goal(std::size_t first, std::size_t last) const;
  void stamp() { set_point_ns_ = measured_.stamp_ns; }

  const adf::CrtkArm arm_;
  OperatingState state_ = OperatingState::disabled;
  bool homed_ = false;
  bool homing_ = false, arm_moves_ = false, jaw_moves_ = false;
  Mode mode_ = Mode::position;
  bool jaw_effort_mode_ = false, wrench_absolute_ = false;
  math::Pose T_frame_base_;
  Measured measured_;
  std::vector<JointMotion> motion_;  // set-points: joints, then the jaw (always there)
  std::vector<MotionLimits> limits_;
  Joints goal_;  // the same
  Joints effort_;
  double jaw_effort_ = 0.0, settling_s_ = 0.0;
  double ratio_velocity_ = 1.0, ratio_acceleration_ = 1.0;
  WrenchFrame wrench_frame_ = WrenchFrame::body;
  math::Wrench wrench_;
  std::int64_t set_point_ns_ = 0, now_ns_ = 0;
  std::vector<Event> events_;
  std::map<std::string, std::int64_t> warned_ns_;
};

}  // namespace ambf::crtk
