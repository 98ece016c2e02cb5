// What one arm does: its operating state, and what it is commanded to do (docs/crtk.md). Its set-points move in the
// simulation (crtk/arm_motion.h); this knows neither ROS nor the simulation: it is given what frames show, and asked
// for commands. One thread at a time. C++17.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "adf/crtk_arms.h"
#include "crtk/arm_motion.h"
#include "kinematics/statics.h"

namespace ambf::crtk {

using kinematics::Joints;

enum class OperatingState { disabled, enabled, paused, fault };
const char* to_string(OperatingState state);  // "DISABLED" ...

inline constexpr const char* kNoView = "the arm in whose view poses are is not there; set_base_frame ends the view";

// News for others, in this order.
struct Event {
  enum class Kind {
    state,
    goal_reached,        // `yes`
    orientation_locked,  // `yes`
    tool,                // `text`
    tool_request,
    endoscope,  // `text`
    status,
    warning,
    error
  } kind = Kind::state;
  OperatingState state = OperatingState::disabled;
  bool homed = false, busy = false;
  bool yes = false;
  std::string text{};
};

// An arm as of one frame. Lists are by joint of the kinematics, then the opening of the jaw.
struct Measured {
  bool valid = false;
  Joints position, velocity, effort;
  ArmMotion motion;     // set-points
  bool active = false;  // the simulation obeys commands of this arm
  bool stands = false;  // the world does: it is paused, or waits for a client's steps
  double sim_time = 0.0;
  std::uint64_t epoch = 0;
  std::int64_t stamp_ns = 0;  // of what clients call time
};

enum class WrenchFrame { body, spatial };

// crtk_msgs/CartesianImpedance. A force (N, Nm) for each axis of a frame: p x (distance from the centre, less the
// deadband) + d x velocity + bias, by other gains on either side of the centre; nothing within the deadband.
struct Impedance {
  struct Side {
    math::Vec3 p, d, bias, deadband;
  };
  math::Quat force_orientation;
  math::Vec3 force_position;
  math::Quat torque_orientation;
  Side position_positive, position_negative, orientation_positive, orientation_negative;
};

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
  std::string servo_cv(const math::Twist& twist);  // of the tip, along the axes of the arm's frame
  std::string servo_cf(WrenchFrame frame, const math::Wrench& wrench);
  std::string servo_ci(const Impedance& impedance);
  std::string move_jp(const Joints& position);
  std::string move_jr(const Joints& change);
  std::string move_cp(const math::Pose& pose);
  std::string move_cr(const math::Pose& change);
  std::string hold();
  std::string free();
  std::string lock_orientation(const math::Quat& orientation);
  std::string unlock_orientation();
  std::string jaw_servo_jp(double opening);
  std::string jaw_servo_jf(double effort);
  std::string jaw_move_jp(double opening);
  std::string set_base_frame(const math::Pose& T_frame_base);
  // A tool with an instrument (adf::CrtkArm::instruments) is the arm's once exchanged() says so; until then commands
  // are refused, and the arm keeps its place.
  std::string set_tool_type(const std::string& tool);
  std::string set_endoscope_type(const std::string& type);
  // Share of the trajectory limits, ]0, 1].
  std::string set_ratio(bool velocity, bool acceleration, double ratio);
  void set_wrench_axes_absolute(bool absolute) { wrench_absolute_ = absolute; }

  // A command that was never fit to act on; returns `why`. `move`: its sender waits for an end.
  std::string refuse(const std::string& command, const std::string& why, bool move = false);
  // On the topic `status`.
  void say(const std::string& text) { report(Event::Kind::status, text); }
  // The present state, for who comes later.
  Event state_event() const { return {Event::Kind::state, state_, homed_, busy()}; }

  // A newer frame.
  void update(const Measured& measured, std::int64_t now_ns);
  // The simulation has the arm (again): it knows nothing of it yet.
  void bound();
  // Until a client sets a base frame, the arm's frame is what another arm sees, with this name. Nothing: that arm is
  // not there, so that poses in its view are not known.
  void see_from(const std::string& frame, const std::optional<math::Pose>& T_view_base);
  // What set_tool_type has begun: the model shall get that tool's instrument, once the arm rests. Given once.
  struct Exchange {
    std::string tool;
    std::uint64_t number = 0;  // of the request: a fault ends one, and another may follow before its outcome is there
  };
  std::optional<Exchange> take_exchange();
  bool exchanging() const { return !next_tool_.empty(); }
  bool exchanging(std::uint64_t number) const { return exchanging() && number == exchange_number_; }
  // Whether the simulation keeps the joints that stay and they rest, so that the instrument may go. Its own joints need
  // not: it is put where they are.
  bool may_exchange() const;
  void exchanged();                               // the model has it
  void not_exchanged(const std::string& reason);  // the model is as it was
  // Its joints are gone; `reason` goes to all.
  void fault(const std::string& reason);
  // What the simulation shall obey from now on; nothing: what it was given last.
  std::optional<ArmCommand> take_command();

  const adf::CrtkArm& description() const { return arm_; }
  const Measured& measured() const { return measured_; }
  OperatingState state() const { return state_; }
  bool homed() const { return homed_; }
  bool busy() const { return arm_moves_ || jaw_moves_ || homing_; }
  double ratio_velocity() const { return command_.ratio_velocity; }
  double ratio_acceleration() const { return command_.ratio_acceleration; }
  bool orientation_locked() const { return locked_.has_value(); }
  const std::string& endoscope_type() const { return endoscope_; }

  bool has_set_point() const { return set_point_ns_ != 0; }
  std::int64_t set_point_ns() const { return set_point_ns_; }  // as Measured::stamp_ns; 0: never enabled
  bool holds_position() const { return way_ == Way::position; }
  bool holds_velocity() const { return way_ == Way::velocity; }
  bool jaw_holds_position() const { return !jaw_effort_; }
  bool arm_moves() const { return arm_moves_ || homing_; }
  Joints set_position() const;  // of the arm's joints, as are the next four
  Joints set_velocity() const;
  Joints set_effort() const;
  Joints goal() const;
  double jaw_position() const { return set_axis(size()); }
  double jaw_velocity() const { return measured_.motion.velocity[size()]; }
  double jaw_effort() const { return jaw_effort_.value_or(0.0); }

  math::Pose base_frame() const { return T_frame_base_; }
  bool knows_base_frame() const { return !view_lost_; }
  const std::string& frame() const { return frame_; }  // frame_id of poses
  math::Pose local_pose(const Joints& joints) const { return kinematics::forward(arm_.kinematics, joints); }
  Joints measured_joints() const { return joints_of(measured_.position); }
  Joints measured_velocities() const { return joints_of(measured_.velocity); }
  Joints measured_efforts() const { return joints_of(measured_.effort); }
  // 6 x n, row-major; spatial: along the axes of the arm's frame.
  std::vector<double> jacobian(WrenchFrame frame) const { return jacobian(frame, measured_joints()); }
  std::vector<double> jacobian(WrenchFrame frame, const Joints& joints) const;
  // What the measured efforts exert at the tip.
  kinematics::SixVector measured_wrench(WrenchFrame frame) const;

  std::vector<Event> take_events();

 private:
  enum class Way { position, velocity, effort, wrench, impedance };

  std::size_t size() const { return arm_.kinematics.size(); }
  Joints joints_of(const Joints& axes) const {
    return {axes.begin(), axes.begin() + static_cast<std::ptrdiff_t>(size())};
  }
  std::string not_ready() const;
  void warn(const std::string& text);
  void report(Event::Kind kind, const std::string& text, bool yes = false);
  void tell_state(bool busy);
  void tell_state() { tell_state(busy()); }
  void enable();
  void start_homing();
  void end_arm_move();
  void end_jaw_move();
  std::string check(const char* command, const Joints& values, bool move);
  std::string check(const char* command, const math::Pose& pose, bool move);
  void set(const Joints& position);
  void start_move(const Joints& position);
  Joints clipped(const char* command, Joints position);
  double clipped_jaw(double opening);
  std::string go_to(const char* command, const math::Pose& pose, bool move);
  math::Pose set_pose() const;
  double set_axis(std::size_t axis) const;
  bool pending() const { return command_.arm.number > measured_.motion.arm.order.number; }
  void order_arm(Mode mode) { command_.arm = {++last_number_, mode}, changed_ = true; }
  void order_jaw(Mode mode) { command_.jaw = {++last_number_, mode}, changed_ = true; }
  void rest();
  void leave_effort();
  void exert();
  void take_over(const ArmMotion& motion);
  void finish_moves();
  void use_tool(const kinematics::Arm& tool);
  void keep_place();
  bool goes_with_instrument(std::size_t joint) const;
  void note_state();
  const kinematics::Arm* find_tool(const std::string& name) const;
  math::Wrench impedance_wrench() const;
  Joints locked_joints() const;

  adf::CrtkArm arm_;
  OperatingState state_ = OperatingState::disabled;
  bool homed_ = false;
  bool homing_ = false, arm_moves_ = false, jaw_moves_ = false;
  Way way_ = Way::position;
  bool wrench_absolute_ = false;
  math::Pose T_frame_base_;
  std::string frame_;
  bool view_lost_ = false, view_refused_ = false;  // refused: a client has set another base frame
  Measured measured_;
  ArmCommand command_;
  bool changed_ = false;  // command_ is to be given to the simulation
  std::uint64_t last_number_ = 0;
  Joints goal_;
  bool goal_follows_ = true;  // the goal is the set-point
  Joints effort_;
  std::optional<double> jaw_effort_;
  WrenchFrame wrench_frame_ = WrenchFrame::body;
  math::Wrench wrench_;
  math::Twist twist_;
  double twist_left_s_ = 0.0;
  Impedance impedance_;
  std::optional<math::Quat> locked_;
  std::string endoscope_;
  std::string next_tool_;  // of an exchange that has not ended
  bool exchange_taken_ = false;
  std::uint64_t exchange_number_ = 0;
  std::int64_t set_point_ns_ = 0, now_ns_ = 0;
  std::vector<Event> events_;
  std::map<std::string, std::int64_t> warned_ns_;
};

}  // namespace ambf::crtk
