// Messages of arms, whichever of several types they use, and bytes that are none.
#include "dvrk_arm/arm_messages.h"

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <gtest/gtest.h>
#include <ros/serialization.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/Joy.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Float64.h>
#include <std_msgs/String.h>

#include <cmath>
#include <cstring>
#include <vector>

namespace ambf::dvrk_arm {
namespace {

struct Packed {
  std::vector<std::uint8_t> bytes;
  std::string type;
  Message message() const { return {type, bytes.data(), bytes.size()}; }
};

template <class M>
Packed packed(const M& value) {
  Packed out;
  out.type = ros::message_traits::DataType<M>::value();
  out.bytes.resize(ros::serialization::serializationLength(value));
  ros::serialization::OStream stream(out.bytes.data(), static_cast<std::uint32_t>(out.bytes.size()));
  ros::serialization::serialize(stream, value);
  return out;
}

// crtk_msgs/OperatingState as its definition has it: header, state, is_homed, is_busy.
Packed operating_state(const std::string& state, bool homed) {
  std_msgs::Header header;
  header.stamp = ros::Time(5, 6);
  std_msgs::String text;
  text.data = state;
  Packed out = packed(header);
  const Packed tail = packed(text);
  out.bytes.insert(out.bytes.end(), tail.bytes.begin(), tail.bytes.end());
  out.bytes.push_back(homed);
  out.bytes.push_back(0);
  out.type = "crtk_msgs/OperatingState";
  return out;
}

TEST(ArmMessages, PosesOfBothReleasesAreTheSame) {
  geometry_msgs::PoseStamped pose;
  pose.header.stamp = ros::Time(3, 4);
  pose.pose.position.x = 1.0;
  pose.pose.position.z = 3.0;
  pose.pose.orientation.w = 0.6;
  pose.pose.orientation.y = 0.8;
  geometry_msgs::TransformStamped transform;
  transform.header = pose.header;
  transform.transform.translation.x = 1.0;
  transform.transform.translation.z = 3.0;
  transform.transform.rotation = pose.pose.orientation;
  for (const Packed& one : {packed(pose), packed(transform)}) {
    StampedPose read;
    EXPECT_EQ(read_pose(one.message(), read), "");
    EXPECT_EQ(read.pose, (math::Pose{{1.0, 0.0, 3.0}, {0.0, 0.8, 0.0, 0.6}}));
    EXPECT_EQ(read.stamp_ns, 3'000'000'004);
  }
  StampedPose read;
  EXPECT_EQ(read_pose(packed(pose.pose).message(), read), "");
  EXPECT_FALSE(read.stamped);
  EXPECT_NE(read_pose(packed(std_msgs::Bool()).message(), read).find("std_msgs/Bool"), std::string::npos);
}

TEST(ArmMessages, StatesSayWhyAnArmCannotBeUsed) {
  const auto why_not = [](const Packed& one) {
    const char* why = "not read";
    EXPECT_EQ(read_state(one.message(), why), "");
    return std::string(why);
  };
  EXPECT_EQ(why_not(operating_state("ENABLED", true)), "");
  EXPECT_EQ(why_not(operating_state("ENABLED", false)), "the arm is not homed");
  EXPECT_EQ(why_not(operating_state("PAUSED", true)), "the arm is not enabled");
  EXPECT_EQ(why_not(operating_state("FAULT", true)), "the arm is not enabled");
  std_msgs::String old;
  old.data = "DVRK_EFFORT_CARTESIAN";
  EXPECT_EQ(why_not(packed(old)), "");
  old.data = "DVRK_UNINITIALIZED";
  EXPECT_EQ(why_not(packed(old)), "the arm is not enabled");
}

TEST(ArmMessages, PedalsAnglesTwistsAndJoys) {
  bool on = false;
  sensor_msgs::Joy joy;
  for (const auto& [value, down] : {std::pair{1, true}, {0, false}, {2, false}}) {
    joy.buttons = {value};
    EXPECT_EQ(read_switch(packed(joy).message(), on), "");
    EXPECT_EQ(on, down) << value;
  }
  joy.axes = {0.5F, -1.0F};
  joy.buttons.assign(70, 1);
  joy.buttons[1] = 0;
  JoyValues values;
  EXPECT_EQ(read_joy(packed(joy).message(), values), "");
  EXPECT_EQ(values.axes, (std::vector<double>{0.5, -1.0}));
  EXPECT_EQ(values.buttons, ~std::uint64_t{2});

  double angle = 0.0;
  sensor_msgs::JointState joint;
  EXPECT_NE(read_angle(packed(joint).message(), angle), "");
  joint.position = {0.25, 7.0};
  EXPECT_EQ(read_angle(packed(joint).message(), angle), "");
  EXPECT_EQ(angle, 0.25);
  MtmJoints q{}, qd{};
  EXPECT_NE(read_joints(packed(joint).message(), q, qd), "") << "two positions";
  joint.position.assign(kMtmJoints, 0.5);
  EXPECT_EQ(read_joints(packed(joint).message(), q, qd), "");
  EXPECT_EQ(q[6], 0.5);
  joint.position[3] = std::nan("");
  EXPECT_NE(read_joints(packed(joint).message(), q, qd), "");
  geometry_msgs::TwistStamped twist;
  twist.twist.angular.z = 2.0;
  math::Twist read;
  EXPECT_EQ(read_twist(packed(twist).message(), read), "");
  EXPECT_EQ(read.angular, (math::Vec3{0.0, 0.0, 2.0}));
}

TEST(ArmMessages, BytesThatEndEarlyOrClaimTooMuchAreRefused) {
  Packed state = operating_state("ENABLED", true);
  const char* why = "";
  for (std::size_t size = 0; size < state.bytes.size(); ++size) {
    EXPECT_NE(read_state({state.type, state.bytes.data(), size}, why), "") << size << " bytes";
  }
  Packed joy = packed(sensor_msgs::Joy());
  const std::uint32_t many = 1U << 30;
  std::memcpy(joy.bytes.data() + joy.bytes.size() - sizeof(many), &many, sizeof(many));
  JoyValues values;
  EXPECT_NE(read_joy(joy.message(), values), "");
}

}  // namespace
}  // namespace ambf::dvrk_arm
