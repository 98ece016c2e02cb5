// Joints that follow others: both ways, in chains, momentum kept, and the same after a restart.
#include <gtest/gtest.h>

#include <vector>

#include "tests/physics/fixtures.h"

namespace ambf::physics {
namespace {

using namespace testing;
using state::JointType;

// A palm of 1 kg, static or free, and fingers of 0.1 kg that reach 0.1 m along x, hinged about z at y = +-0.05.
struct Gripper {
  explicit Gripper(bool free_palm) {
    WorldOptions options;
    options.gravity = {};
    options.sleeping = false;
    world = std::make_unique<World>(options);
    bodies.push_back(std::make_unique<Body>(mass_only(free_palm ? 1.0 : 0.0, {0.01, 0.02, 0.03})));
  }
  ~Gripper() {
    world.reset();
    joints.clear();
  }

  Joint& finger(std::size_t parent, const math::Vec3& pivot, JointType type = JointType::revolute) {
    scene::Joint hinge;
    hinge.type = type;
    hinge.parent_axis = hinge.child_axis = {0, 0, 1};
    hinge.parent_pivot = pivot;
    hinge.child_pivot = {-0.05, 0, 0};
    const math::Vec3 at = bodies[parent]->pose().position + pivot + math::Vec3{0.05, 0, 0};
    bodies.push_back(std::make_unique<Body>(mass_only(0.1, {1e-4, 1e-4, 1e-4}, {at, {}})));
    joints.push_back(std::make_unique<Joint>(hinge, *bodies[parent], *bodies.back()));
    return *joints.back();
  }
  void begin() {
    for (const auto& body : bodies) world->add(*body);
    for (const auto& joint : joints) world->add(*joint);
  }
  // A force at the tip of a finger, across it.
  void push(std::size_t finger, double force) {
    Body& body = *bodies[finger];
    const math::Vec3 across = math::rotate(body.pose().orientation, {0, force, 0});
    const math::Vec3 arm = math::rotate(body.pose().orientation, {0.05, 0, 0});
    body.apply_wrench({across, math::cross(arm, across)});
  }

  std::vector<std::unique_ptr<Body>> bodies;
  std::vector<std::unique_ptr<Joint>> joints;
  std::unique_ptr<World> world;
};

TEST(Mimic, HoldsUnderALoadOnEitherFinger) {
  for (const bool free_palm : {false, true}) {
    for (const std::size_t loaded : {1U, 2U}) {
      Gripper gripper(free_palm);
      Joint& leader = gripper.finger(0, {0, 0.05, 0});
      Joint& follower = gripper.finger(0, {0, -0.05, 0});
      follower.follow(leader, -1.0, 0.0);
      gripper.begin();
      leader.set_servo({.position = 0.2, .stiffness = 1000.0, .damping = 10.0});
      double largest = 0.0;
      for (int i = 0; i < 500; ++i) {
        gripper.push(loaded, 10.0);
        gripper.world->step();
        largest = std::max(largest, std::abs(follower.position() + leader.position()));
      }
      EXPECT_LT(largest, 1e-4) << "free palm " << free_palm << ", loaded finger " << loaded;
      EXPECT_GT(std::abs(leader.position()), 0.1);
    }
  }
}

TEST(Mimic, TheLeaderFeelsTheFollower) {
  Gripper gripper(false);
  Joint& leader = gripper.finger(0, {0, 0.05, 0});
  Joint& follower = gripper.finger(0, {0, -0.05, 0});
  follower.follow(leader, -2.0, 0.3);
  gripper.begin();
  for (int i = 0; i < 300; ++i) gripper.world->step();
  EXPECT_NEAR(follower.position(), -2.0 * leader.position() + 0.3, 1e-6) << "it goes to its place";
  follower.set_servo({.position = -0.5, .stiffness = 100.0, .damping = 1.0});
  for (int i = 0; i < 1000; ++i) gripper.world->step();
  EXPECT_NEAR(follower.position(), -0.5, 1e-3);
  EXPECT_NEAR(leader.position(), 0.4, 1e-3) << "its own drive moves the other";
}

TEST(Mimic, ChainsAndShifts) {
  Gripper gripper(false);
  Joint& first = gripper.finger(0, {});
  Joint& second = gripper.finger(1, {0.05, 0, 0});                       // on the first finger
  Joint& third = gripper.finger(2, {0.05, 0, 0}, JointType::prismatic);  // and on that one
  third.follow(second, 0.1, 0.02);
  second.follow(first, 0.5, 0.0);
  gripper.begin();
  first.set_servo({.position = 0.6, .stiffness = 100.0, .damping = 1.0});
  for (int i = 0; i < 1500; ++i) gripper.world->step();
  EXPECT_NEAR(first.position(), 0.6, 1e-3);
  EXPECT_NEAR(second.position(), 0.5 * first.position(), 1e-5);
  EXPECT_NEAR(third.position(), 0.1 * second.position() + 0.02, 1e-5);
}

TEST(Mimic, KeepsMomentumWhereNothingIsFixed) {
  Gripper gripper(true);
  Joint& leader = gripper.finger(0, {0, 0.05, 0});
  Joint& follower = gripper.finger(0, {0, -0.05, 0});
  follower.follow(leader, 0.7, 0.0);
  gripper.begin();
  const auto momentum = [&gripper] {
    math::Vec3 angular, linear;
    for (const auto& body : gripper.bodies) {
      const math::Twist twist = body->twist();
      const double mass = body == gripper.bodies[0] ? 1.0 : 0.1;
      const double inertia = body == gripper.bodies[0] ? 0.03 : 1e-4;
      linear = linear + twist.linear * mass;
      angular = angular + math::cross(body->pose().position, twist.linear) * mass +
                math::Vec3{0, 0, inertia * twist.angular.z};
    }
    return std::pair{linear, angular};
  };
  gripper.bodies[1]->set_twist({{0, 0.25, 0}, {0, 0, 5}});  // the leading finger turns about its hinge
  const auto [linear, angular] = momentum();
  for (int i = 0; i < 200; ++i) gripper.world->step();
  EXPECT_GT(std::abs(leader.position()), 0.05);
  EXPECT_NEAR(follower.position(), 0.7 * leader.position(), 1e-5);
  EXPECT_LT(math::norm(momentum().first - linear), 1e-6 * math::norm(linear));
  EXPECT_LT(math::norm(momentum().second - angular), 1e-4 * math::norm(angular));
}

TEST(Mimic, EndsWithItsLeaderAndOutlivesARestart) {
  const auto moved = [](Gripper& gripper, int steps) {
    for (int i = 0; i < steps; ++i) {
      gripper.push(1, 0.1);
      gripper.world->step();
    }
  };
  const auto make = [] {
    auto gripper = std::make_unique<Gripper>(true);
    Joint& leader = gripper->finger(0, {0, 0.05, 0});
    gripper->finger(0, {0, -0.05, 0}).follow(leader, -1.0, 0.0);
    gripper->begin();
    return gripper;
  };
  const auto a = make(), b = make();
  moved(*a, 100);
  std::vector<std::byte> saved;
  a->world->save_state(saved);
  ASSERT_TRUE(b->world->restore_state(saved));
  moved(*a, 100), moved(*b, 100);
  for (std::size_t i = 0; i < a->bodies.size(); ++i) EXPECT_EQ(a->bodies[i]->pose(), b->bodies[i]->pose()) << i;
  EXPECT_NEAR(b->joints[1]->position(), -b->joints[0]->position(), 1e-5);

  a->world->remove(*a->joints[0]);
  const double before = a->joints[1]->velocity();
  a->joints[1]->set_effort(0.01);
  moved(*a, 200);
  EXPECT_GT(a->joints[1]->velocity() - before, 3.0) << "it is free now";
}

}  // namespace
}  // namespace ambf::physics
