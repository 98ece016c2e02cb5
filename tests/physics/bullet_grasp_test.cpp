// The original holds with Bullet's fixed constraint: how far that opens under the same load, beside ours. Printed.
#include <btBulletDynamicsCommon.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <memory>

#include "tests/physics/fixtures.h"

namespace ambf::physics {
namespace {

using namespace testing;

constexpr double kLoad = 20.0, kLever = 0.3;  // kg, m
constexpr double kStep = 0.001;               // s
constexpr int kSteps = 2000;

// A hand of 2 kg on a rail along z, which a motor keeps where it is; the load beside it. Largest gap, m.
double gap_of_ours() {
  World world;
  Body post(mass_only(0.0, {})), hand(mass_only(2.0, {0.01, 0.01, 0.01}));
  Body load(mass_only(kLoad, {0.1, 0.1, 0.1}, {{kLever, 0, 0}, {}}));
  scene::Joint vertical;
  vertical.type = state::JointType::prismatic;
  vertical.max_motor_impulse = 10.0;
  Joint rail(vertical, post, hand);
  Grasp grasp;
  for (Body* body : {&post, &hand, &load}) world.add(*body);
  world.add(rail);
  world.add(grasp);
  rail.set_motor_velocity(0.0);
  EXPECT_TRUE(grasp.hold(hand, load, {}));
  double largest = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    world.step();
    const math::Vec3 where = math::inverse(hand.com_pose()) * load.com_pose().position;
    largest = std::max(largest, math::norm(where - math::Vec3{kLever, 0, 0}));
  }
  return largest;
}

// As the original builds it: one step of 1 ms, Bullet's own solver with its default of ten iterations.
double gap_of_bullet() {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity({0, 0, -9.8});
  btEmptyShape none;
  const auto body = [&](double mass, double inertia, double x) {
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, &none, {inertia, inertia, inertia});
    info.m_startWorldTransform.setOrigin({x, 0, 0});
    auto made = std::make_unique<btRigidBody>(info);
    made->setActivationState(DISABLE_DEACTIVATION);
    world.addRigidBody(made.get());
    return made;
  };
  const auto post = body(0.0, 0.0, 0.0), hand = body(2.0, 0.01, 0.0), load = body(kLoad, 0.1, kLever);
  const btTransform along_z(btQuaternion({0, 1, 0}, -SIMD_HALF_PI));
  btSliderConstraint rail(*post, *hand, along_z, along_z, true);
  rail.setLowerLinLimit(0.0);
  rail.setUpperLinLimit(0.0);
  rail.setLowerAngLimit(0.0);
  rail.setUpperAngLimit(0.0);
  btTransform at_hand = btTransform::getIdentity();
  at_hand.setOrigin({kLever, 0, 0});
  btFixedConstraint grasp(*hand, *load, at_hand, btTransform::getIdentity());
  world.addConstraint(&rail, true);
  world.addConstraint(&grasp, true);
  double largest = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    world.stepSimulation(kStep, 0);
    const btVector3 where = hand->getWorldTransform().inverse() * load->getWorldTransform().getOrigin();
    largest = std::max(largest, (where - btVector3(kLever, 0, 0)).length());
  }
  world.removeConstraint(&grasp);
  world.removeConstraint(&rail);
  for (const auto* each : {&post, &hand, &load}) world.removeRigidBody(each->get());
  return largest;
}

TEST(FixedGrasp, IsStifferThanBulletsFixedConstraint) {
  const double ours = gap_of_ours(), bullet = gap_of_bullet();
  std::printf("20 kg grasped at 0.3 m open by %.3g mm; with Bullet's fixed constraint, as the original's, by %.3g mm\n",
              1e3 * ours, 1e3 * bullet);
  EXPECT_LT(ours, 1e-5);
  EXPECT_LT(ours, 0.1 * bullet);
}

}  // namespace
}  // namespace ambf::physics
