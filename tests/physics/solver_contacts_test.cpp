// Contacts under the joint block solver: things rest, stand, are held, bounce and roll as they should.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/physics/mechanisms.h"

namespace ambf::physics::testing {
namespace {

constexpr double kMillimetre = 1e-3;

double distance_moved(const btRigidBody& body, const btVector3& from) {
  return body.getWorldTransform().getOrigin().distance(from);
}

// Slip of the box in the fingers while they lift it by 10 cm and hold it, 3.4 s.
double slip_of(double force, double finger_mass, double box_mass) {
  BulletScene scene;
  Gripper gripper = add_gripper(scene, finger_mass, box_mass);
  close_gripper(gripper, force);
  scene.step(300);
  const auto in_hand = [&] {
    return gripper.fingers[0]->getWorldTransform().inverse() * gripper.box->getWorldTransform().getOrigin();
  };
  const btVector3 grasped = in_hand();
  gripper.lift->setTargetLinMotorVelocity(0.1);
  double slip = 0.0;
  for (int i = 0; i < 3400; ++i) {
    if (i == 1000) gripper.lift->setTargetLinMotorVelocity(0.0);
    scene.step();
    slip = std::max(slip, in_hand().distance(grasped));
  }
  EXPECT_NEAR(gripper.box->getWorldTransform().getOrigin().z(), 0.12, 2e-3) << "was not lifted";
  EXPECT_LT(scene.largest_gap(), 0.001 * kMillimetre);
  return slip;
}

TEST(Grasp, HeldBoxDoesNotSlipWhenLifted) {
  EXPECT_LT(slip_of(5.0, 0.2, 0.1), 0.05 * kMillimetre);
  EXPECT_LT(slip_of(50.0, 0.2, 0.1), 0.25 * kMillimetre);
}

TEST(Grasp, LightFingersHoldAHeavyBox) { EXPECT_LT(slip_of(50.0, 0.02, 1.0), 0.25 * kMillimetre); }

TEST(Grasp, BoxTooHeavyForTheFrictionFalls) {
  BulletScene scene;
  Gripper gripper = add_gripper(scene, 0.2, 2.0);  // 2 x 5 N cannot carry 19.6 N
  close_gripper(gripper, 5.0);
  scene.step(300);
  gripper.lift->setTargetLinMotorVelocity(0.1);
  scene.step(1000);
  EXPECT_LT(gripper.box->getWorldTransform().getOrigin().z(), 0.03);
}

TEST(Resting, BoxDoesNotDrift) {
  BulletScene scene;
  scene.add_ground();
  auto& box = scene.add_box(btVector3(0.05, 0.05, 0.05), 0.5, btVector3(0, 0, 0.05));
  scene.step(500);
  const btVector3 from = box.getWorldTransform().getOrigin();
  scene.step(10000);
  EXPECT_LT(distance_moved(box, from), 0.01 * kMillimetre / 6.0);  // 10 s of the 60 s that the benchmark runs
}

TEST(Resting, BoxStaysOnASlopeBelowItsFrictionAngleAndLeavesASteeperOne) {
  for (const double degrees : {20.0, 35.0}) {
    BulletScene scene;
    const btQuaternion tilt(btVector3(0, 1, 0), degrees * SIMD_RADS_PER_DEG);
    scene.add_box(btVector3(1, 1, 0.05), 0.0, btTransform(tilt, btVector3(0, 0, 0)), true, 1.0);
    auto& box = scene.add_box(btVector3(0.05, 0.05, 0.05), 0.5,
                              btTransform(tilt, quatRotate(tilt, btVector3(-0.5, 0, 0.1))), true, 0.577);
    scene.step(200);
    const btVector3 from = box.getWorldTransform().getOrigin();
    scene.step(1000);
    if (degrees < 30.0) {
      EXPECT_LT(distance_moved(box, from), 0.01 * kMillimetre);
    } else {
      // a = g (sin - mu cos), from the start
      const double a = 9.81 * (std::sin(degrees * SIMD_RADS_PER_DEG) - 0.577 * std::cos(degrees * SIMD_RADS_PER_DEG));
      EXPECT_NEAR(box.getLinearVelocity().length(), a * 1.2, 0.05 * a);
    }
  }
}

TEST(Friction, IsTheSameInEveryDirection) {
  double slowest = 1e9;
  double fastest = 0.0;
  for (int i = 0; i < 12; ++i) {
    BulletScene scene;
    scene.add_ground();
    auto& box = scene.add_box(btVector3(0.05, 0.05, 0.02), 0.5, btVector3(0, 0, 0.02));
    scene.step(100);
    const double angle = SIMD_2_PI * i / 12.0;
    box.setLinearVelocity(btVector3(std::cos(angle), std::sin(angle), 0));
    scene.step(1000);
    const double way = distance_moved(box, btVector3(0, 0, 0.02));
    slowest = std::min(slowest, way);
    fastest = std::max(fastest, way);
  }
  // v^2 / (2 mu g) with mu = 0.5 * 0.5
  EXPECT_NEAR(slowest, 1.0 / (2.0 * 0.25 * 9.81), 0.01);
  EXPECT_LT(fastest - slowest, 0.02 * fastest);
}

TEST(Towers, StandForTenSeconds) {
  for (const int height : {5, 10}) {
    BulletScene scene;
    scene.add_ground();
    add_towers(scene, 2, height);
    scene.step(10000);
    int k = 0;
    for (const auto& body : scene.bodies()) {
      if (body->getInvMass() == 0.0) continue;
      const btVector3 at = body->getWorldTransform().getOrigin();
      EXPECT_NEAR(at.z(), 0.05 + 0.1 * (k % height), 1e-3);
      EXPECT_LT(std::fabs(at.x() - 0.25 * (k / height)), 0.02);
      EXPECT_LT(std::fabs(at.y()), 0.02);
      ++k;
    }
  }
}

TEST(Bounce, RestitutionIsKeptAndDepthAddsNothingToIt) {
  for (const double restitution : {0.0, 0.5, 0.8}) {
    BulletScene scene;
    scene.add_ground().setRestitution(1.0);
    btSphereShape sphere(0.05);
    btRigidBody ball(0.5, nullptr, &sphere, btVector3(5e-4, 5e-4, 5e-4));
    ball.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, 0, 0.55)));
    ball.setActivationState(DISABLE_DEACTIVATION);
    ball.setRestitution(restitution);
    scene.world().addRigidBody(&ball);
    double impact = 0.0;
    double rebound = 0.0;
    for (int i = 0; i < 500; ++i) {
      scene.step();
      impact = std::min(impact, ball.getLinearVelocity().z());
      rebound = std::max(rebound, ball.getLinearVelocity().z());
    }
    EXPECT_NEAR(impact, -std::sqrt(2.0 * 9.81 * 0.5), 0.05);
    EXPECT_NEAR(rebound, -restitution * impact, 0.1);
    scene.world().removeRigidBody(&ball);
  }
}

TEST(Rolling, RollingFrictionStopsABallThatWouldRollOn) {
  double way[2] = {};
  for (const int with : {0, 1}) {
    BulletScene scene;
    btRigidBody& ground = scene.add_ground();
    btSphereShape sphere(0.05);
    btVector3 inertia;
    sphere.calculateLocalInertia(0.5, inertia);
    btRigidBody ball(0.5, nullptr, &sphere, inertia);
    ball.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, 0, 0.05)));
    ball.setActivationState(DISABLE_DEACTIVATION);
    for (btRigidBody* body : {&ground, &ball}) {
      body->setRollingFriction(with ? 0.1 : 0.0);
      body->setSpinningFriction(with ? 0.1 : 0.0);
      body->setFriction(1.0);
    }
    scene.world().addRigidBody(&ball);
    ball.setLinearVelocity(btVector3(0.5, 0, 0));
    ball.setAngularVelocity(btVector3(0, 10.0, 0));
    scene.step(2000);
    way[with] = ball.getWorldTransform().getOrigin().x();
    scene.world().removeRigidBody(&ball);
  }
  EXPECT_NEAR(way[0], 1.0, 0.02);
  EXPECT_LT(way[1], 0.5);
}

TEST(SplitImpulse, DeepPenetrationIsResolvedWithoutThrowingTheBox) {
  BulletScene scene;
  scene.world().getSolverInfo().m_splitImpulsePenetrationThreshold = -0.001;
  scene.add_ground();
  auto& box = scene.add_box(btVector3(0.05, 0.05, 0.05), 0.5, btVector3(0, 0, 0.02));  // 3 cm deep
  double fastest = 0.0;
  for (int i = 0; i < 1000; ++i) {
    scene.step();
    fastest = std::max(fastest, box.getLinearVelocity().z());
  }
  EXPECT_GT(box.getWorldTransform().getOrigin().z(), 0.045);
  EXPECT_LT(fastest, 0.3);
}

TEST(Contacts, JointedBodiesStayClosedWhenTheyHitTheGround) {
  BulletScene scene;
  scene.add_ground();
  auto& a = scene.add_box(btVector3(0.1, 0.05, 0.05), 1.0, btVector3(0, 0, 0.4));
  auto& b = scene.add_box(btVector3(0.1, 0.05, 0.05), 1.0, btVector3(0.25, 0, 0.4));
  scene.add_hinge(a, b, btVector3(0.125, 0, 0.4), btVector3(0, 1, 0));
  double gap = 0.0;
  for (int i = 0; i < 2000; ++i) {
    scene.step();
    gap = std::max(gap, scene.largest_gap());
  }
  EXPECT_LT(gap, 0.05 * kMillimetre);
  EXPECT_NEAR(a.getWorldTransform().getOrigin().z(), 0.05, 1e-3);
}

TEST(Contacts, IslandsWithoutJointsNeverTouchTheJointSolver) {
  BulletScene scene;
  scene.add_ground();
  add_towers(scene, 4, 2);
  scene.step(100);
  EXPECT_EQ(scene.solver().statistics().symbolic_analyses, 0U);
  EXPECT_EQ(scene.solver().statistics().joints.solves, 0U);
}

TEST(Contacts, SettledBodiesNeedOneSweep) {
  BulletScene scene;
  scene.add_ground();
  add_towers(scene, 20, 1);
  scene.step(500);
  scene.solver().clear_statistics();
  scene.step(100);
  const auto& counts = scene.solver().statistics();
  EXPECT_LE(counts.contact_sweeps, counts.calls);
}

}  // namespace
}  // namespace ambf::physics::testing
