// Tissue: a modulus means itself, nothing is lost, and bodies rest on it and it on them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "physics/tissue.h"
#include "physics/tissue_grid.h"
#include "tests/physics/fixtures.h"
#include "tests/physics/soft_scene.h"
#include "tests/physics/tissue_block.h"

namespace ambf::physics {
namespace {

using math::Vec3;
using testing::block;
using testing::box;
using testing::expect_keeps_the_momentum_of_both;
using testing::ground;
using testing::kG;
using testing::parameters;
using testing::Scene;
using testing::sphere;
using testing::tissue_of;

// Rings around the z axis.
TissueSurface ball(double radius, std::uint32_t rings = 12, std::uint32_t around = 20) {
  TissueSurface made;
  made.vertices.push_back({0, 0, -radius});
  for (std::uint32_t r = 1; r < rings; ++r)
    for (std::uint32_t k = 0; k < around; ++k) {
      const double polar = std::numbers::pi * r / rings, turn = 2.0 * std::numbers::pi * k / around;
      made.vertices.push_back({radius * std::sin(polar) * std::cos(turn), radius * std::sin(polar) * std::sin(turn),
                               -radius * std::cos(polar)});
    }
  made.vertices.push_back({0, 0, radius});
  const auto last = static_cast<std::uint32_t>(made.vertices.size() - 1);
  for (std::uint32_t k = 0; k < around; ++k) {
    const std::uint32_t next = (k + 1) % around;
    made.triangles.push_back({0, 1 + next, 1 + k});
    for (std::uint32_t r = 0; r + 2 < rings; ++r) {
      const std::uint32_t a = 1 + r * around + k, b = 1 + r * around + next;
      made.triangles.push_back({a, b, a + around});
      made.triangles.push_back({b, b + around, a + around});
    }
    made.triangles.push_back({last, last - around + k, last - around + next});
  }
  return made;
}

template <class Fits>
void fix(TissueDefinition& of, const Fits& fits) {
  for (std::uint32_t i = 0; i < of.grid.corners.size(); ++i)
    if (fits(of.grid.corners[i])) of.fixed.push_back(i);
}

// The mean height of the nodes of the surface whose rest height fits.
template <class Fits>
double mean_z(const Tissue& tissue, const std::vector<Vec3>& rest, const Fits& fits) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < tissue.node_count(); ++i)
    if (fits(rest[i])) sum += tissue.position(i).z, ++count;
  return sum / count;
}

std::vector<Vec3> nodes(const Tissue& tissue) {
  std::vector<Vec3> all;
  for (std::size_t i = 0; i < tissue.node_count(); ++i) all.push_back(tissue.position(i));
  return all;
}

TEST(TissueGrid, HasTheVolumeOfItsSurface) {
  const TissueSurface cube = block({0.05, 0.03, 0.021});
  const TissueGrid of_cube = make_tissue_grid(cube, 0.005);
  EXPECT_EQ(of_cube.elements.size(), 5U * 10 * 6 * 5);
  EXPECT_EQ(of_cube.corners.size(), 11U * 7 * 6);
  const TissueSurface round = ball(0.02);
  for (const auto& [surface, size] : {std::pair(&cube, 0.005), std::pair(&round, 0.005), std::pair(&round, 0.008)}) {
    const TissueGrid grid = make_tissue_grid(*surface, size);
    double volume = 0.0;
    for (const TissueElement& e : grid.elements) {
      const Vec3 o = grid.corners[e.corner[0]];
      volume += e.share *
                math::dot(grid.corners[e.corner[1]] - o,
                          math::cross(grid.corners[e.corner[2]] - o, grid.corners[e.corner[3]] - o)) /
                6.0;
    }
    EXPECT_NEAR(volume / volume_within(*surface), 1.0, 1e-3) << size;
    // The surface stays where it was, and closed.
    TissueSurface fine{{}, grid.faces};
    for (const TissuePoint& p : grid.points) {
      Vec3 at{};
      for (int k = 0; k < 4; ++k) at += grid.corners[p.corner[k]] * p.weight[k];
      fine.vertices.push_back(at);
    }
    for (std::size_t i = 0; i < surface->vertices.size(); ++i)
      EXPECT_LT(math::norm(fine.vertices[i] - surface->vertices[i]), 1e-12);
    EXPECT_EQ(open_edges(fine), 0U);
    EXPECT_NEAR(volume_within(fine), volume_within(*surface), 1e-12);
  }
}

TEST(TissueGrid, CountsOpenEdges) {
  TissueSurface cube = block({1, 1, 1});
  EXPECT_EQ(open_edges(cube), 0U);
  EXPECT_NEAR(volume_within(cube), 1.0, 1e-12);
  cube.triangles.pop_back();
  EXPECT_EQ(open_edges(cube), 3U);
}

// A hanging column of modulus E sags by rho g L^2 / 2E at its end.
TEST(Tissue, ModulusIsThatOfAColumn) {
  for (const auto& [young, step] : {std::pair(2e3, 0.001), std::pair(1e4, 0.0005), std::pair(1e5, 0.002)}) {
    const double length = 0.04;
    TissueDefinition column = tissue_of(block({0.01, 0.01, length}), 0.005, young, 0.3);
    column.step_s = step;
    fix(column, [&](const Vec3& at) { return at.z > length - 1e-9; });
    Scene scene({0, 0, -kG}, step);
    Tissue tissue(column);
    const std::vector<Vec3> rest = nodes(tissue);
    add(scene.world, tissue);
    double mean = 0.0;
    const int settle = static_cast<int>(1.0 / step);
    scene.step(settle);
    for (int i = 0; i < settle; ++i) {
      scene.step(1);
      mean += mean_z(tissue, rest, [](const Vec3& at) { return at.z < 1e-9; }) / settle;
    }
    EXPECT_NEAR(-mean * 2.0 * young / (1060.0 * kG * length * length), 1.0, 0.1) << young << " Pa, " << step << " s";
    remove(scene.world, tissue);
  }
}

TEST(Tissue, FallsFreelyAndKeepsItsSpin) {
  TissueDefinition given = tissue_of(ball(0.02), 0.008, 3e3);
  given.T_world_body = {{0, 0, 5}, math::exp({0.3, -0.2, 1.0})};
  Scene scene;
  Tissue tissue(given);
  add(scene.world, tissue);
  tissue.apply_wrench({{0.0, 0.0, 0.0}, {0.0, 2e-3, 0.0}});
  scene.step(1);
  const Vec3 spin = tissue.angular_momentum();
  EXPECT_NEAR(spin.y, 2e-6, 2e-9);
  const double before = tissue.momentum().z;
  scene.step(500);
  EXPECT_NEAR((tissue.momentum().z - before) / (-kG * 0.5 * tissue.mass()), 1.0, 1e-6);
  EXPECT_LT(math::norm(tissue.angular_momentum() - spin), 0.005 * math::norm(spin));
  EXPECT_LT(std::abs(tissue.momentum().x) + std::abs(tissue.momentum().y), 1e-9);
  remove(scene.world, tissue);
}

// A plate squeezes a block by a tenth: it loses (1 - 2 nu) of that volume, pushes with E times the strain, and comes
// back.
TEST(Tissue, PushesBackByItsModulusAndComesBack) {
  for (const double poisson : {0.3, 0.45}) {
    const double side = 0.03, young = 2e4;
    TissueDefinition given = tissue_of(block({side, side, side}), 0.0075, young, poisson);
    given.material.friction = 0.0;
    Scene scene({0, 0, 0});
    Tissue tissue(given);
    Body floor(parameters(0.0, {ground()}, {}));
    Body plate(parameters(0.0, {box(0.1, 0.1, 0.02)}, {0.015, 0.015, side + 0.01 + 2e-3}));
    scene.world.add(floor);
    scene.world.add(plate);
    add(scene.world, tissue);
    const double from = side + 0.01 + 2.0 * given.margin;
    for (int i = 0; i <= 300; ++i) {
      plate.move_to({{0.015, 0.015, from - 0.1 * side * i / 300.0}, {}});
      scene.step(1);
    }
    scene.step(700);
    EXPECT_NEAR(1.0 - tissue.volume() / (side * side * side), 0.1 * (1.0 - 2.0 * poisson), 0.012) << poisson;
    EXPECT_NEAR(tissue.force_on(plate).z / (young * std::log(1.0 / 0.9) * side * side), 1.0, 0.2) << poisson;
    plate.move_to({{0.015, 0.015, 0.3}, {}});
    scene.step(1500);
    EXPECT_NEAR(tissue.volume() / (side * side * side), 1.0, 2e-3);
    remove(scene.world, tissue);
  }
}

// A box on a block of tissue: its weight arrives, and it rests. On a slope it holds below the friction's angle, and
// slides above it.
TEST(Tissue, BearsWeightsOfAllShapes) {
  const double mass = 0.05;
  std::vector<scene::PlacedGeometry> shapes = {box(0.03, 0.03, 0.02), sphere(0.01), box(0, 0, 0)};
  shapes[2].geometry.shape = scene::Shape::cylinder;
  shapes[2].geometry.radius = 0.012;
  shapes[2].geometry.height = 0.02;
  for (std::size_t shape = 0; shape < shapes.size(); ++shape) {
    TissueDefinition given = tissue_of(block({0.05, 0.05, 0.02}), 0.005, 3e4);
    fix(given, [](const Vec3& at) { return at.z < 1e-9; });
    Scene scene;
    Tissue tissue(given);
    Body weight(parameters(mass, {shapes[shape]}, {0.025, 0.025, 0.033}));
    scene.world.add(weight);
    add(scene.world, tissue);
    scene.step(700);
    double force = 0.0;
    for (int i = 0; i < 100; ++i) scene.step(1), force -= tissue.force_on(weight).z / 100;
    EXPECT_NEAR(force / (-mass * kG), 1.0, 0.02) << shape;
    EXPECT_LT(math::norm(weight.twist().linear), 2e-3) << shape;
    EXPECT_GT(weight.pose().position.z, 0.02) << shape;
    remove(scene.world, tissue);
  }
}

TEST(Tissue, SlidesAboveItsAngleOfFrictionAndHoldsBelow) {
  for (const double friction : {0.3, 0.8})
    for (const double by : {0.88, 1.15}) {
      TissueDefinition given = tissue_of(block({0.03, 0.03, 0.01}), 0.005, 2e4);
      given.material.friction = friction;
      const double slope = std::atan(friction) * by;
      Scene scene({kG * std::sin(slope), 0, -kG * std::cos(slope)});
      given.T_world_body.position.z = given.margin;
      Tissue tissue(given);
      BodyDefinition floor_of = parameters(0.0, {ground()}, {});
      floor_of.surface.friction = 1.0;
      Body floor(floor_of);
      scene.world.add(floor);
      add(scene.world, tissue);
      scene.step(300);
      const double before = tissue.centre().position.x, speed = tissue.momentum().x / tissue.mass();
      scene.step(200);
      const double gained = (tissue.momentum().x / tissue.mass() - speed) / 0.2;
      if (by < 1.0) {
        EXPECT_LT(std::abs(tissue.centre().position.x - before), 2e-5) << friction;
      } else {
        EXPECT_NEAR(gained / (kG * (std::sin(slope) - friction * std::cos(slope))), 1.0, 0.1) << friction;
      }
      remove(scene.world, tissue);
    }
}

TEST(Tissue, ThrownAtABodyItKeepsTheMomentumOfBoth) {
  expect_keeps_the_momentum_of_both(tissue_of(ball(0.015), 0.006, 1e4), 0.05, 200);
}

// Half of a column ten times stiffer: ten times less strain. And what hangs on a body pulls it.
TEST(Tissue, RegionsAreStifferAndHangOnBodies) {
  const double length = 0.08;
  TissueDefinition given = tissue_of(block({0.01, 0.01, length}), 0.005, 2e4, 0.3);
  for (TissueElement& e : given.grid.elements) {
    double middle = 0.0;
    for (const std::uint32_t corner : e.corner) middle += 0.25 * given.grid.corners[corner].z;
    if (middle > 0.5 * length) e.stiffness = 10.0;
  }
  std::vector<std::uint32_t> top;
  for (std::uint32_t i = 0; i < given.grid.corners.size(); ++i)
    if (given.grid.corners[i].z > length - 1e-9) top.push_back(i);
  given.attached = {top};
  Scene scene({0, 0, 0});
  Tissue tissue(given);
  BodyDefinition holder_of = parameters(0.2, {box(0.03, 0.03, 0.01)}, {0.005, 0.005, length + 0.02});
  holder_of.surface.linear_damping = holder_of.surface.angular_damping = 0.0;
  Body holder(holder_of);
  scene.world.add(holder);
  add(scene.world, tissue);
  tissue.attach(0, &holder);
  const std::vector<Vec3> rest = nodes(tissue);
  const auto at = [&](double z) {
    return mean_z(tissue, rest, [&](const Vec3& p) { return std::abs(p.z - z) < 1e-6; });
  };
  const double pull = 0.01;
  const auto pulled = std::count_if(rest.begin(), rest.end(), [](const Vec3& p) { return p.z < 1e-9; });
  for (int i = 0; i < 1500; ++i) {
    for (std::uint32_t node = 0; node < rest.size(); ++node)
      if (rest[node].z < 1e-9) tissue.apply_force(node, {0, 0, -pull / static_cast<double>(pulled)});
    holder.apply_wrench({{0, 0, pull}, {}});
    scene.step(1);
  }
  const double soft = 1.0 - (at(0.03) - at(0.01)) / 0.02, stiff = 1.0 - (at(0.07) - at(0.05)) / 0.02;
  EXPECT_NEAR(-soft, pull / (2e4 * 1e-4), 0.15 * pull / (2e4 * 1e-4));
  EXPECT_NEAR(soft / stiff, 10.0, 1.5);
  EXPECT_NEAR(tissue.force_on(holder).z, -pull, 0.02 * pull);
  EXPECT_LT(math::norm(tissue.momentum() + holder.twist().linear * holder.mass()), 1e-6);
  scene.world.remove(holder);
  scene.step(10);
  EXPECT_EQ(tissue.force_on(holder).z, 0.0);
  remove(scene.world, tissue);
}

// The force of a held strain falls to its share, within its time.
TEST(Tissue, StressRelaxes) {
  const double length = 0.03;
  TissueDefinition given = tissue_of(block({0.01, 0.01, length}), 0.005, 2e4, 0.3);
  given.material.share = 0.4;
  given.material.time = 0.5;
  std::vector<std::uint32_t> top;
  for (std::uint32_t i = 0; i < given.grid.corners.size(); ++i)
    if (given.grid.corners[i].z > length - 1e-9) top.push_back(i);
  given.attached = {top};
  fix(given, [](const Vec3& at) { return at.z < 1e-9; });
  Scene scene({0, 0, 0});
  Tissue tissue(given);
  Body holder(parameters(0.0, {box(0.03, 0.03, 0.01)}, {0.005, 0.005, length + 0.02}));
  scene.world.add(holder);
  add(scene.world, tissue);
  tissue.attach(0, &holder);
  for (int i = 1; i <= 10; ++i) {
    holder.move_to({{0.005, 0.005, length + 0.02 + 0.0002 * i}, {}});
    scene.step(1);
  }
  const auto mean_force = [&] {  // over 20 ms, in which it trembles several times
    double sum = 0.0;
    for (int i = 0; i < 20; ++i) scene.step(1), sum -= tissue.force_on(holder).z / 20;
    return sum;
  };
  scene.step(40);
  const double at_once = mean_force();
  scene.step(480);
  const double later = mean_force();
  scene.step(4000);
  const double at_last = mean_force();
  EXPECT_NEAR(at_last / at_once, 0.4 / (0.4 + 0.6 * std::exp(-0.055 / 0.5)), 0.02);
  EXPECT_NEAR((later - at_last) / (at_once - at_last), std::exp(-1.0), 0.05);
  remove(scene.world, tissue);
}

TEST(Tissue, ContinuesBitForBitFromItsState) {
  TissueDefinition given = tissue_of(ball(0.015), 0.006, 1e4);
  given.material.share = 0.5;
  given.T_world_body.position.z = 0.02;
  Scene scene;
  Tissue tissue(given);
  Body floor(parameters(0.0, {ground()}, {}));
  scene.world.add(floor);
  add(scene.world, tissue);
  testing::expect_goes_on_from_its_state(scene, tissue, 100, 100, given.T_world_body.position, 1e-6);
  remove(scene.world, tissue);
}

// Crushed flat by a plate, it comes back; thrown out of bounds, it is frozen and named.
TEST(Tissue, RecoversFromBeingCrushed) {
  const double side = 0.02;
  Scene scene({0, 0, 0});
  TissueDefinition given = tissue_of(block({side, side, side}), 0.005, 1e4);
  Tissue tissue(given);
  Body floor(parameters(0.0, {ground()}, {}));
  Body plate(parameters(0.0, {box(0.2, 0.2, 0.02)}, {0.01, 0.01, side + 0.012}));
  scene.world.add(floor);
  scene.world.add(plate);
  add(scene.world, tissue);
  for (int i = 0; i <= 200; ++i) {
    plate.move_to({{0.01, 0.01, side + 0.012 - 0.95 * side * i / 200.0}, {}});
    scene.step(1);
  }
  scene.step(100);
  EXPECT_FALSE(tissue.divergence());
  plate.move_to({{0.01, 0.01, 0.3}, {}});
  scene.step(1500);
  EXPECT_NEAR(tissue.volume() / (side * side * side), 1.0, 0.01);
  std::vector<double> state;
  tissue.get_state(state);
  state[3] = 1e9;
  tissue.set_state(state);
  const auto frozen = freeze_diverged_soft_bodies(scene.world);
  ASSERT_EQ(frozen.size(), 1U);
  EXPECT_EQ(frozen[0].body, &tissue);
  EXPECT_TRUE(tissue.frozen());
  scene.step(10);
  tissue.reset();
  EXPECT_FALSE(tissue.frozen());
  remove(scene.world, tissue);
}

}  // namespace
}  // namespace ambf::physics
