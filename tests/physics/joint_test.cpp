// Frames, coordinates, limits, effort and damping of every joint kind with one coordinate, for every solver that is
// offered.
#include <gtest/gtest.h>

#include <tuple>

#include "tests/physics/fixtures.h"

namespace ambf::physics {
namespace {

using namespace testing;
using state::JointType;

WorldOptions weightless(SolverKind solver = SolverKind::direct) {
  WorldOptions options;
  options.gravity = {};
  options.solver = solver;
  options.sleeping = false;
  return options;
}

scene::Joint random_joint(JointType type, Random& random) {
  scene::Joint joint;
  joint.type = type;
  joint.parent_pivot = random.vector(0.3);
  joint.child_pivot = random.vector(0.3);
  joint.parent_axis = random.unit();
  joint.child_axis = random.unit();
  joint.child_offset = random(-2.5, 2.5);
  joint.joint_offset = random(-1.0, 1.0);
  return joint;
}

// T_parent_child(q) as the description has it.
math::Pose pose_at(const scene::Joint& j, double q) {
  const bool turns = j.type == JointType::revolute || j.type == JointType::torsion_spring;
  const bool shifts = j.type == JointType::prismatic || j.type == JointType::linear_spring;
  const math::Quat r = math::from_axis_angle(j.parent_axis, j.child_offset - j.joint_offset + (turns ? q : 0.0)) *
                       math::rotation_between(j.child_axis, j.parent_axis);
  const math::Vec3 shift = shifts ? j.parent_axis * q : math::Vec3{};
  return {j.parent_pivot + shift - math::rotate(r, j.child_pivot), r};
}

class JointOfKind : public ::testing::TestWithParam<std::tuple<JointType, SolverKind>> {};

TEST_P(JointOfKind, CoordinateIsTheRightHandedTurnOrShiftOfTheChild) {
  const auto [type, solver] = GetParam();
  Random random(11);
  for (int trial = 0; trial < 40; ++trial) {
    const scene::Joint description = random_joint(type, random);
    BodyDefinition parent_parameters = mass_only(2.0, {0.02, 0.03, 0.025}, random.pose(1.0));
    BodyDefinition child_parameters = mass_only(1.0, {0.01, 0.012, 0.02});
    parent_parameters.T_body_com = random.pose(0.2);
    child_parameters.T_body_com = random.pose(0.2);
    const double q = random(-1.5, 1.5);
    child_parameters.T_world_body = parent_parameters.T_world_body * pose_at(description, q);
    Body parent(parent_parameters), child(child_parameters);
    Joint joint(description, parent, child);
    EXPECT_NEAR(joint.position(), q, 1e-9);
    EXPECT_LT(joint.gap().position, 1e-9);
    EXPECT_LT(joint.gap().angle, 1e-7);
    const math::Pose expected = parent.pose() * joint.child_pose_in_parent(q);
    EXPECT_LT(math::norm(expected.position - child.pose().position), 1e-9);
    EXPECT_LT(angle_between(expected.orientation, child.pose().orientation), 1e-7);

    World world(weightless(solver));
    world.add(parent);
    world.add(child);
    world.add(joint);
    // A motor turns it; the measured coordinate, its rate and the poses agree at every moment.
    joint.set_motor_velocity(0.7, 10.0);
    for (int i = 0; i < 200; ++i) world.step();
    const double now = joint.position();
    EXPECT_NEAR(joint.velocity(), 0.7, 1e-3);
    EXPECT_NEAR(now, q + 0.14, 2e-3);
    const math::Pose there = parent.pose() * pose_at(description, now);
    EXPECT_LT(math::norm(there.position - child.pose().position), 1e-5);
    EXPECT_LT(angle_between(there.orientation, child.pose().orientation), 1e-5);
    world.remove(joint);
    world.remove(child);
    world.remove(parent);
  }
}

TEST_P(JointOfKind, SwappingParentAndChildWithNegatedAxesKeepsPoseAndSign) {
  const auto [type, solver] = GetParam();
  Random random(5);
  for (int trial = 0; trial < 20; ++trial) {
    const scene::Joint forward = random_joint(type, random);
    scene::Joint swapped = forward;
    std::swap(swapped.parent_pivot, swapped.child_pivot);
    swapped.parent_axis = -forward.child_axis;
    swapped.child_axis = -forward.parent_axis;
    const double q = random(-1.0, 1.0);
    BodyDefinition a = mass_only(1.0, {0.01, 0.01, 0.01}, random.pose(1.0));
    BodyDefinition b = mass_only(1.0, {0.01, 0.01, 0.01}, a.T_world_body * pose_at(forward, q));
    Body parent(a), child(b);
    Joint one(forward, parent, child), other(swapped, child, parent);
    EXPECT_NEAR(one.position(), q, 1e-9);
    EXPECT_NEAR(other.position(), q, 1e-9);
    EXPECT_LT(other.gap().position, 1e-9);
  }
}

TEST_P(JointOfKind, EffortConservesMomentumAndAcceleratesTheChildForward) {
  const auto [type, solver] = GetParam();
  Random random(23);
  for (int trial = 0; trial < 10; ++trial) {
    const scene::Joint description = random_joint(type, random);
    BodyDefinition a = mass_only(2.0, {0.02, 0.02, 0.02}, random.pose(0.5));
    BodyDefinition b = mass_only(1.0, {0.01, 0.01, 0.01}, a.T_world_body * pose_at(description, 0.2));
    Body parent(a), child(b);
    Joint joint(description, parent, child);
    World world(weightless(solver));
    world.add(parent);
    world.add(child);
    world.add(joint);
    joint.set_effort(0.05);
    for (int i = 0; i < 300; ++i) {
      world.step();
      ASSERT_NEAR(joint.effort(), 0.05, 1e-6);
    }
    EXPECT_GT(joint.velocity(), 0.0);
    EXPECT_GT(joint.position(), 0.2);
    const Momentum m = momentum({&parent, &child});
    EXPECT_LT(math::norm(m.linear), 1e-10);
    // Levers are those of the step's start, so what Bullet's integration loses is of second order.
    EXPECT_LT(math::norm(m.angular), 2e-6);
    world.remove(joint);
    world.remove(child);
    world.remove(parent);
  }
}

TEST_P(JointOfKind, LimitsStopWithoutOvershoot) {
  const auto [type, solver] = GetParam();
  Random random(31);
  for (const double drive : {3.0, -3.0}) {
    scene::Joint description = random_joint(type, random);
    description.limits = std::array<double, 2>{-0.3, 0.4};
    BodyDefinition a = mass_only(0.0, {});
    BodyDefinition b = mass_only(1.0, {0.01, 0.01, 0.01}, pose_at(description, 0.0));
    Body parent(a), child(b);
    Joint joint(description, parent, child);
    World world(weightless(solver));
    world.add(parent);
    world.add(child);
    world.add(joint);
    joint.set_effort(drive);
    double farthest = 0.0;
    for (int i = 0; i < 1500; ++i) {
      world.step();
      farthest = drive > 0 ? std::max(farthest, joint.position()) : std::min(farthest, joint.position());
    }
    const double stop = drive > 0 ? 0.4 : -0.3;
    EXPECT_NEAR(joint.position(), stop, 2e-4);
    EXPECT_NEAR(farthest, stop, 1e-3);
    EXPECT_NEAR(joint.velocity(), 0.0, 1e-2);
    // Pushed back once it is beyond.
    world.remove(joint);
    world.remove(child);
    world.remove(parent);
  }
}

TEST_P(JointOfKind, ViscousDampingDecaysAsItShould) {
  const auto [type, solver] = GetParam();
  Random random(41);
  for (const double damping : {0.05, 500.0}) {  // the second is far beyond what an explicit damper survives
    scene::Joint description = random_joint(type, random);
    // Through the COM, so that the inertia about the axis is known.
    description.child_pivot = {};
    description.damping = damping;
    BodyDefinition b = mass_only(0.5, {0.5, 0.5, 0.5}, pose_at(description, 0.0));
    Body parent(mass_only(0.0, {})), child(b);
    Joint joint(description, parent, child);
    World world(weightless(solver));
    world.add(parent);
    world.add(child);
    world.add(joint);
    const math::Vec3 axis = description.parent_axis;
    const bool shifts = type == JointType::prismatic || type == JointType::linear_spring;
    child.set_twist(shifts ? math::Twist{axis, {}} : math::Twist{{}, axis});
    ASSERT_NEAR(joint.velocity(), 1.0, 1e-9);
    for (int i = 0; i < 1000; ++i) world.step();
    // Implicit: each step divides by 1 + D h / m.
    EXPECT_NEAR(joint.velocity(), std::pow(1.0 + damping * 0.001 / 0.5, -1000.0), 1e-4);
    world.remove(joint);
    world.remove(child);
    world.remove(parent);
  }
}

std::string name_of(JointType type) {
  switch (type) {
    case JointType::revolute: return "revolute";
    case JointType::prismatic: return "prismatic";
    case JointType::linear_spring: return "linear_spring";
    default: return "torsion_spring";
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, JointOfKind,
                         ::testing::Combine(::testing::Values(JointType::revolute, JointType::prismatic,
                                                              JointType::linear_spring, JointType::torsion_spring),
                                            ::testing::Values(SolverKind::direct, SolverKind::si, SolverKind::mlcp)),
                         [](const auto& parameter) {
                           return name_of(std::get<0>(parameter.param)) + "_" +
                                  testing::name_of(std::get<1>(parameter.param));
                         });

}  // namespace
}  // namespace ambf::physics
