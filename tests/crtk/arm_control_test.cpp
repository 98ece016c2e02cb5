// An arm's states, set-points and moves, without ROS: what a client may count on in every order of commands.
#include "crtk/arm_control.h"

#include <gtest/gtest.h>

#include <limits>

namespace ambf::crtk {
namespace {

// A PSM whose joints follow their set-points at once.
class Arm {
 public:
  Arm() : control(description()) { update(0.0); }

  static adf::CrtkArm description() {
    const auto read = adf::parse_crtk_arms(
        "crtk arms: {PSM1: {kinematics: PSM, base: base, max velocity: [1, 1, 0.2, 1, 1, 1], "
        "max acceleration: [2, 2, 1, 2, 2, 2]}}",
        "arms.yaml");
    EXPECT_TRUE(read.diagnostics.empty());
    return read.arms.at(0);
  }
  void update(double seconds) {
    time_s += seconds;
    Measured measured;
    measured.valid = true;
    measured.position = control.set_position();
    measured.position.push_back(control.jaw_position());
    measured.velocity.assign(7, 0.0);
    measured.sim_time = time_s;
    measured.epoch = epoch;
    measured.stamp_ns = 1 + static_cast<std::int64_t>(time_s * 1e9);
    control.update(measured, now_ns += 3'000'000'000);
  }
  void run(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 100); ++i) update(0.01);
  }
  void home() {
    control.state_command("home");
    run(5.0);
    ASSERT_TRUE(control.homed());
    control.take_events();
  }
  std::vector<bool> busy_events() {
    std::vector<bool> seen;
    for (const Event& event : control.take_events()) {
      if (event.kind == Event::Kind::state) seen.push_back(event.busy);
    }
    return seen;
  }

  ArmControl control;
  double time_s = 0.0;
  std::uint64_t epoch = 1;
  std::int64_t now_ns = 0;
};

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
  arm.update(0.0);
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
    told |= event.kind == Event::Kind::goal_reached && !event.reached;
  }
  EXPECT_TRUE(told);
  EXPECT_FALSE(arm.control.busy());
}

TEST(ArmControl, NothingIsAskedOfTheJointsUnlessItIsEnabledOrPaused) {
  Arm arm;
  EXPECT_TRUE(arm.control.targets().empty());
  arm.home();
  EXPECT_EQ(arm.control.targets().size(), 7U);
  arm.control.state_command("pause");
  EXPECT_EQ(arm.control.targets().size(), 7U);
  EXPECT_NE(arm.control.servo_jp(Joints(6, 0.1)), "");
  EXPECT_EQ(arm.control.set_position()[0], 0.0);
  arm.control.state_command("disable");
  EXPECT_TRUE(arm.control.targets().empty());
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
  EXPECT_EQ(arm.control.targets()[0].type, state::JointCommandType::effort);
  EXPECT_FALSE(arm.control.holds_position());
}

TEST(ArmControl, AResetOfTheWorldEndsAMoveAndTheArmRests) {
  Arm arm;
  arm.home();
  arm.control.move_jp({1.0, 0.0, 0.12, 0.0, 0.0, 0.0});
  ++arm.epoch;
  arm.update(0.01);
  EXPECT_FALSE(arm.control.busy());
  EXPECT_EQ(arm.control.goal(), arm.control.set_position());
}

}  // namespace
}  // namespace ambf::crtk
