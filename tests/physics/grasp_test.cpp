// A gripper holds what it grasps: no creep, whatever the force; and lets go when its force does not suffice.
#include <gtest/gtest.h>

#include "tests/physics/fixtures.h"

namespace ambf::physics {
namespace {

using namespace testing;

// Two fingers on prismatic joints below a carriage that a motor lifts; a cube between them, on the ground.
struct Gripper {
  explicit Gripper(SolverKind solver)
      : world([solver] {
          WorldOptions options;
          options.solver = solver;
          return options;
        }()) {
    for (Body* body : {&floor, &post, &carriage, &left, &right, &cube}) world.add(*body);
    for (Joint* joint : {&lift, &left_slide, &right_slide}) world.add(*joint);
  }
  static BodyParameters finger(double x) {
    BodyParameters p = parameters(0.1, {box(0.01, 0.04, 0.06)}, {x, 0, 0.03});
    p.surface.friction = 1.0;
    return p;
  }
  static BodyParameters object() {
    BodyParameters p = parameters(0.2, {box(0.04, 0.04, 0.04)}, {0, 0, 0.02});
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
  Body left{finger(-0.03)}, right{finger(0.03)}, cube{object()};
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
    Gripper gripper(SolverKind::direct);
    for (int i = 0; i < 500; ++i) gripper.step(c.force, 0.0);
    const double before = gripper.cube.pose().position.z - gripper.left.pose().position.z;
    for (int i = 0; i < 3400; ++i) gripper.step(c.force, i < 1000 ? 0.1 : 0.0);
    EXPECT_NEAR(gripper.cube.pose().position.z, 0.12, 1e-3) << c.force;
    EXPECT_NEAR(gripper.cube.pose().position.z - gripper.left.pose().position.z, before, c.slip) << c.force;
    for (const Joint* joint : {&gripper.lift, &gripper.left_slide, &gripper.right_slide})
      EXPECT_LT(joint->gap().position, 1e-5);
  }
}

TEST(Grasp, LetsGoWhatIsTooHeavyForItsForce) {
  Gripper gripper(SolverKind::direct);
  for (int i = 0; i < 500; ++i) gripper.step(0.5, 0.0);  // holds 1.0 N of 1.96
  for (int i = 0; i < 1500; ++i) gripper.step(0.5, i < 1000 ? 0.1 : 0.0);
  EXPECT_LT(gripper.cube.pose().position.z, 0.05);
}

}  // namespace
}  // namespace ambf::physics
