// Heavy bodies on light ones.
#include <gtest/gtest.h>

#include "fixtures.h"

namespace ambf::physics::testing {
namespace {

TEST(HeavyLoad, StaysOnABoxOfATenThousandthOfItsMass) {
  for (const double mass : {1000.0, 10000.0}) {
    World world;
    Body floor(parameters(0.0, {ground()}, {}));
    Body small(parameters(1.0, {box(0.1, 0.1, 0.1)}, {0, 0, 0.05}));
    Body load(parameters(mass, {box(0.5, 0.5, 0.5)}, {0, 0, 0.35}));
    for (Body* body : {&floor, &small, &load}) world.add(*body);
    run(world, 3.0);
    const math::Vec3 at = load.pose().position;
    EXPECT_LT(std::hypot(at.x, at.y), 0.03) << mass;
    EXPECT_NEAR(at.z, 0.35, 0.005) << mass;
    EXPECT_LT(math::norm(small.pose().position - math::Vec3{0, 0, 0.05}), 0.01) << mass;
    for (Body* body : {&load, &small, &floor}) world.remove(*body);
  }
}

}  // namespace
}  // namespace ambf::physics::testing
