// Fast bodies do not pass through what is thinner than their way in one step.
#include <gtest/gtest.h>

#include "fixtures.h"

namespace ambf::physics::testing {
namespace {

BodyDefinition projectile(const std::vector<scene::PlacedGeometry>& parts, const math::Vec3& at) {
  BodyDefinition p = parameters(0.01, parts, at);
  p.gravity = math::Vec3{};
  p.surface.linear_damping = 0.0;
  return p;
}

// The highest x that the body reaches in so many steps, started at -0.5 m with this speed along x.
double reached(Body& body, World& world, double speed, int steps = 60) {
  world.add(body);
  body.set_twist({{speed, 0, 0}, {}});
  double x = body.pose().position.x;
  for (int i = 0; i < steps; ++i) {
    world.step();
    x = std::max(x, body.pose().position.x);
  }
  world.remove(body);
  return x;
}

TEST(SweptMotion, ABallOf5MillimetresStopsAtAPlateOf2) {
  for (const double speed : {3.0, 20.0, 100.0, 333.3, 1000.0}) {
    World world;
    Body plate(parameters(0.0, {box(0.002, 1, 1)}, {}));
    world.add(plate);
    Body ball(projectile({sphere(0.0025)}, {-0.5, 0, 0}));
    EXPECT_LT(reached(ball, world, speed, 400), 0.0) << speed;
  }
}

TEST(SweptMotion, BoxesAndPartsOfCompoundsAreStoppedToo) {
  for (const auto& parts : {std::vector{box(0.01, 0.01, 0.01)},
                            std::vector{sphere(0.005, {{0, 0.1, 0}, {}}), sphere(0.005, {{0, -0.1, 0}, {}})}}) {
    World world;
    Body plate(parameters(0.0, {box(0.002, 1, 1)}, {}));
    world.add(plate);
    Body body(projectile(parts, {-0.5, 0, 0}));
    EXPECT_LT(reached(body, world, 200.0), 0.0);
  }
}

TEST(SweptMotion, WhatMovesMeetsWhatMoves) {
  World world;
  Body plate(projectile({box(0.002, 0.2, 0.2)}, {}));
  world.add(plate);
  Body ball(projectile({sphere(0.0025)}, {-0.5, 0, 0}));
  world.add(ball);
  ball.set_twist({{100, 0, 0}, {}});
  plate.set_twist({{-100, 0, 0}, {}});
  for (int i = 0; i < 20; ++i) {
    world.step();
    ASSERT_LT(ball.pose().position.x, plate.pose().position.x);
  }
  world.remove(ball);
  world.remove(plate);
}

TEST(SweptMotion, NothingIsStoppedOnAFreeWay) {
  World world;
  Body plate(parameters(0.0, {box(0.002, 1, 1)}, {0, 0, -0.51}));
  Body other(projectile({sphere(0.0025)}, {-0.4, 0, 0}));  // flies ahead as fast
  world.add(plate);
  world.add(other);
  other.set_twist({{100, 0, 0}, {}});
  Body ball(projectile({sphere(0.0025)}, {-0.5, 0, 0}));
  EXPECT_NEAR(reached(ball, world, 100.0, 20), 1.5, 1e-9);
  world.remove(other);
  world.remove(plate);
}

TEST(SweptMotion, WhatSlidesFastSlidesOn) {
  World world;
  BodyDefinition smooth = parameters(0.0, {box(20, 1, 0.1)}, {0, 0, -0.05});
  smooth.surface.friction = 0.0;
  Body floor(smooth);
  world.add(floor);
  BodyDefinition puck = parameters(0.01, {box(0.01, 0.01, 0.004)}, {-5, 0, 0.002});
  puck.surface.friction = puck.surface.linear_damping = 0.0;
  Body body(puck);
  world.add(body);
  body.set_twist({{50, 0, 0}, {}});
  for (int i = 0; i < 100; ++i) world.step();
  EXPECT_NEAR(body.pose().position.x, 0.0, 1e-3);
  EXPECT_NEAR(body.pose().position.z, 0.002, 1e-4);
}

}  // namespace
}  // namespace ambf::physics::testing
