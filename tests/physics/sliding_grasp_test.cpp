// A cube between two pads that press with a known force: friction is mu N, and turns nothing.
#include <gtest/gtest.h>

#include "tests/physics/fixtures.h"

namespace ambf::physics {
namespace {

using namespace testing;

constexpr double kGravity = 9.8, kForce = 6.96, kMass = 0.1;  // m/s^2, N, kg

struct Grip {
  Grip(double h, double friction)
      : world([h] {
          WorldOptions options;
          options.step = h;
          options.gravity = {0.0, 0.0, -kGravity};
          options.sleeping = false;
          return options;
        }()),
        frame(mass_only(0.0, {})),
        cube([friction] {
          BodyDefinition definition = parameters(kMass, {box(0.05, 0.05, 0.05)}, {});
          definition.surface = {friction, 0.0, 0.0, 0.0, 0.0};
          return definition;
        }()) {
    world.add(frame);
    world.add(cube);
    for (const double side : {-1.0, 1.0}) {
      BodyDefinition definition = parameters(0.1, {box(0.02, 0.1, 2.0)}, {0.035 * side, 0.0, 0.0});
      definition.surface = {1.0, 0.0, 0.0, 0.0, 0.0};
      definition.gravity = math::Vec3{};
      pads.push_back(std::make_unique<Body>(definition));
      world.add(*pads.back());
      scene::Joint slider;
      slider.type = state::JointType::prismatic;
      slider.parent_pivot = {0.035 * side, 0.0, 0.0};
      slider.parent_axis = slider.child_axis = {1.0, 0.0, 0.0};
      sliders.push_back(std::make_unique<Joint>(slider, frame, *pads.back()));
      world.add(*sliders.back());
      sliders.back()->set_effort(-side * kForce);
    }
  }
  ~Grip() {
    for (auto& slider : sliders) world.remove(*slider);
  }
  World world;
  Body frame, cube;
  std::vector<std::unique_ptr<Body>> pads;
  std::vector<std::unique_ptr<Joint>> sliders;
};

TEST(SlidingGrasp, FrictionIsThatOfTheForceAndTurnsNothing) {
  for (const double h : {2e-3, 1e-3, 2e-4}) {
    const double friction = 0.05;
    Grip grip(h, friction);
    run(grip.world, 0.1);
    const double before = grip.cube.twist().linear.z;
    run(grip.world, 0.2);
    const double slowed = kGravity + (grip.cube.twist().linear.z - before) / 0.2;
    EXPECT_NEAR(slowed * kMass / (2.0 * friction * kForce), 1.0, 1e-6) << "step " << h;
    EXPECT_LT(math::norm(math::log(grip.cube.pose().orientation)), 1e-3) << "step " << h;
  }
}

// What it slides in the first steps, while the pads come to press, goes on at critical friction.
TEST(SlidingGrasp, HoldsAtCriticalFrictionAndSlidesBelow) {
  const double critical = kMass * kGravity / (2.0 * kForce);
  for (const double share : {1.0, 0.995}) {
    Grip grip(1e-3, share * critical);
    run(grip.world, 2.0);
    const double fallen = -grip.cube.pose().position.z;
    const double expected = 0.5 * (1.0 - share) * kGravity * 4.0;
    EXPECT_NEAR(fallen, expected, 3e-3) << share;
  }
}

}  // namespace
}  // namespace ambf::physics
