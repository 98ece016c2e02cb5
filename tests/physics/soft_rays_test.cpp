// Rays of bundles meet the faces of soft bodies where they are.
#include <gtest/gtest.h>

#include "physics/rays.h"
#include "physics/soft_body.h"
#include "tests/physics/fixtures.h"
#include "tests/physics/soft_sheet.h"

namespace ambf::physics {
namespace {

using namespace testing;

// A slack sheet that hangs by two corners.
SoftDefinition hanging() {
  SoftDefinition cloth = sheet(9, 0.2);
  cloth.config.kDP = 0.02;
  cloth.fixed = {0, 8};
  cloth.T_world_body = {{-0.1, -0.1, 0.5}, {}};
  return cloth;
}

std::array<math::Vec3, 3> corners(const SoftBody& body, int face) {
  const auto& nodes = body.faces().at(static_cast<std::size_t>(face));
  return {body.position(nodes[0]), body.position(nodes[1]), body.position(nodes[2])};
}

TEST(SoftRays, MeetTheirFaceAtItsExactPointFromBothSides) {
  World world;
  SoftBody cloth(hanging());
  add(world, cloth);
  run(world, 0.05);
  Random random(7);
  RayBundle bundle;
  std::vector<BundleHit> hits(2);
  for (int i = 0; i < 200; ++i) {
    // A random point of a random face, from one side and from the other.
    const int face = static_cast<int>(random(0.0, static_cast<double>(cloth.faces().size()) - 1e-9));
    const auto [a, b, c] = corners(cloth, face);
    const double u = random(0.05, 0.45), v = random(0.05, 0.45);
    const math::Vec3 point = a + (b - a) * u + (c - a) * v;
    const math::Vec3 normal = math::normalized(math::cross(b - a, c - a));
    const math::Vec3 along = math::normalized(normal + random.vector(0.3)) * 0.004;
    const Ray rays[] = {{point - along, point + along}, {point + along, point - along}};
    bundle.forget();  // it takes its rays for the same ones
    bundle.cast(world, {}, rays, {.soft_bodies = true}, hits);
    for (int side = 0; side < 2; ++side) {
      ASSERT_EQ(hits[side].soft, &cloth) << i;
      EXPECT_EQ(hits[side].body, nullptr);
      EXPECT_EQ(hits[side].triangle, face);
      EXPECT_LT(math::norm(hits[side].point - point), 1e-12);
      EXPECT_NEAR(hits[side].fraction, 0.5, 1e-9);
      EXPECT_LT(math::norm(hits[side].normal - normal * (side == 0 ? -1.0 : 1.0)), 1e-12);
    }
  }
  remove(world, cloth);
}

TEST(SoftRays, PassNoEdgeAndNoNode) {
  World world;
  SoftBody cloth(hanging());
  add(world, cloth);
  RayBundle bundle;
  std::vector<BundleHit> hits(1);
  for (std::size_t node = 0; node < cloth.node_count(); ++node) {
    const math::Vec3 at = cloth.position(node);
    const Ray ray{at + math::Vec3{0, 0, 0.01}, at - math::Vec3{0, 0, 0.01}};
    bundle.forget();
    bundle.cast(world, {}, {&ray, 1}, {.soft_bodies = true}, hits);
    EXPECT_EQ(hits[0].soft, &cloth) << node;
  }
  remove(world, cloth);
}

TEST(SoftRays, MeetWhateverIsNearerAndSoftBodiesOnlyIfTheyAreAskedTo) {
  World world;
  Body floor(parameters(0.0, {box(1, 1, 0.1)}, {}));
  world.add(floor);
  SoftBody cloth(hanging());
  add(world, cloth);
  RayBundle above, below, blind;
  std::vector<BundleHit> hits(1);
  const Ray down{{0.01, 0.02, 0.6}, {0.01, 0.02, -0.4}}, under{{0.01, 0.02, 0.4}, {0.01, 0.02, -0.4}};
  above.cast(world, {}, {&down, 1}, {.soft_bodies = true}, hits);
  EXPECT_EQ(hits[0].soft, &cloth);
  EXPECT_NEAR(hits[0].point.z, 0.5, 1e-12);
  below.cast(world, {}, {&under, 1}, {.soft_bodies = true}, hits);
  EXPECT_EQ(hits[0].body, &floor);
  EXPECT_EQ(hits[0].soft, nullptr);
  blind.cast(world, {}, {&down, 1}, {}, hits);
  EXPECT_EQ(hits[0].body, &floor);
  remove(world, cloth);
  above.cast(world, {}, {&down, 1}, {.soft_bodies = true}, hits);
  EXPECT_EQ(hits[0].body, &floor) << "it is gone";
}

TEST(SoftRays, AreCastAnewOnlyWhereNodesOfFacesNearThemMayHaveMoved) {
  World world;
  SoftBody cloth(hanging());
  add(world, cloth);
  RayBundle near, far;
  std::vector<BundleHit> hits(1);
  const Ray at{{0.01, 0.02, 0.6}, {0.01, 0.02, 0.4}}, beside{{1.01, 0.02, 0.6}, {1.01, 0.02, 0.4}};
  EXPECT_EQ(near.cast(world, {}, {&at, 1}, {.soft_bodies = true}, hits), 1U);
  EXPECT_EQ(near.cast(world, {}, {&at, 1}, {.soft_bodies = true}, hits), 0U) << "nothing moved";
  EXPECT_EQ(far.cast(world, {}, {&beside, 1}, {.soft_bodies = true}, hits), 1U);
  world.step();
  EXPECT_EQ(near.cast(world, {}, {&at, 1}, {.soft_bodies = true}, hits), 1U);
  EXPECT_EQ(far.cast(world, {}, {&beside, 1}, {.soft_bodies = true}, hits), 0U) << "nothing is near";
  cloth.reset();
  EXPECT_EQ(near.cast(world, {}, {&at, 1}, {.soft_bodies = true}, hits), 1U) << "put back between two steps";
  remove(world, cloth);
}

}  // namespace
}  // namespace ambf::physics
