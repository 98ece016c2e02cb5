// Where the surface of a cut is: on what the edge of the blade swept, not along the elements that it opens.
#include <gtest/gtest.h>

#include <cmath>

#include "physics/soft_grip.h"
#include "tests/physics/cut_strokes.h"
#include "tests/physics/tissue_shapes.h"

namespace ambf::physics {
namespace {

using namespace testing;
using math::Vec3;

constexpr double kBar = 0.2;  // elements: bar 7 of the issue

void expect_near(const OffSwept& off) {
  EXPECT_GT(off.nodes, 20U);
  EXPECT_EQ(off.pieces, 2U);
  EXPECT_LT(off.most, kBar);
  EXPECT_GT(off.loaded, 0.2) << "there is something to mend";
}

TEST(CutFace, OfABlockLiesOnAStraightStroke) {
  for (const auto& [turn, roll] : {std::pair{0.0, 0.0}, {0.6, 0.0}, {0.9, 0.4}}) {
    SCOPED_TRACE(std::to_string(turn) + " " + std::to_string(roll));
    expect_near(CutStrokes::block_straight(turn, roll));
  }
}

TEST(CutFace, OfABlockLiesOnARoundStroke) {
  for (const double radius : {0.03, 0.015}) {
    SCOPED_TRACE(radius);
    expect_near(CutStrokes::block_round(radius));
  }
}

TEST(CutFace, OfABallAndALiverLiesOnAStraightStroke) {
  for (const TissueSurface& mesh : {ball(), liver()}) expect_near(CutStrokes::mesh_straight(mesh, 0.4, 0.2));
}

TEST(CutFace, OfASheetLiesOnAStraightStroke) {
  for (const Mesh mesh : {Mesh::diagonals, Mesh::crossed})
    for (const auto& [turn, lean] : {std::pair{0.0, 0.0}, {0.3, 0.5}, {0.9, 0.0}}) {
      SCOPED_TRACE(std::to_string(turn) + " " + std::to_string(lean));
      expect_near(CutStrokes::sheet_straight(mesh, turn, lean));
    }
}

TEST(CutFace, OfASheetLiesOnARoundStroke) {
  for (const double radius : {0.05, 0.025}) {
    SCOPED_TRACE(radius);
    expect_near(CutStrokes::sheet_round(Mesh::crossed, radius));
  }
}

std::vector<Vec3> nodes_of(const Tissue& tissue) {
  std::vector<Vec3> all;
  for (std::size_t i = 0; i < tissue.node_count(); ++i) all.push_back(tissue.position(i));
  return all;
}

TEST(CutFace, IsSavedAndResetsCloseIt) {
  const auto expect = [](LoadedScene scene, LoadedScene other, const math::Pose& from, const Vec3& way) {
    const std::vector<Vec3> loaded = nodes_of(scene.tissue);
    scene.stroke(from, way, 50);
    ASSERT_GT(scene.tissue.cut_nodes().size(), 10U);
    std::vector<double> state;
    scene.tissue.get_state(state);
    ASSERT_TRUE(other.tissue.set_state(state));
    EXPECT_EQ(nodes_of(other.tissue), nodes_of(scene.tissue));
    EXPECT_EQ(other.tissue.cut_nodes(), scene.tissue.cut_nodes());
    for (const double wrong : {std::nan(""), 1e9}) {  // a way to what was swept that cannot be
      std::vector<double> forged = state;
      forged.back() = wrong;
      EXPECT_FALSE(other.tissue.set_state(forged));
    }
    other.tissue.reset();
    EXPECT_EQ(nodes_of(other.tissue), loaded);
    EXPECT_TRUE(other.tissue.cut_nodes().empty());
  };
  expect(CutStrokes::block_scene(), CutStrokes::block_scene(), {{0.021, 0.0101, 0.025}, {}}, {0, 0, -0.014});
  expect(CutStrokes::sheet_scene(Mesh::crossed), CutStrokes::sheet_scene(Mesh::crossed), {{0.0011, -0.03, 0}, {}},
         {0, 0.04, 0});
}

// What is held at a node goes along when a cut moves the node along the surface: it pulls at nothing.
TEST(CutFace, WhatIsHeldThereIsNotPulled) {
  LoadedScene scene = CutStrokes::block_scene();
  SoftGrip grip({500.0, 0.5});
  for (std::size_t i = 0; i < scene.tissue.node_count() && grip.held().size() < SoftGrip::kMaxNodes; ++i) {
    const Vec3 at = scene.tissue.position(i);
    if (at.z > 0.0199 && std::abs(at.x - 0.0213) < 0.004) grip.hold_in_world(scene.world, scene.tissue, i);
  }
  ASSERT_GT(grip.held().size(), 10U);
  double most = 0.0;
  const auto at = [](double share) { return math::Pose{{0.0213, 0.0101, 0.025 - 0.03 * share}, {}}; };
  scene.blade.use(nullptr);
  scene.hand.set_pose(at(0.0));
  scene.blade.use(&scene.hand);
  for (int i = 1; i <= 60; ++i) {
    scene.hand.move_to(at(i / 60.0));
    scene.world.step();
    for (const HeldNode& held : grip.held()) most = std::max(most, math::norm(held.force_world));
  }
  EXPECT_EQ(scene.tissue.pieces(), 2U);
  EXPECT_LT(most, 0.02) << "N; elements of 5 mm would pull 1 N";
  grip.release();
}

}  // namespace
}  // namespace ambf::physics
