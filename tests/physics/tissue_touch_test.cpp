// Tissue that meets tissue: another one, and its own lips. What rests on what, friction, momentum, that nothing passes,
// and that all of it repeats and can be saved.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "physics/blade.h"
#include "tests/physics/fixtures.h"
#include "tests/physics/tissue_block.h"

namespace ambf::physics {
namespace {

using namespace testing;
using math::Vec3;

constexpr double kG = 9.81;

WorldOptions options(const Vec3& gravity) {
  WorldOptions made;
  made.gravity = gravity;
  return made;
}

std::unique_ptr<Tissue> made_of(TissueDefinition given, const Vec3& at, bool held_below = false) {
  for (std::uint32_t i = 0; held_below && i < given.grid.corners.size(); ++i)
    if (given.grid.corners[i].z < 1e-9) given.fixed.push_back(i);
  given.T_world_body.position = at;
  return std::make_unique<Tissue>(given);
}

double fastest(const Tissue& tissue) {
  double most = 0.0;
  for (std::size_t i = 0; i < tissue.node_count(); ++i) most = std::max(most, math::norm(tissue.velocity(i)));
  return most;
}

// A small block on a larger one, whose bottom is fixed; their elements are not in line.
struct Stack {
  explicit Stack(const Vec3& gravity, double friction = 1.0, double lower_young = 2e4, bool touches = true)
      : world(options(gravity)) {
    TissueDefinition low = tissue_of(block({0.08, 0.04, 0.01}), 0.005, lower_young);
    TissueDefinition high = tissue_of(block({0.02, 0.02, 0.01}), 0.004, 2e4);
    low.material.friction = 1.0, high.material.friction = friction;
    high.touches_others = touches;
    lower = made_of(low, {}, true);
    upper = made_of(high, {0.0093, 0.0108, 0.01});
    add(world, *lower);
    add(world, *upper);
  }
  ~Stack() {
    remove(world, *upper);
    if (lower != nullptr) remove(world, *lower);
  }
  void wait(int steps) {
    for (int i = 0; i < steps; ++i) world.step();
  }

  World world;
  std::unique_ptr<Tissue> lower, upper;
};

TEST(TissueTouch, OneBearsAnother) {
  for (const double young : {1e4, 2e5}) {
    SCOPED_TRACE(young);
    Stack stack({0, 0, -kG}, 1.0, young);
    const Vec3 before = stack.upper->centre().position;
    stack.wait(1000);
    const Vec3 sunk = stack.upper->centre().position - before;
    EXPECT_LT(sunk.z, 0.0);
    EXPECT_GT(sunk.z, -0.0006);
    EXPECT_LT(std::hypot(sunk.x, sunk.y), 1e-4);
    EXPECT_LT(fastest(*stack.upper), 1e-4) << "it lies still";
    EXPECT_GT(stack.upper->touches(), 20U);
    EXPECT_GT(stack.lower->touches(), 20U);
  }
  Stack apart({0, 0, -kG}, 1.0, 2e4, false);
  apart.wait(100);
  EXPECT_NEAR(apart.upper->momentum().z / apart.upper->mass(), -0.1 * kG, 1e-6) << "they do not touch";
}

TEST(TissueTouch, SlidesAboveItsAngleOfFrictionAndHoldsBelow) {
  constexpr double kFriction = 0.4;
  for (const double by : {0.85, 1.3}) {
    SCOPED_TRACE(by);
    const double slope = std::atan(kFriction) * by;
    Stack stack({kG * std::sin(slope), 0, -kG * std::cos(slope)}, kFriction);
    stack.wait(100);
    const double before = stack.upper->centre().position.x, speed = stack.upper->momentum().x / stack.upper->mass();
    stack.wait(150);  // it is still on the other
    const double gained = (stack.upper->momentum().x / stack.upper->mass() - speed) / 0.15;
    if (by < 1.0) {
      EXPECT_LT(std::abs(stack.upper->centre().position.x - before), 5e-5);
    } else {
      EXPECT_NEAR(gained, kG * (std::sin(slope) - kFriction * std::cos(slope)), 0.3);
    }
  }
}

// Cut through in the middle; the left end may be fixed.
struct Halves {
  explicit Halves(bool held, bool touches = true) : world(options({})) {
    TissueDefinition given = tissue_of(block({0.04, 0.02, 0.02}), 0.005, 2e4, 0.45, 4000);
    given.touches_itself = touches;
    for (std::uint32_t i = 0; held && i < given.grid.corners.size(); ++i)
      if (given.grid.corners[i].x < 1e-9) given.fixed.push_back(i);
    tissue = made_of(given, {});
    for (std::size_t i = 0; i < tissue->node_count(); ++i) loaded.push_back(tissue->position(i));
    add(world, *tissue);
    world.add(hand);
    add(world, blade);
    blade.use(&hand);
    for (int i = 1; i <= 120; ++i) {
      hand.move_to({{0.021, 0, 0.025 - 0.0003 * i}, {}});
      world.step();
    }
    blade.use(nullptr);
  }
  ~Halves() {
    remove(world, blade);
    world.remove(hand);
    remove(world, *tissue);
  }
  // m/s^2, on the right half.
  void push(double acceleration, int steps) {
    std::size_t count = 0;
    for (const Vec3& at : loaded) count += at.x > 0.03 ? 1 : 0;
    const double force = 0.5 * 0.04 * 0.02 * 0.02 * 1060.0 * acceleration / static_cast<double>(count);
    for (int step = 0; step < steps; ++step) {
      for (std::size_t i = 0; i < loaded.size(); ++i)
        if (loaded[i].x > 0.03) tissue->apply_force(i, {force, 0, 0});
      world.step();
    }
  }
  // m, of the right end's middle.
  double right() const {
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < loaded.size(); ++i)
      if (loaded[i].x > 0.04 - 1e-6) sum += tissue->position(i).x, ++count;
    return sum / count;
  }

  World world;
  Body hand{mass_only(0.0, {}, {{0.021, 0, 0.025}, {}})};
  Blade blade{{{{0, -0.005, 0}, {0, 0.025, 0}}, 0.1}};
  std::unique_ptr<Tissue> tissue;
  std::vector<Vec3> loaded;
};

TEST(TissueTouch, LipsOfACutBearEachOther) {
  Halves halves(true), loose(true, false);
  ASSERT_EQ(halves.tissue->pieces(), 2U);
  halves.push(-2.0 * kG, 800);
  EXPECT_LT(halves.right(), 0.04);
  EXPECT_GT(halves.right(), 0.0385);
  EXPECT_GT(halves.tissue->touches(), 20U);
  EXPECT_LT(fastest(*halves.tissue), 0.002) << "it lies still";
  loose.push(-2.0 * kG, 50);
  EXPECT_LT(loose.right(), 0.030) << "they pass through each other";
}

TEST(TissueTouch, LipsThatMeetKeepTheMomentumOfBoth) {
  Halves halves(false);
  halves.push(-20.0, 20);  // 0.4 m/s
  const Vec3 before = halves.tissue->momentum();
  for (int i = 0; i < 100; ++i) halves.world.step();
  EXPECT_LT(math::norm(halves.tissue->momentum() - before), 1e-9 * math::norm(before));
  double left = 1.0;
  for (std::size_t i = 0; i < halves.loaded.size(); ++i) left = std::min(left, halves.tissue->position(i).x);
  EXPECT_GT(halves.right() - left, 0.03) << "they go on together";
  EXPECT_FALSE(halves.tissue->divergence());
}

TEST(TissueTouch, RepeatsAndIsSaved) {
  Halves first(true), again(true), other(true);
  std::vector<double> state, a, b, c;
  for (Halves* each : {&first, &again}) {
    each->push(-kG, 100);
    each->tissue->get_state(state);
    ASSERT_TRUE(each->tissue->set_state(state));  // as saving a world does
  }
  ASSERT_TRUE(other.tissue->set_state(state));
  for (Halves* each : {&first, &again, &other}) each->push(-3.0 * kG, 100);
  first.tissue->get_state(a), again.tissue->get_state(b), other.tissue->get_state(c);
  EXPECT_EQ(a, b);
  EXPECT_EQ(a, c);
}

TEST(TissueTouch, WhatItTouchesMayGo) {
  Stack stack({0, 0, -kG});
  stack.wait(200);
  ASSERT_GT(stack.upper->touches(), 0U);
  remove(stack.world, *stack.lower);
  stack.lower = nullptr;
  stack.wait(50);
  EXPECT_EQ(stack.upper->touches(), 0U);
  EXPECT_FALSE(stack.upper->divergence());
  TissueDefinition low = tissue_of(block({0.04, 0.04, 0.01}), 0.005, 2e4);
  stack.lower = made_of(low, {0, 0, -0.05}, true);
  add(stack.world, *stack.lower);
  stack.wait(1000);
  EXPECT_NEAR(stack.upper->centre().position.z, -0.035, 0.002) << "it fell onto the new one";
  stack.lower->freeze();
  stack.wait(100);
  EXPECT_NEAR(stack.upper->centre().position.z, -0.035, 0.002) << "what is frozen still bears it";
}

// Six plates in one place rest on a seventh: at each of its points there are six touches or more.
TEST(TissueTouch, SaysThatThereIsNoRoomForAllTouches) {
  World world(options({}));
  const TissueDefinition given = tissue_of(block({0.076, 0.076, 0.004}), 0.004, 2e4);
  std::vector<std::unique_ptr<Tissue>> plates;
  for (int i = 0; i < 7; ++i) {
    plates.push_back(made_of(given, {0.0011, 0.0007, i == 0 ? 0.0 : 0.0035}));
    add(world, *plates.back());
  }
  world.step();
  EXPECT_TRUE(plates[0]->touches_left_out());
  EXPECT_LE(plates[0]->touches(), 2 * plates[0]->node_count() + Tissue::kFurtherTouches + Tissue::kMaxTips);
  EXPECT_GT(plates[1]->touches(), 0U);
  EXPECT_FALSE(plates[1]->touches_left_out());
  for (const auto& plate : plates) remove(world, *plate);
}

// Pairs are found anew only when something has moved: what comes together later is found, too, and a fold is as one
// that is looked at in each step.
TEST(TissueTouch, FindsWhatComesTogetherLater) {
  Halves halves(true);
  halves.push(0.2 * kG, 60);  // apart
  ASSERT_GT(halves.right(), 0.042);
  EXPECT_EQ(halves.tissue->touches(), 0U);
  halves.push(-2.0 * kG, 800);
  EXPECT_GT(halves.right(), 0.0385);
  EXPECT_GT(halves.tissue->touches(), 20U);
}

// What lies on a slope stays where it sticks while a cut beneath it moves corners of the faces that hold it.
TEST(TissueTouch, ACutBeneathDoesNotPushWhatSticks) {
  const double slope = std::atan(0.4) * 0.85;
  World world(options({kG * std::sin(slope), 0, -kG * std::cos(slope)}));
  TissueDefinition low = tissue_of(block({0.08, 0.04, 0.01}), 0.005, 2e5, 0.45, 8000);
  low.material.friction = 1.0;
  TissueDefinition high = tissue_of(block({0.02, 0.02, 0.01}), 0.004, 2e4);
  high.material.friction = 0.4;
  const auto lower = made_of(low, {}, true), upper = made_of(high, {0.0093, 0.0108, 0.01});
  Body hand(mass_only(0.0, {}, {{0.0183, -0.01, 0.0105}, {}}));
  Blade blade({{{0, 0, -0.004}, {0, 0, 0.001}}, 0.1});
  for (Tissue* each : {lower.get(), upper.get()}) add(world, *each);
  world.add(hand);
  add(world, blade);
  for (int i = 0; i < 200; ++i) world.step();
  blade.use(&hand);
  double most = 0.0;
  Vec3 before = upper->momentum();
  for (int i = 1; i <= 45; ++i) {
    hand.move_to({{0.0183, -0.01 + 0.0006 * i, 0.0105}, {}});
    world.step();
    most = std::max(most, math::norm(upper->momentum() - before) / upper->mass());
    before = upper->momentum();
  }
  EXPECT_GT(lower->open_seams(), 4U);
  EXPECT_LT(most, 2e-5) << "m/s, in a step: it was 4e-5 as they went along";
  remove(world, blade);
  world.remove(hand);
  for (Tissue* each : {lower.get(), upper.get()}) remove(world, *each);
}

}  // namespace
}  // namespace ambf::physics
