// Limits that are far away at a step's start and would be passed within it.
#include <gtest/gtest.h>

#include <array>

#include "tests/physics/fixtures.h"

namespace ambf::physics {
namespace {

using namespace testing;
using state::JointType;

constexpr double kH = 1e-3;               // s
constexpr double kAsExactly = 1e-6;       // rad or m
constexpr double kLight = 1e-7;           // kg m^2: a jaw
constexpr std::array kLimits{-0.5, 0.7};  // rad or m

WorldOptions weightless() {
  WorldOptions options;
  options.gravity = {};
  options.sleeping = false;
  return options;
}

scene::Joint joint_of(JointType type, const std::optional<std::array<double, 2>>& limits = kLimits) {
  scene::Joint joint;
  joint.type = type;
  joint.parent_axis = joint.child_axis = {0.0, 0.0, 1.0};
  joint.limits = limits;
  return joint;
}

double beyond(const Joint& joint) {
  return std::max((*joint.limits())[0] - joint.position(), joint.position() - (*joint.limits())[1]);
}

TEST(PassedLimit, AnEffortThatCrossesTheRangeInAStepEndsAtTheLimit) {
  for (const JointType type : {JointType::revolute, JointType::prismatic}) {
    for (const double sign : {1.0, -1.0}) {
      World world(weightless());
      Body base(mass_only(0.0, {})), jaw(mass_only(1e-3, {kLight, kLight, kLight}));
      Joint joint(joint_of(type), base, jaw);
      world.add(base);
      world.add(jaw);
      world.add(joint);
      const double inertia = type == JointType::revolute ? kLight : 1e-3;
      const double effort = 2.0 * inertia / (kH * kH);  // 2 rad or m within a step
      joint.set_effort(sign * effort);
      world.step();
      EXPECT_NEAR(joint.position(), sign > 0.0 ? 0.7 : -0.5, kAsExactly);
      // What motor and limit give together is what the link took on.
      EXPECT_NEAR(joint.effort() * kH, inertia * joint.velocity(), 1e-9 * effort);
      for (int i = 0; i < 50; ++i) {
        world.step();
        EXPECT_LT(beyond(joint), kAsExactly);
      }
      world.remove(joint);
    }
  }
}

// The link in the middle is turned; the light one behind it has no motor, and would stay where it is.
TEST(PassedLimit, AnEffortOfANeighbourTakesNoJointPastItsLimit) {
  World world(weightless());
  Body base(mass_only(0.0, {})), middle(mass_only(0.01, {1e-6, 1e-6, 1e-6})), last(mass_only(0.01, {1e-6, 1e-6, 1e-6}));
  Joint driven(joint_of(JointType::revolute, std::nullopt), base, middle),
      loose(joint_of(JointType::revolute), middle, last);
  for (Body* body : {&base, &middle, &last}) world.add(*body);
  world.add(driven);
  world.add(loose);
  driven.set_effort(2.0);
  world.step();
  EXPECT_GT(driven.velocity(), 600.0);
  for (int i = 0; i < 20; ++i) {
    driven.set_effort(i % 2 == 0 ? -4.0 : 4.0);
    EXPECT_LT(beyond(loose), kAsExactly) << "step " << i;
    world.step();
  }
  world.remove(driven);
  world.remove(loose);
}

TEST(PassedLimit, AHitTakesNoJointPastItsLimit) {
  World world(weightless());
  Body base(mass_only(0.0, {}));
  BodyDefinition plate = parameters(1e-3, {box(0.02, 0.002, 0.002)}, {});
  plate.inertia = math::Vec3{kLight, kLight, kLight};
  BodyDefinition hammer = parameters(1.0, {sphere(0.005)}, {0.009, -0.0062, 0.0});
  Body jaw(plate), ball(hammer);
  Joint joint(joint_of(JointType::revolute), base, jaw);
  for (Body* body : {&base, &jaw, &ball}) world.add(*body);
  world.add(joint);
  ball.set_twist({{0.0, 20.0, 0.0}, {}});
  double farthest = -1.0, turned = 0.0;
  for (int i = 0; i < 10; ++i) {
    world.step();
    farthest = std::max(farthest, beyond(joint));
    turned = std::max(turned, std::abs(joint.position()));
  }
  EXPECT_GT(turned, 0.4) << "it was not hit";
  EXPECT_LT(farthest, kAsExactly);
  world.remove(joint);
}

// Limits that nothing comes near are as none, to the bit.
TEST(PassedLimit, FarLimitsDoNothing) {
  std::vector<double> motion[2];
  for (const bool limited : {false, true}) {
    World world;
    Body base(mass_only(0.0, {}));
    world.add(base);
    std::vector<std::unique_ptr<Body>> links;
    std::vector<std::unique_ptr<Joint>> joints;
    for (int i = 0; i < 4; ++i) {
      links.push_back(std::make_unique<Body>(mass_only(0.3, {1e-4, 2e-4, 3e-4}, {{0.1 * (i + 1), 0.0, 0.0}, {}})));
      scene::Joint joint = joint_of(JointType::revolute, std::nullopt);
      joint.parent_axis = joint.child_axis = i % 2 == 0 ? math::Vec3{0.0, 1.0, 0.0} : math::Vec3{0.0, 0.6, 0.8};
      joint.parent_pivot = {0.05, 0.0, 0.0};
      joint.child_pivot = {-0.05, 0.0, 0.0};
      if (limited) joint.limits = std::array{-40.0, 40.0};
      world.add(*links.back());
      joints.push_back(
          std::make_unique<Joint>(joint, i == 0 ? base : *links[static_cast<std::size_t>(i) - 1], *links.back()));
      world.add(*joints.back());
    }
    for (int step = 0; step < 300; ++step) {
      joints[1]->set_motor_velocity(3.0 * std::sin(0.01 * step), 0.01);
      joints[3]->set_effort(0.01 * std::cos(0.02 * step));
      world.step();
      for (const auto& link : links) {
        const math::Pose pose = link->pose();
        for (const double value :
             {pose.position.x, pose.position.y, pose.position.z, pose.orientation.w, link->twist().angular.x})
          motion[limited ? 1 : 0].push_back(value);
      }
      for (const auto& joint : joints) motion[limited ? 1 : 0].push_back(joint->effort());
    }
    for (auto& joint : joints) world.remove(*joint);
  }
  EXPECT_EQ(motion[0], motion[1]);
}

// A link whose tip is 5 mm inside a fixed box would be pushed out by 50 mrad; 2 mrad from its limit it stays inside.
TEST(PassedLimit, PushesOutOfDepthStopThere) {
  constexpr double kLimit = 0.002, kDepth = 0.005;
  WorldOptions options;
  options.gravity = {};
  World world(options);
  Body base(mass_only(0.0, {})), wall(parameters(0.0, {box(0.04, 0.04, 0.04)}, {0.1, -0.025 + kDepth, 0.0}));
  Body link(parameters(0.05, {sphere(0.005, {{0.1, 0.0, 0.0}, {}})}, {}));
  scene::Joint hinge;
  hinge.type = state::JointType::revolute;
  hinge.parent_axis = hinge.child_axis = {0.0, 0.0, 1.0};
  hinge.limits = {-1.0, kLimit};
  Joint joint(hinge, base, link);
  for (Body* body : {&base, &wall, &link}) world.add(*body);
  world.add(joint);
  double farthest = 0.0;
  for (int step = 0; step < 200; ++step) {
    world.step();
    farthest = std::max(farthest, joint.position());
  }
  EXPECT_GT(farthest, 0.5 * kLimit) << "it is pushed";
  EXPECT_LT(farthest, kLimit + 2e-5);
  world.remove(joint);
}

}  // namespace
}  // namespace ambf::physics
