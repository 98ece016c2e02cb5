// What an arm publishes. Used under its ServedArm's lock, but for making and ending it. C++17.
#pragma once

#include <crtk_msgs/OperatingState.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <geometry_msgs/WrenchStamped.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/Joy.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Empty.h>
#include <std_msgs/Float64.h>
#include <std_msgs/Float64MultiArray.h>
#include <std_msgs/String.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "crtk/arm_control.h"
#include "crtk/stamps.h"
#include "ros_comm/endpoints/topics.h"

namespace ambf::crtk {

class ArmTopics {
 public:
  // Throws when ROS does not take a topic.
  ArmTopics(ros_comm::Node& node, const std::string& prefix, const adf::CrtkArm& arm, const Stamps& stamps);

  void publish(const std::vector<Event>& events);
  // Measured values and set-points. `gripper`: its opening, rad.
  void publish(const ArmControl& control, std::optional<double> gripper);
  // What is latched and changes rarely.
  void publish_latched(const ArmControl& control);

 private:
  template <class Message>
  using Topic = ros_comm::TopicPublisher<Message>;
  using Joints = Topic<sensor_msgs::JointState>;
  using Pose = Topic<geometry_msgs::PoseStamped>;
  using Twist = Topic<geometry_msgs::TwistStamped>;
  using Wrench = Topic<geometry_msgs::WrenchStamped>;
  using Matrix = Topic<std_msgs::Float64MultiArray>;
  using Text = Topic<std_msgs::String>;
  using Number = Topic<std_msgs::Float64>;
  using Switch = Topic<std_msgs::Bool>;
  using Signal = Topic<std_msgs::Empty>;
  using Button = Topic<sensor_msgs::Joy>;

  void publish_joints(const ArmControl& control, ros::Time measured, ros::Time set);
  void publish_poses(const ArmControl& control, ros::Time measured, ros::Time set);
  void publish_velocities(const ArmControl& control, ros::Time measured, ros::Time set);
  void publish_wrenches(const ArmControl& control, ros::Time measured);
  void publish_jaw(const ArmControl& control, ros::Time measured, ros::Time set);
  void publish_gripper(double opening, ros::Time measured);

  const std::vector<std::string> names_;
  const std::string local_frame_;
  std::string frame_;
  Joints measured_js_, setpoint_js_, goal_js_;
  Pose measured_cp_, setpoint_cp_, goal_cp_, local_measured_cp_, local_setpoint_cp_;
  Twist measured_cv_, local_measured_cv_, setpoint_cv_, local_setpoint_cv_;
  Wrench body_measured_cf_, spatial_measured_cf_;
  Matrix body_jacobian_, spatial_jacobian_;
  Topic<crtk_msgs::OperatingState> operating_state_;
  Text desired_state_, error_, warning_, status_;
  Switch goal_reached_;
  Number ratio_, ratio_v_, ratio_a_;
  // Of some arms only.
  std::unique_ptr<Text> tool_type_, endoscope_type_;
  std::unique_ptr<Signal> tool_type_request_, gripper_pinch_;
  std::unique_ptr<Joints> jaw_measured_js_, jaw_setpoint_js_, gripper_measured_js_;
  std::unique_ptr<Switch> gripper_closed_, orientation_locked_;
  std::vector<std::unique_ptr<Button>> buttons_;
  std::optional<bool> was_closed_;
  double closed_below_ = 0.0;
  ros::Time closed_at_;
  const Stamps& stamps_;
  ros::Time last_state_;
};

}  // namespace ambf::crtk
