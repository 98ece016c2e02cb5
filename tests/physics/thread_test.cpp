// Threads: they keep their length, bend as rods do, lose nothing, and hold by friction.
#include "physics/thread.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "physics/soft_grip.h"
#include "tests/physics/fixtures.h"
#include "tests/physics/soft_scene.h"

namespace ambf::physics {
namespace {

using math::Vec3;
using testing::box;
using testing::ground;
using testing::kG;
using testing::parameters;
using testing::Random;
using testing::Scene;

ThreadDefinition straight(const Vec3& from, const Vec3& to, std::size_t segments) {
  ThreadDefinition made;
  for (std::size_t i = 0; i <= segments; ++i)
    made.nodes.push_back(from + (to - from) * (static_cast<double>(i) / static_cast<double>(segments)));
  return made;
}

scene::PlacedGeometry cylinder(double radius, double length, const math::Pose& offset = {}) {
  scene::PlacedGeometry part;
  part.geometry.shape = scene::Shape::cylinder;
  part.geometry.radius = radius;
  part.geometry.height = length;
  part.offset = offset;
  return part;
}

TEST(Thread, KeepsItsLengthUnderTwoNewtons) {
  for (const double young : {0.0, 1e6, 3e9}) {
    ThreadDefinition made = straight({}, {0.1, 0, 0}, 50);
    made.material.young = young;
    made.fixed = {0};
    Scene scene;
    Thread thread(made);
    add(scene.world, thread);
    for (int i = 0; i < 300; ++i) {
      thread.apply_force(50, {0, 0, -2.0});
      scene.step(1);
    }
    EXPECT_GT(thread.length() / thread.rest_length(), 1.0001) << young;
    EXPECT_LT(thread.length() / thread.rest_length(), 1.005) << young;
    EXPECT_NEAR(thread.tension_at(0.05), 2.0, 0.01) << young;
    EXPECT_NEAR(thread.position(50).z, -thread.length(), 1e-4);
    remove(scene.world, thread);
  }
}

TEST(Thread, FallsFreelyAndKeepsMomentum) {
  ThreadDefinition made = straight({}, {0.1, 0, 0}, 40);
  made.material.young = 2e9;
  Scene scene;
  Thread thread(made);
  add(scene.world, thread);
  Random random(3);
  for (std::size_t i = 0; i <= 40; ++i) thread.apply_force(i, random.vector(1e-4));
  scene.step(1);
  const Vec3 start = thread.momentum();
  const Vec3 from = thread.centre().position;
  scene.step(300);
  const Vec3 gained = thread.momentum() - start - Vec3{0, 0, -kG * 0.3} * thread.mass();
  EXPECT_LT(math::norm(gained), 1e-6 * kG * 0.3 * thread.mass());
  const Vec3 expected = start / thread.mass() * 0.3 + Vec3{0, 0, -0.5 * kG * 0.3 * 0.301};
  EXPECT_LT(math::norm(thread.centre().position - from - expected), 1e-6);
  remove(scene.world, thread);
}

TEST(Thread, SpinsOn) {
  ThreadDefinition made = straight({-0.05, 0, 0}, {0.05, 0, 0}, 40);
  made.material.young = 2e9;
  Scene scene({0, 0, 0});
  Thread thread(made);
  add(scene.world, thread);
  std::vector<double> state;
  thread.get_state(state);
  for (std::size_t i = 0; i <= 40; ++i) state[6 * i + 4] = 5.0 * state[6 * i];
  ASSERT_TRUE(thread.set_state(state));
  const Vec3 start = thread.angular_momentum();
  scene.step(1000);
  EXPECT_NEAR(thread.angular_momentum().z / start.z, 1.0, 0.03);
  EXPECT_NEAR(thread.length() / thread.rest_length(), 1.0, 1e-4);
  remove(scene.world, thread);
}

// A rod of modulus E clamped at one end: F L^3 / 3 E I under a force, rho A g L^4 / 8 E I under its own weight.
TEST(Thread, BendsAsABeam) {
  for (const double young : {5e8, 3e9}) {
    const double length = 0.04, radius = 0.0003;
    ThreadDefinition made = straight({}, {length, 0, 0}, 40);
    made.material.young = young;
    made.material.radius = radius;
    made.fixed = {0, 1};
    Scene scene({0, 0, 0});
    Thread thread(made);
    add(scene.world, thread);
    const double stiffness = young * std::numbers::pi * std::pow(radius, 4) / 4.0;
    const double free = length - 0.001, force = 0.05 * 3.0 * stiffness / (free * free);
    for (int i = 0; i < 2000; ++i) {
      thread.apply_force(40, {0, 0, -force});
      scene.step(1);
    }
    EXPECT_NEAR(-thread.position(40).z / (force * std::pow(free, 3) / (3.0 * stiffness)), 1.0, 0.05) << young;
    remove(scene.world, thread);
  }
}

// Between two points at one height, of a length that is not all needed: the sag of a catenary.
TEST(Thread, HangsAsACatenary) {
  const double span = 0.16, length = 0.2;
  double low = 1e-3, high = 1.0;  // of its parameter a: length = 2 a sinh(span / 2 a)
  for (int i = 0; i < 100; ++i) {
    const double a = 0.5 * (low + high);
    (2.0 * a * std::sinh(span / (2.0 * a)) > length ? low : high) = a;
  }
  const double sag = low * (std::cosh(span / (2.0 * low)) - 1.0);
  ThreadDefinition made;
  for (int i = 0; i <= 60; ++i) {
    const double turn = i / 60.0;  // a bend that is as long, near enough: two straight halves
    const double half = std::sqrt(0.25 * length * length - 0.25 * span * span);
    made.nodes.push_back({span * (turn - 0.5), 0, -half * (1.0 - std::abs(2.0 * turn - 1.0))});
  }
  made.material.young = 0.0;
  made.fixed = {0, 60};
  Scene scene;
  Thread thread(made);
  add(scene.world, thread);
  scene.step(3000);
  EXPECT_NEAR(thread.rest_length(), length, 1e-9);
  EXPECT_NEAR(-thread.position(30).z / sag, 1.0, 0.02);
  remove(scene.world, thread);
}

// Around half a cylinder: the end that holds bears e^(mu pi) times what the other pulls by.
TEST(Thread, IsHeldByFrictionOnACylinder) {
  const double peg = 0.01, mu = 0.3;
  Scene scene({0, 0, 0});
  math::Pose lying;
  lying.orientation = math::exp(Vec3{std::numbers::pi / 2, 0, 0});
  Body body(parameters(0.0, {cylinder(peg, 0.05, lying)}, {}));
  scene.world.add(body);
  ThreadDefinition made;
  made.material.radius = 0.0003;
  made.material.young = 1e7;
  made.material.friction = mu / BodyDefinition{}.surface.friction;
  const double around = peg + made.material.radius;
  for (int i = -20; i < 0; ++i) made.nodes.push_back({-around, 0, 0.0015 * i});
  for (int i = 0; i <= 22; ++i) {
    const double turn = std::numbers::pi * i / 22.0;
    made.nodes.push_back({-around * std::cos(turn), 0, around * std::sin(turn)});
  }
  for (int i = 1; i <= 20; ++i) made.nodes.push_back({around, 0, -0.0015 * i});
  Thread thread(made);
  add(scene.world, thread);
  const std::size_t last = made.nodes.size() - 1;
  const double capstan = std::exp(mu * std::numbers::pi);
  const auto slides = [&](double pull) {
    thread.reset();
    double from = 0.0;
    for (int i = 0; i < 250; ++i) {
      thread.apply_force(last, {0, 0, -0.2});
      thread.apply_force(0, {0, 0, -pull});
      scene.step(1);
      if (i == 150) from = thread.position(0).z;
    }
    return from - thread.position(0).z;
  };
  EXPECT_LT(slides(0.2 * capstan * 0.85), 1e-4);
  EXPECT_GT(slides(0.2 * capstan * 1.15), 1e-3);
  EXPECT_GT(thread.contacts(), 10U);
  remove(scene.world, thread);
  scene.world.remove(body);
}

// What hangs on it is felt, and what hangs it feels.
TEST(Thread, CarriesABodyOverAnother) {
  Scene scene;
  math::Pose lying;
  lying.orientation = math::exp(Vec3{std::numbers::pi / 2, 0, 0});
  Body peg(parameters(0.0, {cylinder(0.01, 0.1, lying)}, {0.02, 0, 0}));
  Body weight(parameters(0.02, {box(0.01, 0.01, 0.01)}, {0.0305, 0, -0.05}));
  scene.world.add(peg);
  scene.world.add(weight);
  ThreadDefinition made;
  for (int i = 0; i <= 20; ++i) made.nodes.push_back({-0.03 + 0.003 * i, 0, 0.0105});
  for (int i = 1; i <= 18; ++i) made.nodes.push_back({0.0305, 0, 0.0105 - 0.003 * i});
  made.fixed = {0};
  made.attached = {{static_cast<std::uint32_t>(made.nodes.size() - 1)}};
  made.material.friction = 0.05;
  Thread thread(made);
  add(scene.world, thread);
  thread.attach(0, &weight);
  scene.step(1500);
  Vec3 on_weight{}, on_peg{};
  double tension = 0.0;
  for (int i = 0; i < 500; ++i) {
    scene.step(1);
    on_weight += thread.force_on(weight) / 500.0;
    on_peg += thread.force_on(peg) / 500.0;
    tension += thread.tension_at(0.001) / 500.0;
  }
  const double load = 0.02 * kG;
  EXPECT_NEAR(on_weight.z, load, 0.02 * load);
  EXPECT_NEAR(tension, load, 0.05 * load);
  EXPECT_NEAR(thread.length() / thread.rest_length(), 1.0, 0.005);
  EXPECT_LT(on_peg.z, -0.8 * load);
  EXPECT_GT(on_peg.x, -1.1 * load);
  remove(scene.world, thread);
  scene.world.remove(weight);
  scene.world.remove(peg);
}

TEST(Thread, HangsOnAPointOfABodyAndAnswersSprings) {
  Scene scene({0, 0, 0});
  Body body(parameters(0.01, {box(0.004, 0.004, 0.004)}, {0, 0, 0}));
  scene.world.add(body);
  ThreadDefinition made = straight({0.002, 0, 0}, {0.052, 0, 0}, 25);
  Thread thread(made);
  add(scene.world, thread);
  thread.attach_first(&body, {0.002, 0, 0});
  ThreadSpring spring;
  spring.s = 0.0313;
  spring.anchor = {0.0333, 0, 0.001};
  spring.stiffness = 100.0;
  spring.damping = 1.0;
  spring.axes = ThreadSpring::Axes::across;
  for (int i = 0; i < 50; ++i) {
    const std::size_t number = thread.add_spring(spring);
    scene.step(1);
    EXPECT_EQ(number, 0U);
    EXPECT_LT(std::abs(thread.spring_force(number).x), 0.5 * math::norm(thread.spring_force(number)) + 1e-12);
  }
  EXPECT_GT(thread.position_at(spring.s).z, 0.0005);
  EXPECT_NEAR(thread.tangent_at(spring.s).x, 1.0, 0.1);
  const double before = body.com_pose().position.x;
  for (int i = 0; i < 100; ++i) {
    thread.apply_force_at(0.05, {0.1, 0, 0});
    scene.step(1);
  }
  // Taut, it accelerates the body: 10 m/s^2.
  EXPECT_NEAR(body.com_pose().position.x - before, 0.05, 0.005);
  spring.max_force = 0.01;
  spring.axes = ThreadSpring::Axes::all;
  thread.add_spring(spring);
  scene.step(1);
  EXPECT_NEAR(math::norm(thread.spring_force(0)), 0.01, 1e-9);
  EXPECT_EQ(thread.spring_force(7), Vec3{});
  remove(scene.world, thread);
  scene.world.remove(body);
}

TEST(Thread, IsHeldAndSeenByRays) {
  Scene scene;
  Body hand(parameters(0.0, {box(0.004, 0.004, 0.004)}, {0.05, 0, 0.01}));
  scene.world.add(hand);
  ThreadDefinition made = straight({}, {0.1, 0, 0}, 50);
  made.fixed = {0};
  Thread thread(made);
  add(scene.world, thread);
  const double radius = thread.radius();
  // From below past its surface, and at a node within 1 % of the distance.
  const auto hit = ray_cast_soft(scene.world, {0.051, 0.0, -0.1}, {0.051, 0.0, 0.1});
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(hit->body, &thread);
  EXPECT_EQ(hit->face, 25);
  EXPECT_NEAR(hit->point.z, -radius, 1e-9);
  EXPECT_FALSE(ray_cast_soft(scene.world, {0.051, 0.01, -0.1}, {0.051, 0.01, 0.1}).has_value());
  SoftGripOptions options;
  options.hardness = 500.0;
  options.damping = 1.0;
  SoftGrip grip(options);
  ASSERT_TRUE(grip.hold(hand, thread, 25));
  scene.step(1000);
  // What hangs between the fixed end and the hand, and behind it.
  EXPECT_LT(math::norm(thread.position(25) - grip.target(grip.held()[0])), 1e-3);
  EXPECT_GT(grip.held()[0].force_world.z, 0.3 * thread.mass() * kG);
  EXPECT_LT(grip.held()[0].force_world.z, thread.mass() * kG);
  EXPECT_LT(thread.position(50).z, -0.006);
  remove(scene.world, thread);
  EXPECT_TRUE(grip.held().empty());
  scene.world.remove(hand);
}

// Whatever is done to it, it stays in one piece and comes to rest.
TEST(Thread, SurvivesViolence) {
  for (const double step : {0.001, 0.002}) {
    Scene scene({0, 0, -kG}, step);
    Body floor(parameters(0.0, {ground()}, {}));
    scene.world.add(floor);
    ThreadDefinition made = straight({0, 0, 0.1}, {0.2, 0, 0.1}, 60);
    made.material.young = 1e9;
    Thread thread(made);
    add(scene.world, thread);
    Random random(7);
    double longest = 0.0;
    for (int i = 0; i < 300; ++i) {
      const auto node = static_cast<std::size_t>(random(0.0, 60.99));
      thread.apply_force(node, random.vector(0.02));
      scene.step(1);
      ASSERT_FALSE(thread.divergence().has_value()) << step << " " << i;
      longest = std::max(longest, thread.length() / thread.rest_length());
    }
    EXPECT_LT(longest, 1.1) << step;
    // As it is then, but at rest and just above the floor.
    std::vector<double> state;
    thread.get_state(state);
    double lowest = 1e9;
    for (std::size_t i = 0; i <= 60; ++i) lowest = std::min(lowest, state[6 * i + 2]);
    for (std::size_t i = 0; i <= 60; ++i) {
      state[6 * i + 2] += 0.005 - lowest;
      for (std::size_t k = 3; k < 6; ++k) state[6 * i + k] = 0.0;
    }
    ASSERT_TRUE(thread.set_state(state));
    for (int i = 0; i < static_cast<int>(1.5 / step); ++i) scene.step(1);
    double fastest = 0.0;
    for (std::size_t i = 0; i <= 60; ++i) fastest = std::max(fastest, math::norm(thread.velocity(i)));
    EXPECT_LT(fastest, 0.02) << step;
    EXPECT_NEAR(thread.length() / thread.rest_length(), 1.0, 1e-3) << step;
    EXPECT_LT(thread.position(30).z, 0.01);
    remove(scene.world, thread);
    scene.world.remove(floor);
  }
}

TEST(Thread, RepeatsAndContinuesToTheBit) {
  std::vector<double> first, second, third;
  for (std::vector<double>* out : {&first, &second}) {
    Scene scene;
    Body peg(parameters(0.0, {cylinder(0.01, 0.1)}, {0.03, 0.012, -0.02}));
    Body weight(parameters(0.01, {box(0.004, 0.004, 0.004)}, {0.1, 0, 0}));
    scene.world.add(peg);
    scene.world.add(weight);
    ThreadDefinition made = straight({}, {0.1, 0, 0}, 40);
    made.fixed = {0};
    made.attached = {{40}};
    Thread thread(made);
    add(scene.world, thread);
    thread.attach(0, &weight);
    scene.step(200);
    std::vector<std::byte> saved;
    scene.world.save_state(saved);
    std::vector<double> nodes;
    thread.get_state(nodes);
    scene.step(200);
    thread.get_state(*out);
    scene.world.restore_state(saved);
    ASSERT_TRUE(thread.set_state(nodes));
    scene.step(200);
    thread.get_state(third);
    EXPECT_EQ(*out, third);
    remove(scene.world, thread);
    scene.world.remove(weight);
    scene.world.remove(peg);
  }
  EXPECT_EQ(first, second);
}

}  // namespace
}  // namespace ambf::physics
