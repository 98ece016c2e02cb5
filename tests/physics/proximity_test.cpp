// Distances between bodies by their shapes alone.
#include <gtest/gtest.h>

#include "physics/proximity.h"
#include "tests/physics/fixtures.h"
#include "tests/physics/meshes.h"

namespace ambf::physics {
namespace {

using testing::box;
using testing::ground;
using testing::parameters;
using testing::sphere;

TEST(Proximity, OfTwoBallsIsThatOfTheirCentresLessTheirRadii) {
  testing::Random random(1);
  const Body still(parameters(0.0, {sphere(0.03)}, {}));
  for (int i = 0; i < 200; ++i) {
    const math::Vec3 at = random.unit() * random(0.01, 0.2);
    const Body other(parameters(1.0, {sphere(0.05)}, at));
    const auto found = proximity(other, still, 1.0);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->distance, math::norm(at) - 0.08, 1e-9);
    EXPECT_NEAR(math::norm(found->normal_on_b - math::normalized(at)), 0.0, 1e-6);
    EXPECT_NEAR(math::norm(found->point_on_b - math::normalized(at) * 0.03), 0.0, 1e-6);
    EXPECT_EQ(overlap(still, other), math::norm(at) < 0.08);
  }
}

TEST(Proximity, EndsAtItsLimit) {
  const Body a(parameters(0.0, {box(0.1, 0.1, 0.1)}, {})), b(parameters(1.0, {box(0.1, 0.1, 0.1)}, {0.12, 0, 0}));
  EXPECT_FALSE(proximity(a, b, 0.0));
  EXPECT_FALSE(proximity(a, b, 0.0199));
  ASSERT_TRUE(proximity(a, b, 0.0201));
  EXPECT_NEAR(proximity(a, b, 0.0201)->distance, 0.02, 1e-9);
}

TEST(Proximity, IsTheDeepestOfAllParts) {
  const Body a(parameters(0.0, {sphere(0.05, {{0, 0, 0}, {}}), sphere(0.05, {{0.2, 0, 0}, {}})}, {}));
  const Body b(parameters(1.0, {box(1.0, 0.1, 0.1, {{0.1, 0.09, 0}, {}}), sphere(0.02, {{0.2, -0.06, 0}, {}})}, {}));
  const auto found = proximity(b, a, 0.0);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->distance, -0.01, 1e-6);
  EXPECT_TRUE(overlap(a, b));
}

TEST(Proximity, KnowsPlanesFromBothSides) {
  const Body floor(parameters(0.0, {ground(0.5)}, {}));
  const Body cube(parameters(1.0, {box(0.1, 0.1, 0.1)}, {3, 4, 0.57}));
  EXPECT_NEAR(proximity(cube, floor, 0.1)->distance, 0.02, 1e-12);
  EXPECT_EQ(proximity(cube, floor, 0.1)->normal_on_b, (math::Vec3{0, 0, 1}));
  EXPECT_EQ(proximity(floor, cube, 0.1)->normal_on_b, (math::Vec3{0, 0, -1}));
  EXPECT_FALSE(overlap(floor, cube));
  EXPECT_FALSE(proximity(floor, floor, 1.0)) << "planes have no distance";
}

TEST(Proximity, OfMeshesIsThatOfTheirTriangles) {
  for (const bool moving : {false, true}) {
    BodyDefinition definition = parameters(moving ? 1.0 : 0.0, {}, {});
    ShapeOptions options;
    options.moving = moving;
    options.margin = 0.0;
    definition.shape = testing::box_mesh({0.1, 0.1, 0.1}).shape(options);
    const Body mesh(definition);
    const auto ball_at = [](double x) { return parameters(1.0, {sphere(0.02)}, {x, 0.013, 0.007}); };
    EXPECT_NEAR(proximity(Body(ball_at(0.08)), mesh, 0.1)->distance, 0.01, 1e-9);
    EXPECT_TRUE(overlap(Body(ball_at(0.069)), mesh));
    EXPECT_FALSE(overlap(Body(ball_at(0.071)), mesh));
    EXPECT_FALSE(overlap(Body(ball_at(0.0)), mesh)) << "a surface has no inside";
    definition.T_world_body.position = {0.1005, 0, 0};
    EXPECT_FALSE(overlap(Body(definition), mesh));
    definition.T_world_body.position = {0.0995, 0.01, 0.02};
    EXPECT_TRUE(overlap(Body(definition), mesh));
  }
}

TEST(Proximity, LeavesNothingBehind) {
  World world;
  Body a(parameters(0.0, {box(0.1, 0.1, 0.1)}, {})), b(parameters(0.0, {box(0.1, 0.1, 0.1)}, {0.05, 0, 0}));
  world.add(a);
  world.add(b);
  EXPECT_TRUE(overlap(a, b)) << "static bodies, too";
  std::array<Contact, 4> contacts;
  EXPECT_EQ(world.contacts(contacts), 0u);
}

TEST(Proximity, GroupsLetMeetWhatSharesOneOrHasNone) {
  const auto in = [](std::vector<int> groups) {
    BodyDefinition definition = parameters(1.0, {sphere(0.1)}, {});
    definition.collision_groups = std::move(groups);
    return definition;
  };
  EXPECT_TRUE(groups_meet(Body(in({})), Body(in({3}))));
  EXPECT_TRUE(groups_meet(Body(in({5, 3})), Body(in({3}))));
  EXPECT_FALSE(groups_meet(Body(in({5, 3})), Body(in({4}))));
}

}  // namespace
}  // namespace ambf::physics
