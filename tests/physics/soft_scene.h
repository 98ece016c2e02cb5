// A world for tests of tissue and threads, and that what is saved of them goes on as it was.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "physics/tissue.h"
#include "physics/world.h"

namespace ambf::physics::testing {

constexpr double kG = 9.81;  // m/s^2

struct Scene {
  explicit Scene(const math::Vec3& gravity = {0, 0, -kG}, double step = 0.001) : world(options(gravity, step)) {}
  static WorldOptions options(const math::Vec3& gravity, double step) {
    WorldOptions made;
    made.gravity = gravity;
    made.step = step;
    return made;
  }
  void step(int steps) {
    for (int i = 0; i < steps; ++i) world.step();
  }
  World world;
};

// From its state after some steps it goes on bit for bit; a reset brings its centre back to where it was loaded, within
// `near` m.
inline void expect_goes_on_from_its_state(Scene& scene, Tissue& tissue, int before, int after, const math::Vec3& loaded,
                                          double near) {
  scene.step(before);
  std::vector<double> state, later, again;
  std::vector<std::byte> saved;
  scene.world.save_state(saved);
  tissue.get_state(state);
  ASSERT_EQ(state.size(), tissue.state_size());
  scene.step(after);
  tissue.get_state(later);
  scene.world.restore_state(saved);
  EXPECT_TRUE(tissue.set_state(state));
  scene.step(after);
  tissue.get_state(again);
  EXPECT_EQ(later, again);
  state.pop_back();
  EXPECT_FALSE(tissue.set_state(state));
  tissue.reset();
  EXPECT_LT(math::norm(tissue.centre().position - loaded), near);
}

}  // namespace ambf::physics::testing
