// Motion between impulses: free flight, spin, joints that turn fast, and what a twist means.
#include <gtest/gtest.h>

#include "tests/physics/fixtures.h"

namespace ambf::physics {
namespace {

using namespace testing;

WorldOptions in(const math::Vec3& gravity, double h = 0.001) {
  WorldOptions options;
  options.gravity = gravity;
  options.step = h;
  options.sleeping = false;
  return options;
}

double kinetic(const Body& body) {
  const math::Twist twist = body.twist();
  const math::Vec3 local = math::rotate(math::inverse(body.com_pose().orientation), twist.angular);
  return 0.5 * body.mass() * math::dot(twist.linear, twist.linear) +
         0.5 * math::dot(local, math::scaled(local, body.inertia()));
}

scene::Joint ball(const math::Vec3& parent_pivot, const math::Vec3& child_pivot) {
  scene::Joint joint;
  joint.type = state::JointType::p2p;
  joint.parent_pivot = parent_pivot;
  joint.child_pivot = child_pivot;
  return joint;
}

struct Spin {
  const char* name;
  math::Vec3 inertia, omega;
};

class FreeSpin : public ::testing::TestWithParam<Spin> {};

TEST_P(FreeSpin, KeepsMomentumAndEnergy) {
  World world(in({}));
  Body body(mass_only(2.0, GetParam().inertia));
  world.add(body);
  body.set_twist({{}, GetParam().omega});
  const Momentum before = momentum({&body});
  const double energy = kinetic(body);
  for (int i = 0; i < 4000; ++i) {
    world.step();
    ASSERT_NEAR(kinetic(body) / energy, 1.0, 1e-7) << "step " << i;
  }
  const Momentum after = momentum({&body});
  EXPECT_LT(math::norm(after.angular - before.angular), 1e-10 * math::norm(before.angular));
}

INSTANTIATE_TEST_SUITE_P(Bodies, FreeSpin,
                         ::testing::Values(Spin{"ScpetersBox", {8.083, 6.833, 1.417}, {0.1, 5.0, 0.1}},
                                           Spin{"FastAndUneven", {2e-3, 1e-3, 3e-3}, {10.0, 5.0, 200.0}},
                                           Spin{"Needle", {1e-6, 1e-4, 1e-4}, {100.0, 3.0, 1.0}},
                                           Spin{"Ball", {1.0, 1.0, 1.0}, {300.0, -20.0, 5.0}}),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

TEST(FreeMotion, AThrownBodyKeepsItsEnergyAtEveryInstant) {
  const double g = 9.8;
  World world(in({0.0, 0.0, -g}));
  Body body(mass_only(2.0, {0.01, 0.02, 0.03}));
  world.add(body);
  body.set_twist({{1.0, 0.0, 5.0}, {1.0, 2.0, 3.0}});
  const double energy = kinetic(body);
  for (int i = 1; i <= 2000; ++i) {
    world.step();
    const double t = 0.001 * i;
    ASSERT_NEAR(body.pose().position.z, 5.0 * t - 0.5 * g * t * t, 1e-9);
    ASSERT_NEAR(kinetic(body) + body.mass() * g * body.pose().position.z, energy, 1e-7 * energy);
  }
}

// What balances gravity acts as gravity does: in full at the start of each step it would lift the body by 4.9 mm a
// second.
TEST(FreeMotion, AForceThatHoldsABodyUpMovesItNowhere) {
  const double g = 9.8;
  for (const double share : {1.0, 0.5}) {
    World world(in({0.0, 0.0, -g}));
    Body body(mass_only(2.0, {0.01, 0.02, 0.03}));
    world.add(body);
    for (int i = 0; i < 1000; ++i) {
      body.apply_wrench({{0.0, 0.0, share * 2.0 * g}, {}});
      world.step();
    }
    EXPECT_NEAR(body.com_pose().position.z, -0.5 * (1.0 - share) * g, 1e-9) << share;
    EXPECT_NEAR(body.twist().linear.z, -(1.0 - share) * g, 1e-9) << share;
  }
}

// Damping acts on both sides of a step's middle, so that falling against it is of second order, too.
TEST(FreeMotion, ADampedFallConvergesWithTheSquareOfTheStep) {
  const auto error = [](double h) {
    const double g = 9.8, c = -std::log(1.0 - 0.9);
    World world(in({0.0, 0.0, -g}, h));
    BodyDefinition definition = mass_only(1.0, {1.0, 1.0, 1.0});
    definition.surface.linear_damping = 0.9;  // of the velocity a second
    Body body(definition);
    world.add(body);
    run(world, 1.0);
    return std::abs(body.pose().position.z + g / c * (1.0 - (1.0 - std::exp(-c)) / c));
  };
  EXPECT_LT(error(1e-3), error(1e-2) / 80.0);
}

TEST(FreeMotion, ATwistThatIsSetIsThatOfTheInstant) {
  World world(in({0.0, 0.0, -9.8}));
  Body body(mass_only(1.0, {1.0, 1.0, 1.0}));
  world.add(body);
  run(world, 0.1);
  body.set_pose({});
  body.set_twist({{0.0, 0.0, 2.0}, {}});
  run(world, 0.5);
  EXPECT_NEAR(body.pose().position.z, 2.0 * 0.5 - 0.5 * 9.8 * 0.25, 1e-9);
  EXPECT_NEAR(body.twist().linear.z, 2.0 - 9.8 * 0.5, 1e-9);
}

// What lies is pressed on the floor by its weight from the second step on, and does not move in the first.
TEST(FreeMotion, ABodyThatIsLoadedOnTheFloorStays) {
  World world(in({0.0, 0.0, -9.8}));
  Body floor(parameters(0.0, {ground()}, {})), cube(parameters(1.0, {box(0.1, 0.1, 0.1)}, {0.0, 0.0, 0.05}));
  world.add(floor);
  world.add(cube);
  for (int i = 0; i < 200; ++i) {
    world.step();
    ASSERT_NEAR(cube.pose().position.z, 0.05, 1e-6);
    ASSERT_LT(math::norm(cube.twist().linear), 1e-5);
  }
  std::vector<Contact> contacts(16);
  contacts.resize(world.contacts(contacts));
  double weight = 0.0;
  for (const Contact& contact : contacts) weight += contact.normal_impulse / 0.001;
  EXPECT_NEAR(weight, 9.8, 1e-3);
}

// A fast top precesses; with Bullet's rotation it fell over. Momentum about the vertical is kept by gravity.
TEST(FreeMotion, AFastTopKeepsUp) {
  World world(in({0.0, 0.0, -9.8}));
  Body post(mass_only(0.0, {}));
  const math::Quat leaning = math::from_axis_angle({1.0, 0.0, 0.0}, kPi / 6.0);
  Body top(mass_only(1.0, {1.6e-3, 1.6e-3, 3.2e-3}, {math::rotate(leaning, {0.0, 0.0, 0.1}), leaning}));
  Joint tip(ball({}, {0.0, 0.0, -0.1}), post, top);
  for (Body* body : {&post, &top}) world.add(*body);
  world.add(tip);
  top.set_twist({{}, math::rotate(leaning, {0.0, 0.0, 100.0})});
  double low = kPi, high = 0.0, gap = 0.0;
  for (int i = 0; i < 4000; ++i) {
    world.step();
    const double tilt = std::acos(math::rotate(top.com_pose().orientation, {0.0, 0.0, 1.0}).z);
    low = std::min(low, tilt);
    high = std::max(high, tilt);
    gap = std::max(gap, tip.gap().position);
  }
  EXPECT_NEAR(low, kPi / 6.0, 2e-3);
  // Where energy and the two momenta allow no more: a quadratic equation for the cosine of the tilt.
  const double across = 1.6e-3 + 0.01, spin = 3.2e-3 * 100.0, moment = 0.98, start = std::cos(kPi / 6.0);
  const double q = spin * spin / (4.0 * across * moment);
  const double turning_point = q - std::sqrt(q * q - 2.0 * q * start + 1.0);
  EXPECT_NEAR(high, std::acos(turning_point), 2e-3);
  EXPECT_LT(gap, 2e-6);
}

TEST(FreeMotion, APendulumConvergesWithTheSquareOfTheStep) {
  const auto angle = [](double h) {
    World world(in({0.0, 0.0, -9.8}, h));
    Body post(mass_only(0.0, {})), bob(mass_only(1.0, {0.01, 0.02, 0.03}, {{1.0, 0.0, 0.0}, {}}));
    scene::Joint description = ball({}, {-1.0, 0.0, 0.0});
    description.type = state::JointType::revolute;
    description.parent_axis = description.child_axis = {0.0, 1.0, 0.0};
    Joint hinge(description, post, bob);
    for (Body* body : {&post, &bob}) world.add(*body);
    world.add(hinge);
    run(world, 2.0);
    return hinge.position();
  };
  const double fine = angle(1e-4), middle = angle(1e-3), coarse = angle(1e-2);
  EXPECT_LT(std::abs(middle - fine), std::abs(coarse - fine) / 80.0);
  EXPECT_LT(std::abs(middle - fine), 1e-4);
}

// Its tension must not count as a stiff spring: it turns about a fixed point.
TEST(FreeMotion, APendulumWithItsMassInAPointConverges) {
  const auto angle = [](double h) {
    World world(in({0.0, 0.0, -9.8}, h));
    Body post(mass_only(0.0, {})), bob(mass_only(1.0, {1e-6, 1e-6, 1e-6}, {{1.0, 0.0, 0.0}, {}}));
    scene::Joint description = ball({}, {-1.0, 0.0, 0.0});
    description.type = state::JointType::revolute;
    description.parent_axis = description.child_axis = {0.0, 1.0, 0.0};
    Joint hinge(description, post, bob);
    for (Body* body : {&post, &bob}) world.add(*body);
    world.add(hinge);
    run(world, 2.0);
    return hinge.position();
  };
  EXPECT_NEAR(angle(2e-4), angle(1e-4), 1e-5);
}

TEST(FreeMotion, ASnapshotInFlightContinuesBitForBit) {
  const auto make = [](World& world, Body& flying, Body& swinging, Body& post, Joint& joint) {
    for (Body* body : {&post, &flying, &swinging}) world.add(*body);
    world.add(joint);
  };
  const auto definition = [](double x) { return mass_only(1.0, {0.01, 0.02, 0.03}, {{x, 0.0, 0.0}, {}}); };
  World world(in({0.0, 0.0, -9.8})), other(in({0.0, 0.0, -9.8}));
  Body post(mass_only(0.0, {})), flying(definition(5.0)), swinging(definition(1.0));
  Body post2(mass_only(0.0, {})), flying2(definition(5.0)), swinging2(definition(1.0));
  Joint joint(ball({}, {-1.0, 0.0, 0.0}), post, swinging), joint2(ball({}, {-1.0, 0.0, 0.0}), post2, swinging2);
  make(world, flying, swinging, post, joint);
  make(other, flying2, swinging2, post2, joint2);
  flying.set_twist({{1.0, 2.0, 3.0}, {10.0, 20.0, 30.0}});
  run(world, 0.3);
  std::vector<std::byte> state;
  world.save_state(state);
  ASSERT_TRUE(other.restore_state(state));
  run(world, 0.3);
  run(other, 0.3);
  EXPECT_EQ(flying.pose(), flying2.pose());
  EXPECT_EQ(swinging.pose(), swinging2.pose());
  EXPECT_EQ(flying.twist().angular, flying2.twist().angular);
  EXPECT_EQ(swinging.twist().linear, swinging2.twist().linear);
}

}  // namespace
}  // namespace ambf::physics
