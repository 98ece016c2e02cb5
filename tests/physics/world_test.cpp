// One step, forces, filters, rays, contacts, divergence.
#include <gtest/gtest.h>

#include <limits>

#include "tests/physics/fixtures.h"

namespace ambf::physics {
namespace {

using namespace testing;

TEST(World, AForceActsForOneStep) {
  WorldOptions options;
  options.gravity = {};
  World world(options);
  Body body(mass_only(2.0, {1, 1, 1}));
  world.add(body);
  for (int i = 0; i < 1000; ++i) {
    if (i % 2 == 0) body.apply_force({1, 0, 0}, {0, 0.5, 0});
    world.step();
  }
  EXPECT_EQ(world.steps(), 1000u);
  EXPECT_NEAR(body.twist().linear.x, 500 * 0.001 / 2.0, 1e-9);
  EXPECT_NEAR(body.twist().angular.z, -0.25, 2e-3);
  EXPECT_EQ(body.applied_wrench().force, (math::Vec3{}));
}

TEST(World, FreeFallIsExact) {
  World world;
  BodyDefinition own = mass_only(1.0, {1, 1, 1}), heavy = mass_only(1.0, {1, 1, 1});
  own.gravity = math::Vec3{1.0, 0, 0};
  own.T_world_body.position = {5, 0, 0};
  Body a(heavy), b(own);
  world.add(a);
  world.add(b);
  run(world, 1.0);
  EXPECT_NEAR(a.pose().position.z, -0.5 * 9.8, 1e-9);
  EXPECT_NEAR(b.pose().position.x, 5.5, 1e-9);
  EXPECT_NEAR(b.pose().position.z, 0.0, 1e-12);
}

// Their boxes around them overlap, and so Bullet keeps a manifold for them, without a contact.
TEST(World, ForcesActOnceOnBodiesThatAreNear) {
  for (const SolverKind solver : {SolverKind::direct, SolverKind::si, SolverKind::mlcp}) {
    SCOPED_TRACE(name_of(solver));
    WorldOptions options;
    options.solver = solver;
    World world(options);
    std::vector<std::unique_ptr<Body>> bars;
    for (const double x : {0.0, 0.5, 1.0}) {
      BodyDefinition bar = parameters(1.0, {box(1.0, 0.02, 0.02)}, {x, 0, 0});
      bar.T_world_body.orientation = math::exp({0, 0, kPi / 4});
      bar.surface.linear_damping = 0.0;
      bars.push_back(std::make_unique<Body>(bar));
      world.add(*bars.back());
    }
    run(world, 0.1);
    for (const auto& bar : bars) EXPECT_NEAR(bar->pose().position.z, -0.5 * 9.8 * 0.01, 1e-3);
  }
}

TEST(World, DampingLosesItsShareASecond) {
  WorldOptions options;
  options.gravity = {};
  World world(options);
  BodyDefinition p = mass_only(1.0, {1, 1, 1});
  p.surface.linear_damping = 0.3;
  p.surface.angular_damping = 0.6;
  Body body(p);
  world.add(body);
  body.set_twist({{1, 0, 0}, {0, 0, 1}});
  run(world, 1.0);
  EXPECT_NEAR(body.twist().linear.x, 0.7, 1e-9);
  EXPECT_NEAR(body.twist().angular.z, 0.4, 1e-9);
}

TEST(World, ImpulseOffCentreTurnsAndMoves) {
  WorldOptions options;
  options.gravity = {};
  World world(options);
  Body body(mass_only(2.0, {0.5, 0.5, 0.5}));
  world.add(body);
  body.apply_impulse({0, 1, 0}, {0.3, 0, 0});
  EXPECT_NEAR(body.twist().linear.y, 0.5, 1e-12);
  EXPECT_NEAR(body.twist().angular.z, 0.6, 1e-12);
  EXPECT_NEAR(body.velocity_at({0.3, 0, 0}).y, 0.5 + 0.18, 1e-12);
}

TEST(World, RestingBoxDoesNotCreep) {
  for (const SolverKind solver : {SolverKind::direct, SolverKind::si}) {
    WorldOptions options;
    options.solver = solver;
    options.sleeping = false;
    World world(options);
    Body floor(parameters(0.0, {ground()}, {})), cube(parameters(1.0, {box(0.1, 0.1, 0.1)}, {0, 0, 0.051}));
    world.add(floor);
    world.add(cube);
    run(world, 2.0);
    const math::Vec3 settled = cube.pose().position;
    EXPECT_NEAR(settled.z, 0.05, 1e-4);
    run(world, 20.0);
    EXPECT_LT(math::norm(cube.pose().position - settled), 5e-6);
  }
}

TEST(World, ContactsCarryTheWeight) {
  World world;
  Body floor(parameters(0.0, {ground()}, {})), cube(parameters(1.0, {box(0.1, 0.1, 0.1)}, {0, 0, 0.05}));
  world.add(floor);
  world.add(cube);
  run(world, 0.5);
  std::vector<Contact> contacts(2);
  const std::size_t count = world.contacts(contacts);
  ASSERT_EQ(count, 4u);  // more than fit
  contacts.resize(count);
  world.contacts(contacts);
  double impulse = 0.0;
  for (const Contact& contact : contacts) {
    const bool a_is_cube = contact.body_a == &cube;
    EXPECT_EQ(a_is_cube ? contact.body_b : contact.body_a, &floor);
    EXPECT_NEAR((a_is_cube ? 1.0 : -1.0) * contact.normal_on_b.z, 1.0, 1e-6);
    EXPECT_NEAR(contact.point_on_a.z, 0.0, 1e-3);
    EXPECT_LT(std::abs(contact.distance), 1e-3);
    impulse += contact.normal_impulse;
  }
  EXPECT_NEAR(impulse, 9.8e-3, 1e-5);
}

bool fall_through(World& world, Body& body) {
  run(world, 0.6);
  return body.pose().position.z < -0.3;
}

TEST(CollisionFilter, GroupsCollideWhereTheyShareOneOrOneHasNone) {
  struct Case {
    std::vector<int> floor, cube;
    bool collide;
  };
  for (const Case& c : {Case{{}, {}, true}, Case{{1}, {}, true}, Case{{}, {7}, true}, Case{{1, 5}, {9, 5}, true},
                        Case{{1, 2}, {3}, false}}) {
    World world;
    BodyDefinition floor = parameters(0.0, {box(1, 1, 0.1)}, {}), cube = parameters(1.0, {sphere(0.05)}, {0, 0, 0.2});
    floor.collision_groups = c.floor;
    cube.collision_groups = c.cube;
    Body a(floor), b(cube);
    world.add(a);
    world.add(b);
    EXPECT_EQ(fall_through(world, b), !c.collide);
  }
}

TEST(CollisionFilter, BodiesOfOneSetDoNotCollide) {
  for (const std::uint32_t set : {0u, 3u, 4u}) {
    World world;
    BodyDefinition floor = parameters(0.0, {box(1, 1, 0.1)}, {}), cube = parameters(1.0, {sphere(0.05)}, {0, 0, 0.2});
    floor.no_collision_set = 3;
    cube.no_collision_set = set;
    Body a(floor), b(cube);
    world.add(a);
    world.add(b);
    EXPECT_EQ(fall_through(world, b), set == 3);
  }
}

TEST(CollisionFilter, JointedBodiesCollideAgainWhenTheJointIsGone) {
  World world;
  Body floor(parameters(0.0, {box(1, 1, 0.1)}, {})), cube(parameters(1.0, {sphere(0.05)}, {0, 0, 0.0}));
  scene::Joint description;
  description.type = state::JointType::prismatic;
  description.limits = std::array<double, 2>{-0.02, 0.3};
  {
    Joint joint(description, floor, cube);
    world.add(floor);
    world.add(cube);
    world.add(joint);
    run(world, 0.5);
    EXPECT_NEAR(cube.pose().position.z, -0.02, 1e-3);  // inside the floor, at its limit
    cube.set_pose({{0, 0, 0.2}, {}});
    cube.set_twist({});
    world.remove(joint);
  }
  run(world, 1.0);
  EXPECT_NEAR(cube.pose().position.z, 0.1, 2e-3);

  description.ignore_inter_collision = false;
  Joint joint(description, floor, cube);
  world.add(joint);
  run(world, 0.5);
  EXPECT_NEAR(cube.pose().position.z, 0.1, 2e-3);
  world.remove(joint);
}

TEST(Ray, FindsTheNearestThatTheFilterAllows) {
  World world;
  Body floor(parameters(0.0, {ground()}, {})), low(parameters(1.0, {box(0.2, 0.2, 0.2)}, {0, 0, 0.5})),
      high(parameters(1.0, {sphere(0.1)}, {0, 0, 1.0}));
  world.add(floor);
  world.add(low);
  world.add(high);
  const math::Vec3 from{0, 0, 2}, to{0, 0, -2};
  auto hit = world.ray_cast(from, to);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->body, &high);
  EXPECT_NEAR(hit->point.z, 1.1, 1e-6);
  EXPECT_NEAR(hit->normal.z, 1.0, 1e-6);
  EXPECT_NEAR(hit->fraction, 0.9 / 4.0, 1e-6);
  RayFilter filter;
  filter.ignored = &high;
  hit = world.ray_cast(from, to, filter);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->body, &low);
  EXPECT_NEAR(hit->point.z, 0.6, 1e-6);
  const std::array<const Body*, 1> also{&low};
  filter.also_ignored = also;
  hit = world.ray_cast(from, to, filter);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->body, &floor);
  filter.hit_static = false;
  EXPECT_FALSE(world.ray_cast(from, to, filter));
  EXPECT_FALSE(world.ray_cast({5, 5, 2}, {5, 5, 1}));
  // A teleported body is found at once.
  high.set_pose({{5, 5, 1.5}, {}});
  ASSERT_TRUE(world.ray_cast({5, 5, 2}, {5, 5, 1}));
}

TEST(Ray, StartingInsideHitsAtOnceWhereAsked) {
  World world;
  Body floor(parameters(0.0, {ground()}, {})), solid(parameters(1.0, {box(0.2, 0.2, 0.2)}, {0, 0, 0.5})),
      pair(parameters(1.0, {sphere(0.1, {{1, 0, 0}, {}}), sphere(0.1, {{2, 0, 0}, {}})}, {0, 0, 1.0}));
  for (Body* body : {&floor, &solid, &pair}) world.add(*body);
  const math::Vec3 inside{0.05, 0, 0.55}, outside{0.05, 0, 3.0};
  EXPECT_FALSE(world.ray_cast(inside, outside));
  RayFilter filter;
  filter.hit_from_inside = true;
  const auto hit = world.ray_cast(inside, outside, filter);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->body, &solid);
  EXPECT_EQ(hit->fraction, 0.0);
  EXPECT_EQ(hit->point, inside);
  EXPECT_NEAR(hit->normal.z, -1.0, 1e-12);
  ASSERT_TRUE(world.ray_cast({2.0, 0, 1.05}, outside, filter));  // the second ball of a compound
  EXPECT_EQ(world.ray_cast({2.0, 0, 1.05}, outside, filter)->body, &pair);
  EXPECT_FALSE(world.ray_cast({1.5, 0, 1.0}, outside, filter));  // between the balls
  EXPECT_EQ(world.ray_cast({5, 5, -0.1}, outside, filter)->body, &floor);
  filter.ignored = &solid;
  EXPECT_FALSE(world.ray_cast(inside, outside, filter));
}

TEST(Divergence, NamesTheBodyInTheStepItHappens) {
  World world;
  Body good(mass_only(1.0, {1, 1, 1})), bad(mass_only(1.0, {1, 1, 1}, {{2, 0, 0}, {}}));
  world.add(good);
  world.add(bad);
  world.step();
  EXPECT_EQ(world.first_diverged(), nullptr);
  bad.set_twist({{2e4, 0, 0}, {}});
  EXPECT_EQ(world.first_diverged(), &bad);
  EXPECT_EQ(world.first_diverged({1e5, 1e5}), nullptr);
  bad.set_twist({{std::numeric_limits<double>::quiet_NaN(), 0, 0}, {}});
  EXPECT_EQ(world.first_diverged(), &bad);
  bad.set_twist({});
  bad.set_pose({{std::numeric_limits<double>::infinity(), 0, 0}, {}});
  EXPECT_EQ(world.first_diverged(), &bad);
}

TEST(World, BodiesAndJointsComeAndGo) {
  World world;
  Body floor(parameters(0.0, {ground()}, {}));
  world.add(floor);
  for (int round = 0; round < 20; ++round) {
    Body a(parameters(1.0, {box(0.1, 0.1, 0.1)}, {0, 0, 0.06})), b(parameters(1.0, {box(0.1, 0.1, 0.1)}, {0, 0, 0.3}));
    scene::Joint description;
    description.child_pivot = {0, 0, -0.24};
    Joint joint(description, a, b);
    world.add(a);
    world.add(b);
    world.add(joint);
    run(world, 0.05);
    EXPECT_LT(joint.gap().position, 1e-4);
    world.remove(joint);
    world.remove(a);
    world.step();
    world.remove(b);
  }
  EXPECT_EQ(world.body_count(), 1u);
  EXPECT_EQ(world.joint_count(), 0u);
  EXPECT_EQ(world.contacts({}), 0u);
}

TEST(World, ResetGoesBackToTheBeginning) {
  World world;
  Body floor(parameters(0.0, {ground()}, {})), cube(parameters(1.0, {box(0.1, 0.1, 0.1)}, {0, 0, 0.5}));
  world.add(floor);
  world.add(cube);
  std::vector<math::Pose> first, second;
  for (std::vector<math::Pose>* run_poses : {&first, &second}) {
    for (int i = 0; i < 800; ++i) {
      world.step();
      run_poses->push_back(cube.pose());
    }
    world.reset();
    EXPECT_EQ(world.steps(), 0u);
    EXPECT_EQ(cube.pose().position, (math::Vec3{0, 0, 0.5}));
  }
  EXPECT_EQ(first, second);
}

TEST(World, SteadyStateAllocatesNothingInBullet) {
  for (const SolverKind solver : {SolverKind::direct, SolverKind::si}) {
    WorldOptions options;
    options.solver = solver;
    options.sleeping = false;
    World world(options);
    Body floor(parameters(0.0, {ground()}, {}));
    world.add(floor);
    std::vector<std::unique_ptr<Body>> cubes;
    for (int i = 0; i < 20; ++i) {
      cubes.push_back(std::make_unique<Body>(parameters(1.0, {box(0.1, 0.1, 0.1)}, {0.2 * i, 0, 0.06})));
      world.add(*cubes.back());
    }
    run(world, 1.0);
    const std::uint64_t before = bullet_allocation_count();
    run(world, 1.0);
    EXPECT_EQ(bullet_allocation_count(), before);
  }
}

}  // namespace
}  // namespace ambf::physics
