// Bounces that are passed on within a step: rows of balls, on joints and loose.
#include <gtest/gtest.h>

#include <array>

#include "tests/physics/fixtures.h"

namespace ambf::physics {
namespace {

using namespace testing;

constexpr double kRadius = 0.05;  // m

BodyDefinition ball(double mass, double x, double restitution) {
  BodyDefinition definition = parameters(mass, {sphere(kRadius)}, {x, 0.0, 0.0});
  definition.surface = {0.0, 0.0, restitution, 0.0, 0.0};
  return definition;
}

// Balls that touch, in a row along x; the first comes at 1 m/s. Velocities after the impact.
std::vector<double> after_hit(const std::vector<double>& masses, double restitution, double gap = 0.0) {
  WorldOptions options;
  options.gravity = {};
  World world(options);
  std::vector<std::unique_ptr<Body>> balls;
  for (std::size_t i = 0; i < masses.size(); ++i) {
    balls.push_back(
        std::make_unique<Body>(ball(masses[i], (2.0 * kRadius + gap) * static_cast<double>(i), restitution)));
    world.add(*balls.back());
  }
  balls[0]->set_twist({{1.0, 0.0, 0.0}, {}});
  run(world, 0.2);
  std::vector<double> velocities;
  for (const auto& body : balls) velocities.push_back(body->twist().linear.x);
  return velocities;
}

TEST(Impact, ARowOfEqualBallsThrowsTheLast) {
  for (const double gap : {0.0, 1e-5, 1e-3}) {
    const std::vector<double> v = after_hit({1.0, 1.0, 1.0, 1.0, 1.0}, 1.0, gap);
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(v[static_cast<std::size_t>(i)], 0.0, 1e-6) << "gap " << gap;
    EXPECT_NEAR(v[4], 1.0, 1e-6) << "gap " << gap;
  }
}

// Each pair in turn: v' = (1 + e) m1 / (m1 + m2) v, while slower ones behind do not catch up.
TEST(Impact, LighterAndLighterBallsGetFaster) {
  const double of_a_ball = 0.9, e = of_a_ball * of_a_ball;  // of a pair: the product
  const std::vector<double> v = after_hit({4.0, 2.0, 1.0}, of_a_ball);
  const double second = (1.0 + e) * 4.0 / 6.0, third = (1.0 + e) * 2.0 / 3.0 * second;
  EXPECT_NEAR(v[2], third, 1e-6);
  EXPECT_NEAR(4.0 * v[0] + 2.0 * v[1] + v[2], 4.0, 1e-9);
}

TEST(Impact, WithoutRestitutionARowMovesTogether) {
  for (const double v : after_hit({1.0, 1.0, 1.0}, 0.0)) EXPECT_NEAR(v, 1.0 / 3.0, 1e-3);
}

TEST(Impact, ForcesOfAPassedBounceAreReported) {
  WorldOptions options;
  options.gravity = {};
  World world(options);
  Body a(ball(1.0, 0.0, 1.0)), b(ball(1.0, 0.1, 1.0)), c(ball(1.0, 0.2, 1.0));
  for (Body* body : {&a, &b, &c}) world.add(*body);
  a.set_twist({{1.0, 0.0, 0.0}, {}});
  world.step();
  std::vector<Contact> contacts(4);
  ASSERT_EQ(world.contacts(contacts), 2u);
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(contacts[static_cast<std::size_t>(i)].normal_impulse, 1.0, 1e-9);
  world.step();
  ASSERT_EQ(world.contacts(contacts), 2u);
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(contacts[static_cast<std::size_t>(i)].normal_impulse, 0.0, 1e-9);
}

// Let go at 60 degrees, the first of five hanging balls throws the last one as high, and the others stay.
TEST(Impact, ANewtonsCradleSwings) {
  const double length = 1.0, g = 9.8, start = kPi / 3.0;
  WorldOptions options;
  options.gravity = {0.0, 0.0, -g};
  World world(options);
  Body frame(mass_only(0.0, {}));
  world.add(frame);
  std::vector<std::unique_ptr<Body>> balls;
  std::vector<std::unique_ptr<Joint>> hinges;
  for (int i = 0; i < 5; ++i) {
    BodyDefinition definition = ball(1.0, 0.0, 1.0);
    const double x = 2.0 * kRadius * i, angle = i == 0 ? start : 0.0;
    definition.T_world_body = {{x - length * std::sin(angle), 0.0, -length * std::cos(angle)},
                               math::from_axis_angle({0.0, 1.0, 0.0}, angle)};
    balls.push_back(std::make_unique<Body>(definition));
    world.add(*balls.back());
    scene::Joint hinge;
    hinge.type = state::JointType::revolute;
    hinge.parent_pivot = {x, 0.0, 0.0};
    hinge.child_pivot = {0.0, 0.0, length};
    hinge.parent_axis = hinge.child_axis = {0.0, 1.0, 0.0};
    hinges.push_back(std::make_unique<Joint>(hinge, frame, *balls.back()));
    world.add(*hinges.back());
  }
  run(world, 0.7);  // past the hit at the bottom
  std::array<double, 5> highest{};
  for (int step = 0; step < 700; ++step) {
    world.step();
    for (std::size_t i = 0; i < 5; ++i) highest[i] = std::max(highest[i], std::abs(hinges[i]->position()));
  }
  EXPECT_NEAR(highest[4], start, 0.01);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_LT(highest[i], 0.01) << "ball " << i;
  for (auto& hinge : hinges) world.remove(*hinge);
}

// Motors hold the links against a bounce until they have no strength left. What an impulse does while they hold says
// nothing of what it does afterwards.
TEST(Impact, AnArmWhoseMotorsGiveWayBouncesFromTwoPlacesAtOnce) {
  for (const double strength : {0.03, 0.1, 0.3}) {  // Nms
    WorldOptions options;
    options.gravity = {};
    World world(options);
    Body base(mass_only(0.0, {}));
    BodyDefinition slab = parameters(0.0, {box(2.0, 2.0, 0.1)}, {0.0, 0.0, -0.05});
    slab.surface = {0.0, 0.0, 0.5, 0.0, 0.0};
    Body table(slab);
    world.add(base);
    world.add(table);
    std::vector<std::unique_ptr<Body>> links;
    std::vector<std::unique_ptr<Joint>> hinges;
    const double height = kRadius + 5e-4, turn = 2.0;  // m, rad/s about y: down
    for (int i = 0; i < 2; ++i) {
      BodyDefinition link = ball(0.2, 0.3 * (i + 1), 0.5);
      link.T_world_body.position.z = height;
      links.push_back(std::make_unique<Body>(link));
      world.add(*links.back());
      scene::Joint hinge;
      hinge.type = state::JointType::revolute;
      hinge.parent_axis = hinge.child_axis = {0.0, 1.0, 0.0};
      hinge.parent_pivot = i == 0 ? math::Vec3{0.0, 0.0, height} : math::Vec3{};
      hinge.child_pivot = {-0.3, 0.0, 0.0};
      hinges.push_back(std::make_unique<Joint>(hinge, i == 0 ? base : *links[0], *links.back()));
      world.add(*hinges.back());
      links.back()->set_twist({{0.0, 0.0, -turn * 0.3 * (i + 1)}, {0.0, turn, 0.0}});
    }
    hinges[0]->set_motor_velocity(turn, strength);
    hinges[1]->set_motor_velocity(0.0, strength);
    double fastest = 0.0, fastest_up = 0.0;
    for (int step = 0; step < 60; ++step) {
      world.step();
      for (const auto& link : links) {
        fastest = std::max(fastest, math::norm(link->twist().linear));
        fastest_up = std::max(fastest_up, link->twist().linear.z);
      }
    }
    EXPECT_LT(fastest, 1.5) << "it came at 1.2 m/s; motors of " << strength << " Nms";
    EXPECT_GT(fastest_up, 0.2) << "nothing bounced; motors of " << strength << " Nms";
    for (auto& hinge : hinges) world.remove(*hinge);
  }
}

}  // namespace
}  // namespace ambf::physics
