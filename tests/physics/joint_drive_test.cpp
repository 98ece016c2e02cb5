// Drives, springs and joints with several free directions, for every solver that is offered.
#include <gtest/gtest.h>

#include <array>
#include <memory>
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

class EverySolver : public ::testing::TestWithParam<SolverKind> {};
INSTANTIATE_TEST_SUITE_P(Solvers, EverySolver, ::testing::Values(SolverKind::direct, SolverKind::si, SolverKind::mlcp),
                         [](const auto& parameter) { return testing::name_of(parameter.param); });

TEST_P(EverySolver, SpringWithoutLimitsSwingsWithItsPeriod) {
  for (const JointType type : {JointType::linear_spring, JointType::torsion_spring}) {
    scene::Joint description;
    description.type = type;
    description.stiffness = 40.0;
    Body parent(mass_only(0.0, {})), child(mass_only(0.1, {0.1, 0.1, 0.1}));
    Joint joint(description, parent, child);
    World world(weightless(GetParam()));
    world.add(parent);
    world.add(child);
    world.add(joint);
    child.set_twist(type == JointType::linear_spring ? math::Twist{{0, 0, 1}, {}} : math::Twist{{}, {0, 0, 1}});
    // Upward crossings of zero.
    std::vector<double> crossings;
    double peak = 0.0, before = joint.position();
    for (int i = 1; i <= 4000; ++i) {
      world.step();
      const double now = joint.position();
      if (before < 0.0 && now >= 0.0) crossings.push_back(i * 0.001);
      if (i > 3500) peak = std::max(peak, now);
      before = now;
    }
    ASSERT_GE(crossings.size(), 10u);
    const double period = (crossings.back() - crossings.front()) / static_cast<double>(crossings.size() - 1);
    EXPECT_NEAR(period, 2.0 * kPi / std::sqrt(40.0 / 0.1), 5e-4);
    EXPECT_NEAR(peak, 1.0 / 20.0, 1e-3);  // v / omega: no energy is lost
    world.remove(joint);
    world.remove(child);
    world.remove(parent);
  }
}

// Two motors of a parallelogram against each other press 20 kN through its coupler. Rows of loops give way a little, so
// that redundant ones may contradict each other: by 22 um here, were it not taken back within the step.
// Returns how far they open, m, on a base that turns at `spin`, rad/s.
double opens_under_motors(double spin) {
  constexpr double kCrank = 0.1, kApart = 0.3, kEffort = 2000.0;
  World world(weightless());
  // The cranks point away from the axis, so that they stay where they are.
  const math::Pose below{{kApart / 2, -0.5, 0.0}, {}};
  Body base(spin != 0.0 ? mass_only(100.0, {10, 10, 10}, below) : mass_only(0.0, {}, below));
  Body left(mass_only(0.1, {1e-4, 1e-4, 1e-4}, {{0.0, kCrank / 2, 0.0}, {}}));
  Body right(mass_only(0.1, {1e-4, 1e-4, 1e-4}, {{kApart, kCrank / 2, 0.0}, {}}));
  Body coupler(mass_only(0.1, {1e-4, 1e-4, 1e-4}, {{kApart / 2, kCrank, 0.0}, {}}));
  const auto hinge = [](Body& parent, Body& child, double x, double y) {
    const auto seen_from = [&](const Body& body) {
      const math::Vec3 at = body.com_pose().position;
      return math::Vec3{x - at.x, y - at.y, 0.0};
    };
    scene::Joint description;
    description.type = JointType::revolute;
    description.parent_axis = description.child_axis = {0.0, 0.0, 1.0};
    description.parent_pivot = seen_from(parent);
    description.child_pivot = seen_from(child);
    return std::make_unique<Joint>(description, parent, child);
  };
  const std::array joints{hinge(base, left, 0.0, 0.0), hinge(base, right, kApart, 0.0),
                          hinge(left, coupler, 0.0, kCrank), hinge(right, coupler, kApart, kCrank)};
  for (Body* body : {&base, &left, &right, &coupler}) world.add(*body);
  for (const auto& joint : joints) world.add(*joint);
  for (Body* body : {&base, &left, &right, &coupler}) {
    if (spin == 0.0) break;
    const math::Vec3 at = body->com_pose().position - below.position;
    body->set_twist({{-spin * at.y, spin * at.x, 0.0}, {0.0, 0.0, spin}});
  }
  joints[0]->set_effort(kEffort);
  joints[1]->set_effort(-kEffort);
  double gap = 0.0;
  for (int i = 0; i < 300; ++i) {
    world.step();
    for (const auto& joint : joints) gap = std::max(gap, joint->gap().position);
  }
  EXPECT_NEAR(joints[0]->position(), 0.0, 1e-3);
  for (const auto& joint : joints) world.remove(*joint);
  return gap;
}

TEST(ClosedLoops, StayClosedWhileMotorsPullAgainstEachOther) { EXPECT_LT(opens_under_motors(0.0), 2e-6); }

// Where a step turns too far for straight rows, they are given new targets, beyond what was taken back.
TEST(ClosedLoops, StayClosedSoWhileTheyTurnFast) { EXPECT_LT(opens_under_motors(100.0), 5e-6); }

// Bodies that do not turn as balls do: what joints apply as forces counts in every step, also once they turn fast.
TEST_P(EverySolver, EffortsAndSpringsActOnThinBodies) {
  const math::Vec3 inertia{0.01, 0.04, 0.039};
  for (const math::Vec3& axis : {math::Vec3{0, 0, 1}, math::Vec3{0, 1, 0}, math::Vec3{1, 0, 0}}) {
    const double about = dot(axis, math::Vec3{axis.x * inertia.x, axis.y * inertia.y, axis.z * inertia.z});
    for (const bool sprung : {false, true}) {
      scene::Joint description;
      description.type = sprung ? JointType::torsion_spring : JointType::revolute;
      description.parent_axis = description.child_axis = axis;
      description.stiffness = sprung ? 10.0 : 0.0;
      description.equilibrium = 0.5;
      Body parent(mass_only(0.0, {})), child(mass_only(1.0, inertia));
      Joint joint(description, parent, child);
      World world(weightless(GetParam()));
      world.add(parent);
      world.add(child);
      world.add(joint);
      if (!sprung) joint.set_effort(0.3);
      for (int i = 0; i < 150; ++i) world.step();
      const double rate = std::sqrt(10.0 / about);  // rad/s
      const double expected = sprung ? 0.5 * (1.0 - std::cos(rate * 0.15)) : 0.5 * 0.3 / about * 0.15 * 0.15;
      EXPECT_NEAR(joint.position(), expected, 0.02 * expected)
          << axis.x << axis.y << axis.z << (sprung ? " sprung" : "");
      world.remove(joint);
      world.remove(child);
      world.remove(parent);
    }
  }
}

TEST_P(EverySolver, StiffSpringStaysStable) {
  scene::Joint description;
  description.type = JointType::torsion_spring;
  description.stiffness = 1e6;  // K h^2 / I = 100
  description.equilibrium = 0.1;
  Body parent(mass_only(0.0, {})), child(mass_only(0.1, {0.01, 0.01, 0.01}));
  Joint joint(description, parent, child);
  World world(weightless(GetParam()));
  world.add(parent);
  world.add(child);
  world.add(joint);
  for (int i = 0; i < 1000; ++i) world.step();
  EXPECT_NEAR(joint.position(), 0.1, 1e-6);
  world.remove(joint);
}

TEST_P(EverySolver, ServoHoldsALoadWithGainsNoExplicitControllerSurvives) {
  scene::Joint description;
  description.parent_axis = description.child_axis = {0, 1, 0};
  BodyDefinition p = mass_only(1.0, {0.001, 0.001, 0.001}, {{0.2, 0, 0}, {}});
  description.child_pivot = {-0.2, 0, 0};
  Body parent(mass_only(0.0, {})), child(p);
  Joint joint(description, parent, child);
  WorldOptions options = weightless(GetParam());
  options.gravity = {0, 0, -9.8};
  World world(options);
  world.add(parent);
  world.add(child);
  world.add(joint);
  joint.set_servo({.position = 0.0, .stiffness = 1e5, .damping = 1e4});
  for (int i = 0; i < 3000; ++i) world.step();
  const double sag = 1.0 * 9.8 * 0.2 / 1e5;
  EXPECT_NEAR(joint.position(), sag, 2e-6);
  EXPECT_NEAR(joint.effort(), -1.96, 1e-3);
  joint.set_servo({.position = 0.0, .stiffness = 1e5, .damping = 1e4, .max_effort = 1.0});
  for (int i = 0; i < 200; ++i) world.step();
  EXPECT_GT(joint.position(), 0.05);  // too weak: falls
  EXPECT_GE(joint.effort(), -1.0 - 1e-6);
  world.remove(joint);
}

TEST_P(EverySolver, MotorGivesUpAtItsImpulse) {
  scene::Joint description;
  description.parent_axis = description.child_axis = {0, 1, 0};
  description.child_pivot = {-0.5, 0, 0};
  Body parent(mass_only(0.0, {})), child(mass_only(1.0, {0.01, 0.01, 0.01}, {{0.5, 0, 0}, {}}));
  Joint joint(description, parent, child);
  WorldOptions options = weightless(GetParam());
  options.gravity = {0, 0, -9.8};
  World world(options);
  world.add(parent);
  world.add(child);
  world.add(joint);
  joint.set_motor_velocity(0.0, 0.01);  // 10 Nm against 4.9
  for (int i = 0; i < 500; ++i) world.step();
  EXPECT_NEAR(joint.position(), 0.0, 1e-4);
  EXPECT_NEAR(joint.effort(), -4.9, 1e-2);
  joint.set_motor_velocity(0.0, 0.003);
  for (int i = 0; i < 100; ++i) world.step();
  EXPECT_NEAR(joint.effort(), -3.0, 1e-6);
  EXPECT_GT(joint.position(), 0.005);
  world.remove(joint);
}

TEST_P(EverySolver, PointJointHoldsThePointAndLeavesTurnsFree) {
  scene::Joint description;
  description.type = JointType::p2p;
  description.parent_pivot = {0, 0, 1};
  description.child_pivot = {0, 0, 0.3};
  Body parent(mass_only(0.0, {})), child(mass_only(1.0, {0.01, 0.01, 0.01}, {{0, 0, 0.7}, {}}));
  Joint joint(description, parent, child);
  WorldOptions options = weightless(GetParam());
  options.gravity = {0, 0, -9.8};
  World world(options);
  world.add(parent);
  world.add(child);
  world.add(joint);
  child.set_twist({{0.6, 0, 0}, {0, -2.0, 3.0}});
  double worst = 0.0;
  for (int i = 0; i < 2000; ++i) {
    world.step();
    worst = std::max(worst, joint.gap().position);
  }
  EXPECT_LT(worst, 2e-5);
  EXPECT_GT(std::abs(child.twist().angular.z), 0.5);
  world.remove(joint);
}

TEST_P(EverySolver, ConeKeepsSwingAndTwistWithinItsSpans) {
  scene::Joint description;
  description.type = JointType::cone_twist;
  description.cone_limits = {0.3, 0.6, 0.5};
  for (const math::Vec3 torque : {math::Vec3{0.5, 0, 0}, math::Vec3{0, 0.5, 0}, math::Vec3{0, 0, 0.5}}) {
    Body parent(mass_only(0.0, {})), child(mass_only(1.0, {0.02, 0.02, 0.02}));
    Joint joint(description, parent, child);
    World world(weightless(GetParam()));
    world.add(parent);
    world.add(child);
    world.add(joint);
    joint.set_damping(0.1);
    for (int i = 0; i < 3000; ++i) {
      child.apply_torque(torque);
      world.step();
    }
    const math::Vec3 turned = math::log(child.pose().orientation);
    const double expected = torque.x > 0 ? 0.3 : (torque.y > 0 ? 0.6 : 0.5);
    EXPECT_NEAR(math::dot(turned, math::normalized(torque)), expected, 5e-3);
    EXPECT_NEAR(math::norm(turned), expected, 5e-3);
    world.remove(joint);
    world.remove(child);
    world.remove(parent);
  }
}

TEST_P(EverySolver, SixDofKeepsItsRangesAndSpringsPullToTheirEquilibrium) {
  scene::Joint description;
  description.type = JointType::six_dof_spring;
  description.six_dof.linear_low = {0, -0.1, -0.5};
  description.six_dof.linear_high = {0, 0.2, 0.5};
  description.six_dof.angular_low = {0, 0, -0.4};
  description.six_dof.angular_high = {0, 0, 0.4};
  description.spring.linear_stiffness = {0, 0, 50.0};
  description.spring.linear_equilibrium = {0, 0, 0.2};
  description.spring.linear_damping = {0, 0, 20.0};
  description.spring.angular_stiffness = {};
  description.spring.angular_damping = {0.5, 0.5, 0.5};
  Body parent(mass_only(0.0, {})), child(mass_only(1.0, {0.02, 0.02, 0.02}));
  Joint joint(description, parent, child);
  World world(weightless(GetParam()));
  world.add(parent);
  world.add(child);
  world.add(joint);
  for (int i = 0; i < 4000; ++i) {
    child.apply_wrench({{1.0, 1.0, 0.0}, {0.2, 0.0, 1.0}});
    world.step();
  }
  const math::Pose pose = child.pose();
  EXPECT_NEAR(pose.position.x, 0.0, 1e-4);
  EXPECT_NEAR(pose.position.y, 0.2, 1e-3);
  EXPECT_NEAR(pose.position.z, 0.2, 1e-3);
  const math::Vec3 turned = math::log(pose.orientation);
  EXPECT_NEAR(turned.z, 0.4, 5e-3);
  EXPECT_NEAR(turned.x, 0.0, 1e-3);
  world.remove(joint);
}

TEST(Joint, CountsFullTurnsOfAContinuousJoint) {
  scene::Joint description;
  Body parent(mass_only(0.0, {})), child(mass_only(1.0, {0.01, 0.01, 0.01}));
  Joint joint(description, parent, child);
  World world(weightless());
  world.add(parent);
  world.add(child);
  world.add(joint);
  joint.set_motor_velocity(-5.0, 1.0);
  for (int i = 0; i < 3000; ++i) world.step();
  EXPECT_NEAR(joint.position(), -15.0, 0.01);
  EXPECT_NEAR(joint.wrapped_position(), -15.0 + 4.0 * kPi, 0.01);
  world.remove(joint);
}

TEST(Joint, ErpAndCfmReachEveryRow) {
  // A hanging load opens a soft joint: gap = F cfm h / (erp A) in every locked direction; a hard one does not open.
  for (const double cfm : {0.0, 0.1}) {
    scene::Joint description;
    description.type = JointType::fixed;
    description.cfm = cfm;
    description.erp = 0.2;
    Body parent(mass_only(0.0, {})), child(mass_only(2.0, {0.1, 0.1, 0.1}));
    Joint joint(description, parent, child);
    WorldOptions options = weightless();
    options.gravity = {0, 0, -10.0};
    World world(options);
    world.add(parent);
    world.add(child);
    world.add(joint);
    for (int i = 0; i < 2000; ++i) world.step();
    // Impulse a step m g h; softness relative to 1/m: velocity g h cfm against erp gap / h.
    EXPECT_NEAR(joint.gap().position, 10.0 * 1e-6 * cfm / 0.2, 1e-9);
    EXPECT_NEAR(joint.reaction_on_child().force.z, 20.0, 1e-4);
    world.remove(joint);
  }
}

TEST(Joint, ScaleMultipliesPivots) {
  scene::Joint description;
  description.parent_pivot = {1, 0, 0};
  description.child_pivot = {0, 1, 0};
  Body parent(mass_only(0.0, {})), child(mass_only(1.0, {0.01, 0.01, 0.01}, {{2.0, -0.5, 0}, {}}));
  Joint joint(description, parent, child, {.parent_scale = 2.0, .child_scale = 0.5});
  EXPECT_LT(joint.gap().position, 1e-12);
}

}  // namespace
}  // namespace ambf::physics
