// An arm's states, set-points and moves, without ROS: what a client may count on in every order of commands.
#include "crtk/arm_control.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "crtk/arm_layout.h"
#include "math/rotation.h"
#include "tests/crtk/arm_rig.h"

namespace ambf::crtk {
namespace {

using rig::Arm;

void bring_to(Arm& arm, OperatingState state) {
  if (state == OperatingState::disabled) return;
  arm.control.state_command("enable");
  if (state == OperatingState::paused) arm.control.state_command("pause");
  if (state != OperatingState::fault) return;
  arm.control.fault("its joints are gone");
  arm.update(0.0);
}

TEST(ArmControl, StatesFollowTheTable) {
  using S = OperatingState;
  const std::vector<std::string> commands = {"enable", "disable", "pause", "resume", "home", "unhome"};
  const std::map<S, std::vector<S>> table = {
      {S::disabled, {S::enabled, S::disabled, S::disabled, S::disabled, S::enabled, S::disabled}},
      {S::enabled, {S::enabled, S::disabled, S::paused, S::enabled, S::enabled, S::enabled}},
      {S::paused, {S::paused, S::disabled, S::paused, S::enabled, S::paused, S::paused}},
      {S::fault, {S::enabled, S::disabled, S::fault, S::fault, S::fault, S::fault}}};
  for (const auto& [from, results] : table) {
    for (std::size_t i = 0; i < commands.size(); ++i) {
      Arm arm;
      bring_to(arm, from);
      ASSERT_EQ(arm.control.state(), from);
      arm.control.state_command(commands[i]);
      EXPECT_EQ(arm.control.state(), results[i]) << to_string(from) << " " << commands[i];
    }
  }
}

TEST(ArmControl, InvalidAndUnknownStateCommandsAreRefusedAloud) {
  Arm arm;
  arm.control.take_events();
  EXPECT_NE(arm.control.state_command("pause"), "");
  const std::vector<Event> events = arm.control.take_events();
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].kind, Event::Kind::warning);
  EXPECT_NE(arm.control.state_command("dance"), "");
}

TEST(ArmControl, HomingIsBusyAndEndsHomedAtHome) {
  Arm arm;
  arm.control.take_events();
  arm.control.state_command("home");
  EXPECT_TRUE(arm.control.busy());
  arm.run(5.0);
  EXPECT_TRUE(arm.control.homed() && !arm.control.busy());
  EXPECT_DOUBLE_EQ(arm.control.set_position()[2], 0.12);
  EXPECT_EQ(arm.busy_events(), (std::vector<bool>{true, false}));
}

TEST(ArmControl, AMoveIsBusyOnceThenIdleAndComesToRest) {
  Arm arm;
  arm.home();
  EXPECT_EQ(arm.control.move_jp({0.3, -0.2, 0.15, 1.0, 0.1, -0.1}), "");
  EXPECT_TRUE(arm.control.busy());
  arm.run(5.0);
  EXPECT_EQ(arm.control.set_position(), (Joints{0.3, -0.2, 0.15, 1.0, 0.1, -0.1}));
  EXPECT_EQ(arm.control.set_velocity(), Joints(6, 0.0));
  EXPECT_EQ(arm.busy_events(), (std::vector<bool>{true, false}));
}

TEST(ArmControl, AMoveToWhereItIsStillShowsAsBusy) {
  Arm arm;
  arm.home();
  arm.control.move_jp(arm.control.set_position());
  arm.update(0.001);
  EXPECT_EQ(arm.busy_events(), (std::vector<bool>{true, false}));
}

TEST(ArmControl, RefusedMovesShowAsBusyForAMomentAndMoveNothing) {
  Arm arm;
  arm.home();
  const Joints before = arm.control.set_position();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(arm.control.move_jp({0.1, 0.2}), "");
  EXPECT_EQ(arm.busy_events(), (std::vector<bool>{true, false}));
  EXPECT_NE(arm.control.move_jp(Joints(6, nan)), "");
  EXPECT_NE(arm.control.move_cp({{5.0, 0.0, 0.0}, {}}), "");
  arm.control.state_command("disable");
  arm.control.take_events();
  EXPECT_NE(arm.control.move_jp(before), "");
  EXPECT_EQ(arm.busy_events(), (std::vector<bool>{true, false}));
  EXPECT_EQ(arm.control.set_position(), before);
}

TEST(ArmControl, ServoCommandsAddExactlyClipAndNeverShowAsBusy) {
  Arm arm;
  arm.home();
  for (int i = 0; i < 8; ++i) EXPECT_EQ(arm.control.servo_jr({0.125, 0.0, 0.0, 0.0, 0.0, 0.0}), "");
  EXPECT_EQ(arm.control.set_position()[0], 1.0);
  EXPECT_EQ(arm.control.servo_jp({9.0, 0.0, 9.0, 0.0, 0.0, 0.0}), "");
  EXPECT_EQ(arm.control.set_position()[2], 0.24);
  EXPECT_NE(arm.control.servo_jp({0.0}), "");
  EXPECT_EQ(arm.control.set_position()[2], 0.24);
  EXPECT_TRUE(arm.busy_events().empty());
}

TEST(ArmControl, ACartesianCommandOfTheSetPointMovesNothing) {
  Arm arm;
  arm.home();
  arm.control.servo_jp({0.2, 0.1, 0.15, 3.9, 0.3, -0.4});
  const Joints before = arm.control.set_position();
  EXPECT_EQ(arm.control.servo_cp(arm.control.local_pose(before)), "");
  EXPECT_EQ(arm.control.servo_cr({}), "");
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(arm.control.set_position()[i], before[i], 1e-6);
}

TEST(ArmControl, AServoCommandEndsAMove) {
  Arm arm;
  arm.home();
  arm.control.move_jp({1.0, 0.0, 0.12, 0.0, 0.0, 0.0});
  arm.update(0.1);
  arm.control.take_events();
  arm.control.servo_jp(arm.control.set_position());
  bool told = false;
  for (const Event& event : arm.control.take_events()) {
    told |= event.kind == Event::Kind::goal_reached && !event.yes;
  }
  EXPECT_TRUE(told);
  EXPECT_FALSE(arm.control.busy());
}

TEST(ArmControl, NothingIsAskedOfTheJointsUnlessItIsEnabledOrPaused) {
  Arm arm;
  EXPECT_FALSE(arm.control.take_command() && arm.motion.arm.order.mode != Mode::off);
  arm.home();
  EXPECT_EQ(arm.motion.arm.order.mode, Mode::position);
  arm.control.state_command("pause");
  arm.update(0.01);
  EXPECT_EQ(arm.motion.arm.order.mode, Mode::position);
  EXPECT_NE(arm.control.servo_jp(Joints(6, 0.1)), "");
  EXPECT_EQ(arm.control.set_position()[0], 0.0);
  arm.control.state_command("disable");
  arm.update(0.01);
  EXPECT_EQ(arm.motion.arm.order.mode, Mode::off);
  EXPECT_EQ(arm.motion.jaw.order.mode, Mode::off);
}

TEST(ArmControl, BrakesHoldWhatIsDisabled) {
  Arm arm(", brakes: true");
  arm.control.state_command("enable");
  arm.control.state_command("disable");
  arm.update(0.01);
  EXPECT_EQ(arm.control.state(), OperatingState::disabled);
  EXPECT_EQ(arm.motion.arm.order.mode, Mode::position);
  EXPECT_NE(arm.control.servo_jp(Joints(6, 0.1)), "");
  arm.control.fault("its joints are gone");
  arm.update(0.01);
  EXPECT_EQ(arm.motion.arm.order.mode, Mode::off);
}

TEST(ArmDescriptions, NamesAreOfOnePartOrSeveral) {
  const auto count = [](const std::string& name) {
    return adf::parse_crtk_arms("crtk arms: {" + name + ": {kinematics: PSM, base: base}}", "arms.yaml").arms.size();
  };
  for (const char* good : {"A", "SUJ/PSM1", "a_1/b/c2"}) EXPECT_EQ(count(good), 1u) << good;
  for (const char* bad : {"1", "SUJ/", "/SUJ", "SUJ//PSM1", "SUJ/1", "a-b"}) EXPECT_EQ(count(bad), 0u) << bad;
}

TEST(ArmControl, AWrenchIsAskedOfTheJointsByTheJacobian) {
  Arm arm;
  arm.home();
  EXPECT_EQ(arm.control.servo_cf(WrenchFrame::body, {{1.0, 2.0, 3.0}, {0.0, 0.0, 0.1}}), "");
  const std::vector<double> matrix = arm.control.jacobian(WrenchFrame::body);
  const double wrench[6] = {1.0, 2.0, 3.0, 0.0, 0.0, 0.1};
  const Joints effort = arm.control.set_effort();
  for (std::size_t i = 0; i < 6; ++i) {
    double expected = 0.0;
    for (std::size_t row = 0; row < 6; ++row) expected += matrix[row * 6 + i] * wrench[row];
    EXPECT_NEAR(effort[i], expected, 1e-12);
  }
  arm.update(0.01);
  EXPECT_EQ(arm.motion.arm.order.mode, Mode::effort);
  EXPECT_NEAR(arm.motion.effort[0], effort[0], 1e-12);
  EXPECT_FALSE(arm.control.holds_position());
}

TEST(ArmControl, MeasuredEffortsOfAWrenchGiveThatWrench) {
  Arm arm;
  arm.home();
  arm.control.servo_jp({0.2, 0.1, 0.15, 0.4, 0.3, -0.4});
  arm.update(0.01);
  const kinematics::SixVector wrench = {1.0, -2.0, 3.0, 0.02, 0.03, -0.01};
  for (const WrenchFrame frame : {WrenchFrame::body, WrenchFrame::spatial}) {
    arm.efforts = kinematics::efforts_for(arm.control.jacobian(frame), wrench);
    arm.efforts.push_back(0.0);
    arm.update(0.01);
    const kinematics::SixVector measured = arm.control.measured_wrench(frame);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(measured[i], wrench[i], 1e-9);
  }
}

TEST(ArmControl, ATwistMovesTheTipThatWayUntilItsSenderFallsSilent) {
  Arm arm;
  arm.home();
  const math::Pose before = arm.control.local_pose(arm.control.set_position());
  EXPECT_EQ(arm.control.servo_cv({{0.02, 0.0, -0.01}, {}}), "");
  arm.run(0.3);
  EXPECT_TRUE(arm.control.holds_velocity());
  EXPECT_FALSE(arm.control.busy());
  const math::Vec3 way = arm.control.local_pose(arm.control.set_position()).position - before.position;
  EXPECT_NEAR(way.x, 0.02 * 0.3, 3e-4);
  EXPECT_NEAR(way.y, 0.0, 3e-4);
  EXPECT_NEAR(way.z, -0.01 * 0.3, 3e-4);
  arm.run(0.6);
  EXPECT_TRUE(arm.control.holds_position());
  const Joints rest = arm.control.set_position();
  arm.run(0.2);
  EXPECT_EQ(arm.control.set_position(), rest);
  EXPECT_NE(arm.control.servo_cv({{std::nan(""), 0.0, 0.0}, {}}), "");
}

TEST(ArmControl, AnEndoscopesTypeTurnsItsView) {
  const auto read = adf::parse_crtk_arms("crtk arms: {ECM: {kinematics: ECM, base: base}}", "arms.yaml");
  ArmControl ecm(read.arms.at(0));
  EXPECT_EQ(ecm.endoscope_type(), "HD_STRAIGHT");
  const math::Quat straight = ecm.local_pose(Joints(4, 0.0)).orientation;
  EXPECT_EQ(ecm.set_endoscope_type("SD_UP"), "");
  const math::Vec3 turn = math::log(math::inverse(straight) * ecm.local_pose(Joints(4, 0.0)).orientation);
  EXPECT_NEAR(math::norm(turn), 30.0 * M_PI / 180.0, 1e-9);
  EXPECT_NEAR(turn.y, 30.0 * M_PI / 180.0, 1e-9);  // x of the tip is up in the picture: its z turns there
  EXPECT_EQ(ecm.set_endoscope_type("NONE"), "");
  EXPECT_NE(ecm.set_endoscope_type("HD_SIDEWAYS"), "");
  EXPECT_EQ(ecm.endoscope_type(), "NONE");
}

class Master : public testing::Test {
 protected:
  Master()
      : control(adf::parse_crtk_arms("crtk arms: {MTMR: {kinematics: MTMR, base: base, homing: none}}", "a.yaml")
                    .arms.at(0)) {
    see();
    control.state_command("enable");
    see();
  }
  void see() {
    if (const auto command = control.take_command()) obey(motion, limits, *command, at);
    Measured measured;
    measured.valid = measured.active = true;
    measured.position.assign(at.begin(), at.begin() + 8);
    measured.velocity = velocity;
    measured.effort.assign(8, 0.0);
    measured.motion = motion;
    measured.stamp_ns = 1;
    control.update(measured, 0);
  }
  ArmControl control;
  ArmMotion motion;
  ArmLimits limits = limits_of(control.description());
  Axes at{0.1, 0.2, -0.1, 0.3, 0.2, 0.1, 0.4};
  Joints velocity = Joints(8, 0.0);
};

TEST_F(Master, ImpedancePullsTowardsItsCentreByTheGainsOfEitherSide) {
  Impedance impedance;
  impedance.force_position = control.local_pose(control.measured_joints()).position - math::Vec3{0.01, -0.02, 0.0};
  impedance.torque_orientation = control.local_pose(control.measured_joints()).orientation;
  impedance.position_positive.p = {-200.0, 0.0, 0.0};
  impedance.position_negative.p = {0.0, -100.0, 0.0};
  impedance.position_negative.deadband = {0.0, 0.005, 0.0};
  EXPECT_EQ(control.servo_ci(impedance), "");
  see();
  const auto expected = kinematics::efforts_for(control.jacobian(WrenchFrame::spatial), {-2.0, 1.5, 0, 0, 0, 0});
  for (std::size_t i = 0; i < 7; ++i) EXPECT_NEAR(motion.effort[i], expected[i], 1e-9) << i;
  impedance.force_orientation = {0.0, 0.0, 0.0, 0.0};
  EXPECT_NE(control.servo_ci(impedance), "");
}

TEST_F(Master, ALockedOrientationIsKeptByTheWristWhileTheArmIsPushed) {
  const math::Quat kept = control.local_pose(control.measured_joints()).orientation;
  EXPECT_EQ(control.lock_orientation(kept), "");
  EXPECT_EQ(control.servo_cf(WrenchFrame::body, {}), "");
  see();
  EXPECT_TRUE(exerts(motion, limits, 0));
  EXPECT_FALSE(exerts(motion, limits, 4));
  at[0] += 0.2, at[1] -= 0.1;  // somebody moved it
  see(), see();
  Joints wrist = control.measured_joints();
  for (std::size_t i = 3; i < 7; ++i) wrist[i] = motion.position[i];
  EXPECT_LT(math::norm(math::log(math::inverse(kept) * control.local_pose(wrist).orientation)), 1e-6);
  EXPECT_EQ(control.unlock_orientation(), "");
  see(), see();
  EXPECT_TRUE(exerts(motion, limits, 4));
}

TEST(ArmControl, PosesAreInTheViewOfAnotherArmUntilAClientSetsABaseFrame) {
  Arm arm;
  arm.home();
  EXPECT_EQ(arm.control.frame(), "PSM1_base");
  const math::Pose seen{{0.1, -0.2, 0.3}, math::from_rpy(0.3, 0.2, -0.5)};
  arm.control.see_from("ECM", seen);
  EXPECT_EQ(arm.control.frame(), "ECM");
  const Joints wanted{0.1, -0.1, 0.14, 0.0, 0.0, 0.0};
  EXPECT_EQ(arm.control.servo_cp(seen * arm.control.local_pose(wanted)), "");
  arm.update(0.01);
  for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_NEAR(arm.control.set_position()[i], wanted[i], 1e-9) << i;
  // Without the other arm nobody knows where such poses are; joints and relative poses do not need it.
  arm.control.see_from("ECM", std::nullopt);
  EXPECT_FALSE(arm.control.knows_base_frame());
  EXPECT_NE(arm.control.servo_cp(seen), "");
  EXPECT_NE(arm.control.move_cp(seen), "");
  EXPECT_NE(arm.control.servo_cv({}), "");
  EXPECT_EQ(arm.control.servo_cr({}), "");
  EXPECT_EQ(arm.control.servo_jp(wanted), "");
  EXPECT_EQ(arm.control.set_base_frame({{1.0, 0.0, 0.0}, {}}), "");
  arm.control.see_from("ECM", seen);
  EXPECT_EQ(arm.control.frame(), "PSM1_base");
  EXPECT_TRUE(arm.control.knows_base_frame());
  EXPECT_EQ(arm.control.base_frame().position.x, 1.0);
}

TEST(ArmControl, AResetOfTheWorldEndsAMoveAndTheArmRests) {
  Arm arm;
  arm.home();
  arm.control.move_jp({1.0, 0.0, 0.12, 0.0, 0.0, 0.0});
  arm.update(0.1);
  ++arm.epoch;
  start_afresh(arm.motion, arm.limits, arm.at);
  arm.show();
  EXPECT_FALSE(arm.control.busy());
  EXPECT_TRUE(arm.control.homed());
  EXPECT_EQ(arm.control.goal(), arm.control.set_position());
}

TEST(ArmControl, ARestoredStateIsThatOfTheSimulation) {
  Arm arm;
  arm.home();
  arm.control.move_jp({1.0, 0.0, 0.12, 0.0, 0.0, 0.0});
  arm.update(0.1);
  const ArmMotion saved = arm.motion;
  arm.control.state_command("disable");
  arm.update(0.1);
  arm.motion = saved;
  ++arm.epoch;
  arm.show();
  EXPECT_EQ(arm.control.state(), OperatingState::enabled);
  EXPECT_TRUE(arm.control.homed() && arm.control.busy());
  arm.run(5.0);
  EXPECT_FALSE(arm.control.busy());
  EXPECT_EQ(arm.control.set_position()[0], 1.0);
  EXPECT_EQ(arm.control.servo_jr({0.0, 0.1, 0.0, 0.0, 0.0, 0.0}), "");  // orders go on from those of the saved state
  arm.update(0.01);
  EXPECT_EQ(arm.control.set_position()[1], 0.1);
}

TEST(ArmControl, AnArmThatTheSimulationLetGoRestsWhereItIs) {
  Arm arm;
  arm.home();
  arm.active = false;
  arm.show();
  bool warned = false;
  for (const Event& event : arm.control.take_events()) warned |= event.kind == Event::Kind::warning;
  EXPECT_TRUE(warned);
  arm.update(0.01);
  EXPECT_TRUE(arm.active);
}

}  // namespace
}  // namespace ambf::crtk
