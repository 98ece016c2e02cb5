// Sheets that meet tissue: solids, other sheets and themselves. What rests on what, friction, that nothing passes, and
// that all of it repeats and can be saved.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "tests/physics/fixtures.h"
#include "tests/physics/soft_scene.h"
#include "tests/physics/tissue_block.h"
#include "tests/physics/tissue_rectangle.h"

namespace ambf::physics {
namespace {

using math::Vec3;
using testing::kG;
using testing::Mesh;
using testing::rectangle;
using testing::Scene;
using testing::sheet_of;
using testing::those;

constexpr double kThickness = 0.001;

double fastest(const Tissue& tissue) {
  double most = 0.0;
  for (std::size_t i = 0; i < tissue.node_count(); ++i) most = std::max(most, math::norm(tissue.velocity(i)));
  return most;
}

double lowest(const Tissue& tissue) {
  double least = 1.0;
  for (std::size_t i = 0; i < tissue.node_count(); ++i) least = std::min(least, tissue.position(i).z);
  return least;
}

// 5 cm by 5 cm and 1 cm high, its top at z = 0; its bottom is fixed.
TissueDefinition bed() {
  TissueDefinition made = testing::tissue_of(testing::block({0.05, 0.05, 0.01}, {-0.025, -0.025, -0.01}), 0.0075, 2e4);
  made.fixed = those(made, [](const Vec3& at) { return at.z < -0.01 + 1e-9; });
  made.material.friction = 1.0;
  return made;
}

TissueDefinition sheet(double side, double height, bool held = false) {
  TissueDefinition made = sheet_of(rectangle(side, side, 9, 9, Mesh::crossed), kThickness, 1e5);
  made.T_world_body.position.z = height;
  if (held)
    made.fixed = those(made, [&](const Vec3& at) { return std::max(std::abs(at.x), std::abs(at.y)) > 0.49 * side; });
  return made;
}

using Pair = testing::TwoTissues;

TEST(SheetTouch, ASheetLiesOnASolid) {
  Pair pair(bed(), sheet(0.04, 0.002));
  pair.step(600);
  EXPECT_LT(fastest(pair.upper), 2e-3) << "it lies still";
  EXPECT_NEAR(pair.upper.centre().position.z, 0.5 * kThickness, 0.3e-3);
  EXPECT_GT(lowest(pair.upper), 0.0);
  EXPECT_GT(pair.upper.touches(), 50U);
  EXPECT_LT(std::hypot(pair.upper.centre().position.x, pair.upper.centre().position.y), 2e-4);
  const double sunk = pair.lower.centre().position.z;
  pair.upper.apply_wrench({{0, 0, -2.0 * pair.upper.mass() * kG}, {}});
  pair.step(1);
  EXPECT_LT(pair.lower.momentum().z, 0.0) << "it is felt";
  pair.step(200);
  EXPECT_NEAR(pair.lower.centre().position.z, sunk, 1e-7);
  TissueDefinition passes = sheet(0.04, 0.002);
  passes.touches_others = false;
  Pair apart(bed(), passes);
  apart.step(100);
  EXPECT_NEAR(apart.upper.momentum().z / apart.upper.mass(), -0.1 * kG, 1e-6) << "they do not touch";
}

TEST(SheetTouch, ASheetBearsASolidAndAnotherSheet) {
  TissueDefinition block = testing::tissue_of(testing::block({0.02, 0.02, 0.01}, {-0.01, -0.01, 0.002}), 0.005, 2e4);
  TissueDefinition low = sheet(0.06, 0.0, true);
  low.material.share = 0.5, low.material.time = 0.03;  // it is a trampoline else
  Pair solid(low, block);
  solid.step(800);
  EXPECT_LT(solid.upper.centre().position.z, 0.006) << "it sank";
  EXPECT_GT(lowest(solid.upper), -0.01);
  EXPECT_LT(std::abs(solid.upper.momentum().z / solid.upper.mass()), 5e-3);
  const double below = solid.lower.position(44).z;
  EXPECT_LT(below, -0.0005);
  EXPECT_GT(lowest(solid.upper), below) << "on it";
  Pair two(low, sheet(0.03, 0.002));
  two.step(600);
  EXPECT_LT(fastest(two.upper), 0.01);
  const double between = two.upper.position(44).z - two.lower.position(44).z;
  EXPECT_GT(between, 0.5 * kThickness);
  EXPECT_LT(between, 1.5 * kThickness);
}

// One mesh of two parts, of which the upper falls onto the lower.
TEST(SheetTouch, ASheetMeetsItself) {
  for (const bool touches : {true, false}) {
    TissueSurface both = rectangle(0.04, 0.04, 8, 8, Mesh::crossed);
    const auto half = static_cast<std::uint32_t>(both.vertices.size());
    const TissueSurface over = rectangle(0.03, 0.03, 6, 6, Mesh::crossed);
    for (const Vec3& at : over.vertices) both.vertices.push_back(at + Vec3{0.0011, 0.0007, 0.015});
    for (const auto& t : over.triangles) both.triangles.push_back({t[0] + half, t[1] + half, t[2] + half});
    TissueDefinition given = sheet_of(both, kThickness, 1e5);
    given.fixed = those(given, [](const Vec3& at) { return at.z < 0.001; });
    given.touches_itself = touches;
    Scene scene;
    Tissue tissue(given);
    add(scene.world, tissue);
    scene.step(400);
    double low = 1.0;
    for (std::size_t i = half; i < tissue.node_count(); ++i) low = std::min(low, tissue.position(i).z);
    EXPECT_EQ(low > 0.0, touches) << low;
    if (touches) {
      EXPECT_LT(low, 1.5 * kThickness);
      EXPECT_LT(fastest(tissue), 0.02);
    }
    remove(scene.world, tissue);
  }
}

TEST(SheetTouch, SlidesOnASolidAboveItsAngleOfFrictionAndHoldsBelow) {
  constexpr double kFriction = 0.4;
  for (const double by : {0.85, 1.3}) {
    SCOPED_TRACE(by);
    const double slope = std::atan(kFriction) * by;
    TissueDefinition given = sheet(0.03, 0.5 * kThickness - 8e-7);
    given.material.friction = kFriction;
    Pair pair(bed(), given, {kG * std::sin(slope), 0, -kG * std::cos(slope)});
    pair.step(40);
    const double before = pair.upper.centre().position.x, speed = pair.upper.momentum().x / pair.upper.mass();
    pair.step(60);
    const double gained = (pair.upper.momentum().x / pair.upper.mass() - speed) / 0.06;
    if (by < 1.0) {
      EXPECT_LT(std::abs(pair.upper.centre().position.x - before), 5e-5);
    } else {
      EXPECT_NEAR(gained, kG * (std::sin(slope) - kFriction * std::cos(slope)), 0.15);
    }
  }
}

TEST(SheetTouch, RepeatsAndIsSaved) {
  Pair first(bed(), sheet(0.04, 0.001)), again(bed(), sheet(0.04, 0.001)), other(bed(), sheet(0.04, 0.001));
  testing::expect_repeats_and_is_saved(first, again, other, 100, 100, [](Pair& pair, int steps) { pair.step(steps); });
}

}  // namespace
}  // namespace ambf::physics
