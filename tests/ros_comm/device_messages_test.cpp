#include "ros_comm/devices/device_messages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "math/rotation.h"
#include "ros_comm/devices/device_topics.h"
#include "tests/support/fake_devices.h"

namespace ambf::ros_comm {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr ClockPair kNow{5'000'000'000, 1'000'000'000'000};

FakeDevices::Device device() {
  FakeDevices fake;
  FakeDevices::Device& out = fake.add("left hand");
  out.info.effector = {3, 1};
  out.info.effector_name = "/ambf/env/psm/tip";
  out.info.camera_names = {"/ambf/env/cameras/main", "/ambf/env/cameras/side"};
  out.info.buttons = 3;
  out.info.gripper = true;
  out.status.steady_ns = 4'000'000'000;
  out.status.sampled_ns = 3'999'000'000;
  return out;
}

TEST(DeviceTopicNames, AreInTheWorldsNamespaceAndLegal) {
  EXPECT_EQ(device_topic("/ambf/env/World", 0, "MTMR"), "/ambf/env/physical_device_0/MTMR");
  EXPECT_EQ(device_topic("/left/ambf/env/World", 11, "Razer Hydra0"), "/left/ambf/env/physical_device_11/Razer_Hydra0");
}

TEST(DeviceMessages, StateHasHandAndForceInTheWorld) {
  FakeDevices::Device left = device();
  const math::Pose T_world_u{{1.0, 2.0, 3.0}, math::from_rpy(0.0, 0.0, M_PI / 2.0)};
  left.status.frames.T_world_u = T_world_u;
  left.status.frames.T_u_iid = {{0.1, 0.0, 0.0}, {}};
  left.status.wrench_u_written = {{2.0, 0.0, 0.0}, {0.0, 0.5, 0.0}};
  left.status.jaw_hand = 0.25;
  left.status.buttons = 0b101;
  left.status.fault = state::DeviceFault::silent;
  ambf_msgs::ObjectState message;
  fill_names(left.info, message);
  fill(left.status, {42, 10.0, 9.0}, kNow, message);
  EXPECT_EQ(message.name.data, "left hand");
  EXPECT_EQ(message.header.stamp.toNSec(), 999'000'000'000u);
  EXPECT_EQ(message.sim_step, 42u);
  EXPECT_EQ(message.sim_time, 9.0F);
  EXPECT_NEAR(message.pose.position.x, 1.0, 1e-12);
  EXPECT_NEAR(message.pose.position.y, 2.1, 1e-12);
  EXPECT_NEAR(message.wrench.force.y, 2.0, 1e-12);
  EXPECT_NEAR(message.wrench.torque.x, -0.5, 1e-12);
  ASSERT_EQ(message.joint_positions.size(), 1u);
  EXPECT_EQ(message.joint_positions[0], 0.25F);
  ASSERT_EQ(message.userdata.size(), 9u);
  EXPECT_EQ(message.userdata[1], 1.0F);  // engaged
  EXPECT_EQ(message.userdata[5], static_cast<float>(state::DeviceFault::silent));
  EXPECT_EQ(std::vector<float>(message.userdata.begin() + 6, message.userdata.end()), (std::vector<float>{1, 0, 1}));
}

TEST(DeviceMessages, MappingHasEveryFrameUnderItsName) {
  FakeDevices::Device left = device();
  // Each frame at a place of its own: a pair that is exchanged shows.
  auto* const frames = reinterpret_cast<math::Pose*>(&left.status.frames);
  constexpr std::size_t kFrames = sizeof(state::MappingFrames) / sizeof(math::Pose);
  static_assert(kFrames == 16, "the 17th, S-W, is the world itself");
  for (std::size_t i = 0; i < kFrames; ++i) frames[i].position.x = 2.0 + static_cast<double>(i);
  left.status.wrench_u_wanted.force.x = 9.0;
  left.status.wrench_u_written.force.x = 4.0;
  left.status.hand_gains.angular_damping.z = 0.5;
  left.status.rotation = state::RotationReference::world;
  left.status.fault = state::DeviceFault::not_ready;
  left.status.not_ready = "nobody holds it";
  ambf_msgs::DeviceMapping message;
  fill_names(left.info, message);
  fill(left.status, {}, kNow, message);
  const geometry_msgs::Pose* const poses[] = {
      &message.T_world_u,     &message.T_u_iid,        &message.T_u_base,       &message.T_base_e,
      &message.T_base_bo,     &message.T_e_to,         &message.T_u_iid_cl,     &message.T_u_iid_pre_cl,
      &message.T_world_sde,   &message.T_world_sde_bo, &message.T_sde_to,       &message.T_world_ref,
      &message.T_world_ref_o, &message.T_world_cam,    &message.T_world_cam_cl, &message.T_world_cam_pre_cl};
  for (std::size_t i = 0; i < kFrames; ++i) EXPECT_EQ(poses[i]->position.x, 2.0 + static_cast<double>(i)) << i;
  EXPECT_EQ(message.wrench_u_wanted.force.x, 9.0);
  EXPECT_EQ(message.wrench_u_written.force.x, 4.0);
  EXPECT_EQ(message.haptic_angular_damping.z, 0.5);
  EXPECT_TRUE(message.world_rotation);
  EXPECT_EQ(message.fault, "nobody holds it");
  EXPECT_EQ(message.effector, "/ambf/env/psm/tip");
  EXPECT_EQ(message.camera, "/ambf/env/cameras/main");
  EXPECT_NEAR(message.sample_age, 1e-3, 1e-12);
}

TEST(DeviceMessages, RatesSayWhatTheRunWasLike) {
  FakeDevices::Device left = device();
  left.status.period = {1000, 1e-3, 1.1e-3, 1.2e-3, 5e-3};
  left.status.fault = state::DeviceFault::silent;
  left.status.fault_since_ns = 4'000'000'000;
  ambf_msgs::DeviceRates message;
  fill(left.info, left.status, 4'500'000'000, message);
  EXPECT_EQ(message.period.count, 1000u);
  EXPECT_EQ(message.period.p999, 1.2e-3);
  EXPECT_EQ(message.fault, "no sample arrives");
  EXPECT_DOUBLE_EQ(message.fault_seconds, 0.5);
}

TEST(DeviceMessages, InfoHasEveryParameterWithItsValue) {
  FakeDevices::Device left = device();
  left.status.gains.linear_damping = {1.0, 2.0, 3.0};
  ambf_msgs::DeviceInfo message;
  fill(left.info, left.status, "/ambf/env/physical_device_0/left_hand", message);
  ASSERT_EQ(message.parameters.size(), static_cast<std::size_t>(state::DeviceParameter::count));
  const ambf_msgs::DeviceParameter& damping = message.parameters[1];
  EXPECT_EQ(damping.name, "linear damping");
  EXPECT_EQ(damping.value.z, 3.0);
  EXPECT_TRUE(damping.by_axis);
}

TEST(DeviceCommands, AreAWrenchOrATargetAndChecked) {
  ambf_msgs::ObjectCmd message;
  message.wrench.force.y = 2.0;
  HandCommand command;
  EXPECT_EQ(read(message, command), "");
  EXPECT_FALSE(command.has_target);
  EXPECT_EQ(command.wrench_world.force.y, 2.0);
  message.wrench.torque.x = kNan;
  EXPECT_NE(read(message, command), "");
  message.enable_position_controller = 1;  // the wrench does not count then
  message.pose.position.x = 1.0;
  EXPECT_NE(read(message, command), "") << "a quaternion of zeros";
  message.pose.orientation.w = 1.0;
  EXPECT_EQ(read(message, command), "");
  EXPECT_TRUE(command.has_target);
  EXPECT_EQ(command.T_world_target.position.x, 1.0);
}

TEST(DeviceCommands, ParametersAreFoundByNameAndTakeOneNumberOrThree) {
  EXPECT_EQ(find_parameter("dominance"), state::DeviceParameter::dominance);
  EXPECT_EQ(find_parameter("nothing"), state::DeviceParameter::count);
  math::Vec3 value;
  EXPECT_EQ(read_value({2.0}, state::DeviceParameter::linear_stiffness, value), "");
  EXPECT_EQ(value.z, 2.0);
  EXPECT_EQ(read_value({1.0, 2.0, 3.0}, state::DeviceParameter::linear_stiffness, value), "");
  EXPECT_EQ(value.y, 2.0);
  EXPECT_NE(read_value({1.0, 2.0, 3.0}, state::DeviceParameter::dominance, value), "");
  EXPECT_NE(read_value({}, state::DeviceParameter::dominance, value), "");
}

}  // namespace
}  // namespace ambf::ros_comm
