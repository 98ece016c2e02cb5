// The jaw follows a hand only once the hand's opening has met the tool's.
#include "devices/jaw.h"

#include <gtest/gtest.h>

namespace ambf::devices {
namespace {

TEST(Jaw, AGraspSurvivesTheStartUntilTheHandMeetsIt) {
  Jaw jaw;
  JawInput in;
  in.has_gripper = true;
  in.engaged = true;
  in.tool = 0.2;
  in.gripper = 0.9;
  jaw.step(in);
  EXPECT_FALSE(jaw.moves());
  in.gripper = 0.5;
  jaw.step(in);
  EXPECT_FALSE(jaw.moves());
  in.gripper = 0.1;  // past the tool's opening within one sample
  jaw.step(in);
  EXPECT_TRUE(jaw.follows());
  EXPECT_EQ(jaw.tool(), 0.1);
}

TEST(Jaw, AClutchHoldsItAndItGoesOnWhenMet) {
  Jaw jaw;
  JawInput in;
  in.has_gripper = true;
  in.engaged = true;
  in.tool = in.gripper = 0.0;
  jaw.step(in);
  in.engaged = false;
  in.gripper = 1.0;
  jaw.step(in);
  EXPECT_TRUE(jaw.moves());
  EXPECT_FALSE(jaw.follows());
  EXPECT_EQ(jaw.tool(), 0.0);
  in.engaged = true;
  jaw.step(in);
  EXPECT_EQ(jaw.tool(), 0.0) << "the hand is wide open: the grasp stays";
  in.gripper = 0.02;
  jaw.step(in);
  EXPECT_EQ(jaw.tool(), 0.02);
}

TEST(Jaw, AButtonClosesItAndItsReleaseOpensIt) {
  Jaw jaw;
  JawInput in;
  in.has_button = in.engaged = true;
  in.tool = 0.4;
  jaw.step(in);
  EXPECT_FALSE(jaw.moves()) << "up is open, and the tool is not";
  in.button = true;
  jaw.step(in);
  EXPECT_EQ(jaw.tool(), 0.0);
  in.button = false;
  jaw.step(in);
  EXPECT_EQ(jaw.tool(), 1.0);
}

TEST(Jaw, IsHalfOpenWhereNothingMovesItAndModesShiftIt) {
  Jaw jaw;
  JawInput in;
  in.engaged = true;
  in.tool = 0.0;
  jaw.step(in);
  EXPECT_EQ(jaw.tool(), 0.5);
  in.offset = -0.9;
  jaw.step(in);
  EXPECT_EQ(jaw.tool(), 0.0);
}

}  // namespace
}  // namespace ambf::devices
