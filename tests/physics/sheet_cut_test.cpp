// Blades that cut sheets: what falls apart, what gapes, what is lost (nothing), the force that it takes, and that a cut
// repeats and can be saved.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/physics/cut_scene.h"
#include "tests/physics/tissue_rectangle.h"

namespace ambf::physics {
namespace {

using namespace testing;
using math::Vec3;

constexpr double kLength = 0.06, kWidth = 0.04, kThickness = 0.0005;

TissueDefinition strip(Mesh mesh, std::size_t max_corners = 2000) {
  return sheet_of(rectangle(kLength, kWidth, 20, 13, mesh), kThickness, 1e5, 0.4, max_corners);
}

// Edges through the sheet, and in its plane along y and x.
const BladeOptions kUpright{{{0, 0, -0.004}, {0, 0, 0.004}}, 2.0};
BladeOptions across(double sharpness) { return {{{0, -0.025, 0}, {0, 0.025, 0}}, sharpness}; }

// Pulls both ends apart; N, on each.
void pull(CutScene& scene, double force, int steps) {
  std::vector<std::size_t> left, right;
  for (std::size_t i = 0; i < scene.tissue.node_count(); ++i) {
    const double x = scene.tissue.position(i).x;
    if (x < -0.5 * kLength + 0.002) left.push_back(i);
    if (x > 0.5 * kLength - 0.002) right.push_back(i);
  }
  for (int step = 0; step < steps; ++step) {
    for (const std::size_t i : left) scene.tissue.apply_force(i, {-force / static_cast<double>(left.size()), 0, 0});
    for (const std::size_t i : right) scene.tissue.apply_force(i, {force / static_cast<double>(right.size()), 0, 0});
    scene.world.step();
  }
}

// How far from each other nodes are that were loaded at one place; m.
double gap(const CutScene& scene, const TissueDefinition& given) {
  double most = 0.0;
  const auto& points = given.grid.points;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t k = i + 1; k < points.size(); ++k)
      if (points[i].corner[0] == points[k].corner[0])
        most = std::max(most, math::norm(scene.tissue.position(i) - scene.tissue.position(k)));
  return most;
}

TEST(SheetCut, HalfwayItGapesAndThroughItFallsApart) {
  for (const Mesh mesh : {Mesh::diagonals, Mesh::crossed})
    for (const bool pressed : {false, true}) {
      SCOPED_TRACE(pressed);
      const TissueDefinition given = strip(mesh);
      // Sharp: a free sheet would be taken along.
      BladeOptions edge{kUpright.edge, 0.1};
      if (pressed) edge = {{{0, -0.06, 0}, {0, 0, 0}}, 0.01};
      CutScene scene(given, edge);
      ASSERT_TRUE(scene.tissue.can_be_cut());
      const double mass = scene.tissue.mass(), area = scene.tissue.volume();
      EXPECT_NEAR(area, kLength * kWidth * kThickness, 1e-12);
      const std::size_t corners = scene.tissue.corner_count(), nodes = scene.tissue.node_count();
      if (pressed)
        scene.stroke({{0.0011, 0, 0.002}, {}}, {0, 0, -0.006}, 60);
      else
        scene.stroke({{0.0011, -0.025, 0}, {}}, {0, 0.025, 0}, 100);
      const std::size_t half = scene.tissue.open_seams();
      EXPECT_GT(half, 6U);
      EXPECT_LT(half, 24U) << "it is one line of edges";
      EXPECT_EQ(scene.tissue.pieces(), 1U);
      EXPECT_EQ(scene.tissue.node_count(), nodes);
      EXPECT_GT(scene.tissue.corner_count(), corners);
      std::vector<double> state;
      scene.tissue.get_state(state);
      scene.blade.use(nullptr);
      pull(scene, 0.02, 120);
      EXPECT_GT(gap(scene, given), 0.001);
      EXPECT_LT(gap(scene, given), 0.02);
      ASSERT_TRUE(scene.tissue.set_state(state));
      if (pressed)
        scene.stroke({{0.0011, 0.03, 0.002}, {}}, {0, 0, -0.006}, 60);
      else
        scene.stroke({scene.tissue.centre().position + Vec3{0.0011, -0.004, 0}, {}}, {0, 0.034, 0}, 150);
      EXPECT_EQ(scene.tissue.pieces(), 2U);
      EXPECT_NEAR(scene.tissue.mass(), mass, 1e-9 * mass);
      scene.blade.use(nullptr);
      pull(scene, 0.002, 100);
      EXPECT_GT(gap(scene, given), 0.005) << "they fall apart";
      EXPECT_NEAR(scene.tissue.volume(), area, 0.03 * area);
      EXPECT_FALSE(scene.tissue.divergence());
      scene.tissue.reset();
      EXPECT_EQ(scene.tissue.open_seams(), 0U);
      EXPECT_EQ(scene.tissue.corner_count(), corners);
      EXPECT_EQ(scene.tissue.pieces(), 1U);
      EXPECT_EQ(gap(scene, given), 0.0);
    }
}

TEST(SheetCut, FlatInItsPlaneItCutsNothing) {
  const TissueDefinition given = strip(Mesh::crossed);
  for (const double height : {0.0, 0.0001, -0.0002}) {
    SCOPED_TRACE(height);
    CutScene scene(given, {{{-0.01, 0, 0}, {0.01, 0, 0}}, 0.0});
    scene.stroke({{-0.05, 0.0013, height}, {}}, {0.1, 0, 0}, 200);  // along its edge
    EXPECT_EQ(scene.tissue.open_seams(), 0U);
    scene.stroke({{0.0013, -0.03, height}, {}}, {0, 0.06, 0}, 200);  // across, between the sheet's sides
    EXPECT_EQ(scene.tissue.open_seams(), 0U);
    scene.stroke({{0.0013, 0.0013, height + 0.002}, {}}, {0, 0, -0.004}, 20);  // through it
    EXPECT_GT(scene.tissue.open_seams(), 3U);
  }
}

// Both ends are fixed. What the edge takes is sharpness times its length within, and less than that does not cut.
TEST(SheetCut, TakesItsForceAndBelowItOnlyPushes) {
  TissueDefinition given = strip(Mesh::crossed);
  given.fixed = those(given, [](const Vec3& at) { return std::abs(at.x) > 0.5 * kLength - 0.001; });
  for (const double sharpness : {1.0, 2.0}) {
    SCOPED_TRACE(sharpness);
    CutScene pressed(given, across(sharpness));
    double most = 0.0, pushed = 0.0;
    pressed.stroke({{0.0011, 0, 0.001}, {}}, {}, 5);
    for (int i = 1; i <= 400 && pressed.tissue.open_seams() == 0; ++i) {
      pressed.hand.move_to({{0.0011, 0, 0.001 - 0.00003 * i}, {}});
      pressed.world.step();
      most = std::max(most, -pressed.blade.force_world().z);
      EXPECT_NEAR(pressed.tissue.force_on(pressed.hand).z, -pressed.blade.force_world().z, 1e-9);
      if (pressed.tissue.open_seams() == 0) pushed = -pressed.tissue.position(20 / 2 + 6 * 21).z;
    }
    EXPECT_GT(pressed.tissue.open_seams(), 0U);
    EXPECT_NEAR(most / (sharpness * kWidth), 1.0, 0.1);
    EXPECT_GT(pushed, 0.0005) << "it gives way before";
    CutScene slit(given, {{{0, 0, -0.004}, {0, 0, 0.004}}, sharpness});
    slit.stroke({{0.0011, 0, 0.01}, {}}, {0, 0, -0.01}, 100);
    double mean = 0.0;
    for (int i = 1; i <= 100; ++i) {
      slit.hand.move_to({{0.0011, 0.0001 * i, 0}, {}});
      slit.world.step();
      if (i > 50) mean += slit.blade.force_world().y / 50;
    }
    EXPECT_GT(slit.tissue.open_seams(), 3U);
    EXPECT_NEAR(slit.blade.length_in_tissue() / kThickness, 1.0, 0.05);
    EXPECT_NEAR(mean / (sharpness * kThickness), 1.0, 0.2);
  }
}

// No faster is too fast: it is held where it came in.
TEST(SheetCut, IsNotPassedInOneStep) {
  const TissueDefinition given = strip(Mesh::crossed);
  CutScene scene(given, across(1e4));
  scene.stroke({{0.0011, 0, 0.0024}, {}}, {0, 0, -0.03}, 15);  // 2 m/s
  EXPECT_EQ(scene.tissue.open_seams(), 0U) << "blunt: it takes the sheet along";
  EXPECT_LT(scene.tissue.centre().position.z, -0.01);
}

// Where it is cut, nothing bends: clamped at one end, it hangs by what is left.
TEST(SheetCut, NothingBendsAcrossACut) {
  TissueDefinition given = sheet_of(rectangle(kLength, kWidth, 15, 10), 0.002, 1e6, 0.4, 2000);
  given.fixed = those(given, [](const Vec3& at) { return at.x < -0.5 * kLength + 0.0041; });
  double sag[2] = {};
  for (const int cut : {0, 1}) {
    CutScene scene(given, kUpright);
    if (cut == 1) scene.stroke({{-0.0189, -0.025, 0}, {}}, {0, 0.042, 0}, 150);
    EXPECT_EQ(scene.tissue.open_seams() > 0, cut == 1);
    scene.blade.use(nullptr);
    for (int step = 0; step < 500; ++step) {
      for (std::size_t i = 0; i < scene.tissue.node_count(); ++i) scene.tissue.apply_force(i, {0, 0, -2e-6});
      scene.world.step();
      if (step >= 130) sag[cut] -= scene.tissue.centre().position.z / 370;
    }
  }
  EXPECT_GT(sag[0], 1e-5);
  EXPECT_GT(sag[1], 1.5 * sag[0]);
}

TEST(SheetCut, RandomStrokesLoseNothingRepeatAndAreSaved) {
  const TissueDefinition given = strip(Mesh::diagonals, 4000);
  CutScene first(given, across(2.0)), again(given, across(2.0)), saved(given, across(2.0));
  const double mass = first.tissue.mass(), area = first.tissue.volume();
  std::mt19937 random(1);
  const auto number = [&] { return static_cast<double>(random() % 10001) / 10000.0; };
  for (int i = 0; i < 40; ++i) {
    const math::Quat turned = math::Quat{number() - 0.5, number() - 0.5, number() - 0.5, 0.2 + number()};
    const double size = 1.0 / math::norm(turned);
    const math::Pose from{{0.06 * number() - 0.03, 0.04 * number() - 0.02, 0.01},
                          {turned.x * size, turned.y * size, turned.z * size, turned.w * size}};
    const Vec3 way{0.02 * number() - 0.01, 0.02 * number() - 0.01, -0.02 * number()};
    if (i == 20) {
      std::vector<double> state, edge;
      first.tissue.get_state(state);
      first.blade.get_state(edge);
      for (CutScene* each : {&first, &again, &saved}) {
        ASSERT_TRUE(each->tissue.set_state(state));
        each->blade.set_state(each->world, edge);
      }
      EXPECT_EQ(saved.tissue.open_seams(), first.tissue.open_seams());
    }
    first.stroke(from, way, 8);
    again.stroke(from, way, 8);
    if (i >= 20) saved.stroke(from, way, 8);
    ASSERT_FALSE(first.tissue.divergence()) << i;
  }
  EXPECT_GT(first.tissue.open_seams(), 50U);
  EXPECT_FALSE(first.tissue.full());
  EXPECT_NEAR(first.tissue.mass(), mass, 1e-9 * mass);
  EXPECT_EQ(first.state(), again.state());
  EXPECT_EQ(first.state(), saved.state());
  first.blade.use(nullptr);
  for (int i = 0; i < 300; ++i) first.world.step();
  EXPECT_NEAR(first.tissue.volume(), area, 5e-3 * area);
  EXPECT_FALSE(first.tissue.divergence());
}

// From the middle of a stroke, and with a place of the edge that it could not have written.
TEST(SheetCut, AStrokeGoesOnFromItsState) {
  TissueDefinition given = strip(Mesh::crossed);
  given.fixed = those(given, [](const Vec3& at) { return std::abs(at.x) > 0.5 * kLength - 0.001; });
  CutScene scene(given, kUpright), other(given, kUpright);
  scene.stroke({{0.0011, -0.025, 0}, {}}, {0, 0.02, 0}, 100);
  ASSERT_GT(scene.tissue.open_seams(), 0U);
  std::vector<double> state, edge, now;
  scene.tissue.get_state(state);
  scene.blade.get_state(edge);
  other.hand.set_pose(scene.hand.pose());
  for (CutScene* each : {&scene, &other}) {
    ASSERT_TRUE(each->tissue.set_state(state));
    each->blade.set_state(each->world, edge);
    for (int i = 1; i <= 50; ++i) {
      each->hand.move_to({{0.0011, -0.005 + 0.0002 * i, 0}, {}});
      each->world.step();
    }
  }
  EXPECT_EQ(scene.state(), other.state());
  std::size_t first = 0;
  while (edge[first] < 0.0) first += 6;
  for (const auto& [number, value] : {std::pair{2, -3.0}, {2, 1e9}, {2, NAN}, {3, NAN}, {4, 1e300}, {5, 1.0}}) {
    std::vector<double> forged = edge;
    forged[first + static_cast<std::size_t>(number)] = value;
    scene.blade.set_state(scene.world, forged);
    scene.blade.get_state(now);
    EXPECT_EQ(now[first], -1.0) << number << " " << value;
  }
}

// Where it had room for some copies only: cutting stops, and nothing is lost.
TEST(SheetCut, FullItStops) {
  const TissueDefinition given = strip(Mesh::crossed, 21 * 14 + 3);
  CutScene scene(given, kUpright);
  scene.stroke({{0.0011, -0.025, 0}, {}}, {0, 0.05, 0}, 200);
  EXPECT_TRUE(scene.tissue.full());
  EXPECT_LE(scene.tissue.corner_count(), 21U * 14 + 3);
  EXPECT_GT(scene.tissue.open_seams(), 0U);
  EXPECT_EQ(scene.tissue.pieces(), 1U);
  EXPECT_FALSE(scene.tissue.divergence());
}

}  // namespace
}  // namespace ambf::physics
