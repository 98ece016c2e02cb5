// Lips of a sheet's cut: a fresh cut pushes nothing, lips that are pushed together bear and rub on each other in the
// plane, one that is laid over the other lies on it, and all of it repeats and can be saved.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tests/physics/cut_scene.h"
#include "tests/physics/tissue_rectangle.h"

namespace ambf::physics {
namespace {

using namespace testing;
using math::Vec3;

constexpr double kLength = 0.06, kWidth = 0.04, kThickness = 0.001, kCut = 0.0011;

struct Strip {
  Mesh mesh = Mesh::crossed;
  double held_to = -0.029;   // m, along x: what is left of that is fixed
  double held_beyond = 1.0;  // m, likewise on the right
  double narrower = 1.0;     // the right half, than the left
  bool touches = true;
  double friction = 0.4;
};

TissueDefinition made_of(const Strip& strip) {
  TissueSurface surface = rectangle(kLength, kWidth, 20, 13, strip.mesh);
  for (Vec3& at : surface.vertices)
    if (at.x > -0.002) at.y *= strip.narrower;
  TissueDefinition made = sheet_of(surface, kThickness, 1e6, 0.4, 2000);
  made.fixed = those(made, [&](const Vec3& at) { return at.x < strip.held_to || at.x > strip.held_beyond; });
  made.touches_itself = strip.touches;
  made.material.friction = strip.friction;
  made.material.share = 0.5, made.material.time = 0.03;  // it is a trampoline else
  return made;
}

// Cut through across its length, by an edge that goes through it upright.
struct Lips : CutScene {
  explicit Lips(const Strip& strip = {})
      : CutScene(made_of(strip), {{{0, 0, -0.004}, {0, 0, 0.004}}, 0.05}), narrower(strip.narrower) {
    for (std::size_t i = 0; i < tissue.node_count(); ++i) loaded.push_back(tissue.position(i));
    for (const auto& face : tissue.faces()) {
      double middle = 0.0;
      for (const std::uint32_t node : face) middle += loaded[node].x / 3.0;
      for (const std::uint32_t node : face) (middle > kCut ? right : left).push_back(node);
    }
    stroke({{kCut, -0.025, 0}, {}}, {0, 0.05, 0}, 250);
    blade.use(nullptr);
    hand.set_pose(away());
  }
  // m/s^2, on the right half.
  void push(const Vec3& acceleration, int steps) {
    const double share = kThickness * 1060.0 * kLength * kWidth * narrower / static_cast<double>(loaded.size());
    for (int step = 0; step < steps; ++step) {
      for (const std::size_t i : right) tissue.apply_force(i, acceleration * share);
      world.step();
    }
  }
  // Carries the right half there, and it is at rest again.
  void carry(const Vec3& by, int steps) {
    const double half = 0.5e-3 * steps;
    push(by / (half * half), steps / 2);
    push(by / (-half * half), steps / 2);
  }
  Vec3 mean(const std::vector<std::size_t>& nodes) const {
    Vec3 sum{};
    for (const std::size_t i : nodes) sum += tissue.position(i) / static_cast<double>(nodes.size());
    return sum;
  }
  Vec3 speed() const {
    Vec3 sum{};
    for (const std::size_t i : right) sum += tissue.velocity(i) / static_cast<double>(right.size());
    return sum;
  }
  double nearest_over_the_left(double side) const {
    double least = 1.0;
    for (const std::size_t i : right)
      if (tissue.position(i).x < -0.003) least = std::min(least, side * tissue.position(i).z);
    return least;
  }
  double highest() const {
    double most = 0.0;
    for (std::size_t i = 0; i < loaded.size(); ++i) most = std::max(most, std::abs(tissue.position(i).z));
    return most;
  }
  double fastest() const {
    double most = 0.0;
    for (std::size_t i = 0; i < loaded.size(); ++i) most = std::max(most, math::norm(tissue.velocity(i)));
    return most;
  }

  double narrower;
  std::vector<Vec3> loaded;
  std::vector<std::size_t> left, right;  // nodes, each once for each triangle
};

// Lips that do not touch are where the cut leaves them: those that do are there, too.
TEST(SheetLips, AFreshCutPushesNothing) {
  for (const Mesh mesh : {Mesh::diagonals, Mesh::crossed}) {
    Lips lips({.mesh = mesh, .held_beyond = 0.029}), loose({.mesh = mesh, .held_beyond = 0.029, .touches = false});
    ASSERT_EQ(lips.tissue.pieces(), 2U);
    double apart = 0.0;
    for (int i = 0; i < 60; ++i) {
      lips.world.step(), loose.world.step();
      for (std::size_t n = 0; n < lips.loaded.size(); ++n)
        apart = std::max(apart, math::norm(lips.tissue.position(n) - loose.tissue.position(n)));
    }
    EXPECT_LT(apart, 2e-5);
    EXPECT_LT(lips.highest(), 1e-6);
    EXPECT_LT(lips.fastest(), 1e-3);
    EXPECT_EQ(loose.tissue.touches(), 0U);
  }
}

TEST(SheetLips, PushedTogetherInThePlaneTheyBear) {
  for (const Mesh mesh : {Mesh::diagonals, Mesh::crossed}) {
    Lips lips({.mesh = mesh}), loose({.mesh = mesh, .touches = false});
    const double before = lips.mean(lips.right).x;
    lips.push({-4.0, 0, 0}, 300);
    EXPECT_NEAR(lips.mean(lips.right).x, before, 1e-4);
    EXPECT_LT(lips.highest(), 0.1 * kThickness);
    EXPECT_LT(lips.fastest(), 2e-3) << "it lies still";
    EXPECT_GT(lips.tissue.touches(), 10U);
    loose.push({-4.0, 0, 0}, 100);
    EXPECT_LT(loose.mean(loose.right).x, before - 0.015) << "they pass through each other";
    lips.push({4.0, 0, 0}, 60);
    const double speed = lips.speed().x;
    lips.push({4.0, 0, 0}, 20);
    EXPECT_NEAR((lips.speed().x - speed) / 0.02, 4.0, 0.1) << "nothing holds them together";
    EXPECT_EQ(lips.tissue.touches(), 0U);
  }
}

TEST(SheetLips, TheyRubAsTheySlideAlongEachOther) {
  for (const double friction : {0.0, 0.5}) {
    Lips lips({.friction = friction});
    lips.push({-2.0, 1.0, 0}, 30);
    const double before = lips.speed().y;
    lips.push({-2.0, 1.0, 0}, 60);
    EXPECT_NEAR((lips.speed().y - before) / 0.06, 1.0 - 2.0 * friction * friction, 0.08);
    EXPECT_GT(lips.mean(lips.right).y, 0.001);
    EXPECT_LT(lips.highest(), 0.1 * kThickness);
  }
}

// The left half is held. The right one is lifted, carried over it and let down, or laid beneath it: it lies there, also
// when it is pressed far more than by its weight, and comes off again.
TEST(SheetLips, OneIsLaidOverTheOther) {
  for (const auto& [mesh, side] : {std::pair{Mesh::diagonals, 1.0}, {Mesh::crossed, -1.0}}) {
    Lips lips({.mesh = mesh, .held_to = 0.0, .narrower = 0.7});
    lips.carry({0, 0, 0.004 * side}, 40);
    lips.carry({-0.024, 0.0003, 0}, 60);
    EXPECT_NEAR(lips.mean(lips.right).z * side, 0.004, 1e-3);
    lips.push({0, 0, -9.81 * side}, 250);
    EXPECT_GT(lips.tissue.touches(), 50U);
    EXPECT_GT(lips.nearest_over_the_left(side), 0.6 * kThickness);
    EXPECT_LT(lips.mean(lips.right).z * side, 1.5 * kThickness);
    lips.push({0, 0, -50.0 * side}, 100);
    EXPECT_GT(lips.nearest_over_the_left(side), 0.4 * kThickness);
    lips.push({0, 0, 10.0 * side}, 80);
    EXPECT_GT(lips.mean(lips.right).z * side, 0.005);
  }
}

TEST(SheetLips, ThoseThatMeetKeepTheMomentumOfBoth) {
  Lips lips({.held_to = -1.0});
  lips.push({5.0, 0, 0}, 20);
  lips.push({-15.0, 0, 0}, 20);  // 0.2 m/s, towards the left half
  const Vec3 before = lips.tissue.momentum();
  for (int i = 0; i < 60; ++i) lips.world.step();
  EXPECT_LT(math::norm(lips.tissue.momentum() - before), 1e-9 * math::norm(before));
  EXPECT_GT(lips.mean(lips.right).x - lips.mean(lips.left).x, 0.028) << "they go on together";
  EXPECT_FALSE(lips.tissue.divergence());
}

TEST(SheetLips, RepeatsAndIsSaved) {
  Lips first, again, other;
  std::vector<double> state, a, b, c;
  for (Lips* each : {&first, &again}) {
    each->push({-4.0, 0.5, 0.2}, 60);
    each->tissue.get_state(state);
    ASSERT_TRUE(each->tissue.set_state(state));  // as saving a world does
  }
  ASSERT_TRUE(other.tissue.set_state(state));
  for (Lips* each : {&first, &again, &other}) each->push({-4.0, 0.5, 0.2}, 60);
  EXPECT_GT(first.tissue.touches(), 10U);
  first.tissue.get_state(a), again.tissue.get_state(b), other.tissue.get_state(c);
  EXPECT_EQ(a, b);
  EXPECT_EQ(a, c);
}

}  // namespace
}  // namespace ambf::physics
