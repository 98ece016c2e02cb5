// A gripper holds what it grasps: no creep, whatever the force; and lets go when its force does not suffice.
#include <gtest/gtest.h>

#include "tests/physics/fixtures.h"
#include "tests/physics/meshes.h"

namespace ambf::physics {
namespace {

using namespace testing;

// Two fingers on prismatic joints below a carriage that a motor lifts; a cube between them, on the ground.
struct Gripper {
  Gripper() : Gripper(finger_box(), parameters(0.2, {box(0.04, 0.04, 0.04)}, {0, 0, 0.02})) {}
  Gripper(const SharedShape& finger_shape, const BodyDefinition& object)
      : left(finger(-0.03, finger_shape)), right(finger(0.03, finger_shape)), cube(with_friction(object)) {
    for (Body* body : {&floor, &post, &carriage, &left, &right, &cube}) world.add(*body);
    for (Joint* joint : {&lift, &left_slide, &right_slide}) world.add(*joint);
  }
  static SharedShape finger_box() { return make_shape({box(0.01, 0.04, 0.06)}, {}); }
  static BodyDefinition finger(double x, const SharedShape& shape) {
    BodyDefinition p;
    p.mass = 0.1;
    p.T_world_body.position = {x, 0, 0.03};
    p.shape = shape;
    return with_friction(p);
  }
  static BodyDefinition with_friction(BodyDefinition p) {
    p.surface.friction = 1.0;
    return p;
  }
  static scene::Joint slide(const math::Vec3& axis, const math::Vec3& pivot) {
    scene::Joint joint;
    joint.type = state::JointType::prismatic;
    joint.parent_axis = joint.child_axis = axis;
    joint.parent_pivot = pivot;
    return joint;
  }
  void step(double force, double speed) {
    left_slide.set_effort(force);
    right_slide.set_effort(force);
    lift.set_motor_velocity(speed, 1.0);
    world.step();
  }
  Body floor{parameters(0.0, {ground()}, {})}, post{mass_only(0.0, {}, {{0, 0, 0.2}, {}})};
  Body carriage{mass_only(1.0, {0.01, 0.01, 0.01}, {{0, 0, 0.2}, {}})};
  Body left, right, cube;
  Joint lift{slide({0, 0, 1}, {}), post, carriage};
  Joint left_slide{slide({1, 0, 0}, {-0.03, 0, -0.17}), carriage, left};
  Joint right_slide{slide({-1, 0, 0}, {0.03, 0, -0.17}), carriage, right};
  World world;
};

TEST(Grasp, HoldsAndLiftsWithoutSlip) {
  struct Case {
    double force, slip;
  };
  for (const Case& c : {Case{5.0, 5e-5}, Case{50.0, 2.5e-4}}) {
    Gripper gripper;
    for (int i = 0; i < 500; ++i) gripper.step(c.force, 0.0);
    const double before = gripper.cube.pose().position.z - gripper.left.pose().position.z;
    for (int i = 0; i < 3400; ++i) gripper.step(c.force, i < 1000 ? 0.1 : 0.0);
    EXPECT_NEAR(gripper.cube.pose().position.z, 0.12, 1e-3) << c.force;
    EXPECT_NEAR(gripper.cube.pose().position.z - gripper.left.pose().position.z, before, c.slip) << c.force;
    for (const Joint* joint : {&gripper.lift, &gripper.left_slide, &gripper.right_slide})
      EXPECT_LT(joint->gap().position, 1e-5);
  }
}

TEST(Grasp, HoldsAndLiftsTriangleMeshes) {
  const SharedShape mesh_finger = box_mesh({0.01, 0.04, 0.056}, 2).shape();
  struct Case {
    SharedShape finger;
    TestMesh object;
    double height, slip;
  };
  for (const Case& c : {Case{Gripper::finger_box(), box_mesh({0.04, 0.04, 0.04}, 3), 0.021, 1e-4},
                        Case{mesh_finger, box_mesh({0.04, 0.04, 0.04}, 3), 0.021, 1e-4},
                        Case{Gripper::finger_box(), ring_mesh(0.015, 0.006, 30, 12), 0.007, 2e-4},
                        Case{mesh_finger, ring_mesh(0.015, 0.006, 30, 12), 0.007, 2e-4}}) {
    BodyDefinition object;
    object.mass = 0.2;
    object.T_world_body.position.z = c.height;
    object.shape = c.object.shape();
    Gripper gripper(c.finger, object);
    for (int i = 0; i < 500; ++i) gripper.step(10.0, 0.0);
    const double before = gripper.cube.pose().position.z - gripper.left.pose().position.z;
    for (int i = 0; i < 3400; ++i) gripper.step(10.0, i < 1000 ? 0.1 : 0.0);
    EXPECT_NEAR(gripper.cube.pose().position.z, 0.1 + c.height, 1e-3);
    EXPECT_NEAR(gripper.cube.pose().position.z - gripper.left.pose().position.z, before, c.slip);
  }
}

TEST(Grasp, LetsGoWhatIsTooHeavyForItsForce) {
  Gripper gripper;
  for (int i = 0; i < 500; ++i) gripper.step(0.5, 0.0);  // holds 1.0 N of 1.96
  for (int i = 0; i < 1500; ++i) gripper.step(0.5, i < 1000 ? 0.1 : 0.0);
  EXPECT_LT(gripper.cube.pose().position.z, 0.05);
}

}  // namespace
}  // namespace ambf::physics
