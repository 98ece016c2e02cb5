#include "dvrk_arm/arm_messages.h"

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <ros/serialization.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/Joy.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Float64.h>
#include <std_msgs/String.h>

#include <algorithm>
#include <cmath>

#include "ros_comm/message_lengths.h"

namespace ambf::dvrk_arm {

// crtk_msgs is not among Debian's packages; this message of it is all that is needed.
struct OperatingState {
  std_msgs::Header header;
  std::string state;
  std::uint8_t is_homed = 0, is_busy = 0;
};

}  // namespace ambf::dvrk_arm

namespace ros::serialization {

template <>
struct Serializer<ambf::dvrk_arm::OperatingState> {
  template <typename Stream, typename T>
  inline static void allInOne(Stream& stream, T message) {
    stream.next(message.header);
    stream.next(message.state);
    stream.next(message.is_homed);
    stream.next(message.is_busy);
  }
  ROS_DECLARE_ALLINONE_SERIALIZER
};

}  // namespace ros::serialization

namespace ambf::dvrk_arm {

namespace {

template <class M, class Use>
std::string decoded(const Message& message, const Use& use) {
  if (std::string problem = ros_comm::problem_of_lengths<M>(message.bytes, message.size); !problem.empty())
    return problem;
  // The stream reads only; its type has no const form.
  ros::serialization::IStream stream(const_cast<std::uint8_t*>(message.bytes),
                                     static_cast<std::uint32_t>(message.size));
  M value;
  ros::serialization::deserialize(stream, value);
  use(value);
  return {};
}

std::string unknown(const Message& message, const char* wanted) {
  return "a message of type " + message.type + ", where " + wanted + " is wanted";
}

math::Vec3 vector_of(const geometry_msgs::Vector3& v) { return {v.x, v.y, v.z}; }
math::Vec3 vector_of(const geometry_msgs::Point& p) { return {p.x, p.y, p.z}; }
math::Quat quaternion_of(const geometry_msgs::Quaternion& q) { return {q.x, q.y, q.z, q.w}; }
math::Pose pose_of(const geometry_msgs::Pose& p) { return {vector_of(p.position), quaternion_of(p.orientation)}; }
math::Pose pose_of(const geometry_msgs::Transform& t) { return {vector_of(t.translation), quaternion_of(t.rotation)}; }
math::Twist twist_of(const geometry_msgs::Twist& t) { return {vector_of(t.linear), vector_of(t.angular)}; }
std::int64_t nanoseconds(const ros::Time& time) { return static_cast<std::int64_t>(time.toNSec()); }

bool starts_with(const std::string& text, const char* part) { return text.rfind(part, 0) == 0; }

}  // namespace

std::string read_pose(const Message& message, StampedPose& pose) {
  if (message.type == "geometry_msgs/PoseStamped") {
    return decoded<geometry_msgs::PoseStamped>(message, [&](const auto& m) {
      pose = {pose_of(m.pose), nanoseconds(m.header.stamp), true};
    });
  }
  if (message.type == "geometry_msgs/TransformStamped") {
    return decoded<geometry_msgs::TransformStamped>(message, [&](const auto& m) {
      pose = {pose_of(m.transform), nanoseconds(m.header.stamp), true};
    });
  }
  if (message.type == "geometry_msgs/Pose") {
    return decoded<geometry_msgs::Pose>(message, [&](const auto& m) { pose = {pose_of(m), 0, false}; });
  }
  if (message.type == "geometry_msgs/Transform") {
    return decoded<geometry_msgs::Transform>(message, [&](const auto& m) { pose = {pose_of(m), 0, false}; });
  }
  return unknown(message, "a pose or transform");
}

std::string read_twist(const Message& message, math::Twist& twist) {
  if (message.type == "geometry_msgs/TwistStamped") {
    return decoded<geometry_msgs::TwistStamped>(message, [&](const auto& m) { twist = twist_of(m.twist); });
  }
  if (message.type == "geometry_msgs/Twist") {
    return decoded<geometry_msgs::Twist>(message, [&](const auto& m) { twist = twist_of(m); });
  }
  return unknown(message, "a twist");
}

std::string read_joy(const Message& message, JoyValues& joy) {
  if (message.type != "sensor_msgs/Joy") return unknown(message, "a Joy");
  return decoded<sensor_msgs::Joy>(message, [&](const auto& m) {
    joy.axes.assign(m.axes.begin(), m.axes.end());
    joy.buttons = 0;
    for (std::size_t i = 0; i < m.buttons.size() && i < 64; ++i) {
      if (m.buttons[i] != 0) joy.buttons |= std::uint64_t{1} << i;
    }
  });
}

std::string read_switch(const Message& message, bool& on) {
  if (message.type == "std_msgs/Bool") {
    return decoded<std_msgs::Bool>(message, [&](const auto& m) { on = m.data != 0; });
  }
  if (message.type != "sensor_msgs/Joy") return unknown(message, "a Joy or Bool");
  // A quick tap (2) comes after its release: the pedal is up again.
  return decoded<sensor_msgs::Joy>(message, [&](const auto& m) { on = !m.buttons.empty() && m.buttons.front() == 1; });
}

std::string read_angle(const Message& message, double& angle_rad) {
  if (message.type == "std_msgs/Float64") {
    return decoded<std_msgs::Float64>(message, [&](const auto& m) { angle_rad = m.data; });
  }
  if (message.type != "sensor_msgs/JointState") return unknown(message, "a JointState or Float64");
  bool empty = false;
  const std::string problem = decoded<sensor_msgs::JointState>(message, [&](const auto& m) {
    empty = m.position.empty();
    if (!empty) angle_rad = m.position.front();
  });
  return !problem.empty() ? problem : empty ? "a JointState without a position" : "";
}

std::string read_joints(const Message& message, MtmJoints& position, MtmJoints& velocity) {
  if (message.type != "sensor_msgs/JointState") return unknown(message, "a JointState");
  bool whole = false;
  const std::string problem = decoded<sensor_msgs::JointState>(message, [&](const auto& m) {
    const auto finite = [](const auto& values) {
      return values.size() == kMtmJoints &&
             std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
    };
    whole = finite(m.position) && (m.velocity.empty() || finite(m.velocity));
    if (!whole) return;
    std::copy(m.position.begin(), m.position.end(), position.begin());
    velocity.fill(0.0);
    std::copy(m.velocity.begin(), m.velocity.end(), velocity.begin());
  });
  return !problem.empty() ? problem : whole ? "" : "a JointState that has not seven finite positions";
}

std::string read_state(const Message& message, const char*& why) {
  constexpr const char* kDisabled = "the arm is not enabled";
  constexpr const char* kNotHomed = "the arm is not homed";
  if (message.type == "std_msgs/String") {
    return decoded<std_msgs::String>(message, [&](const auto& m) {
      const bool usable = m.data == "ENABLED" || starts_with(m.data, "DVRK_READY") ||
                          starts_with(m.data, "DVRK_POSITION") || starts_with(m.data, "DVRK_EFFORT");
      why = usable ? "" : kDisabled;
    });
  }
  if (message.type != "crtk_msgs/OperatingState" && message.type != "crtk_msgs/operating_state")
    return unknown(message, "an OperatingState or String");
  return decoded<OperatingState>(message, [&](const auto& m) {
    why = m.state != "ENABLED" ? kDisabled : m.is_homed == 0 ? kNotHomed : "";
  });
}

}  // namespace ambf::dvrk_arm
