// Trajectories of one joint keep their limits and end at their goals, whatever motion they start in.
#include "crtk/joint_motion.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ambf::crtk {
namespace {

TEST(JointMotion, KeepsItsLimitsAndRestsExactlyAtTheGoal) {
  const MotionLimits limits{0.7, 1.3};
  for (const double h_s : {1e-3, 2.5e-4}) {
    for (const double goal : {0.9, -0.4, 1e-7, 0.00123}) {
      for (const double velocity : {0.0, 0.7, -0.6}) {
        JointMotion motion{0.0, velocity};
        int steps = 0;
        for (bool rests = false; !rests && steps < 100'000; ++steps) {
          const double before = motion.velocity;
          rests = advance(motion, goal, limits, h_s);
          EXPECT_LE(std::abs(motion.velocity - before), limits.acceleration * h_s * (1.0 + 1e-6));
          EXPECT_LE(std::abs(motion.velocity), limits.velocity);
        }
        EXPECT_EQ(motion.position, goal);
        EXPECT_EQ(motion.velocity, 0.0);
      }
    }
  }
}

TEST(JointMotion, TakesAboutTheTimeOfATrapezoid) {
  JointMotion motion;
  int steps = 0;
  while (!advance(motion, 1.0, {0.5, 1.0}, 1e-3)) ++steps;
  EXPECT_NEAR(steps * 1e-3, 1.0 / 0.5 + 0.5 / 1.0, 0.01);  // s
}

TEST(JointMotion, FollowsANewGoalWithoutAStepOfItsVelocity) {
  JointMotion motion;
  for (int i = 0; i < 400; ++i) advance(motion, 1.0, {0.5, 1.0}, 1e-3);
  for (int i = 0; i < 10'000; ++i) {
    const double before = motion.velocity;
    if (advance(motion, -1.0, {0.5, 1.0}, 1e-3)) break;
    ASSERT_LE(std::abs(motion.velocity - before), 1e-3 * (1.0 + 1e-6));
  }
  EXPECT_EQ(motion.position, -1.0);
}

}  // namespace
}  // namespace ambf::crtk
