#include "tests/physics/mechanisms.h"

#include <cmath>

namespace ambf::physics::testing {
namespace {

const btVector3 kX(1, 0, 0);
const btVector3 kY(0, 1, 0);
const btVector3 kZ(0, 0, 1);

// A thin bar from one point to another, along its own x axis.
btRigidBody& add_bar(BulletScene& scene, const btVector3& from, const btVector3& to, double mass) {
  const btVector3 along = to - from;
  const btTransform pose(shortestArcQuat(kX, along.normalized()), 0.5 * (from + to));
  return scene.add_box(btVector3(0.5 * along.length(), 0.02, 0.02), mass, pose, false);
}

// A payload that shares the pose of a body, so that it loads the joints without a lever of its own.
void load(BulletScene& scene, btRigidBody& carrier, double mass) {
  if (mass <= 0.0) return;
  auto& payload = scene.add_box(btVector3(0.05, 0.05, 0.05), mass, carrier.getWorldTransform(), false);
  scene.add_weld(carrier, payload);
}

}  // namespace

void drive(btHingeConstraint& hinge, double speed, double torque) {
  hinge.enableAngularMotor(true, speed, torque * kStep);
}

std::vector<btHingeConstraint*> add_four_bars(BulletScene& scene, int count, double payload) {
  std::vector<btHingeConstraint*> motors;
  for (int i = 0; i < count; ++i) {
    const btVector3 left(0, 1.0 * i, 1);
    const btVector3 right = left + btVector3(0.5, 0, 0);
    const btVector3 up(0.05, 0, 0.3);
    auto& crank = add_bar(scene, left, left + up, 1.0);
    auto& rocker = add_bar(scene, right, right + up, 1.0);
    auto& coupler = add_bar(scene, left + up, right + up, 1.0);
    auto& motor = scene.add_hinge(crank, left, kY);
    scene.add_hinge(rocker, right, kY);
    scene.add_hinge(crank, coupler, left + up, kY);
    scene.add_hinge(rocker, coupler, right + up, kY);
    load(scene, coupler, payload);
    drive(motor, 2.0, 200.0);
    motors.push_back(&motor);
  }
  return motors;
}

btHingeConstraint& add_coupled_chain(BulletScene& scene, int count, double payload) {
  const btVector3 up(0.02, 0, 0.3);
  btHingeConstraint* motor = nullptr;
  btRigidBody* previous = nullptr;
  for (int i = 0; i <= count; ++i) {
    const btVector3 foot(0.5 * i, 0, 1);
    auto& crank = add_bar(scene, foot, foot + up, 1.0);
    auto& hinge = scene.add_hinge(crank, foot, kY);
    if (i == 0) {
      motor = &hinge;
    } else {
      const btVector3 tip = foot + up;
      auto& coupler = add_bar(scene, tip - btVector3(0.5, 0, 0), tip, 1.0);
      scene.add_hinge(*previous, coupler, tip - btVector3(0.5, 0, 0), kY);
      scene.add_hinge(crank, coupler, tip, kY);
      if (i == count) load(scene, coupler, payload);
    }
    previous = &crank;
  }
  drive(*motor, 2.0, 50.0);
  return *motor;
}

Arm add_arm(BulletScene& scene, double payload) {
  Arm arm;
  const double lengths[7] = {0.15, 0.3, 0.15, 0.3, 0.15, 0.15, 0.1};
  const double masses[7] = {3, 3, 2, 2, 1.5, 1, 0.5};
  const btVector3 axes[7] = {kZ, kY, kX, kY, kX, kY, kX};  // the arm stretches along +x after the first link
  btVector3 at(0, 0, 1);
  btRigidBody* previous = nullptr;
  for (int i = 0; i < 7; ++i) {
    const btVector3 next = at + (i == 0 ? lengths[i] * kZ : lengths[i] * kX);
    const btTransform pose(i == 0 ? shortestArcQuat(kX, kZ) : btQuaternion::getIdentity(), 0.5 * (at + next));
    auto& link = scene.add_box(btVector3(0.5 * lengths[i], 0.05, 0.05), masses[i], pose, false);
    arm.joints.push_back(previous ? &scene.add_hinge(*previous, link, at, axes[i])
                                  : &scene.add_hinge(link, at, axes[i]));
    previous = &link;
    at = next;
  }
  if (payload > 0.0) {
    arm.payload = &scene.add_box(btVector3(0.08, 0.08, 0.08), payload, at, false);
    scene.add_weld(*previous, *arm.payload);
  }
  return arm;
}

std::vector<btTypedConstraint*> add_manipulator(BulletScene& scene, const btVector3& base) {
  std::vector<btTypedConstraint*> joints;
  const auto at = [&](double x, double z) { return base + btVector3(x, 0, z); };
  const auto hinge = [&](btRigidBody& a, btRigidBody& b, const btVector3& pivot, const btVector3& axis) {
    joints.push_back(&scene.add_hinge(a, b, pivot, axis));
    return static_cast<btHingeConstraint*>(joints.back());
  };
  auto& yaw = add_bar(scene, at(0, 0), at(0.4, 0), 4.0);
  auto* yaw_joint = &scene.add_hinge(yaw, at(0, 0), kX);
  joints.push_back(yaw_joint);
  auto& upright_1 = add_bar(scene, at(0.1, 0), at(0.12, 0.3), 1.0);
  auto& upright_2 = add_bar(scene, at(0.3, 0), at(0.32, 0.3), 1.0);
  auto& top = add_bar(scene, at(0.12, 0.3), at(0.62, 0.3), 1.5);
  auto& middle = add_bar(scene, at(0.11, 0.15), at(0.61, 0.15), 1.0);  // redundant: parallel to the top bar
  auto& carrier = add_bar(scene, at(0.61, 0.15), at(0.62, 0.3), 1.5);
  auto* pitch_joint = hinge(yaw, upright_1, at(0.1, 0), kY);
  hinge(yaw, upright_2, at(0.3, 0), kY);
  hinge(upright_1, top, at(0.12, 0.3), kY);
  hinge(upright_2, top, at(0.32, 0.3), kY);
  hinge(upright_1, middle, at(0.11, 0.15), kY);
  hinge(upright_2, middle, at(0.31, 0.15), kY);
  hinge(top, carrier, at(0.62, 0.3), kY);
  hinge(middle, carrier, at(0.61, 0.15), kY);
  auto& tool = scene.add_box(btVector3(0.02, 0.02, 0.2), 0.5, at(0.66, 0.15), false);
  auto* insertion = &scene.add_slider(carrier, tool, at(0.66, 0.15), -kZ);
  insertion->setPoweredLinMotor(true);
  insertion->setTargetLinMotorVelocity(0.0);
  insertion->setMaxLinMotorForce(100.0);
  joints.push_back(insertion);
  btRigidBody* previous = &tool;
  const btVector3 axes[3] = {kZ, kY, kX};
  for (int i = 0; i < 3; ++i) {
    const double z = -0.06 - 0.02 * i;
    auto& link = scene.add_box(btVector3(0.01, 0.01, 0.01), 0.05, at(0.66, z), false);
    drive(*hinge(*previous, link, at(0.66, z + 0.01), axes[i]), 0.0, 5.0);
    previous = &link;
  }
  for (const double side : {-1.0, 1.0}) {
    auto& jaw = scene.add_box(btVector3(0.003, 0.003, 0.01), 0.02, at(0.66 + 0.004 * side, -0.125), false);
    drive(*hinge(*previous, jaw, at(0.66, -0.112), kY), 0.0, 2.0);
  }
  drive(*yaw_joint, 0.0, 500.0);
  drive(*pitch_joint, 0.0, 500.0);
  return joints;
}

StewartPlatform add_stewart_platform(BulletScene& scene, double payload) {
  StewartPlatform result;
  const double height = 0.6;
  result.platform = &scene.add_box(btVector3(0.2, 0.2, 0.02), 5.0, btVector3(0, 0, height), false);
  for (int i = 0; i < 6; ++i) {
    const double foot_angle = (60.0 * (i / 2) * 2 + (i % 2 == 0 ? -10.0 : 10.0)) * SIMD_RADS_PER_DEG;
    const double head_angle = (60.0 * (i / 2) * 2 + (i % 2 == 0 ? -50.0 : 50.0)) * SIMD_RADS_PER_DEG;
    const btVector3 foot(0.4 * std::cos(foot_angle), 0.4 * std::sin(foot_angle), 0.0);
    const btVector3 head(0.2 * std::cos(head_angle), 0.2 * std::sin(head_angle), height);
    const btVector3 middle = 0.5 * (foot + head);
    auto& lower = add_bar(scene, foot, middle, 0.5);
    auto& upper = add_bar(scene, middle, head, 0.5);
    scene.add_ball(lower, foot);
    auto& slider = scene.add_slider(lower, upper, middle, (head - foot).normalized());
    slider.setPoweredLinMotor(true);
    slider.setTargetLinMotorVelocity(0.0);
    slider.setMaxLinMotorForce(5000.0);
    scene.add_ball(*result.platform, upper, head);
    result.legs.push_back(&slider);
  }
  load(scene, *result.platform, payload);
  return result;
}

Gripper add_gripper(BulletScene& scene, double finger_mass, double box_mass) {
  Gripper g;
  scene.add_ground();
  g.box = &scene.add_box(btVector3(0.02, 0.02, 0.02), box_mass, btVector3(0, 0, 0.02));
  g.palm = &scene.add_box(btVector3(0.08, 0.03, 0.01), 1.0, btVector3(0, 0, 0.12), false);
  g.lift = &scene.add_slider(*g.palm, kZ);
  g.lift->setPoweredLinMotor(true);
  g.lift->setTargetLinMotorVelocity(0.0);
  g.lift->setMaxLinMotorForce(1000.0);
  for (const int side : {0, 1}) {
    const double sign = side == 0 ? -1.0 : 1.0;
    g.fingers[side] = &scene.add_box(btVector3(0.01, 0.015, 0.03), finger_mass, btVector3(0.035 * sign, 0, 0.04));
    g.fingers[side]->setFriction(1.0);
    g.jaws[side] = &scene.add_slider(*g.palm, *g.fingers[side], g.fingers[side]->getWorldTransform().getOrigin(),
                                     btVector3(-sign, 0, 0));
    g.jaws[side]->setPoweredLinMotor(true);
    g.jaws[side]->setTargetLinMotorVelocity(0.0);
    g.jaws[side]->setMaxLinMotorForce(1000.0);
  }
  g.box->setFriction(1.0);
  return g;
}

void close_gripper(Gripper& gripper, double force) {
  for (const int side : {0, 1}) {
    gripper.jaws[side]->setTargetLinMotorVelocity(0.1);
    gripper.jaws[side]->setMaxLinMotorForce(force);
  }
}

void add_towers(BulletScene& scene, int towers, int height) {
  const int side = static_cast<int>(std::ceil(std::sqrt(towers)));
  for (int i = 0; i < towers; ++i) {
    for (int k = 0; k < height; ++k) {
      scene.add_box(btVector3(0.05, 0.05, 0.05), 0.5, btVector3(0.25 * (i % side), 0.25 * (i / side), 0.05 + 0.1 * k));
    }
  }
}

}  // namespace ambf::physics::testing
