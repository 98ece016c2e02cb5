// Threads that touch themselves and each other: they bear, rub, hold by friction, and do not pass.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "physics/thread.h"
#include "tests/physics/fixtures.h"
#include "tests/physics/soft_scene.h"

namespace ambf::physics {
namespace {

using math::Vec3;
using testing::box;
using testing::kG;
using testing::parameters;
using testing::Scene;

constexpr double kRadius = 0.0002;  // m

std::uint32_t last_of(const ThreadDefinition& of) { return static_cast<std::uint32_t>(of.nodes.size() - 1); }

ThreadDefinition along(const std::vector<Vec3>& corners, double segment) {
  ThreadDefinition made;
  made.nodes = {corners.front()};
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const Vec3 way = corners[i] - corners[i - 1];
    const auto count = static_cast<int>(std::ceil(math::norm(way) / segment - 1e-9));
    for (int k = 1; k <= count; ++k) made.nodes.push_back(corners[i - 1] + way * (k / static_cast<double>(count)));
  }
  made.material.young = 1e7;
  made.material.radius = kRadius;
  return made;
}

// Between two points, along x, and one that hangs over it with a weight at either end.
struct Hanging {
  explicit Hanging(bool touches) {
    ThreadDefinition line = along({{-0.03, 0, 0}, {0.03, 0, 0}}, 0.002);
    line.fixed = {0, last_of(line)};
    const double top = 2.0 * kRadius + 1e-5, x = 0.0003;
    ThreadDefinition over = along({{x, -0.004, -0.03}, {x, -0.0005, top}, {x, 0.0005, top}, {x, 0.004, -0.03}}, 0.002);
    over.attached = {{0}, {last_of(over)}};
    over.touches_others = touches;
    taut = std::make_unique<Thread>(line);
    hung = std::make_unique<Thread>(over);
    for (Body* body : {&left, &right}) scene.world.add(*body);
    for (Thread* thread : {taut.get(), hung.get()}) add(scene.world, *thread);
    hung->attach(0, &left);
    hung->attach(1, &right);
  }
  ~Hanging() {
    for (Thread* thread : {taut.get(), hung.get()}) remove(scene.world, *thread);
    for (Body* body : {&left, &right}) scene.world.remove(*body);
  }
  double above() const { return hung->position_at(0.5 * hung->rest_length()).z - taut->position_at(0.0303).z; }
  Scene scene;
  Body left{parameters(0.02, {box(0.004, 0.004, 0.004)}, {0.0003, -0.004, -0.032})};
  Body right{parameters(0.02, {box(0.004, 0.004, 0.004)}, {0.0003, 0.004, -0.032})};
  std::unique_ptr<Thread> taut, hung;
};

TEST(ThreadCrossing, BearsWhatHangsOverIt) {
  Hanging hanging(true);
  double lowest = 1.0, highest = 0.0;
  for (int i = 0; i < 1000; ++i) {
    hanging.scene.step(1);
    lowest = std::min(lowest, hanging.above());
    highest = std::max(highest, hanging.above());
  }
  EXPECT_GT(lowest, 1.5 * kRadius);
  EXPECT_LT(highest, 2.1 * kRadius);
  EXPECT_NEAR(hanging.hung->tension_at(0.01), 0.02 * kG, 0.01 * kG * 0.02);
  EXPECT_LT(math::norm(hanging.hung->velocity(16)), 2e-4);
  Hanging passes(false);
  passes.scene.step(300);
  EXPECT_LT(passes.above(), -0.05);
}

// Around a thicker one: two turns and a half, each end down on its own side.
TEST(ThreadCrossing, HoldsByFrictionAroundAnother) {
  constexpr double kCore = 0.001, kMu = 0.15, kTurns = 2.5;
  const double around = kCore + kRadius, angle = 2.0 * std::numbers::pi * kTurns;
  ThreadDefinition core = along({{0, -0.01, 0}, {0, 0.01, 0}}, 0.001);
  core.material.radius = kCore;
  core.material.friction = std::sqrt(kMu);
  core.fixed = {0, last_of(core)};
  ThreadDefinition wound;
  wound.material.radius = kRadius;
  wound.material.young = 1e6;
  wound.material.friction = std::sqrt(kMu);
  const double pitch = 0.0008, half = 0.5 * pitch * kTurns;
  for (int i = -12; i < 0; ++i) wound.nodes.push_back({-around, -half, 0.0005 * i});
  const int pieces = 30;
  for (int i = 0; i <= pieces; ++i) {
    const double turn = angle * i / pieces;
    wound.nodes.push_back({-around * std::cos(turn), -half + 2.0 * half * i / pieces, around * std::sin(turn)});
  }
  for (int i = 1; i <= 12; ++i) wound.nodes.push_back({around, half, -0.0005 * i});
  const double capstan = std::exp(kMu * angle);
  for (const double by : {0.8, 1.25}) {
    Scene scene({0, 0, 0});
    Thread held(core), pulled(wound);
    add(scene.world, held);
    add(scene.world, pulled);
    double from = 0.0;
    for (int i = 0; i < 200; ++i) {
      pulled.apply_force(last_of(wound), {0, 0, -0.02});
      pulled.apply_force(0, {0, 0, -0.02 * capstan * by});
      scene.step(1);
      if (i == 150) from = pulled.position(0).z;
    }
    const double slid = from - pulled.position(0).z;
    if (by < 1.0) {
      EXPECT_LT(std::abs(slid), 2e-6);
    } else {
      EXPECT_GT(slid, 2e-5);
    }
    remove(scene.world, pulled);
    remove(scene.world, held);
  }
}

// Thrown at a taut one, across it.
TEST(ThreadCrossing, DoesNotPassHoweverFast) {
  for (const double speed : {0.5, 3.0}) {
    ThreadDefinition line = along({{-0.03, 0, 0}, {0.03, 0, 0}}, 0.002);
    line.fixed = {0, last_of(line)};
    ThreadDefinition other = along({{0.0004, -0.02, 0.0103}, {0.0004, 0.02, 0.0103}}, 0.002);
    Scene scene({0, 0, 0});
    Thread taut(line), thrown(other);
    add(scene.world, taut);
    add(scene.world, thrown);
    std::vector<double> state;
    thrown.get_state(state);
    for (std::size_t i = 0; i < thrown.node_count(); ++i) state[6 * i + 5] = -speed;
    ASSERT_TRUE(thrown.set_state(state));
    const int steps = static_cast<int>(0.02 / speed * 1000.0);
    double lowest = 1.0;
    for (int i = 0; i < steps; ++i) {
      scene.step(1);
      lowest = std::min(lowest, thrown.position_at(0.02).z - taut.position_at(0.0304).z);
    }
    EXPECT_GT(lowest, 1.9 * kRadius) << speed;
    EXPECT_LT(thrown.position(0).z, 0.0) << "its ends went on";
    remove(scene.world, thrown);
    remove(scene.world, taut);
  }
}

// A trefoil that is cut open, 6 mm wide, and a tail of 25 mm at either end.
ThreadDefinition overhand(double segment) {
  const auto curve = [](double t) {
    return Vec3{std::sin(t) + 2 * std::sin(2 * t), std::cos(t) - 2 * std::cos(2 * t), -std::sin(3 * t)} * 0.001;
  };
  constexpr double kCut = std::numbers::pi / 3, kEnd = 0.25, kTail = 0.025;
  constexpr int kPieces = 400;
  const Vec3 out{std::sin(kCut), std::cos(kCut), 0}, beside{std::cos(kCut), -std::sin(kCut), 0};
  std::vector<Vec3> fine{curve(kCut + kEnd) + (out - beside) * kTail};
  for (int i = 0; i <= kPieces; ++i) fine.push_back(curve(kCut + kEnd + 2 * (std::numbers::pi - kEnd) * i / kPieces));
  fine.push_back(curve(kCut - kEnd) + (out + beside) * kTail);
  ThreadDefinition made;
  made.nodes = {fine.front()};
  double left = segment;
  for (std::size_t i = 1; i < fine.size(); ++i) {
    const Vec3 way = fine[i] - fine[i - 1];
    const double length = math::norm(way);
    double at = 0.0;
    for (; length - at >= left; left = segment) {
      at += left;
      made.nodes.push_back(fine[i - 1] + way * (at / length));
    }
    left -= length - at;
  }
  made.material.young = 1e7;
  made.material.radius = kRadius;
  return made;
}

// Its ends are pulled apart (N).
struct Knot {
  explicit Knot(double force, bool touches = true) : definition(overhand(0.001)), pull(force) {
    definition.touches_itself = touches;
    thread = std::make_unique<Thread>(definition);
    add(scene.world, *thread);
  }
  ~Knot() { remove(scene.world, *thread); }
  void step(int steps) {
    const Vec3 apart{-0.5 * pull, 0.5 * std::sqrt(3.0) * pull, 0};
    for (int i = 0; i < steps; ++i) {
      thread->apply_force(0, apart);
      thread->apply_force(last_of(definition), -apart);
      scene.step(1);
    }
  }
  double shorter() const {  // m, than the thread
    return thread->length() - math::norm(thread->position(last_of(definition)) - thread->position(0));
  }
  ThreadDefinition definition;
  double pull;
  Scene scene{{0, 0, 0}};
  std::unique_ptr<Thread> thread;
};

// A tight overhand knot takes some ten diameters of the thread.
TEST(ThreadCrossing, AKnotDrawnTightHolds) {
  Knot knot(2.0);
  knot.step(600);
  const double tight = knot.shorter();
  EXPECT_NEAR(tight, 20.0 * kRadius, 16.0 * kRadius);
  EXPECT_NEAR(knot.thread->tension_at(0.002), 2.0, 0.02);
  EXPECT_GT(knot.thread->crossings(), 3U);
  knot.step(100);
  EXPECT_NEAR(knot.shorter(), tight, 1e-5) << "and stays so";
  EXPECT_FALSE(knot.thread->divergence());
  Knot passes(2.0, false);
  passes.step(300);
  EXPECT_LT(passes.shorter(), 1e-5);
}

TEST(ThreadCrossing, RepeatsAndGoesOnInAnotherWorldToTheBit) {
  std::vector<double> first, second, other, nodes;
  std::vector<std::byte> saved;
  for (std::vector<double>* out : {&first, &second}) {
    Knot knot(1.0);
    knot.step(90);
    ASSERT_GT(knot.thread->crossings(), 1U);
    knot.scene.world.save_state(saved);
    knot.thread->get_state(nodes);
    knot.step(60);
    knot.thread->get_state(*out);
  }
  EXPECT_EQ(first, second);
  Knot fresh(1.0);
  fresh.scene.world.restore_state(saved);
  ASSERT_TRUE(fresh.thread->set_state(nodes));
  fresh.step(60);
  fresh.thread->get_state(other);
  EXPECT_EQ(first, other);
}

// Side by side, so that each segment touches another.
TEST(ThreadCrossing, SaysThatThereIsNoRoomForAll) {
  const auto beside = [](double z) { return along({{0, 0, z}, {0.2, 0, z}}, 0.002); };
  Scene scene({0, 0, 0});
  Thread left(beside(0)), right(beside(1.9 * kRadius));
  for (Thread* thread : {&left, &right}) add(scene.world, *thread);
  scene.step(1);
  EXPECT_TRUE(left.crossings_left_out());
  EXPECT_EQ(right.crossings(), Thread::kMaxCrossings);
  remove(scene.world, right);
  scene.step(1);
  EXPECT_FALSE(left.crossings_left_out());
  EXPECT_EQ(left.crossings(), 0U);
  remove(scene.world, left);
}

TEST(ThreadCrossing, WhatIsFrozenOrRemovedMeetsNothing) {
  Hanging hanging(true);
  hanging.scene.step(50);
  ASSERT_GT(hanging.hung->crossings(), 0U);
  hanging.taut->freeze();
  hanging.scene.step(200);
  EXPECT_LT(hanging.above(), -0.01);
  EXPECT_FALSE(hanging.hung->divergence());
}

}  // namespace
}  // namespace ambf::physics
