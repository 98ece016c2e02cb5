// Sheets: their modulus and thickness mean themselves, nothing is lost, and they rest on bodies and hang on them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "physics/soft_grip.h"
#include "physics/tissue.h"
#include "physics/tissue_grid.h"
#include "tests/physics/fixtures.h"
#include "tests/physics/soft_scene.h"
#include "tests/physics/tissue_rectangle.h"

namespace ambf::physics {
namespace {

using math::Vec3;
using testing::box;
using testing::ground;
using testing::kG;
using testing::Mesh;
using testing::parameters;
using testing::rectangle;
using testing::Scene;
using testing::sheet_of;
using testing::sphere;
using testing::those;

// A strip that hangs on one end, and is pulled at the other: strain is force by E h w.
TEST(TissueSheet, ModulusAndThicknessAreThoseOfAStrip) {
  for (const auto& [young, step, mesh] :
       {std::tuple(2e4, 0.001, Mesh::diagonals), std::tuple(1e5, 0.002, Mesh::crossed),
        std::tuple(1e6, 0.0005, Mesh::diagonals)}) {
    const double length = 0.06, width = 0.02, thickness = 0.001, strain = 0.05;
    TissueDefinition strip = sheet_of(rectangle(length, width, 12, 4, mesh), thickness, young, 0.4);
    strip.step_s = step;
    strip.fixed = those(strip, [&](const Vec3& at) { return at.x < -0.5 * length + 1e-9; });
    const auto end = those(strip, [&](const Vec3& at) { return at.x > 0.5 * length - 1e-9; });
    Scene scene({0, 0, 0}, step);
    Tissue sheet(strip);
    add(scene.world, sheet);
    const double pull = young * thickness * width * strain;
    double mean = 0.0;
    const int settle = static_cast<int>(1.0 / step);
    for (int i = 0; i < 2 * settle; ++i) {
      for (const std::uint32_t node : end) sheet.apply_force(node, {pull / static_cast<double>(end.size()), 0, 0});
      scene.step(1);
      if (i < settle) continue;
      // Between a quarter and three quarters, where ends are far.
      mean += ((sheet.position(2 * 13 + 9).x - sheet.position(2 * 13 + 3).x) / (0.5 * length) - 1.0) / settle;
    }
    EXPECT_NEAR(mean / strain, 1.0, 0.03) << young << " Pa";
    remove(scene.world, sheet);
  }
}

// Clamped at one end, its own weight bends it as a beam: by w L^4 / (8 E I). Where a row of triangles is fixed, the
// first of the edges between them bends, too: as if it were longer by a quarter of an element.
TEST(TissueSheet, BendsAsThinPlatesDo) {
  for (const auto& [along, mesh, step] :
       {std::tuple(10U, Mesh::diagonals, 0.001), std::tuple(10U, Mesh::crossed, 0.002),
        std::tuple(20U, Mesh::diagonals, 0.001), std::tuple(20U, Mesh::crossed, 0.0005)}) {
    const double length = 0.05, width = 0.02, thickness = 0.002, young = 1e6, nu = 0.3;
    const double gravity = 2.0, cell = length / along;  // m/s^2: it sags by a tenth of its length
    TissueDefinition strip =
        sheet_of(rectangle(length + cell, width, along + 1, along * 2 / 5, mesh), thickness, young, nu);
    strip.step_s = step;
    const double clamp = -0.5 * (length + cell) + cell;
    strip.fixed = those(strip, [&](const Vec3& at) { return at.x < clamp + 1e-9; });
    const auto end = those(strip, [&](const Vec3& at) { return at.x > 0.5 * (length + cell) - 1e-9; });
    Scene scene({0, 0, -gravity}, step);
    Tissue sheet(strip);
    add(scene.world, sheet);
    const int settle = static_cast<int>(0.75 / step);
    double sag = 0.0;
    scene.step(settle);
    for (int i = 0; i < settle; ++i) {
      scene.step(1);
      for (const std::uint32_t node : end) sag -= sheet.position(node).z / static_cast<double>(end.size()) / settle;
    }
    const double beam =
        1060.0 * gravity * thickness * std::pow(length, 4) / (8.0 * young * std::pow(thickness, 3) / 12.0);
    EXPECT_NEAR(sag / beam, 1.0, along < 20 ? 0.12 : 0.06) << along << ", " << step << " s";
    remove(scene.world, sheet);
  }
}

// Thrown and turned, a closed and an open one: momentum is what acts from outside.
TEST(TissueSheet, FallsFreelyAndKeepsItsSpin) {
  TissueDefinition given = sheet_of(rectangle(0.05, 0.04, 10, 8), 0.001, 1e5);
  given.T_world_body = {{0, 0, 5}, math::exp({0.3, -0.2, 1.0})};
  Scene scene;
  Tissue sheet(given);
  EXPECT_NEAR(sheet.mass(), 0.05 * 0.04 * 0.001 * 1060.0, 1e-12);
  EXPECT_NEAR(sheet.volume(), 0.05 * 0.04 * 0.001, 1e-15);
  add(scene.world, sheet);
  sheet.apply_wrench({{0.0, 0.0, 0.0}, {0.0, 2e-3, 1e-3}});
  scene.step(1);
  const Vec3 spin = sheet.angular_momentum();
  EXPECT_NEAR(spin.y, 2e-6, 2e-9);
  const double before = sheet.momentum().z;
  scene.step(500);
  EXPECT_NEAR((sheet.momentum().z - before) / (-kG * 0.5 * sheet.mass()), 1.0, 1e-6);
  EXPECT_LT(math::norm(sheet.angular_momentum() - spin), 0.005 * math::norm(spin));
  EXPECT_LT(std::abs(sheet.momentum().x) + std::abs(sheet.momentum().y), 1e-9);
  remove(scene.world, sheet);
}

// Laid over a ball and over the edge of a box, it hangs there, and nothing of the body is on its other side.
TEST(TissueSheet, HangsOverBodies) {
  for (const bool over_ball : {true, false}) {
    TissueDefinition given = sheet_of(rectangle(0.12, 0.12, 18, 18, Mesh::crossed), 0.0005, 1e5);
    given.T_world_body.position.z = 0.003;
    given.material.friction = 1.0;
    Scene scene;
    Tissue sheet(given);
    BodyDefinition below_of = over_ball ? parameters(0.0, {sphere(0.03)}, {0, 0, -0.03})
                                        : parameters(0.0, {box(0.06, 0.06, 0.06)}, {0, 0, -0.03});
    below_of.surface.friction = 1.0;
    Body below(below_of);
    scene.world.add(below);
    add(scene.world, sheet);
    scene.step(1200);
    const Vec3 centre = sheet.centre().position;
    double held = 0.0;  // on edges it swings for long
    for (int i = 0; i < 100; ++i) {
      scene.step(1);
      held -= 0.01 * sheet.force_on(below).z / (sheet.mass() * kG);
    }
    EXPECT_NEAR(held, 1.0, 0.03) << over_ball;
    double deepest = 1.0, lowest = 1.0;
    for (std::size_t i = 0; i < sheet.node_count(); ++i) {
      const Vec3 at = sheet.position(i) + Vec3{0, 0, 0.03};
      const Vec3 beyond{std::abs(at.x) - 0.03, std::abs(at.y) - 0.03, std::abs(at.z) - 0.03};
      deepest = std::min(deepest, over_ball ? math::norm(at) - 0.03 : std::max({beyond.x, beyond.y, beyond.z}));
      lowest = std::min(lowest, at.z);
    }
    EXPECT_GT(deepest, 0.0009) << over_ball << ": margin and half of its thickness are 1.25 mm";
    EXPECT_LT(lowest, 0.01) << "its edges hang down";
    scene.step(500);
    EXPECT_LT(math::norm(sheet.centre().position - centre), 1e-3) << over_ball;
    remove(scene.world, sheet);
  }
}

TEST(TissueSheet, SlidesAboveItsAngleOfFrictionAndHoldsBelow) {
  for (const double friction : {0.3, 0.8})
    for (const double by : {0.88, 1.15}) {
      TissueDefinition given = sheet_of(rectangle(0.03, 0.03, 6, 6), 0.001, 1e5);
      given.material.friction = friction;
      const double slope = std::atan(friction) * by;
      Scene scene({kG * std::sin(slope), 0, -kG * std::cos(slope)});
      given.T_world_body.position.z = given.margin + 0.0005;
      Tissue sheet(given);
      BodyDefinition floor_of = parameters(0.0, {ground()}, {});
      floor_of.surface.friction = 1.0;
      Body floor(floor_of);
      scene.world.add(floor);
      add(scene.world, sheet);
      scene.step(300);
      const double before = sheet.centre().position.x, speed = sheet.momentum().x / sheet.mass();
      scene.step(200);
      const double gained = (sheet.momentum().x / sheet.mass() - speed) / 0.2;
      if (by < 1.0) {
        EXPECT_LT(std::abs(sheet.centre().position.x - before), 2e-5) << friction;
      } else {
        EXPECT_NEAR(gained / (kG * (std::sin(slope) - friction * std::cos(slope))), 1.0, 0.1) << friction;
      }
      remove(scene.world, sheet);
    }
}

// Clamped along its rim, it bears a ball and a box that fall on it, and both feel their weight.
TEST(TissueSheet, BearsWeights) {
  for (const bool ball : {true, false}) {
    TissueDefinition given = sheet_of(rectangle(0.08, 0.08, 12, 12, Mesh::crossed), 0.001, 3e5);
    given.material.share = 0.7;  // it is a trampoline else
    given.material.time = 0.03;
    given.fixed = those(given, [](const Vec3& at) { return std::abs(at.x) > 0.034 || std::abs(at.y) > 0.034; });
    Scene scene;
    Tissue sheet(given);
    BodyDefinition weight_of = parameters(0.03, {ball ? sphere(0.012) : box(0.02, 0.02, 0.01)}, {0.004, 0, 0.02});
    weight_of.inertia = {2e-6, 2e-6, 2e-6};
    Body weight(weight_of);
    scene.world.add(weight);
    add(scene.world, sheet);
    scene.step(1400);
    double force = 0.0;
    for (int i = 0; i < 200; ++i) scene.step(1), force -= sheet.force_on(weight).z / 200;
    EXPECT_NEAR(force / (-0.03 * kG), 1.0, 0.02) << ball;
    EXPECT_LT(math::norm(weight.twist().linear), 5e-3) << ball;
    EXPECT_GT(weight.pose().position.z, -0.01) << ball;
    EXPECT_LT(sheet.position(6 * 13 + 6).z, -0.002) << "it gives way";
    remove(scene.world, sheet);
  }
}

// Held by two hands that move apart: both feel what the strip bears, and a light one that it hangs on falls with it.
TEST(TissueSheet, IsPulledByTwoHands) {
  const double length = 0.06, width = 0.02, thickness = 0.001, young = 1e5, strain = 0.1;
  TissueDefinition given = sheet_of(rectangle(length, width, 12, 4), thickness, young, 0.3);
  given.attached = {those(given, [&](const Vec3& at) { return at.x < -0.5 * length + 1e-9; })};
  const auto end = those(given, [&](const Vec3& at) { return at.x > 0.5 * length - 1e-9; });
  Scene scene({0, 0, 0});
  Tissue sheet(given);
  Body left(parameters(0.0, {box(0.01, 0.03, 0.01)}, {-0.5 * length, 0, 0}));
  Body right(parameters(0.0, {box(0.01, 0.03, 0.01)}, {0.5 * length, 0, 0}));
  scene.world.add(left);
  scene.world.add(right);
  add(scene.world, sheet);
  sheet.attach(0, &left);
  SoftGrip grip({1e4, 1.0});
  for (const std::uint32_t node : end) ASSERT_TRUE(grip.hold(right, sheet, node));
  for (int i = 1; i <= 200; ++i) {
    right.move_to({{0.5 * length + strain * length * i / 200.0, 0, 0}, {}});
    scene.step(1);
  }
  scene.step(1500);
  double left_force = 0.0, right_force = 0.0;
  for (int i = 0; i < 200; ++i) {
    scene.step(1);
    left_force += sheet.force_on(left).x / 200;
    right_force += sheet.force_on(right).x / 200;
  }
  EXPECT_NEAR(left_force / (young * thickness * width * strain), 1.0, 0.1);
  EXPECT_NEAR(right_force / left_force, -1.0, 0.01);
  grip.release();
  scene.step(500);
  EXPECT_LT(std::abs(sheet.force_on(left).x), 0.1 * left_force);
  scene.world.remove(left);
  scene.step(1);
  EXPECT_EQ(sheet.force_on(left).x, 0.0);
  remove(scene.world, sheet);
}

TEST(TissueSheet, StiffPartsStrainLessAndStressRelaxes) {
  const double length = 0.06, width = 0.01, thickness = 0.001, young = 1e5, strain = 0.02;
  TissueDefinition given = sheet_of(rectangle(length, width, 24, 4), thickness, young, 0.3);
  for (TissueTriangle& each : given.grid.triangles)
    if (given.grid.corners[each.corner[0]].x + given.grid.corners[each.corner[1]].x +
            given.grid.corners[each.corner[2]].x >
        0.0)
      each.stiffness = 10.0;
  given.material.share = 0.4;
  given.material.time = 0.2;
  given.attached = {those(given, [&](const Vec3& at) { return at.x < -0.5 * length + 1e-9; })};
  given.fixed = those(given, [&](const Vec3& at) { return at.x > 0.5 * length - 1e-9; });
  Scene scene({0, 0, 0});
  Tissue sheet(given);
  Body left(parameters(0.0, {box(0.01, 0.03, 0.01)}, {-0.5 * length, 0, 0}));
  scene.world.add(left);
  add(scene.world, sheet);
  sheet.attach(0, &left);
  for (int i = 1; i <= 10; ++i) {
    left.move_to({{-0.5 * length - strain * length * i / 10.0, 0, 0}, {}});
    scene.step(1);
  }
  const auto mean_force = [&] {
    double sum = 0.0;
    for (int i = 0; i < 20; ++i) scene.step(1), sum += sheet.force_on(left).x / 20;
    return sum;
  };
  scene.step(40);
  const double at_once = mean_force();
  scene.step(1800);
  const auto stretch = [&](std::size_t from, std::size_t to) {
    return (sheet.position(2 * 25 + to).x - sheet.position(2 * 25 + from).x) /
               (length / 24.0 * static_cast<double>(to - from)) -
           1.0;
  };
  EXPECT_NEAR(stretch(3, 9) / stretch(15, 21), 10.0, 1.0);
  EXPECT_NEAR(mean_force() / at_once, 0.4 / (0.4 + 0.6 * std::exp(-0.055 / 0.2)), 0.03);
  remove(scene.world, sheet);
}

TEST(TissueSheet, ContinuesBitForBitFromItsState) {
  TissueDefinition given = sheet_of(rectangle(0.06, 0.06, 10, 10), 0.0005, 5e4);
  given.material.share = 0.5;
  Scene scene;
  given.T_world_body.position = {0.005, 0, 0.034};
  Tissue sheet(given);
  Body ball(parameters(0.0, {sphere(0.03)}, {}));
  Body floor(parameters(0.0, {ground(-0.02)}, {}));
  scene.world.add(ball);
  scene.world.add(floor);
  add(scene.world, sheet);
  testing::expect_goes_on_from_its_state(scene, sheet, 150, 300, given.T_world_body.position, 1e-9);
  remove(scene.world, sheet);
}

// Crumpled between plates, it unfolds again.
TEST(TissueSheet, RecoversFromBeingCrushed) {
  TissueDefinition given = sheet_of(rectangle(0.05, 0.05, 10, 10, Mesh::crossed), 0.002, 1e5);
  given.T_world_body.orientation = math::exp({1.5, 0.1, 0.0});
  given.material.friction = 0.3;
  given.touches_itself = false;  // folds would hold each other
  Scene scene({0, 0, 0});
  Tissue sheet(given);
  Body floor(parameters(0.0, {ground(-0.03)}, {}));
  Body plate(parameters(0.0, {box(0.2, 0.2, 0.02)}, {0, 0, 0.04}));
  scene.world.add(floor);
  scene.world.add(plate);
  add(scene.world, sheet);
  const double volume = sheet.volume();
  for (int i = 0; i <= 300; ++i) {
    plate.move_to({{0, 0, 0.04 - 0.05 * i / 300.0}, {}});
    scene.step(1);
  }
  scene.step(100);
  EXPECT_FALSE(sheet.divergence());
  plate.move_to({{0, 0, 0.3}, {}});
  scene.step(3000);
  double out_of_plane = 0.0;
  const math::Pose back = math::inverse(sheet.centre());
  for (std::size_t i = 0; i < sheet.node_count(); ++i)
    out_of_plane = std::max(out_of_plane, std::abs((back * sheet.position(i)).z));
  EXPECT_LT(out_of_plane, 2e-3);
  EXPECT_NEAR(sheet.volume() / volume, 1.0, 0.01);
  remove(scene.world, sheet);
}

TEST(TissueSheet, IsMadeOfAMesh) {
  TissueSurface surface = rectangle(0.04, 0.02, 2, 1);
  EXPECT_EQ(crowded_edges(surface), 0U);
  const TissueGrid grid = make_sheet_grid(surface, 0.001, 0.006);
  ASSERT_GT(grid.triangles.size(), 32U);
  double area = 0.0, longest = 0.0;
  for (const TissueTriangle& t : grid.triangles) {
    const Vec3 a = grid.corners[t.corner[0]], b = grid.corners[t.corner[1]], c = grid.corners[t.corner[2]];
    area += 0.5 * math::norm(math::cross(b - a, c - a));
    longest = std::max({longest, math::norm(b - a), math::norm(c - b), math::norm(a - c)});
  }
  EXPECT_NEAR(area, 0.0008, 1e-15);
  EXPECT_LT(longest, 0.00601);
  for (std::size_t i = 0; i < surface.vertices.size(); ++i) EXPECT_EQ(grid.corners[i], surface.vertices[i]);
  surface.vertices.push_back({0, 0, 0.01});
  surface.triangles.push_back({0, 1, 6});
  surface.triangles.push_back({1, 4, 6});
  surface.triangles.push_back({4, 1, 6});
  EXPECT_EQ(crowded_edges(surface), 2U);
}

}  // namespace
}  // namespace ambf::physics
