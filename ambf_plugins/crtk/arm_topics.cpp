#include "crtk/arm_topics.h"

#include <algorithm>

#include "math/rotation.h"
#include "ros_comm/endpoints/conversions.h"

namespace ambf::crtk {

namespace {

constexpr std::uint32_t kQueue = 10, kStates = 100;
constexpr bool kLatched = true;
constexpr double kPinch_s = 0.5;  // a handle that was closed for less was pinched

ros::Time stamp_of(std::int64_t system_ns) {
  if (system_ns <= 0) return {};
  return ros::Time(static_cast<std::uint32_t>(system_ns / 1'000'000'000),
                   static_cast<std::uint32_t>(system_ns % 1'000'000'000));
}

geometry_msgs::PoseStamped posed(const math::Pose& pose, ros::Time stamp, const std::string& frame) {
  geometry_msgs::PoseStamped message;
  message.header.stamp = stamp;
  message.header.frame_id = frame;
  message.pose = ros_comm::to_ros(pose);
  return message;
}

geometry_msgs::TwistStamped moving(const std::vector<double>& matrix, const kinematics::Joints& rates, ros::Time stamp,
                                   const std::string& frame) {
  double twist[6] = {};
  for (std::size_t row = 0; row < 6; ++row) {
    for (std::size_t i = 0; i < rates.size(); ++i) twist[row] += matrix[row * rates.size() + i] * rates[i];
  }
  geometry_msgs::TwistStamped message;
  message.header.stamp = stamp;
  message.header.frame_id = frame;
  message.twist = ros_comm::to_ros(math::Twist{{twist[0], twist[1], twist[2]}, {twist[3], twist[4], twist[5]}});
  return message;
}

sensor_msgs::JointState joints(const std::vector<std::string>& names, ros::Time stamp, const std::string& frame) {
  sensor_msgs::JointState message;
  message.header.stamp = stamp;
  message.header.frame_id = frame;
  message.name = names;
  return message;
}

std_msgs::Float64MultiArray matrix_message(const std::vector<double>& matrix) {
  std_msgs::Float64MultiArray message;
  message.layout.dim.resize(2);
  message.layout.dim[0].label = "rows", message.layout.dim[1].label = "columns";
  message.layout.dim[0].size = 6;
  message.layout.dim[0].stride = static_cast<std::uint32_t>(matrix.size());
  message.layout.dim[1].size = message.layout.dim[1].stride = static_cast<std::uint32_t>(matrix.size() / 6);
  message.data = matrix;
  return message;
}

std_msgs::String text(const std::string& value) {
  std_msgs::String message;
  message.data = value;
  return message;
}

std_msgs::Float64 number(double value) {
  std_msgs::Float64 message;
  message.data = value;
  return message;
}

std_msgs::Bool flag(bool value) {
  std_msgs::Bool message;
  message.data = value ? 1 : 0;
  return message;
}

}  // namespace

ArmTopics::ArmTopics(ros_comm::Node& node, const std::string& prefix, const adf::CrtkArm& arm, const Stamps& stamps)
    : names_(arm.kinematics.names),
      local_frame_(arm.name + "_local"),
      frame_(arm.frame),
      measured_js_(node, prefix + "/measured_js", kStates),
      setpoint_js_(node, prefix + "/setpoint_js", kStates),
      goal_js_(node, prefix + "/goal_js", kStates),
      measured_cp_(node, prefix + "/measured_cp", kStates),
      setpoint_cp_(node, prefix + "/setpoint_cp", kStates),
      goal_cp_(node, prefix + "/goal_cp", kStates),
      local_measured_cp_(node, prefix + "/local/measured_cp", kStates),
      local_setpoint_cp_(node, prefix + "/local/setpoint_cp", kStates),
      measured_cv_(node, prefix + "/measured_cv", kStates),
      local_measured_cv_(node, prefix + "/local/measured_cv", kStates),
      setpoint_cv_(node, prefix + "/setpoint_cv", kStates),
      local_setpoint_cv_(node, prefix + "/local/setpoint_cv", kStates),
      body_measured_cf_(node, prefix + "/body/measured_cf", kStates),
      spatial_measured_cf_(node, prefix + "/spatial/measured_cf", kStates),
      body_jacobian_(node, prefix + "/body/jacobian", kStates),
      spatial_jacobian_(node, prefix + "/spatial/jacobian", kStates),
      operating_state_(node, prefix + "/operating_state", kStates, kLatched),
      desired_state_(node, prefix + "/desired_state", kQueue, kLatched),
      error_(node, prefix + "/error", kQueue),
      warning_(node, prefix + "/warning", kQueue),
      status_(node, prefix + "/status", kQueue),
      goal_reached_(node, prefix + "/goal_reached", kQueue),
      ratio_(node, prefix + "/trajectory_j/ratio", kQueue, kLatched),
      ratio_v_(node, prefix + "/trajectory_j/ratio_v", kQueue, kLatched),
      ratio_a_(node, prefix + "/trajectory_j/ratio_a", kQueue, kLatched),
      stamps_(stamps) {
  const auto button = [&](const char* name, bool pressed) {
    buttons_.push_back(std::make_unique<Button>(node, prefix + "/" + name, kQueue, kLatched));
    sensor_msgs::Joy message;
    message.header.stamp = stamp_of(stamps_.now());
    message.buttons = {pressed ? 1 : 0};
    buttons_.back()->publish(message);
  };
  // Nobody presses them; an instrument is always there.
  if (arm.is_endoscope() || arm.has_jaw()) button("arm_clutch", false);
  if (arm.is_endoscope()) {
    endoscope_type_ = std::make_unique<Text>(node, prefix + "/endoscope_type", kQueue, kLatched);
  } else if (!arm.kinematics.tool.empty()) {
    tool_type_ = std::make_unique<Text>(node, prefix + "/tool_type", kQueue, kLatched);
    tool_type_request_ = std::make_unique<Signal>(node, prefix + "/tool_type_request", kQueue);
  }
  if (arm.has_jaw()) {
    button("IO/adapter", true), button("IO/tool", true);
    button("IO/arm_clutch", false), button("IO/SUJ_clutch", false);
  }
  if (arm.is_master()) {
    orientation_locked_ = std::make_unique<Switch>(node, prefix + "/orientation_locked", kQueue, kLatched);
  }
  if (arm.has_jaw()) {
    jaw_measured_js_ = std::make_unique<Joints>(node, prefix + "/jaw/measured_js", kStates);
    jaw_setpoint_js_ = std::make_unique<Joints>(node, prefix + "/jaw/setpoint_js", kStates);
  }
  if (arm.gripper) {
    gripper_measured_js_ = std::make_unique<Joints>(node, prefix + "/gripper/measured_js", kStates);
    gripper_closed_ = std::make_unique<Switch>(node, prefix + "/gripper/closed", kQueue, kLatched);
    gripper_pinch_ = std::make_unique<Signal>(node, prefix + "/gripper/pinch", kQueue);
    closed_below_ = arm.gripper->closed_below;
  }
}

void ArmTopics::publish(const std::vector<Event>& events) {
  for (const Event& event : events) {
    switch (event.kind) {
      case Event::Kind::state: {
        crtk_msgs::OperatingState message;
        // Clients drop what is not later than what they have.
        const ros::Time now = stamp_of(stamps_.now());
        last_state_ = now > last_state_ ? now : last_state_ + ros::Duration(0, 1);
        message.header.stamp = last_state_;
        message.header.frame_id = frame_;
        message.state = to_string(event.state);
        message.is_homed = event.homed ? 1 : 0;
        message.is_busy = event.busy ? 1 : 0;
        operating_state_.publish(message);
        desired_state_.publish(text(message.state));
        break;
      }
      case Event::Kind::goal_reached: goal_reached_.publish(flag(event.yes)); break;
      case Event::Kind::orientation_locked:
        if (orientation_locked_) orientation_locked_->publish(flag(event.yes));
        break;
      case Event::Kind::tool:
        if (tool_type_) tool_type_->publish(text(event.text));
        break;
      case Event::Kind::tool_request:
        if (tool_type_request_) tool_type_request_->publish(std_msgs::Empty());
        break;
      case Event::Kind::endoscope:
        if (endoscope_type_) endoscope_type_->publish(text(event.text));
        break;
      case Event::Kind::status: status_.publish(text(event.text)); break;
      case Event::Kind::warning: warning_.publish(text(event.text)); break;
      case Event::Kind::error: error_.publish(text(event.text)); break;
    }
  }
}

void ArmTopics::publish_latched(const ArmControl& control) {
  if (tool_type_) tool_type_->publish(text(control.description().kinematics.tool));
  if (endoscope_type_) endoscope_type_->publish(text(control.endoscope_type()));
  if (orientation_locked_) orientation_locked_->publish(flag(control.orientation_locked()));
  ratio_.publish(number(std::min(control.ratio_velocity(), control.ratio_acceleration())));
  ratio_v_.publish(number(control.ratio_velocity()));
  ratio_a_.publish(number(control.ratio_acceleration()));
}

void ArmTopics::publish(const ArmControl& control, std::optional<double> gripper) {
  // Stamp 0: not valid; it is said all the same, for clients take silence for a lost connection.
  const ros::Time measured = control.measured().valid ? stamp_of(control.measured().stamp_ns) : ros::Time();
  const ros::Time set = control.measured().valid ? stamp_of(control.set_point_ns()) : ros::Time();
  frame_ = control.frame();
  publish_joints(control, measured, set);
  publish_poses(control, measured, set);
  publish_velocities(control, measured, set);
  publish_wrenches(control, measured);
  if (jaw_measured_js_) publish_jaw(control, measured, set);
  if (gripper && gripper_measured_js_) publish_gripper(*gripper, measured);
}

void ArmTopics::publish_joints(const ArmControl& control, ros::Time measured, ros::Time set) {
  if (measured_js_.subscribers() > 0) {
    auto message = joints(names_, measured, frame_);
    message.position = control.measured_joints();
    message.velocity = control.measured_velocities();
    message.effort = control.measured_efforts();
    measured_js_.publish(message);
  }
  if (setpoint_js_.subscribers() > 0) {
    auto message = joints(names_, set, frame_);
    if (control.holds_position()) {
      message.position = control.has_set_point() ? control.set_position() : control.measured_joints();
      if (control.arm_moves()) message.velocity = control.set_velocity();
    } else if (control.holds_velocity()) {
      message.velocity = control.set_velocity();
    } else {
      message.effort = control.set_effort();
    }
    setpoint_js_.publish(message);
  }
  if (goal_js_.subscribers() > 0) {
    auto message = joints(names_, control.holds_position() ? set : ros::Time(), frame_);
    message.position = control.goal();
    goal_js_.publish(message);
  }
}

void ArmTopics::publish_poses(const ArmControl& control, ros::Time measured, ros::Time set) {
  const math::Pose base = control.base_frame();
  const bool known = control.knows_base_frame();
  const auto both = [&](Pose& in_frame, Pose* local, const kinematics::Joints& at, ros::Time stamp) {
    if (in_frame.subscribers() == 0 && (local == nullptr || local->subscribers() == 0)) return;
    const math::Pose tip = control.local_pose(at);
    in_frame.publish(posed(base * tip, known ? stamp : ros::Time(), frame_));
    if (local != nullptr) local->publish(posed(tip, stamp, local_frame_));
  };
  const ros::Time positioned = control.holds_position() ? set : ros::Time();
  both(measured_cp_, &local_measured_cp_, control.measured_joints(), measured);
  both(setpoint_cp_, &local_setpoint_cp_, control.has_set_point() ? control.set_position() : control.measured_joints(),
       positioned);
  both(goal_cp_, nullptr, control.goal(), positioned);
}

void ArmTopics::publish_velocities(const ArmControl& control, ros::Time measured, ros::Time set) {
  const auto local = [&](const kinematics::Joints& at) {
    return kinematics::jacobian(control.description().kinematics, at, kinematics::JacobianFrame::spatial);
  };
  if (measured_cv_.subscribers() > 0 || local_measured_cv_.subscribers() > 0 || spatial_jacobian_.subscribers() > 0) {
    const std::vector<double> spatial = control.jacobian(WrenchFrame::spatial);
    const kinematics::Joints rates = control.measured_velocities();
    measured_cv_.publish(moving(spatial, rates, control.knows_base_frame() ? measured : ros::Time(), frame_));
    local_measured_cv_.publish(moving(local(control.measured_joints()), rates, measured, local_frame_));
    spatial_jacobian_.publish(matrix_message(spatial));
  }
  if (body_jacobian_.subscribers() > 0) body_jacobian_.publish(matrix_message(control.jacobian(WrenchFrame::body)));
  if (setpoint_cv_.subscribers() == 0 && local_setpoint_cv_.subscribers() == 0) return;
  // Of the set-point's own motion: valid while it moves by itself.
  const bool moves = control.holds_velocity() || (control.holds_position() && control.arm_moves());
  const kinematics::Joints at = control.set_position(), rates = control.set_velocity();
  const ros::Time stamp = moves ? set : ros::Time();
  const ros::Time in_frame = control.knows_base_frame() ? stamp : ros::Time();
  setpoint_cv_.publish(moving(control.jacobian(WrenchFrame::spatial, at), rates, in_frame, frame_));
  local_setpoint_cv_.publish(moving(local(at), rates, stamp, local_frame_));
}

void ArmTopics::publish_wrenches(const ArmControl& control, ros::Time measured) {
  const auto publish = [&](const Wrench& topic, WrenchFrame frame) {
    if (topic.subscribers() == 0) return;
    const kinematics::SixVector w = control.measured_wrench(frame);
    geometry_msgs::WrenchStamped message;
    message.header.stamp = measured;
    message.header.frame_id = frame_;
    message.wrench = ros_comm::to_ros(math::Wrench{{w[0], w[1], w[2]}, {w[3], w[4], w[5]}});
    topic.publish(message);
  };
  publish(body_measured_cf_, WrenchFrame::body);
  publish(spatial_measured_cf_, WrenchFrame::spatial);
}

void ArmTopics::publish_jaw(const ArmControl& control, ros::Time measured, ros::Time set) {
  const std::vector<std::string> name = {"jaw"};
  if (jaw_measured_js_->subscribers() > 0) {
    auto message = joints(name, measured, frame_);
    message.position = {control.measured().position.back()};
    message.velocity = {control.measured().velocity.back()};
    message.effort = {control.measured().effort.back()};
    jaw_measured_js_->publish(message);
  }
  if (jaw_setpoint_js_->subscribers() == 0) return;
  auto message = joints(name, set, frame_);
  if (control.jaw_holds_position()) {
    message.position = {control.has_set_point() ? control.jaw_position() : control.measured().position.back()};
    message.velocity = {control.jaw_velocity()};
  } else {
    message.effort = {control.jaw_effort()};
  }
  jaw_setpoint_js_->publish(message);
}

void ArmTopics::publish_gripper(double opening, ros::Time measured) {
  if (gripper_measured_js_->subscribers() > 0) {
    auto message = joints({"gripper"}, measured, frame_);
    message.position = {opening};
    gripper_measured_js_->publish(message);
  }
  const bool closed = opening < closed_below_;
  if (was_closed_ == closed) return;
  const bool was_closed = was_closed_.value_or(false);
  was_closed_ = closed;
  gripper_closed_->publish(flag(closed));
  if (closed) closed_at_ = measured;
  if (was_closed && (measured - closed_at_).toSec() < kPinch_s) gripper_pinch_->publish(std_msgs::Empty());
}

}  // namespace ambf::crtk
