// Heavy bodies on light ones.
#include <gtest/gtest.h>

#include "fixtures.h"

namespace ambf::physics::testing {
namespace {

TEST(HeavyLoad, StaysOnABoxOfATenThousandthOfItsMass) {
  for (const double mass : {1000.0, 10000.0}) {
    World world;
    Body floor(parameters(0.0, {ground()}, {}));
    Body small(parameters(1.0, {box(0.1, 0.1, 0.1)}, {0, 0, 0.05}));
    Body load(parameters(mass, {box(0.5, 0.5, 0.5)}, {0, 0, 0.35}));
    for (Body* body : {&floor, &small, &load}) world.add(*body);
    run(world, 3.0);
    const math::Vec3 at = load.pose().position;
    EXPECT_LT(std::hypot(at.x, at.y), 0.03) << mass;
    EXPECT_NEAR(at.z, 0.35, 0.005) << mass;
    EXPECT_LT(math::norm(small.pose().position - math::Vec3{0, 0, 0.05}), 0.01) << mass;
    for (Body* body : {&load, &small, &floor}) world.remove(*body);
  }
}

// A mat and a board leave a needle of 2 g less room than it takes: whatever pushes it out of one presses it into the
// other, with no end to it. That grows no further than a needle can need, and lets it lie when the board goes.
TEST(HeavyLoad, WhatHasTooLittleRoomIsNotThrown) {
  World world;
  Body mat(parameters(0.0, {box(0.2, 0.2, 0.02)}, {0, 0, -0.01}));
  Body needle(parameters(0.002, {box(0.02, 0.001, 0.001)}, {0, 0, 0.0004}));
  Body board(parameters(0.0, {box(0.2, 0.2, 0.02)}, {0, 0, 0.0108}));
  for (Body* body : {&mat, &needle, &board}) world.add(*body);
  needle.set_sleeping_allowed(false);
  run(world, 60.0);
  double most = 0.0;
  std::vector<Contact> contacts(100);
  contacts.resize(world.contacts(contacts));
  for (const Contact& contact : contacts) most = std::max(most, contact.normal_impulse);
  EXPECT_GT(most, 0.0);
  EXPECT_LT(most, 0.05);
  world.remove(board);
  for (int step = 0; step < 50; ++step) {
    run(world, 0.001);
    EXPECT_LT(math::norm(needle.twist().linear), 0.3) << step;
  }
  for (Body* body : {&needle, &mat}) world.remove(*body);
}

}  // namespace
}  // namespace ambf::physics::testing
