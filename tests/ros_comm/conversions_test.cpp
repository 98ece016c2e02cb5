#include "ros_comm/endpoints/conversions.h"

#include <ambf_msgs/CameraCmd.h>
#include <ambf_msgs/CameraState.h>
#include <ambf_msgs/LightCmd.h>
#include <ambf_msgs/LightState.h>
#include <gtest/gtest.h>

#include <limits>

#include "math/rotation.h"
#include "ros_comm/endpoints/placed_messages.h"

namespace ambf::ros_comm {
namespace {

using ambf_msgs::RigidBodyCmd;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

RigidBodyCmd with_joints(std::vector<float> values, std::vector<std::int8_t> types) {
  RigidBodyCmd message;
  message.joint_cmds = std::move(values);
  message.joint_cmds_types = std::move(types);
  return message;
}

TEST(ReadingCommands, TakesEachCartesianType) {
  RigidBodyCmd message;
  message.wrench.force.x = 1.0, message.wrench.torque.z = 2.0;
  message.twist.linear.y = 3.0, message.twist.angular.x = 4.0;
  message.pose.position.z = 5.0, message.pose.orientation.w = 1.0;
  state::RigidBodyCommand command;
  message.cartesian_cmd_type = RigidBodyCmd::TYPE_FORCE;
  EXPECT_EQ(read(message, command), "");
  EXPECT_EQ(command.type, state::CartesianCommandType::force);
  EXPECT_EQ(command.wrench_world.force.x, 1.0);
  EXPECT_EQ(command.wrench_world.torque.z, 2.0);
  message.cartesian_cmd_type = RigidBodyCmd::TYPE_POSITION;
  EXPECT_EQ(read(message, command), "");
  EXPECT_EQ(command.type, state::CartesianCommandType::position);
  EXPECT_EQ(command.T_world_body.position.z, 5.0);
  message.cartesian_cmd_type = RigidBodyCmd::TYPE_VELOCITY;
  EXPECT_EQ(read(message, command), "");
  EXPECT_EQ(command.type, state::CartesianCommandType::velocity);
  EXPECT_EQ(command.twist_world.linear.y, 3.0);
  EXPECT_EQ(command.twist_world.angular.x, 4.0);
  message.cartesian_cmd_type = -1;
  EXPECT_EQ(read(message, command), "");
  EXPECT_EQ(command.type, state::CartesianCommandType::none);
  for (const int type : {-2, 3, 127}) {
    message.cartesian_cmd_type = static_cast<std::int8_t>(type);
    EXPECT_NE(read(message, command), "") << type;
  }
}

TEST(ReadingCommands, JointsWithoutTypeAreEffortsAndUnknownTypesLeaveThemAlone) {
  state::RigidBodyCommand command;
  EXPECT_EQ(read(with_joints({1.0f, 2.0f, 3.0f, 4.0f}, {2, -1, 1}), command), "");
  ASSERT_EQ(command.joints.size(), 4u);
  EXPECT_EQ(command.joints[0].type, state::JointCommandType::velocity);
  EXPECT_EQ(command.joints[1].type, state::JointCommandType::none);
  EXPECT_EQ(command.joints[2].type, state::JointCommandType::position);
  EXPECT_EQ(command.joints[3].type, state::JointCommandType::effort);
  EXPECT_EQ(command.joints[3].value, 4.0);
}

TEST(ReadingCommands, RefusesWhatIsNotFiniteOrTooLongWhereItIsUsed) {
  state::RigidBodyCommand command;
  RigidBodyCmd message;
  message.wrench.force.y = kNan;
  EXPECT_NE(read(message, command), "");
  message.cartesian_cmd_type = RigidBodyCmd::TYPE_VELOCITY;
  EXPECT_EQ(read(message, command), "");  // the wrench is not used now
  EXPECT_NE(read(with_joints({static_cast<float>(kNan)}, {1}), command), "");
  EXPECT_EQ(read(with_joints({static_cast<float>(kNan)}, {-1}), command), "");  // nor is this joint's value
  EXPECT_NE(read(with_joints({1.0f}, {1, 1}), command), "");
  EXPECT_NE(read(with_joints(std::vector<float>(5000), {}), command), "");
}

TEST(ReadingCommands, PosesNeedAQuaternionAndOnlyWhenEnabled) {
  state::PoseCommand command;
  geometry_msgs::Pose pose;  // all zero
  EXPECT_EQ(read_pose_command(false, pose, command), "");
  EXPECT_NE(read_pose_command(true, pose, command), "");
  pose.orientation.z = 1.05;
  EXPECT_EQ(read_pose_command(true, pose, command), "");
  EXPECT_NEAR(math::norm(command.T_parent_object.orientation), 1.0, 1e-12);
  pose.position.x = kNan;
  EXPECT_NE(read_pose_command(true, pose, command), "");
}

TEST(PosesAndBack, KeepEveryComponent) {
  const math::Pose pose{{1.0, 2.0, 3.0}, {0.1, 0.2, 0.3, 0.9}};
  const math::Pose back = from_ros(to_ros(pose));
  EXPECT_EQ(back.position.x, 1.0);
  EXPECT_EQ(back.position.y, 2.0);
  EXPECT_EQ(back.position.z, 3.0);
  EXPECT_EQ(back.orientation.x, 0.1);
  EXPECT_EQ(back.orientation.y, 0.2);
  EXPECT_EQ(back.orientation.z, 0.3);
  EXPECT_EQ(back.orientation.w, 0.9);
}

class BodyStates : public ::testing::Test {
 protected:
  BodyStates() {
    auto made = std::make_shared<state::Structure>();
    made->objects.resize(2);
    made->objects[1].name = "tip";
    made->objects[0].local_name = "base";
    made->objects[0].identifier = "/env/BODY base";
    made->bodies.resize(1);
    made->bodies[0].object = 0;
    made->bodies[0].mass = 2.0;
    made->bodies[0].inertia = {0.1, 0.2, 0.3};
    made->bodies[0].children = {1};
    made->bodies[0].joints = {1, 0};  // in the reference's order, not in that of the arrays
    made->joints.resize(2);
    made->joints[0].name = "second";
    made->joints[1].name = "first";
    structure = made;
    frame = state::make_frame(structure);
    frame->sim_step = 7;
    frame->sim_time = 0.5;
    frame->system_ns = 3'000'000'001;
    frame->joints[0].position = 20.0;
    frame->joints[1].position = 10.0;
    frame->joints[1].velocity = 11.0;
    frame->joints[1].effort = 12.0;
    frame->bodies[0].T_world_body.position = {1.0, 2.0, 3.0};
  }
  std::shared_ptr<const state::Structure> structure;
  std::unique_ptr<state::Frame> frame;
  ambf_msgs::RigidBodyState message;
};

TEST_F(BodyStates, JointsComeInTheirBodysOrder) {
  fill_names(*structure, 0, message);
  fill(*frame, 0, message);
  EXPECT_EQ(message.joint_names, (std::vector<std::string>{"first", "second"}));
  EXPECT_EQ(message.joint_positions, (std::vector<float>{10.0f, 20.0f}));
  EXPECT_EQ(message.joint_velocities[0], 11.0f);
  EXPECT_EQ(message.joint_efforts[0], 12.0f);
  EXPECT_EQ(message.name.data, "base");
  EXPECT_EQ(message.identifier.data, "/env/BODY base");
  EXPECT_EQ(message.pInertia.y, 0.2);
  EXPECT_EQ(message.mass, 2.0f);
  EXPECT_EQ(message.sim_step, 7u);
  EXPECT_EQ(message.header.stamp.sec, 3u);
  EXPECT_EQ(message.header.stamp.nsec, 1u);
  EXPECT_EQ(message.pose.position.z, 3.0);
}

TEST_F(BodyStates, ListsAreOnlyThereWhenWanted) {
  fill_names(*structure, 0, message, {false, false, false});
  EXPECT_TRUE(message.children_names.empty());
  // The file's defaults: names and positions of joints.
  EXPECT_EQ(message.joint_names.size(), 2u);
  auto quiet = std::make_shared<state::Structure>(*structure);
  quiet->bodies[0].publish_joint_names = quiet->bodies[0].publish_joint_positions = false;
  fill_names(*quiet, 0, message, {true, false, false});
  EXPECT_EQ(message.children_names, (std::vector<std::string>{"tip"}));
  EXPECT_TRUE(message.joint_names.empty());
  EXPECT_TRUE(message.joint_positions.empty());
  fill(*frame, 0, message);
  EXPECT_TRUE(message.joint_positions.empty());
}

using CameraMessages = PlacedMessages<ambf_msgs::CameraState, ambf_msgs::CameraCmd, &state::Structure::cameras,
                                      &state::Frame::cameras, &state::CameraState::T_parent_camera>;
using LightMessages = PlacedMessages<ambf_msgs::LightState, ambf_msgs::LightCmd, &state::Structure::lights,
                                     &state::Frame::lights, &state::LightState::T_parent_light>;

TEST(PlacedStates, NameTheirParentInFullAndTheWorldNotAtAll) {
  state::Structure structure;
  structure.objects.resize(3);
  structure.objects[0].name = "/ambf/env/psm/tool";
  structure.objects[0].identifier = "/ambf/env/psm/BODY tool";
  structure.cameras.resize(1);
  structure.cameras[0].object = 1;
  structure.cameras[0].parent_object = 0;
  structure.cameras[0].parent_name = "BODY tool";  // as the file has it
  structure.lights.resize(1);
  structure.lights[0].object = 2;
  structure.lights[0].parent_name = "BODY nobody yet";  // until it comes the light hangs in the world
  ambf_msgs::CameraState camera;
  CameraMessages::fill_names(structure, 0, camera);
  EXPECT_EQ(camera.parent_name.data, "/ambf/env/psm/tool");
  ambf_msgs::LightState light;
  LightMessages::fill_names(structure, 0, light);
  EXPECT_EQ(light.parent_name.data, "");
}

}  // namespace
}  // namespace ambf::ros_comm
