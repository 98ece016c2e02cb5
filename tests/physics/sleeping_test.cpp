// Undisturbed bodies rest at no cost, stay where the same scene awake would be, and wake whenever something changes for
// them.
#include <gtest/gtest.h>

#include <functional>

#include "tests/physics/fixtures.h"

namespace ambf::physics {
namespace {

using namespace testing;

struct Pile {
  explicit Pile(bool sleeping)
      : world([sleeping] {
          WorldOptions options;
          options.sleeping = sleeping;
          return options;
        }()) {
    world.add(floor);
    for (int i = 0; i < 3; ++i) {
      tower.push_back(
          std::make_unique<Body>(parameters(1.0, {box(0.1, 0.1, 0.1)}, {0.002 * i, 0.001 * i, 0.051 + 0.102 * i})));
      world.add(*tower.back());
    }
    scene::PlacedGeometry can;
    can.geometry.shape = scene::Shape::cylinder;
    can.geometry.radius = 0.04;
    can.geometry.height = 0.1;
    alone.push_back(std::make_unique<Body>(parameters(0.3, {can}, {1, 0, 0.06})));
    alone.push_back(std::make_unique<Body>(parameters(0.2, {sphere(0.05)}, {2, 0, 0.051})));
    alone.push_back(std::make_unique<Body>(
        parameters(0.2, {box(0.02, 0.1, 0.02), box(0.1, 0.02, 0.02, {{0.05, 0, 0}, {}})}, {3, 0, 0.011})));
    for (auto& body : alone) world.add(*body);
  }
  Body floor{parameters(0.0, {ground()}, {})};
  std::vector<std::unique_ptr<Body>> tower, alone;
  World world;
};

TEST(Sleeping, SettledSceneSleepsAndDoesNotDifferFromTheAwakeOne) {
  Pile sleeping(true), awake(false);
  run(sleeping.world, 5.0);
  run(awake.world, 5.0);
  EXPECT_EQ(sleeping.world.awake_count(), 0u);
  EXPECT_EQ(awake.world.awake_count(), 6u);
  run(sleeping.world, 10.0);
  run(awake.world, 10.0);
  EXPECT_EQ(sleeping.world.steps(), 15000u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT(math::norm(sleeping.tower[i]->pose().position - awake.tower[i]->pose().position), 1e-4);
    EXPECT_LT(math::norm(sleeping.alone[i]->pose().position - awake.alone[i]->pose().position), 1e-4);
  }
}

TEST(Sleeping, SlowMotionIsNotTakenForRest) {
  WorldOptions options;
  options.gravity = {};
  World world(options);
  BodyDefinition p = mass_only(1.0, {1, 1, 1});
  p.shape = make_shape({box(0.1, 0.1, 0.1)}, {});
  Body drifting(p);
  p.T_world_body.position = {1, 0, 0};
  Body turning(p);
  world.add(drifting);
  world.add(turning);
  drifting.set_twist({{2e-5, 0, 0}, {}});
  turning.set_twist({{}, {0, 0, 2e-4}});
  run(world, 10.0);
  EXPECT_NEAR(drifting.pose().position.x, 2e-4, 1e-8);
  EXPECT_NEAR(math::log(turning.pose().orientation).z, 2e-3, 1e-6);
}

// A settled tower sleeps; what is done to it must wake it.
void expect_wakes(const std::function<void(Pile&)>& disturb, std::size_t who) {
  Pile pile(true);
  run(pile.world, 6.0);
  ASSERT_EQ(pile.world.awake_count(), 0u);
  disturb(pile);
  run(pile.world, 0.05);
  EXPECT_FALSE(pile.tower[who]->asleep());
}

TEST(Sleeping, WakesByForceTwistPoseGravityAndLossOfSupport) {
  expect_wakes([](Pile& p) { p.tower[2]->apply_force({0.1, 0, 0}, {}); }, 0);
  expect_wakes([](Pile& p) { p.tower[0]->apply_impulse({0.01, 0, 0}, {}); }, 2);
  expect_wakes([](Pile& p) { p.tower[1]->set_twist({{0.1, 0, 0}, {}}); }, 0);
  expect_wakes([](Pile& p) { p.tower[1]->set_pose({{5, 5, 1}, {}}); }, 2);
  expect_wakes([](Pile& p) { p.world.set_gravity({0, 0, -1}); }, 1);
  expect_wakes([](Pile& p) { p.tower[0]->set_gravity(math::Vec3{0, 0, -1}); }, 1);
  expect_wakes([](Pile& p) { p.floor.set_pose({{0, 0, -0.2}, {}}); }, 0);
  expect_wakes([](Pile& p) { p.floor.move_to({{0, 0, 0.001}, {}}); }, 0);
  expect_wakes([](Pile& p) { p.world.begin_pull(*p.tower[2], {0, 0, 0.3}); }, 0);
}

TEST(Sleeping, RemovingTheSupportLetsTheRestFall) {
  Pile pile(true);
  run(pile.world, 6.0);
  const double before = pile.tower[2]->pose().position.z;
  pile.world.remove(*pile.tower[0]);
  run(pile.world, 0.5);
  EXPECT_LT(pile.tower[2]->pose().position.z, before - 0.09);
}

TEST(Sleeping, TouchWakes) {
  Pile pile(true);
  run(pile.world, 6.0);
  Body ball(parameters(0.5, {sphere(0.05)}, {0.5, 0, 0.25}));
  pile.world.add(ball);
  EXPECT_TRUE(pile.tower[2]->asleep());
  ball.set_twist({{-3, 0, 1}, {}});
  run(pile.world, 0.5);
  EXPECT_GT(std::abs(pile.tower[2]->pose().position.x), 0.02);
}

TEST(Sleeping, WhatAppearsOrFallsAboveWakesOnlyByTouch) {
  Pile pile(true);
  run(pile.world, 6.0);
  const double top = pile.tower[2]->pose().position.z + 0.05;
  Body ball(parameters(0.5, {sphere(0.05)}, {0.004, 0.002, top + 0.05 + 0.02}));
  pile.world.add(ball);
  EXPECT_TRUE(pile.tower[2]->asleep()) << "2 cm above";
  double gap = 1.0;
  while (pile.tower[2]->asleep() && gap > -0.01) {
    pile.world.step();
    gap = ball.pose().position.z - 0.05 - top;
  }
  EXPECT_LT(gap, 3e-3) << "0.6 m/s are 0.6 mm a step";
  EXPECT_GT(gap, -3e-3) << "and it does not fall through";
}

TEST(Sleeping, WhatPassesWithoutTouchingWakesNobodyHoweverLarge) {
  World world;
  Body floor(parameters(0.0, {ground()}, {}));
  Body slab(parameters(50.0, {box(2, 2, 0.5)}, {0, 0, 0.251}));
  BodyDefinition hovering =
      parameters(50.0, {box(2, 2, 0.5)}, {0, 0, 0.5 + 0.25 + 0.01});  // contacts are kept from 2 cm on
  hovering.gravity = math::Vec3{};
  Body passing(hovering);
  world.add(floor);
  world.add(slab);
  run(world, 4.0);
  ASSERT_TRUE(slab.asleep());
  world.add(passing);
  run(world, 4.0);  // being added there woke it
  passing.set_twist({{0.01, 0, 0}, {}});
  run(world, 1.0);
  EXPECT_TRUE(slab.asleep()) << "passes 1 cm above";
  EXPECT_NEAR(passing.pose().position.x, 0.01, 1e-3);
  passing.set_twist({{0, 0, -1.0}, {}});
  run(world, 0.05);
  EXPECT_FALSE(slab.asleep()) << "was hit";
  EXPECT_GT(passing.pose().position.z, 0.5 + 0.25 - 3e-3) << "and not passed through";
}

TEST(Sleeping, NothingIsLostByWakingAndFallingAsleepAgain) {
  Pile pile(true);
  run(pile.world, 6.0);
  const double before = pile.tower[2]->pose().position.z;
  for (int i = 0; i < 10; ++i) {
    pile.tower[0]->wake();
    run(pile.world, 1.5);
  }
  EXPECT_EQ(pile.world.awake_count(), 0u);
  EXPECT_NEAR(pile.tower[2]->pose().position.z, before, 2e-5);
}

struct Arm {
  explicit Arm(const scene::Joint& description) : joint(description, base, link) {
    world.add(base);
    world.add(link);
    world.add(joint);
  }
  static scene::Joint hinge() {
    scene::Joint description;
    description.parent_axis = description.child_axis = {0, 1, 0};
    description.child_pivot = {-0.2, 0, 0};
    return description;
  }
  World world;
  Body base{mass_only(0.0, {})}, link{mass_only(1.0, {0.01, 0.01, 0.01}, {{0.2, 0, 0}, {}})};
  Joint joint;
};

TEST(Sleeping, AHoldingMotorSleepsAndWakesWithItsCommand) {
  Arm arm(Arm::hinge());
  for (int i = 0; i < 3000; ++i) {
    arm.joint.set_motor_velocity(0.0, 0.1);
    arm.world.step();
  }
  EXPECT_TRUE(arm.link.asleep());
  for (int i = 0; i < 1000; ++i) {
    arm.joint.set_motor_velocity(0.1, 0.1);
    arm.world.step();
  }
  EXPECT_NEAR(arm.joint.position(), 0.1, 1e-3);
}

TEST(Sleeping, AnEffortControllerSleepsAtItsTargetAndFollowsTheNext) {
  Arm arm(Arm::hinge());
  double target = 0.0;
  const auto control = [&](double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 1000); ++i) {
      arm.joint.set_effort(50.0 * (target - arm.joint.position()) - 2.0 * arm.joint.velocity() - 1.96);
      arm.world.step();
    }
  };
  control(6.0);
  EXPECT_TRUE(arm.link.asleep());
  target = 0.2;
  control(4.0);
  EXPECT_NEAR(arm.joint.position(), 0.2, 5e-3);
  // Even a small change of the target is followed.
  control(4.0);
  EXPECT_TRUE(arm.link.asleep());
  const double before = arm.joint.position();
  target += 1e-3;
  control(4.0);
  EXPECT_NEAR(arm.joint.position() - before, 1e-3, 2e-4);
}

TEST(Sleeping, AServoWakesWithItsTarget) {
  Arm arm(Arm::hinge());
  arm.joint.set_servo({.position = 0.0, .stiffness = 1e4, .damping = 1e3});
  run(arm.world, 4.0);
  EXPECT_TRUE(arm.link.asleep());
  arm.joint.set_servo({.position = 0.05, .stiffness = 1e4, .damping = 1e3});
  run(arm.world, 3.0);
  EXPECT_NEAR(arm.joint.position(), 0.05, 1e-3);
}

TEST(Sleeping, AMovingMotorKeepsItsMechanismAwake) {
  Arm arm(Arm::hinge());
  arm.joint.set_motor_velocity(1e-3, 1.0);
  run(arm.world, 10.0);
  EXPECT_NEAR(arm.joint.position(), 0.01, 1e-5);
}

TEST(Sleeping, CarryingTheBaseMovesTheSleepingArm) {
  Arm arm(Arm::hinge());
  arm.joint.set_motor_velocity(0.0, 1.0);
  run(arm.world, 3.0);
  ASSERT_TRUE(arm.link.asleep());
  for (int i = 0; i < 100; ++i) {
    arm.base.move_to({{0, 0, 1e-3 * (i + 1)}, {}});
    arm.world.step();
  }
  EXPECT_NEAR(arm.link.pose().position.z, 0.1, 1e-3);
  EXPECT_LT(arm.joint.gap().position, 1e-5);
}

TEST(Sleeping, ASleepingSceneCostsNextToNothing) {
  Pile sleeping(true), awake(false);
  run(sleeping.world, 5.0);
  run(awake.world, 5.0);
  const auto cpu_seconds = [](World& world) {
    timespec start{}, end{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &start);
    run(world, 4.0);
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &end);
    return static_cast<double>(end.tv_sec - start.tv_sec) + 1e-9 * static_cast<double>(end.tv_nsec - start.tv_nsec);
  };
  EXPECT_LT(cpu_seconds(sleeping.world), 0.05 * cpu_seconds(awake.world));
}

}  // namespace
}  // namespace ambf::physics
