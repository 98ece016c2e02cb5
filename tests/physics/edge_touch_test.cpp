// Edges of tissue that cross edges of other tissue between their nodes: rims of sheets, and ridges of solids.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/physics/fixtures.h"
#include "tests/physics/soft_scene.h"
#include "tests/physics/tissue_block.h"
#include "tests/physics/tissue_rectangle.h"

namespace ambf::physics {
namespace {

using math::Vec3;
using testing::rectangle;
using testing::sheet_of;
using testing::those;

constexpr double kThickness = 0.0005, kWide = 0.004;

// A flat ribbon of squares of 10 mm by 4 mm along x or y: where two cross in (0, 0), no node of one is over the other.
TissueDefinition ribbon(bool along_x, double height) {
  TissueDefinition made = sheet_of(rectangle(0.07, kWide, 7, 1), kThickness, 2e5);
  if (!along_x) made.T_world_body.orientation = math::from_axis_angle({0, 0, 1}, 0.5 * testing::kPi);
  made.T_world_body.position.z = height;
  return made;
}

std::vector<std::uint32_t> ends(const TissueDefinition& of) {
  return those(of, [](const Vec3& at) { return std::abs(at.x) > 0.034; });
}

TissueDefinition taut(bool along_x, double height) {
  TissueDefinition made = ribbon(along_x, height);
  made.fixed = ends(made);
  return made;
}

Vec3 middle(const Tissue& ribbon) {
  Vec3 sum{};
  for (const std::size_t node : {3U, 4U, 11U, 12U}) sum += ribbon.position(node) * 0.25;
  return sum;
}

struct Crossed : testing::TwoTissues {
  Crossed(const TissueDefinition& low, const TissueDefinition& high, const Vec3& gravity = {})
      : TwoTissues(low, high, gravity) {}
  double gap() const { return middle(upper).z - middle(lower).z; }
  void lower_by(double way, const TissueDefinition& given, double speed) {
    math::Pose to = given.T_world_body;
    to.position.z -= way;
    for (int i = 0; i < static_cast<int>(way / (0.001 * speed)) + 200; ++i) {
      upper.carry_fixed(to, speed);
      step(1);
      lowest = std::min(lowest, gap());
      deepest = std::min(deepest, middle(lower).z);
    }
  }
  double lowest = 1.0;   // gap
  double deepest = 0.0;  // that the lower one was pushed to
};

TissueDefinition standing(bool along_x, double height) {
  TissueDefinition made = sheet_of(rectangle(0.07, 0.01, 7, 1), kThickness, 2e5);
  made.fixed = ends(made);
  const math::Quat upright = math::from_axis_angle({1, 0, 0}, 0.5 * testing::kPi);
  made.T_world_body.orientation = along_x ? upright : math::from_axis_angle({0, 0, 1}, 0.5 * testing::kPi) * upright;
  made.T_world_body.position.z = height;
  return made;
}

// Fixed, its upper edge along y through the origin.
TissueDefinition bed() {
  TissueDefinition made = testing::tissue_of(testing::block({0.04, 0.05, 0.02}, {-0.04, -0.025, -0.02}), 0.01, 2e4);
  for (std::uint32_t i = 0; i < made.grid.corners.size(); ++i) made.fixed.push_back(i);
  made.material.friction = 0.2;
  return made;
}

// A sheet on it that is held at the far end.
TissueDefinition hanging() {
  TissueDefinition made = sheet_of(rectangle(0.06, 0.03, 8, 4, testing::Mesh::crossed), kThickness, 1e5);
  made.fixed = those(made, [](const Vec3& at) { return at.x < -0.029; });
  made.material.friction = 0.2;
  made.T_world_body.position.z = 0.5 * kThickness;
  return made;
}

// A block that lies on an edge, with another along y through the origin, (0, 0) between its nodes.
TissueDefinition ridge() {
  TissueDefinition made = testing::tissue_of(testing::block({0.01, 0.03, 0.01}, {-0.005, -0.015, -0.005}), 0.01, 2e4);
  made.T_world_body.orientation = math::from_axis_angle({0, 1, 0}, 0.25 * testing::kPi);
  made.T_world_body.position.z = -0.005 * std::sqrt(2.0);
  return made;
}

double fastest(const Tissue& tissue) {
  double most = 0.0;
  for (std::size_t i = 0; i < tissue.node_count(); ++i) most = std::max(most, math::norm(tissue.velocity(i)));
  return most;
}

TEST(EdgeTouch, RimsOfTautSheetsHoldEachOther) {
  for (const double speed : {0.02, 0.5}) {
    SCOPED_TRACE(speed);
    const TissueDefinition high = taut(true, 0.002);
    Crossed crossed(taut(false, 0.0), high);
    crossed.lower_by(0.006, high, speed);
    EXPECT_GT(crossed.lowest, 0.2 * kThickness);
    EXPECT_NEAR(crossed.gap(), kThickness, 0.04 * kThickness) << "they swing";
    EXPECT_EQ(crossed.upper.touches(), 4U);
    EXPECT_LT(crossed.deepest, -0.001) << "it is felt";
    TissueDefinition passes = high;
    passes.touches_others = false;
    Crossed apart(taut(false, 0.0), passes);
    apart.lower_by(0.006, high, speed);
    EXPECT_LT(apart.gap(), -0.002);
  }
}

// On their rims, across each other: nothing else of them is near.
TEST(EdgeTouch, RibbonsThatStandOnTheirRimsBearEachOther) {
  const TissueDefinition high = standing(true, 0.011);
  Crossed crossed(standing(false, 0.0), high);
  crossed.lower_by(0.0012, high, 0.1);
  EXPECT_GT(crossed.upper.touches(), 0U);
  EXPECT_GT(crossed.gap(), 0.01);
}

// Of a sheet that hangs over the side of a block, the block's edge between two rows of the sheet's nodes.
TEST(EdgeTouch, ASheetIsPulledOverTheEdgeOfABlock) {
  Crossed crossed(bed(), hanging(), {0, 0, -9.81});
  double deepest = 0.0, now = 0.0;
  for (int i = 0; i < 800; ++i) {
    for (std::size_t k = 8; k < 45; k += 9) crossed.upper.apply_force(k, {0, 0, -0.02});
    crossed.step(1);
    now = 0.0;
    for (const auto& face : crossed.upper.faces())
      for (std::size_t k = 0; k < 3; ++k)
        for (const double share : {0.25, 0.5, 0.75}) {
          const Vec3 at =
              crossed.upper.position(face[k]) * share + crossed.upper.position(face[(k + 1) % 3]) * (1.0 - share);
          if (at.z > -0.02) now = std::max(now, std::min(-at.x, -at.z));
        }
    deepest = std::max(deepest, now);
  }
  EXPECT_LT(deepest, 6e-4);
  EXPECT_LT(now, 1e-4);
  EXPECT_LT(fastest(crossed.upper), 1e-3);
}

// The rim of a ribbon that stands falls across a ridge of a block; both are free.
TEST(EdgeTouch, ARimAndARidgeKeepTheMomentumOfBoth) {
  TissueDefinition ribbon = standing(true, 0.0063), roof = ridge();
  ribbon.fixed.clear();
  Crossed crossed(roof, ribbon);
  crossed.upper.apply_wrench({{0, 0, -0.5 * crossed.upper.mass() / 0.001}, {}});
  crossed.step(1);
  const Vec3 before = crossed.upper.momentum();
  EXPECT_LT(math::norm(crossed.lower.momentum()), 1e-12);
  std::size_t touches = 0;
  for (int i = 0; i < 12; ++i) {
    crossed.step(1);
    touches = std::max(touches, crossed.upper.touches());
  }
  EXPECT_GT(touches, 0U);
  EXPECT_LT(crossed.lower.momentum().z, 0.5 * before.z);
  EXPECT_LT(math::norm(crossed.upper.momentum() + crossed.lower.momentum() - before), 1e-6 * math::norm(before));
}

TEST(EdgeTouch, RepeatsAndIsSaved) {
  for (const bool on_a_block : {false, true}) {
    SCOPED_TRACE(on_a_block);
    const TissueDefinition low = on_a_block ? bed() : taut(false, 0.0),
                           high = on_a_block ? hanging() : taut(true, 0.002);
    const math::Pose to{{0, 0, -0.002}, {}};
    const auto run = [&](Crossed& crossed, int steps) {
      for (int i = 0; i < steps; ++i) {
        if (!on_a_block) crossed.upper.carry_fixed(to, 0.05);
        crossed.step(1);
      }
    };
    Crossed first(low, high, {0, 0, -9.81}), again(low, high, {0, 0, -9.81}), other(low, high, {0, 0, -9.81});
    testing::expect_repeats_and_is_saved(first, again, other, 60, 100, run);
  }
}

// Drawn over a ridge along it by a frame that it hangs in.
TEST(EdgeTouch, FrictionIsThatOfBoth) {
  constexpr double kFriction = 0.4;
  TissueDefinition given = taut(true, 0.0003), roof = ridge();
  given.attached = {given.fixed};
  given.fixed.clear();
  given.material.friction = kFriction;
  roof.material.friction = 1.0;
  for (std::uint32_t i = 0; i < roof.grid.corners.size(); ++i) roof.fixed.push_back(i);
  Crossed crossed(roof, given);
  Body frame(testing::mass_only(0.0, {}));
  crossed.world.add(frame);
  crossed.upper.attach(0, &frame);
  const auto go = [&](const Vec3& to, int steps) {
    const Vec3 from = frame.pose().position;
    Vec3 force{};
    for (int i = 1; i <= steps; ++i) {
      frame.move_to({from + (to - from) * (static_cast<double>(i) / steps), {}});
      crossed.step(1);
      if (2 * i > steps) force += crossed.upper.force_on(frame) * (2.0 / steps);
    }
    return force;
  };
  go({0, 0, -0.002}, 200);
  const Vec3 down = go({0, 0, -0.002}, 400), sticks = go({0, 0.0002, -0.002}, 100),
             slides = go({0, 0.006, -0.002}, 400), back = go({0, 0.0, -0.002}, 400);
  EXPECT_GT(down.z, 5e-5);
  EXPECT_LT(std::abs(down.y), 1e-3 * down.z);
  EXPECT_LE(sticks.y, 0.0);
  EXPECT_GT(sticks.y, -1.01 * kFriction * sticks.z);
  EXPECT_NEAR(slides.y, -kFriction * slides.z, 0.03 * kFriction * slides.z);
  EXPECT_NEAR(back.y, kFriction * back.z, 0.03 * kFriction * back.z);
  crossed.upper.attach(0, nullptr);
  crossed.world.remove(frame);
}

}  // namespace
}  // namespace ambf::physics
