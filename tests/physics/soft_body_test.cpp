// Soft bodies against Bullet's own world of them, set up by the recipe of AMBF 2.0 in bare_soft_world.cpp.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "physics/joint.h"
#include "physics/soft_body.h"
#include "tests/physics/bare_soft_world.h"
#include "tests/physics/fixtures.h"
#include "tests/physics/soft_sheet.h"

namespace ambf::physics {
namespace {

using testing::BareSoftWorld;
using testing::box;
using testing::ground;
using testing::parameters;
using testing::sheet;
using testing::sphere;

// A ball of rings, with two lines across.
SoftDefinition ball(std::uint32_t rings, std::uint32_t around, double radius) {
  SoftDefinition made;
  made.nodes.push_back({0, 0, -radius});
  for (std::uint32_t r = 1; r < rings; ++r)
    for (std::uint32_t k = 0; k < around; ++k) {
      const double polar = std::numbers::pi * r / rings, turn = 2.0 * std::numbers::pi * k / around;
      made.nodes.push_back({radius * std::sin(polar) * std::cos(turn), radius * std::sin(polar) * std::sin(turn),
                            -radius * std::cos(polar)});
    }
  made.nodes.push_back({0, 0, radius});
  const auto last = static_cast<std::uint32_t>(made.nodes.size() - 1);
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
  made.lines = {{0, last}, {1, 1 + around / 2}};
  return made;
}

struct Scene {
  explicit Scene(const WorldOptions& options = {}) : world(options) {}
  void step(int steps) {
    for (int i = 0; i < steps; ++i) world.step();
  }
  World world;
};

double max_distance(const SoftBody& ours, const BareSoftWorld& bare) {
  double largest = 0.0;
  for (std::size_t i = 0; i < ours.node_count(); ++i)
    largest = std::max(largest, math::norm(ours.position(i) - bare.position(i)));
  return largest;
}

std::vector<math::Vec3> positions(const SoftBody& body) {
  std::vector<math::Vec3> all;
  for (std::size_t i = 0; i < body.node_count(); ++i) all.push_back(body.position(i));
  return all;
}

// The settings of the compat cloth.
SoftDefinition compat_cloth() {
  SoftDefinition cloth = sheet(12, 0.5);
  cloth.config.kLST = 0.005;
  cloth.config.kDP = 0.001;
  cloth.config.piterations = 6;
  cloth.config.bending_distance = 2;
  cloth.config.flags = 16;
  cloth.randomize_constraints = true;
  cloth.fixed = {0};
  cloth.T_world_body = {{0, 0.2, 0.1}, {}};
  cloth.margin = 0.05;
  return cloth;
}

void expect_node_for_node(const SoftDefinition& definition, const char* what) {
  Scene scene;
  SoftBody ours(definition);
  add(scene.world, ours);
  BareSoftWorld bare(definition);
  double largest = 0.0;
  for (int i = 0; i < 50; ++i) {
    scene.step(100);
    for (int k = 0; k < 100; ++k) bare.step();
    largest = std::max(largest, max_distance(ours, bare));
  }
  EXPECT_LT(largest, 1e-9) << what;
  EXPECT_GT(math::norm(ours.position(ours.node_count() / 2) - definition.T_world_body.position), 0.01) << what;
  remove(scene.world, ours);
}

TEST(SoftBody, MovesNodeForNodeAsInBulletsWorld) {
  expect_node_for_node(compat_cloth(), "the compat cloth");
  SoftDefinition bending = sheet(10, 0.3);
  bending.config.bending_distance = 3;
  bending.config.kDP = 0.01;
  bending.config.viterations = 1;
  bending.fixed = {0, 9};
  expect_node_for_node(bending, "a sheet with bending links");
  SoftDefinition tied = ball(6, 10, 0.1);
  tied.config.kMT = 0.05;
  tied.config.kPR = 1.0;
  tied.config.kDP = 0.02;
  tied.mass = 0.3;
  tied.fixed = {0};
  expect_node_for_node(tied, "a ball with lines");
}

TEST(SoftBody, RestsOnABoxAsInBulletsWorld) {
  SoftDefinition cloth = sheet(9, 0.4);
  cloth.config.kDP = 0.05;
  cloth.config.piterations = 4;
  cloth.config.bending_distance = 2;
  cloth.config.kKHR = 1.0;
  cloth.margin = 0.01;
  cloth.T_world_body = {{-0.2, -0.2, 0.3}, {}};
  Scene scene;
  Body table(parameters(0.0, {box(1.0, 1.0, 0.5)}, {0, 0, 0}));
  scene.world.add(table);
  SoftBody ours(cloth);
  add(scene.world, ours);
  BareSoftWorld bare(cloth);
  bare.add_box({0.5, 0.5, 0.25});
  scene.step(1500);
  for (int i = 0; i < 1500; ++i) bare.step();
  EXPECT_LT(max_distance(ours, bare), 0.001);
  for (std::size_t i = 0; i < ours.node_count(); ++i) EXPECT_NEAR(ours.position(i).z, 0.26, 0.001) << i;
  remove(scene.world, ours);
}

TEST(SoftBody, RestsOnEveryKindOfShape) {
  std::vector<math::Vec3> corners{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  const MeshSource square(corners, {{0, 1, 2}, {0, 2, 3}});
  const MeshSource block(
      {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}},
      {{4, 5, 6},
       {4, 6, 7},
       {0, 2, 1},
       {0, 3, 2},
       {0, 1, 5},
       {0, 5, 4},
       {1, 2, 6},
       {1, 6, 5},
       {2, 3, 7},
       {2, 7, 6},
       {3, 0, 4},
       {3, 4, 7}});
  ShapeOptions options;
  options.moving = false;
  std::vector<std::pair<const char*, BodyDefinition>> kinds;
  kinds.emplace_back("a plane", parameters(0.0, {ground(0.0)}, {}));
  kinds.emplace_back("a box", parameters(0.0, {box(2, 2, 0.2)}, {0, 0, -0.1}));
  kinds.emplace_back("a box beside its origin", parameters(0.0, {box(2, 2, 0.2, {{0, 0, -0.1}, {}})}, {}));
  BodyDefinition mesh = parameters(0.0, {}, {});
  mesh.shape = square.shape(scene::CollisionMeshType::triangle_mesh, {}, options);
  kinds.emplace_back("triangles", mesh);
  mesh.shape = block.shape(scene::CollisionMeshType::convex_hull, {}, options);
  kinds.emplace_back("a hull", mesh);
  for (const auto& [what, definition] : kinds) {
    SoftDefinition cloth = sheet(6, 0.1);
    cloth.config.kDP = 0.05;
    cloth.config.kKHR = 1.0;
    cloth.mass = 0.01;
    cloth.T_world_body = {{0.01, 0.02, 0.01}, {}};
    Scene scene;
    Body floor(definition);
    scene.world.add(floor);
    SoftBody ours(cloth);
    add(scene.world, ours);
    scene.step(600);
    for (std::size_t i = 0; i < ours.node_count(); ++i) EXPECT_NEAR(ours.position(i).z, 0.001, 0.0015) << what << i;
    remove(scene.world, ours);
  }
}

// Held at its corners.
TEST(SoftBody, CarriesABall) {
  SoftDefinition cloth = sheet(11, 0.4);
  cloth.config.kDP = 0.02;
  cloth.config.piterations = 8;
  cloth.config.bending_distance = 2;
  cloth.mass = 0.2;
  cloth.fixed = {0, 10, 110, 120};
  cloth.T_world_body = {{-0.2, -0.2, 0.0}, {}};
  Scene scene;
  Body heavy(parameters(0.1, {sphere(0.05)}, {0, 0, 0.06}));
  scene.world.add(heavy);
  SoftBody ours(cloth);
  add(scene.world, ours);
  scene.step(4000);
  const double rest = heavy.pose().position.z;
  EXPECT_GT(rest, -0.15) << "it does not fall through";
  EXPECT_LT(rest, 0.06) << "the cloth gives way";
  double nearest = 1.0;
  for (const math::Vec3& node : positions(ours))
    nearest = std::min(nearest, math::norm(node - heavy.pose().position) - 0.05);
  EXPECT_GT(nearest, -0.002);
  scene.step(500);
  EXPECT_NEAR(heavy.pose().position.z, rest, 0.001) << "it is at rest";
  remove(scene.world, ours);
}

TEST(SoftBody, ContinuesFromItsStateBitForBit) {
  SoftDefinition cloth = sheet(8, 0.3);
  cloth.config.kDP = 0.01;
  cloth.config.bending_distance = 2;
  cloth.config.flags = 0x11;
  cloth.fixed = {0, 7};
  cloth.T_world_body = {{-0.15, -0.15, 0.2}, {}};
  const auto continued = [&](bool restored) {
    Scene scene;
    Body still(parameters(0.0, {sphere(0.1)}, {0, 0, 0.05})), falling(parameters(0.2, {sphere(0.03)}, {0, 0, 0.4}));
    scene.world.add(still);
    scene.world.add(falling);
    SoftDefinition second = cloth;
    second.T_world_body.position.z = 0.25;
    SoftBody first_cloth(cloth), second_cloth(second);
    add(scene.world, first_cloth);
    add(scene.world, second_cloth);
    scene.step(restored ? 700 : 400);
    static std::vector<double> saved_first, saved_second;
    static std::vector<std::byte> saved_world;
    if (!restored) {
      scene.world.save_state(saved_world);
      first_cloth.get_state(saved_first);
      second_cloth.get_state(saved_second);
    } else {
      EXPECT_TRUE(scene.world.restore_state(saved_world));
      EXPECT_TRUE(first_cloth.set_state(saved_first));
      EXPECT_TRUE(second_cloth.set_state(saved_second));
    }
    scene.step(500);
    std::vector<math::Vec3> all = positions(first_cloth);
    for (const math::Vec3& each : positions(second_cloth)) all.push_back(each);
    all.push_back(falling.pose().position);
    remove(scene.world, first_cloth);
    remove(scene.world, second_cloth);
    return all;
  };
  const auto straight = continued(false);  // it comes first: it saves
  EXPECT_EQ(continued(true), straight);
}

TEST(SoftBody, IsAsNewAfterAReset) {
  SoftDefinition cloth = compat_cloth();
  cloth.config.flags = 0x11;
  Scene scene;
  SoftBody ours(cloth);
  add(scene.world, ours);
  scene.step(200);
  const auto first = positions(ours);
  ours.reset();
  scene.step(200);
  EXPECT_EQ(positions(ours), first);
  remove(scene.world, ours);
}

TEST(SoftBody, TakesForcesAndCarriesItsFixedNodes) {
  WorldOptions weightless;
  weightless.gravity = {};
  Scene scene(weightless);
  SoftDefinition free_sheet = sheet(5, 0.1);
  free_sheet.mass = 0.5;
  SoftBody pushed(free_sheet);
  add(scene.world, pushed);
  for (int i = 0; i < 100; ++i) {
    pushed.apply_wrench({{1.0, 0.0, 0.0}, {}});
    pushed.apply_force(3, {0.0, 0.5, 0.0});
    scene.step(1);
  }
  math::Vec3 momentum;
  for (std::size_t i = 0; i < pushed.node_count(); ++i) momentum += pushed.velocity(i) * (0.5 / 25);
  // Bullet has the length of a step in single precision.
  EXPECT_NEAR(math::norm(momentum - math::Vec3{0.1, 0.05, 0.0}), 0.0, 1e-8);

  SoftDefinition held = sheet(5, 0.1);
  held.fixed = {0, 4};
  SoftBody carried(held);
  add(scene.world, carried);
  for (int i = 1; i <= 100; ++i) {
    carried.carry_fixed({{0.001 * i, 0.0, 0.0}, {}}, 10.0);
    scene.step(1);
  }
  EXPECT_NEAR(carried.position(4).x, 0.2, 1e-12);
  scene.step(10);
  EXPECT_NEAR(carried.position(4).x, 0.2, 1e-12) << "they stay where they were carried";
  carried.carry_fixed({{5.0, 0.0, 0.0}, {}}, 2.0);
  scene.step(1);
  EXPECT_NEAR(carried.position(4).x, 0.202, 1e-9) << "no faster than allowed";
  remove(scene.world, pushed);
  remove(scene.world, carried);
}

TEST(SoftBody, KnowsHowItHasTurned) {
  SoftDefinition flat = sheet(6, 0.2);
  const math::Quat turn = math::normalized(math::Quat{0.3, -0.2, 0.5, 0.7});
  flat.T_world_body = {{1.0, 2.0, 3.0}, turn};
  const SoftBody body(flat);
  const math::Pose centre = body.centre();
  EXPECT_NEAR(std::abs(centre.orientation.x * turn.x + centre.orientation.y * turn.y + centre.orientation.z * turn.z +
                       centre.orientation.w * turn.w),
              1.0, 1e-9);
  EXPECT_NEAR(math::norm(centre.position - flat.T_world_body * math::Vec3{0.1, 0.1, 0.0}), 0.0, 1e-12);
}

TEST(SoftBody, FreezesWhereItsLastGoodStepLeftIt) {
  Scene scene;
  SoftBody ours(compat_cloth());
  add(scene.world, ours);
  scene.step(10);
  EXPECT_FALSE(ours.divergence());
  const auto good = positions(ours);
  ours.apply_force(7, {1e9, 0.0, 0.0});
  scene.step(1);
  const std::vector<SoftDivergence> diverged = freeze_diverged_soft_bodies(scene.world);
  ASSERT_EQ(diverged.size(), 1u);
  EXPECT_EQ(diverged[0].body, &ours);
  EXPECT_EQ(positions(ours), good);
  scene.step(10);
  EXPECT_EQ(positions(ours), good);
  EXPECT_FALSE(ours.divergence());
  ours.reset();
  scene.step(10);
  EXPECT_EQ(positions(ours), good);
  remove(scene.world, ours);
}

}  // namespace
}  // namespace ambf::physics
