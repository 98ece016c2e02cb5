// Ropes of light links under heavy loads: geometric stiffness that explicit steps cannot bear.
#include <gtest/gtest.h>

#include <algorithm>

#include "fixtures.h"

namespace ambf::physics::testing {
namespace {

constexpr double kLink = 0.05;  // m
constexpr int kLinks = 40;

// Links of 10 g with a ball below them; taken out to `slope` = sin of the angle from the vertical.
struct Rope {
  Rope(double load, state::JointType type, double slope) {
    const double drop = std::sqrt(1.0 - slope * slope);
    const auto at = [&](double s) { return math::Vec3{s * slope, 0, 5 - s * drop}; };
    const math::Quat rotation = math::from_axis_angle({0, 1, 0}, -std::asin(slope));
    const double across = 0.01 * kLink * kLink / 12.0;
    add(mass_only(0.0, {}, {at(0.0), rotation}));
    for (int i = 0; i < kLinks; ++i) add(mass_only(0.01, {across, across, 1.25e-7}, {at((i + 0.5) * kLink), rotation}));
    const double of_ball = 0.4 * load * 0.01;
    add(mass_only(load, {of_ball, of_ball, of_ball}, {at(kLinks * kLink + 0.1), rotation}));
    for (int i = 1; i <= kLinks + 1; ++i) {
      scene::Joint joint;
      joint.type = type;
      joint.parent_axis = joint.child_axis = i % 2 == 0 ? math::Vec3{1, 0, 0} : math::Vec3{0, 1, 0};
      joint.parent_pivot = {0, 0, i == 1 ? 0.0 : -kLink / 2};
      joint.child_pivot = {0, 0, i == kLinks + 1 ? 0.1 : kLink / 2};
      joint.enable_motor = false;
      joint.damping = 0.0;
      joints.push_back(std::make_unique<Joint>(joint, *bodies[static_cast<std::size_t>(i) - 1], *bodies[i]));
      world.add(*joints.back());
      joints.back()->set_free();
    }
    Body& middle = *bodies[kLinks / 2];
    middle.apply_impulse({0.001, 0.0007, 0}, middle.pose().position);
  }
  ~Rope() {
    for (const auto& joint : joints) world.remove(*joint);
    for (const auto& body : bodies) world.remove(*body);
  }
  void add(const BodyDefinition& body) {
    bodies.push_back(std::make_unique<Body>(body));
    world.add(*bodies.back());
  }
  Body& load() { return *bodies.back(); }

  World world;
  std::vector<std::unique_ptr<Body>> bodies;
  std::vector<std::unique_ptr<Joint>> joints;
};

class Ropes : public ::testing::TestWithParam<state::JointType> {};

TEST_P(Ropes, CarryTenThousandTimesALinksMassAtRest) {
  Rope rope(100.0, GetParam(), 0.0);
  double gap = 0.0;
  for (int i = 0; i < 3000; ++i) {
    rope.world.step();
    for (const auto& joint : rope.joints) gap = std::max(gap, joint->gap().position);
  }
  EXPECT_LT(gap, 1e-5);
  EXPECT_NEAR(rope.load().pose().position.z, 2.9, 1e-3);
  for (const auto& body : rope.bodies) EXPECT_LT(math::norm(body->twist().linear), 0.1);
}

TEST_P(Ropes, SwingWithoutJitterAndKeepTheEnergyOfTheLoad) {
  for (const double load : {10.0, 100.0}) {
    Rope rope(load, GetParam(), 0.8);
    const double top = rope.load().pose().position.z;
    double gap = 0.0, turning = 0.0, off = 0.0;
    for (int i = 0; i < 8000; ++i) {
      rope.world.step();
      for (const auto& joint : rope.joints) gap = std::max(gap, joint->gap().position);
      for (const auto& body : rope.bodies) turning = std::max(turning, math::norm(body->twist().angular));
      const double speed = math::norm(rope.load().twist().linear);
      off = std::max(off, std::abs(0.5 * speed * speed + 9.8 * (rope.load().pose().position.z - top)));
    }
    EXPECT_LT(gap, 1e-4) << load;
    EXPECT_LT(turning, 20.0) << load;
    EXPECT_LT(off, 0.2) << load << ": of 8 J/kg";
  }
}

TEST_P(Ropes, ContinueAlikeAfterASnapshotAndAReset) {
  Rope rope(100.0, GetParam(), 0.8), fresh(100.0, GetParam(), 0.8);
  run(rope.world, 0.3);
  std::vector<std::byte> state;
  rope.world.save_state(state);
  run(rope.world, 0.1);
  ASSERT_TRUE(fresh.world.restore_state(state));
  run(fresh.world, 0.1);
  ASSERT_TRUE(rope.world.restore_state(state));
  run(rope.world, 0.1);
  for (std::size_t i = 0; i < rope.bodies.size(); ++i) {
    EXPECT_EQ(rope.bodies[i]->pose(), fresh.bodies[i]->pose()) << i;
    EXPECT_EQ(rope.bodies[i]->twist().angular, fresh.bodies[i]->twist().angular) << i;
  }
  for (Rope* each : {&rope, &fresh}) each->world.reset();
  run(rope.world, 0.05);
  Rope another(100.0, GetParam(), 0.8);
  another.world.reset();
  run(another.world, 0.05);
  for (std::size_t i = 0; i < rope.bodies.size(); ++i)
    EXPECT_EQ(rope.bodies[i]->pose(), another.bodies[i]->pose()) << i;
}

INSTANTIATE_TEST_SUITE_P(Joints, Ropes, ::testing::Values(state::JointType::revolute, state::JointType::p2p),
                         [](const auto& parameter) {
                           return parameter.param == state::JointType::p2p ? "p2p" : "revolute";
                         });

}  // namespace
}  // namespace ambf::physics::testing
