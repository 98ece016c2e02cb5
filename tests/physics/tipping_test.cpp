// Rolling friction on bodies that tip: an edge is no wheel.
#include <gtest/gtest.h>

#include "fixtures.h"

namespace ambf::physics::testing {
namespace {

BodyDefinition floor_of_default_friction() { return parameters(0.0, {ground()}, {}); }

// A small tile on its edge, its COM 4 mm beside it, with the lever of 10 mm that files have by default.
TEST(Tipping, ATileThatLeansOnItsEdgeFallsOver) {
  World world;
  Body floor(floor_of_default_friction());
  BodyDefinition tile = parameters(0.02, {box(0.02, 0.02, 0.006)}, {});
  const double lean = 0.5 * kPi - 0.6;
  tile.T_world_body = {{0, 0, 0.01 * std::sin(lean) + 0.003 * std::cos(lean) + 1e-4}, math::from_rpy(0, lean, 0)};
  Body body(tile);
  world.add(floor);
  world.add(body);
  run(world, 0.5);
  EXPECT_NEAR(body.com_pose().position.z, 0.003, 2e-4);
}

// What rolls keeps the lever that its file says, however large.
TEST(Tipping, ABallStaysOnASlopeByItsLever) {
  for (const double lever : {0.0, 0.02}) {
    World world;
    world.set_gravity({9.81 * std::sin(0.3), 0, -9.81 * std::cos(0.3)});
    BodyDefinition ground = floor_of_default_friction();
    BodyDefinition ball = parameters(0.1, {sphere(0.02)}, {0, 0, 0.02});
    for (BodyDefinition* body : {&ground, &ball}) {
      body->surface.friction = 1.0;
      body->surface.rolling_friction = lever;
    }
    Body floor(ground), body(ball);
    world.add(floor);
    world.add(body);
    run(world, 1.0);
    EXPECT_EQ(body.com_pose().position.x > 0.01, lever == 0.0) << body.com_pose().position.x;
  }
}

}  // namespace
}  // namespace ambf::physics::testing
