// Random scenes of ten bodies stay numbers and gain no energy; tests/benchmarks/random_scenes_benchmark.cpp runs 10^4.
#include <gtest/gtest.h>

#include "tests/physics/random_scene.h"

namespace ambf::physics {
namespace {

TEST(RandomScene, GainsNoEnergyWithoutWork) {
  int scenes_that_gain = 0;
  for (unsigned seed = 1000; seed < 1080; ++seed) {
    const testing::RandomScene::Result result = testing::RandomScene(seed).run(0.2);
    ASSERT_TRUE(result.finite) << "seed " << seed;
    EXPECT_LT(result.gain, 0.3) << "seed " << seed;
    if (result.gain > 0.01) ++scenes_that_gain;
  }
  // Boxes that hit the floor with a corner and restitution: the impulse of friction is not bounded by their energy.
  EXPECT_LE(scenes_that_gain, 2);
}

}  // namespace
}  // namespace ambf::physics
