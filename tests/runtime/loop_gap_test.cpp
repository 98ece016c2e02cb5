// Joints hold together while everything moves: the pivots of a joint stay together in our own models, and in models of
// others, whose pivots are rounded so that loops cannot close, as near as any placing of the bodies could bring them.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/runtime/joint_motion.h"
#include "tests/runtime/least_squares_assembly.h"

namespace ambf::runtime {
namespace {

using namespace test;

constexpr double kSeconds = 5.0;      // two periods after the blend
constexpr unsigned kAssembled = 200;  // steps until joints that the file leaves apart have been pulled together
constexpr unsigned kEvery = 50;       // steps between two computations of what is possible; it changes slowly
constexpr double kOwnBar = 0.05e-3, kCompatBar = 0.02e-3;  // m

struct OwnModel {
  const char* file;
  const char* name;
};

class OwnModelGaps : public testing::TestWithParam<OwnModel> {};

TEST_P(OwnModelGaps, StayBelowFiveHundredthsOfAMillimetreUnderSinusoids) {
  ModelRig rig(own_world());
  const state::Outcome loaded = rig.load(own_model(GetParam().file));
  ASSERT_TRUE(loaded.success) << loaded.message;
  ASSERT_FALSE(rig.joints.empty());
  JointMotion motion(rig);
  ASSERT_GT(motion.joint_count(), 0u);

  double largest = 0.0;
  std::string whose;
  for (unsigned step = 1; step <= kSeconds * 1e3; ++step) {
    ASSERT_TRUE(rig.step(1, motion.at(step * 1e-3)).success);
    std::string name;
    const double gap = rig.largest_gap(&name);
    if (gap > largest) largest = gap, whose = name;
    motion.note(rig.frame());
  }
  std::printf("%-18s %2zu joints, largest gap %.5f mm (%s)\n", GetParam().name, motion.joint_count(), largest * 1e3,
              whose.c_str());
  EXPECT_LT(largest, kOwnBar) << whose;
  EXPECT_EQ(motion.share_that_moved(), 1.0);
}

INSTANTIATE_TEST_SUITE_P(Models, OwnModelGaps,
                         testing::Values(OwnModel{"robots/arm7.yaml", "arm7"},
                                         OwnModel{"mechanisms/four_bar.yaml", "four_bar"},
                                         OwnModel{"mechanisms/stewart_platform.yaml", "stewart_platform"},
                                         OwnModel{"grippers/two_finger.yaml", "two_finger"},
                                         OwnModel{"puzzles/peg_transfer.yaml", "peg_transfer"},
                                         OwnModel{"vehicles/toy_car.yaml", "toy_car"}),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

class CompatModelGaps : public testing::TestWithParam<OwnModel> {};

TEST_P(CompatModelGaps, StayAtTheModelsOwnLeastSquaresResidual) {
  AMBF_NEEDS_COMPAT();
  ModelRig rig(world_of(own_descriptions() + "world/empty_world.yaml"));
  const state::Outcome loaded = rig.load(compat::model(GetParam().file));
  ASSERT_TRUE(loaded.success) << loaded.message;
  JointMotion motion(rig);
  ASSERT_GT(motion.joint_count(), 0u);

  double worst_excess = -1.0, gap_there = 0.0, best_there = 0.0, possible = 0.0;
  std::string whose;
  for (unsigned step = 1; step <= kSeconds * 1e3; ++step) {
    ASSERT_TRUE(rig.step(1, motion.at(step * 1e-3)).success);
    ASSERT_FALSE(rig.frame().run.diverged);
    motion.note(rig.frame());
    if (step < kAssembled) continue;
    std::string name;
    const double gap = rig.largest_gap(&name);
    if (step % kEvery == 0) {
      const Assembly best = assemble(rig.joints, *rig.simulation.structure(), rig.frame());
      ASSERT_TRUE(best.converged);
      possible = best.largest_gap;
    }
    if (gap - possible <= worst_excess) continue;
    worst_excess = gap - possible;
    gap_there = gap, best_there = possible;
    whose = name;
  }
  std::printf("%-18s %2zu joints, worst gap %.5f mm where the best assembly has %.5f mm (%s)\n", GetParam().name,
              motion.joint_count(), gap_there * 1e3, best_there * 1e3, whose.c_str());
  EXPECT_LT(worst_excess, kCompatBar) << whose;
  EXPECT_GT(motion.share_that_moved(), 0.5);
}

INSTANTIATE_TEST_SUITE_P(Models, CompatModelGaps,
                         testing::Values(OwnModel{"robots/blender-psm.yaml", "psm"},
                                         OwnModel{"robots/blender-ecm.yaml", "ecm"},
                                         OwnModel{"robots/blender-mtm.yaml", "mtm"},
                                         OwnModel{"robots/blender-neuro-robot.yaml", "neuro_robot"}),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

}  // namespace
}  // namespace ambf::runtime
