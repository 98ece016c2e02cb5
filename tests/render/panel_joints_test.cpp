// Joints commanded from the panel.
#include <gtest/gtest.h>

#include "panel_rig.h"

namespace ambf::render {
namespace {

using testing::PanelRig;

// --- 6: joints.

TEST(Panel, ASliderHoldsAJointUntilItIsLetGo) {
  PanelRig rig;
  rig.tab("Joints");
  rig.drag("joint/shoulder", 0.5, 0.75);
  const auto wanted = rig.model.held.held(rig.model.structure(), rig.slot("shoulder", state::ObjectKind::joint));
  ASSERT_TRUE(wanted);
  EXPECT_EQ(wanted->type, state::JointCommandType::position);
  EXPECT_NEAR(wanted->value, 0.75, 0.05);
  rig.run(2000);  // four times the watchdog's patience
  EXPECT_EQ(rig.joint_state("shoulder").commanded_type, state::JointCommandType::position);
  EXPECT_NEAR(rig.joint_state("shoulder").position, wanted->value, 0.02);
  rig.click("joint/shoulder/release");
  rig.run(1000);
  EXPECT_EQ(rig.joint_state("shoulder").commanded_type, state::JointCommandType::effort);
  EXPECT_LT(std::abs(rig.joint_state("shoulder").position), 0.7 * wanted->value) << "it hangs down again";
}

TEST(Panel, FieldsCommandVelocityAndEffort) {
  PanelRig rig;
  rig.model.hold_joint(rig.slot("shoulder", state::ObjectKind::joint), {state::JointCommandType::velocity, 0.5});
  rig.run(500);
  EXPECT_NEAR(rig.joint_state("shoulder").velocity, 0.5, 0.02);
  rig.model.hold_joint(rig.slot("shoulder", state::ObjectKind::joint), {state::JointCommandType::effort, 0.25});
  rig.run(20);
  EXPECT_EQ(rig.joint_state("shoulder").commanded, 0.25);
  EXPECT_EQ(rig.joint_state("shoulder").commanded_type, state::JointCommandType::effort);
}

TEST(Panel, WhatIsTypedIntoAVelocityFieldCommandsIt) {
  PanelRig rig;
  rig.tab("Joints");
  rig.click("joint/elbow/mode");
  rig.key("Down");  // Velocity follows Position
  rig.key("Enter");
  rig.pictures(2);
  ASSERT_TRUE(rig.shown("joint/elbow/velocity"));
  rig.enter("joint/elbow/velocity", "0.4");
  rig.run(300);
  EXPECT_NEAR(rig.joint_state("elbow").velocity, 0.4, 0.02);
}

TEST(Panel, LettingOneJointGoKeepsTheOthersOfItsBody) {
  PanelRig rig;
  const std::uint32_t shoulder = rig.slot("shoulder", state::ObjectKind::joint);
  const std::uint32_t elbow = rig.slot("elbow", state::ObjectKind::joint);
  rig.model.hold_joint(shoulder, {state::JointCommandType::position, 0.3});
  rig.model.hold_joint(elbow, {state::JointCommandType::position, -0.4});
  rig.run(1500);
  EXPECT_NEAR(rig.joint_state("shoulder").position, 0.3, 0.02);
  EXPECT_NEAR(rig.joint_state("elbow").position, -0.4, 0.02);
  rig.model.held.release(rig.model.structure(), elbow);
  rig.run(1000);
  EXPECT_NEAR(rig.joint_state("shoulder").position, 0.3, 0.1);
  EXPECT_EQ(rig.joint_state("elbow").commanded_type, state::JointCommandType::effort);
  EXPECT_TRUE(rig.model.held.held(rig.model.structure(), shoulder));
}

TEST(Panel, AnotherClientTakesAJointOverByCommandingIt) {
  PanelRig rig;
  const std::uint32_t shoulder = rig.slot("shoulder", state::ObjectKind::joint);
  rig.model.hold_joint(shoulder, {state::JointCommandType::position, 0.3});
  rig.run(100);
  const auto ros = rig.rig.simulation.bind(rig.rig.id("BODY base"), state::Source::ros);
  state::RigidBodyCommand command;
  command.joints = {{state::JointCommandType::position, -0.2}};
  ros->post(command);
  rig.run(20);
  EXPECT_EQ(rig.joint_state("shoulder").commanded, -0.2);
  ros->release();
  rig.run(20);
  EXPECT_EQ(rig.joint_state("shoulder").commanded, 0.3) << "and gives it back";
}

TEST(Panel, PassiveJointsAreNotOffered) {
  PanelRig rig;
  ASSERT_TRUE(rig.rig.load(runtime::test::kScene).success);
  rig.rig.step(1);
  rig.tab("Joints");
  EXPECT_TRUE(rig.shown("joint/base-crank"));
  EXPECT_FALSE(rig.shown("joint/crank-coupler"));
  const std::string why =
      HeldJoints::refusal(rig.model.structure(), rig.slot("coupler-rocker", state::ObjectKind::joint));
  EXPECT_NE(why.find("passive"), std::string::npos);
}

TEST(Panel, JointsStayHeldHoweverSlowlyPicturesCome) {
  PanelRig rig;
  rig.model.hold_joint(rig.slot("shoulder", state::ObjectKind::joint), {state::JointCommandType::position, 0.4});
  rig.ui.set_open(false);
  rig.run(1500);
  EXPECT_EQ(rig.joint_state("shoulder").commanded_type, state::JointCommandType::position);
  EXPECT_NEAR(rig.joint_state("shoulder").position, 0.4, 0.02);
  rig.rig.step(2000);  // without a picture
  rig.now_ns += 2'000'000'000;
  rig.picture();
  EXPECT_TRUE(rig.model.held.any());
  EXPECT_EQ(rig.joint_state("shoulder").commanded_type, state::JointCommandType::position);
  EXPECT_NEAR(rig.joint_state("shoulder").position, 0.4, 0.02);
}

}  // namespace
}  // namespace ambf::render
