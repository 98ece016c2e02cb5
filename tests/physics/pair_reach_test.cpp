// Which bodies come near a plane or a part of a room: what does not is spared all work, what does meets it as ever.
#include "physics/contacts/pair_reach.h"

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>
#include <gtest/gtest.h>

#include "tests/physics/fixtures.h"

namespace ambf::physics {
namespace {

using namespace testing;
using detail::comes_near;

btCollisionObject standing(btCollisionShape& shape, const btTransform& pose) {
  btCollisionObject still;
  still.setCollisionShape(&shape);
  still.setCollisionFlags(btCollisionObject::CF_STATIC_OBJECT);
  still.setWorldTransform(pose);
  return still;
}

TEST(PairReach, APlaneIsNearWhatReachesBelowIt) {
  btStaticPlaneShape shape({1, 0, 0}, 0.5);
  // Turned, so that its normal is y, and moved: everything below y = 2.5.
  btCollisionObject plane = standing(shape, btTransform(btQuaternion(btVector3(0, 0, 1), kPi / 2), {7, 2, 3}));
  EXPECT_FALSE(comes_near(plane, {-1, 2.6, -1}, {1, 3, 1}));
  EXPECT_TRUE(comes_near(plane, {-1, 2.4, -1}, {1, 3, 1}));
  EXPECT_TRUE(comes_near(plane, {-1, -9, -1}, {1, -8, 1}));
  plane.setCollisionFlags(0);
  EXPECT_TRUE(comes_near(plane, {-1, 2.6, -1}, {1, 3, 1})) << "what moves is Bullet's";
}

TEST(PairReach, ARoomIsNearWhatReachesOneOfItsWalls) {
  btBoxShape wall({0.1, 5, 5});
  btCompoundShape walls;
  for (const double x : {-5.0, 5.0}) walls.addChildShape(btTransform(btQuaternion::getIdentity(), {x, 0, 0}), &wall);
  btCollisionObject room = standing(walls, btTransform(btQuaternion(btVector3(0, 0, 1), kPi / 2), {0, 10, 0}));
  EXPECT_FALSE(comes_near(room, {-1, 9, -1}, {1, 11, 1})) << "in the middle";
  EXPECT_TRUE(comes_near(room, {-1, 14, -1}, {1, 14.95, 1}));
  EXPECT_TRUE(comes_near(room, {-1, 5.05, -1}, {1, 6, 1}));
  EXPECT_FALSE(comes_near(room, {6, 14, -1}, {7, 15, 1})) << "beside the wall";
}

TEST(PairReach, ABallStillMeetsFloorAndWall) {
  World world;
  Body floor(parameters(0.0, {ground()}, {}));
  Body room(
      parameters(0.0, {box(0.1, 4.0, 2.0, {{-2.0, 0.0, 1.0}, {}}), box(0.1, 4.0, 2.0, {{2.0, 0.0, 1.0}, {}})}, {}));
  Body ball(parameters(0.1, {sphere(0.05)}, {0.0, 0.0, 0.3}));
  for (Body* body : {&floor, &room, &ball}) world.add(*body);
  ball.set_twist({{4.0, 0.0, 0.0}, {}});
  double farthest = 0.0, lowest = 1.0;
  for (int step = 0; step < 800; ++step) {
    world.step();
    farthest = std::max(farthest, ball.pose().position.x);
    lowest = std::min(lowest, ball.pose().position.z);
  }
  EXPECT_NEAR(farthest, 1.9, 5e-3);
  EXPECT_NEAR(lowest, 0.05, 5e-3);
  for (Body* body : {&ball, &room, &floor}) world.remove(*body);
}

}  // namespace
}  // namespace ambf::physics
