// Set-points of an arm obey each order once, keep limits, and say how moves ended.
#include "crtk/arm_motion.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ambf::crtk {
namespace {

constexpr double kStep_s = 1e-3;

struct Arm {
  Arm() {
    limits.joints = 2;
    limits.has_jaw = true;
    limits.axes[0] = {-1.0, 1.0, 0.5, 1.0, false};
    limits.axes[1] = {0.0, 0.2, 0.1, 0.2, true};
    limits.axes[2] = {0.0, 1.0, 2.0, 4.0, false};
  }
  void order(Mode mode, double first = 0.0, double second = 0.0) {
    command.arm = {++number, mode};
    command.values[0] = first, command.values[1] = second;
    obey(motion, limits, command, measured);
  }
  void order_jaw(Mode mode, double value) {
    command.jaw = {++number, mode};
    command.values[2] = value;
    obey(motion, limits, command, measured);
  }
  // Joints follow at once, unless they are stuck.
  void run(double seconds) {
    for (int i = 0; i < std::lround(seconds / kStep_s); ++i) {
      advance(motion, limits, measured, kStep_s);
      if (!stuck) measured = motion.position;
    }
  }

  ArmLimits limits;
  ArmMotion motion;
  ArmCommand command;
  Axes measured{};
  std::uint64_t number = 0;
  bool stuck = false;
};

TEST(ArmMotion, AMoveEndsAtRestAtItsGoalAndSaysSo) {
  Arm arm;
  arm.order(Mode::rest);
  arm.order(Mode::move, 0.3, 0.1);
  EXPECT_TRUE(arm.motion.arm.moves);
  arm.run(4.0);
  EXPECT_FALSE(arm.motion.arm.moves);
  EXPECT_TRUE(arm.motion.arm.reached);
  EXPECT_EQ(arm.motion.position[0], 0.3);
  EXPECT_EQ(arm.motion.velocity[1], 0.0);
}

TEST(ArmMotion, AMoveThatIsHeldUpEndsHalfASecondLaterAndIsNotReached) {
  Arm arm;
  arm.stuck = true;
  arm.order(Mode::rest);
  arm.order(Mode::move, 0.1);
  arm.run(0.9);
  EXPECT_TRUE(arm.motion.arm.moves);
  arm.run(0.3);
  EXPECT_FALSE(arm.motion.arm.moves);
  EXPECT_FALSE(arm.motion.arm.reached);
}

TEST(ArmMotion, ASecondMoveStartsFromTheMotionOfTheFirst) {
  Arm arm;
  arm.order(Mode::rest);
  arm.order(Mode::move, 0.9);
  arm.run(0.4);
  const double speed = arm.motion.velocity[0];
  EXPECT_GT(speed, 0.3);
  arm.order(Mode::move, -0.9);
  arm.run(kStep_s);
  EXPECT_NEAR(arm.motion.velocity[0], speed, 1.0 * kStep_s * (1.0 + 1e-6));
}

TEST(ArmMotion, TheSameOrderAgainChangesNothing) {
  Arm arm;
  arm.order(Mode::rest);
  arm.order(Mode::move, 0.5);
  arm.run(0.2);
  const double before = arm.motion.position[0];
  obey(arm.motion, arm.limits, arm.command, arm.measured);
  arm.order_jaw(Mode::position, 0.7);  // the jaw's order comes with the arm's old one
  EXPECT_EQ(arm.motion.position[0], before);
  EXPECT_TRUE(arm.motion.arm.moves);
  EXPECT_EQ(arm.motion.position[2], 0.7);
}

TEST(ArmMotion, HoldKeepsTheSetPointAndRestTheMeasuredPosition) {
  Arm arm;
  arm.stuck = true;
  arm.measured[0] = 0.2;
  arm.order(Mode::rest);
  EXPECT_EQ(arm.motion.position[0], 0.2);
  arm.order(Mode::position, 0.6);
  arm.order(Mode::hold);
  EXPECT_EQ(arm.motion.position[0], 0.6);
  arm.order(Mode::effort, 3.0);
  EXPECT_TRUE(exerts(arm.motion, arm.limits, 0));
  arm.order(Mode::hold);  // there is no set-point to keep
  EXPECT_EQ(arm.motion.position[0], 0.2);
}

TEST(ArmMotion, NothingLeavesTheLimits) {
  Arm arm;
  arm.order(Mode::rest);
  arm.order(Mode::position, 7.0, -7.0);
  EXPECT_EQ(arm.motion.position[0], 1.0);
  EXPECT_EQ(arm.motion.position[1], 0.0);
  arm.order(Mode::velocity, -100.0, 100.0);
  EXPECT_EQ(arm.motion.velocity[0], -0.5);
  arm.run(10.0);
  EXPECT_EQ(arm.motion.position[0], -1.0);
  EXPECT_EQ(arm.motion.position[1], 0.2);
}

TEST(ArmMotion, AxesThatAreNotMarkedKeepPositionsBesideEfforts) {
  Arm arm;
  arm.order(Mode::rest);
  arm.command.efforts = 1u;
  arm.order(Mode::effort, 2.0, 0.15);
  EXPECT_TRUE(exerts(arm.motion, arm.limits, 0));
  EXPECT_FALSE(exerts(arm.motion, arm.limits, 1));
  EXPECT_EQ(arm.motion.effort[0], 2.0);
  EXPECT_EQ(arm.motion.position[1], 0.15);
}

}  // namespace
}  // namespace ambf::crtk
