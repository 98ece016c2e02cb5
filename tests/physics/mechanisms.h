// Mechanisms that the solver's tests and benchmark share. Lengths in m, masses in kg; links do not collide.
#pragma once

#include <vector>

#include "tests/physics/bullet_scene.h"

namespace ambf::physics::testing {

// A motor that tries to keep `speed` (rad/s) with at most `torque` (N m).
void drive(btHingeConstraint& hinge, double speed, double torque);

// `count` separate parallelogram four-bars in vertical planes, each crank driven at 2 rad/s; payload on the couplers.
// Returns the cranks' motors.
std::vector<btHingeConstraint*> add_four_bars(BulletScene& scene, int count, double payload);

// A row of count + 1 parallel cranks on the ground, neighbours joined by couplers: `count` coupled loops in one island
// with redundant rows, driven at 2 rad/s with at most 50 N m, through the pose where all links lie in line.
btHingeConstraint& add_coupled_chain(BulletScene& scene, int count, double payload);

// Seven links on alternating axes, with a payload welded to the last.
struct Arm {
  std::vector<btHingeConstraint*> joints;
  btRigidBody* payload = nullptr;
};
Arm add_arm(BulletScene& scene, double payload);

// A robot like a surgical manipulator: yaw, a pitch driven through a double parallelogram with a redundant bar (two
// loops), an insertion slider, a wrist of three hinges and two jaws. 12 moving bodies.
std::vector<btTypedConstraint*> add_manipulator(BulletScene& scene, const btVector3& base);

// Base below, platform above, six legs of two bodies each (universal joints as balls, sliders between).
struct StewartPlatform {
  btRigidBody* platform = nullptr;
  std::vector<btSliderConstraint*> legs;
};
StewartPlatform add_stewart_platform(BulletScene& scene, double payload);

// A palm on a vertical slider, two fingers on horizontal sliders at the palm, and a box between them on the ground.
struct Gripper {
  btRigidBody* palm = nullptr;
  btRigidBody* fingers[2] = {};
  btRigidBody* box = nullptr;
  btSliderConstraint* lift = nullptr;
  btSliderConstraint* jaws[2] = {};
};
Gripper add_gripper(BulletScene& scene, double finger_mass = 0.2, double box_mass = 0.1);
void close_gripper(Gripper& gripper, double force);

// `towers` stacks of `height` cubes of 10 cm.
void add_towers(BulletScene& scene, int towers, int height);

}  // namespace ambf::physics::testing
