// Bodies that are led from outside: posed ones that carry what rests on them, and pulled ones.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/physics/fixtures.h"

namespace ambf::physics {
namespace {

using namespace testing;

TEST(CarriedBody, TakesAlongWhatRestsOnItAndArrivesExactly) {
  World world;
  BodyDefinition tray_parameters = parameters(0.0, {box(0.5, 0.5, 0.02)}, {});
  BodyDefinition cube_parameters = parameters(0.5, {box(0.05, 0.05, 0.05)}, {0, 0, 0.035});
  tray_parameters.surface.friction = cube_parameters.surface.friction = 1.0;
  Body tray(tray_parameters), cube(cube_parameters);
  world.add(tray);
  world.add(cube);
  run(world, 0.5);
  // Accelerates gently to 0.2 m/s sideways.
  double x = 0.0;
  for (int i = 0; i < 2000; ++i) {
    x += 0.2e-3 * std::min(1.0, i / 500.0);
    tray.move_to({{x, 0, 0}, {}});
    world.step();
    ASSERT_NEAR(tray.pose().position.x, x, 1e-12);
  }
  EXPECT_NEAR(cube.pose().position.x, x, 2e-3);
  EXPECT_NEAR(cube.twist().linear.x, 0.2, 5e-3);
  EXPECT_EQ(tray.twist().linear, (math::Vec3{}));
}

TEST(CarriedBody, PosingItWhereItIsDisturbsNothing) {
  World world;
  Body table(parameters(0.0, {box(1, 1, 0.1)}, {})), cube(parameters(0.5, {box(0.05, 0.05, 0.05)}, {0, 0, 0.075}));
  world.add(table);
  world.add(cube);
  run(world, 1.0);
  const math::Vec3 before = cube.pose().position;
  const math::Pose same = table.pose();
  for (int i = 0; i < 5000; ++i) {
    table.set_pose(same);
    world.step();
  }
  EXPECT_LT(math::norm(cube.pose().position - before), 1e-6);
  EXPECT_TRUE(cube.asleep());
}

TEST(Pull, TakesABodyToTheTargetAndLetsGo) {
  World world;
  Body floor(parameters(0.0, {ground()}, {})), cube(parameters(0.5, {box(0.1, 0.1, 0.1)}, {0, 0, 0.05}));
  world.add(floor);
  world.add(cube);
  run(world, 2.0);
  EXPECT_TRUE(cube.asleep());
  EXPECT_EQ(world.begin_pull(floor, {0, 0, 0}), -1);
  const int pull = world.begin_pull(cube, {0, 0, 0.1});
  ASSERT_GE(pull, 0);
  EXPECT_EQ(world.pulled(pull), &cube);
  for (int i = 0; i < 2000; ++i) {
    world.move_pull(pull, {std::min(0.2, i * 2e-4), 0, 0.1 + std::min(0.3, i * 3e-4)});
    world.step();
  }
  const math::Vec3 held = cube.pose() * math::Vec3{0, 0, 0.05};
  EXPECT_NEAR(held.x, 0.2, 5e-3);
  EXPECT_NEAR(held.z, 0.4, 5e-3);
  EXPECT_NEAR(world.pull_wrench(pull).force.z, 0.5 * 9.8, 0.6) << "it carries the body, which swings a little";
  world.end_pull(pull);
  EXPECT_EQ(world.pulled(pull), nullptr);
  run(world, 2.0);
  EXPECT_NEAR(cube.pose().position.z, 0.05, 2e-3);
}

TEST(Pull, EndsWhenItsBodyLeaves) {
  World world;
  Body cube(parameters(0.5, {box(0.1, 0.1, 0.1)}, {}));
  world.add(cube);
  const int pull = world.begin_pull(cube, {});
  ASSERT_GE(pull, 0);
  world.remove(cube);
  EXPECT_EQ(world.pulled(pull), nullptr);
  world.step();
}

TEST(Pull, IsLimitedByTheMassOfItsBody) {
  World world(WorldOptions{.gravity = {}});
  Body wall(parameters(0.0, {box(0.1, 10, 10)}, {1, 0, 0})), cube(parameters(0.5, {box(0.1, 0.1, 0.1)}, {}));
  world.add(wall);
  world.add(cube);
  const int pull = world.begin_pull(cube, {});
  world.move_pull(pull, {50, 0, 0});  // far behind the wall
  run(world, 1.0);
  EXPECT_LT(cube.pose().position.x, 0.92) << "through the wall";
  EXPECT_NEAR(world.pull_wrench(pull).force.x, 0.5 / world.options().step, 1.0);
}

TEST(Pull, SeveralActAtOnceAndEachEndsAlone) {
  World world;
  Body left(parameters(0.5, {box(0.1, 0.1, 0.1)}, {-1, 0, 0})), right(parameters(2.0, {box(0.1, 0.1, 0.1)}, {1, 0, 0}));
  world.add(left);
  world.add(right);
  const int first = world.begin_pull(left, {-1, 0, 0}), second = world.begin_pull(right, {0.95, 0, 0});
  const int third = world.begin_pull(right, {1.05, 0, 0});
  world.move_pull(first, {-1, 0, 0.5});
  world.move_pull(second, {0.95, 0, 0.2});
  world.move_pull(third, {1.05, 0, 0.2});
  run(world, 2.0);
  EXPECT_NEAR(left.pose().position.z, 0.5, 5e-3);
  EXPECT_NEAR(right.pose().position.z, 0.2, 5e-3);
  EXPECT_NEAR(world.pull_wrench(second).force.z + world.pull_wrench(third).force.z, 2.0 * 9.8, 0.1)
      << "two carry it together";
  world.end_pull(first);
  run(world, 0.2);
  EXPECT_LT(left.pose().position.z, 0.35) << "let go";
  EXPECT_NEAR(right.pose().position.z, 0.2, 5e-3) << "still held";
}

}  // namespace
}  // namespace ambf::physics
