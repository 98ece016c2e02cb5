// An arm's tools, without ROS: what changes with them, and an instrument that is exchanged in the model.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/crtk/arm_rig.h"

namespace ambf::crtk {
namespace {

using rig::Arm;

TEST(ArmControl, ToolsChangeKinematicsAndLimits) {
  Arm arm;
  arm.home();
  const double length = math::norm(arm.control.local_pose(arm.control.set_position()).position);
  EXPECT_EQ(arm.control.set_tool_type("PROGRASP_FORCEPS:400093"), "");
  arm.update(0.01);
  EXPECT_NEAR(math::norm(arm.control.local_pose(arm.control.set_position()).position), length + 0.0016, 1e-6);
  EXPECT_EQ(arm.control.jaw_servo_jp(-1.0), "");
  arm.update(0.01);
  EXPECT_NEAR(arm.control.jaw_position(), -20.0 * M_PI / 180.0, 1e-9);
  arm.control.take_events();
  EXPECT_NE(arm.control.set_tool_type("A HAMMER"), "");
  bool requested = false;
  for (const Event& event : arm.control.take_events()) requested |= event.kind == Event::Kind::tool_request;
  EXPECT_TRUE(requested);
}

// An arm whose ProGrasp has an instrument.
std::string with_instrument() {
  return ", instruments: {'PROGRASP_FORCEPS:400093': '" AMBF_SOURCE_DIR "/ambf_models/instruments/prograsp.yaml'}";
}

TEST(ArmControl, AnInstrumentIsTheArmsOnceTheModelHasIt) {
  Arm arm(with_instrument());
  arm.home();
  arm.control.jaw_servo_jp(-0.6);
  arm.update(0.01);
  EXPECT_FALSE(arm.control.take_exchange());
  EXPECT_EQ(arm.control.set_tool_type("PROGRASP_FORCEPS:400093"), "");
  const auto taken = arm.control.take_exchange();
  ASSERT_TRUE(taken);
  EXPECT_EQ(taken->tool, "PROGRASP_FORCEPS:400093");
  EXPECT_FALSE(arm.control.take_exchange());
  EXPECT_FALSE(arm.control.may_exchange());  // the simulation does not know yet that it shall keep the others
  arm.update(0.01);
  EXPECT_TRUE(arm.control.may_exchange());
  arm.velocities = {0.0, 0.0, 0.01, 0.0, 0.0, 0.0, 0.0};
  arm.update(0.01);
  EXPECT_FALSE(arm.control.may_exchange());
  arm.velocities = {0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0};  // roll, wrist and jaw go with the instrument
  arm.update(0.01);
  EXPECT_TRUE(arm.control.may_exchange());
  EXPECT_EQ(arm.control.description().kinematics.tool, "LARGE_NEEDLE_DRIVER:400006");
  const Joints before = arm.control.set_position();
  for (const std::string& why :
       {arm.control.servo_jp(before), arm.control.move_jp(before), arm.control.jaw_servo_jp(0.1),
        arm.control.state_command("home"), arm.control.set_tool_type("PROGRASP_FORCEPS:400093")}) {
    EXPECT_NE(why, "");
  }
  arm.control.exchanged();
  arm.update(0.01);
  EXPECT_EQ(arm.control.description().kinematics.tool, "PROGRASP_FORCEPS:400093");
  EXPECT_EQ(arm.control.set_position(), before);
  EXPECT_NEAR(arm.control.jaw_position(), -20.0 * M_PI / 180.0, 1e-9);  // its jaw closes less far
  EXPECT_EQ(arm.motion.note & kKeepsOthers, 0u);
  EXPECT_EQ(arm.control.servo_jp(before), "");
  std::vector<std::string> reported;
  for (const Event& event : arm.control.take_events()) {
    if (event.kind == Event::Kind::tool) reported.push_back(event.text);
  }
  EXPECT_EQ(reported, std::vector<std::string>{"PROGRASP_FORCEPS:400093"});
  // One without an instrument changes the kinematics only, and that is said.
  EXPECT_EQ(arm.control.set_tool_type("TENACULUM"), "");
  bool warned = false;
  for (const Event& event : arm.control.take_events()) warned |= event.kind == Event::Kind::warning;
  EXPECT_TRUE(warned);
}

TEST(ArmControl, AnExchangeWaitsForNoStepOfAWorldThatStands) {
  Arm arm(with_instrument());
  arm.home();
  arm.velocities.assign(7, 0.5);
  arm.show();
  EXPECT_EQ(arm.control.set_tool_type("PROGRASP_FORCEPS:400093"), "");
  arm.show();
  EXPECT_FALSE(arm.control.may_exchange());
  arm.stands = true;
  arm.show();
  EXPECT_TRUE(arm.control.may_exchange());
}

// The first instrument is still on its way when a second one is asked for.
TEST(ArmControl, TheOutcomeOfAnExchangeThatAFaultEndedIsNoOthers) {
  Arm arm(with_instrument());
  arm.home();
  EXPECT_EQ(arm.control.set_tool_type("PROGRASP_FORCEPS:400093"), "");
  const auto first = arm.control.take_exchange();
  ASSERT_TRUE(first);
  EXPECT_TRUE(arm.control.exchanging(first->number));
  arm.control.fault("they are gone");
  EXPECT_FALSE(arm.control.exchanging(first->number));
  EXPECT_EQ(arm.control.set_tool_type("PROGRASP_FORCEPS:400093"), "");
  EXPECT_FALSE(arm.control.exchanging(first->number));
  const auto second = arm.control.take_exchange();
  ASSERT_TRUE(second);
  EXPECT_TRUE(arm.control.exchanging(second->number));
}

TEST(ArmControl, AToolThatCannotBeExchangedStays) {
  Arm arm(with_instrument());
  arm.home();
  arm.control.set_tool_type("PROGRASP_FORCEPS:400093");
  arm.update(0.01);
  arm.control.not_exchanged("its file is refused");
  EXPECT_FALSE(arm.control.exchanging());
  EXPECT_EQ(arm.control.description().kinematics.tool, "LARGE_NEEDLE_DRIVER:400006");
  EXPECT_EQ(arm.control.servo_jr({0.1, 0.0, 0.0, 0.0, 0.0, 0.0}), "");
  // Its joints went while the tool did: no exchange goes on, but a later one may bring them back.
  arm.control.set_tool_type("PROGRASP_FORCEPS:400093");
  arm.control.fault("they are gone");
  EXPECT_FALSE(arm.control.exchanging());
  EXPECT_EQ(arm.control.set_tool_type("LARGE_NEEDLE_DRIVER:400006"), "");
  EXPECT_FALSE(arm.control.take_exchange());  // no file of it
  EXPECT_EQ(arm.control.set_tool_type("PROGRASP_FORCEPS:400093"), "");
  EXPECT_TRUE(arm.control.take_exchange());
  EXPECT_TRUE(arm.control.may_exchange());
  arm.control.exchanged();
  EXPECT_EQ(arm.control.state(), OperatingState::fault);
}

}  // namespace
}  // namespace ambf::crtk
