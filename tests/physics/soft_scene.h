// A world for tests of tissue and threads, and that what is saved of them goes on as it was.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "physics/tissue.h"
#include "physics/world.h"
#include "tests/physics/fixtures.h"

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

// One tissue above another, in a world of their own.
struct TwoTissues : Scene {
  TwoTissues(const TissueDefinition& low, const TissueDefinition& high, const math::Vec3& gravity = {0, 0, -kG})
      : Scene(gravity), lower(low), upper(high) {
    add(world, lower);
    add(world, upper);
  }
  ~TwoTissues() {
    remove(world, upper);
    remove(world, lower);
  }
  std::vector<double> state() const {
    std::vector<double> all, more;
    lower.get_state(all);
    upper.get_state(more);
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  Tissue lower, upper;
};

// Three that were made alike: two take the same steps until they touch, the third goes on from their state, and all end
// alike. run(two, steps) takes steps.
template <typename Two, typename Run>
void expect_repeats_and_is_saved(Two& first, Two& again, Two& other, int before, int after, const Run& run) {
  std::vector<double> lower, upper;
  for (Two* each : {&first, &again}) {
    run(*each, before);
    EXPECT_GT(each->upper.touches(), 0U);
    each->lower.get_state(lower);
    each->upper.get_state(upper);
    ASSERT_TRUE(each->lower.set_state(lower));  // as saving a world does
    ASSERT_TRUE(each->upper.set_state(upper));
  }
  ASSERT_TRUE(other.lower.set_state(lower));
  ASSERT_TRUE(other.upper.set_state(upper));
  for (Two* each : {&first, &again, &other}) run(*each, after);
  EXPECT_EQ(first.state(), again.state());
  EXPECT_EQ(first.state(), other.state());
}

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

// Thrown at 0.5 m/s along x at a cube of 40 mm, without gravity; after these steps they have met.
inline void expect_keeps_the_momentum_of_both(const TissueDefinition& thrown, double to_the_cube, int steps) {
  Scene scene({0, 0, 0});
  Tissue tissue(thrown);
  BodyDefinition target_of = parameters(0.03, {box(0.04, 0.04, 0.04)}, {to_the_cube, 0.003, 0.0});
  target_of.surface.linear_damping = target_of.surface.angular_damping = 0.0;
  Body target(target_of);
  scene.world.add(target);
  add(scene.world, tissue);
  tissue.apply_wrench({{tissue.mass() * 0.5 / 0.001, 0, 0}, {}});
  scene.step(1);
  const math::Vec3 before = tissue.momentum();
  scene.step(steps);
  EXPECT_GT(target.twist().linear.x, 0.05);
  EXPECT_LT(math::norm(tissue.momentum() + target.twist().linear * target.mass() - before), 1e-6 * math::norm(before));
  remove(scene.world, tissue);
}

}  // namespace ambf::physics::testing
