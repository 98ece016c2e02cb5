// Joints of bodies that turn far within a step.
#include <gtest/gtest.h>

#include "tests/physics/fixtures.h"

namespace ambf::physics {
namespace {

using namespace testing;

// `links` in a row, each hinged about its own axis to the one before at 5 cm from its centre, the first to the world;
// all turn at `rate` (rad/s) about the first hinge.
struct Flail {
  Flail(int links, double rate) : world(weightless()) {
    world.add(base);
    for (int i = 0; i < links; ++i) {
      const double x = 0.05 + 0.1 * i;
      bodies.push_back(std::make_unique<Body>(mass_only(0.1, {3e-5, 6e-5, 8e-5}, {{x, 0.0, 0.0}, {}})));
      world.add(*bodies.back());
      scene::Joint joint;
      joint.type = state::JointType::revolute;
      joint.parent_axis = joint.child_axis = {0.0, 0.0, 1.0};
      joint.parent_pivot = {i == 0 ? 0.0 : 0.05, 0.0, 0.0};
      joint.child_pivot = {-0.05, 0.0, 0.0};
      Body& parent = i == 0 ? base : *bodies[static_cast<std::size_t>(i) - 1];
      joints.push_back(std::make_unique<Joint>(joint, parent, *bodies.back()));
      world.add(*joints.back());
      bodies.back()->set_twist({{0.0, rate * x, 0.0}, {0.0, 0.0, rate}});
    }
  }
  ~Flail() {
    for (auto& joint : joints) world.remove(*joint);
  }
  static WorldOptions weightless() {
    WorldOptions options;
    options.gravity = {};
    return options;
  }
  double gap() const {
    double most = 0.0;
    for (const auto& joint : joints) most = std::max(most, joint->gap().position);
    return most;
  }
  double energy() const {
    double sum = 0.0;
    for (const auto& body : bodies) {
      const math::Twist twist = body->twist();
      const math::Vec3 local = math::rotate(math::inverse(body->com_pose().orientation), twist.angular);
      sum += 0.5 * (body->mass() * math::dot(twist.linear, twist.linear) +
                    math::dot(local, math::scaled(local, body->inertia())));
    }
    return sum;
  }

  World world;
  Body base{mass_only(0.0, {})};
  std::vector<std::unique_ptr<Body>> bodies;
  std::vector<std::unique_ptr<Joint>> joints;
};

// Straight rows alone open by r a^2 / 2: 0.25 mm at 100 rad/s, 2.25 mm at 300 rad/s. The last two turn by more than a
// radian in a step, which is taken in parts: rows of the whole step left 29 and 82 mm.
TEST(FastTurn, AHingeStaysClosed) {
  for (const double rate : {30.0, 100.0, 300.0, 600.0, 1100.0, 1900.0}) {
    Flail flail(1, rate);
    const double before = flail.energy();
    double gap = 0.0;
    for (int step = 0; step < 500; ++step) {
      flail.world.step();
      gap = std::max(gap, flail.gap());
    }
    EXPECT_LT(gap, 0.02e-3) << rate << " rad/s";
    EXPECT_NEAR(flail.energy() / before, 1.0, 0.1) << rate << " rad/s";
    EXPECT_NEAR(flail.bodies[0]->twist().angular.z, rate, 0.06 * rate);
  }
}

TEST(FastTurn, AFlailStaysClosedAndGainsNoEnergy) {
  Flail flail(3, 60.0);
  flail.bodies[2]->set_twist({flail.bodies[2]->twist().linear, {0.0, 0.0, 160.0}});
  flail.world.step();
  const double before = flail.energy();
  double gap = 0.0;
  for (int step = 0; step < 1000; ++step) {
    flail.world.step();
    gap = std::max(gap, flail.gap());
    ASSERT_LT(flail.energy(), 1.2 * before) << "step " << step;
  }
  EXPECT_LT(gap, 0.02e-3);
}

// What slides on a turning body is thrown off along the tangent: a straight row of its limit lets it pass by r a^2 / 2,
// 1 mm at 100 rad/s and 0.2 m.
TEST(FastTurn, ASliderStaysWithinItsLimit) {
  constexpr double kLimit = 0.2, kRate = 100.0;
  World world(Flail::weightless());
  Body base(mass_only(0.0, {})), hub(mass_only(10.0, {0.1, 0.1, 0.1}));
  Body slider(mass_only(0.05, {1e-5, 1e-5, 1e-5}, {{0.1, 0.0, 0.0}, {}}));
  scene::Joint hinge, slide;
  hinge.type = state::JointType::revolute;
  hinge.parent_axis = hinge.child_axis = {0.0, 0.0, 1.0};
  slide.type = state::JointType::prismatic;
  slide.parent_axis = slide.child_axis = {1.0, 0.0, 0.0};
  slide.limits = {0.0, kLimit};
  Joint turning(hinge, base, hub), sliding(slide, hub, slider);
  world.add(base);
  world.add(hub);
  world.add(slider);
  world.add(turning);
  world.add(sliding);
  hub.set_twist({{}, {0.0, 0.0, kRate}});
  slider.set_twist({{0.0, 0.1 * kRate, 0.0}, {0.0, 0.0, kRate}});
  double farthest = 0.0;
  for (int step = 0; step < 300; ++step) {
    world.step();
    farthest = std::max(farthest, sliding.position());
  }
  EXPECT_GT(farthest, kLimit - 1e-3) << "it is thrown outwards";
  EXPECT_LT(farthest, kLimit + 0.05e-3);
  EXPECT_LT(sliding.gap().position, 0.02e-3);
  world.remove(sliding);
  world.remove(turning);
}

// A hand of the peg board: 200 g with two jaws, pushed at its jaws' pin by what its pose controller asks for from 30 m
// away. It turns by 0.95 rad in a step after five, each of them faster than the last by 0.2 rad a step.
TEST(FastTurn, AHandThatAKilonewtonThrowsKeepsItsJaws) {
  World world(Flail::weightless());
  Body hand(mass_only(0.2, {3.4e-4, 3.4e-4, 1.5e-5}));
  std::vector<std::unique_ptr<Body>> jaws;
  std::vector<std::unique_ptr<Joint>> joints;
  const math::Vec3 pin{0.0, 0.0, -0.083};
  world.add(hand);
  for (const double side : {1.0, -1.0}) {
    jaws.push_back(
        std::make_unique<Body>(mass_only(0.006, {2e-7, 2e-7, 7.5e-9}, {pin + math::Vec3{0.0, 0.0, -0.01}, {}})));
    world.add(*jaws.back());
    scene::Joint joint;
    joint.type = state::JointType::revolute;
    joint.parent_axis = joint.child_axis = {side, 0.0, 0.0};
    joint.parent_pivot = pin;
    joint.child_pivot = {0.0, 0.0, 0.01};
    joint.limits = {0.0, 0.6};
    joints.push_back(std::make_unique<Joint>(joint, hand, *jaws.back()));
    world.add(*joints.back());
  }
  const auto energy = [&] {
    double sum = 0.0;
    for (const Body* body : {&hand, jaws[0].get(), jaws[1].get()}) {
      const math::Twist twist = body->twist();
      const math::Vec3 local = math::rotate(math::inverse(body->com_pose().orientation), twist.angular);
      sum += 0.5 * (body->mass() * math::dot(twist.linear, twist.linear) +
                    math::dot(local, math::scaled(local, body->inertia())));
    }
    return sum;
  };
  double gap = 0.0, beyond = 0.0, fastest = 0.0, thrown = 0.0, most = 0.0;
  for (int step = 0; step < 300; ++step) {
    if (step < 5) hand.apply_force({800.0, 1400.0, 0.0}, hand.com_pose() * pin);
    world.step();
    fastest = std::max(fastest, math::norm(hand.twist().angular));
    for (const auto& joint : joints) {
      gap = std::max(gap, joint->gap().position);
      beyond = std::max({beyond, -joint->position(), joint->position() - 0.6});
    }
    if (step == 4) thrown = energy();
    if (step > 4) most = std::max(most, energy());
  }
  EXPECT_GT(fastest, 700.0);
  EXPECT_LT(gap, 0.1e-3) << "6 mm where the step is taken as a whole";
  EXPECT_LT(beyond, 1e-3);
  EXPECT_LT(most, 1.05 * thrown);
  for (auto& joint : joints) world.remove(*joint);
}

// The same hand, which a controller presses against a wall at its jaws' pin while it turns about its own axis. What
// presses would turn it by 0.12 rad in each step, and so by 1.2 mrad about the wall's normal; the wall takes that back.
// The last one begins fast, and rolls until friction stops it.
TEST(FastTurn, AHandThatIsPressedAgainstAWallKeepsItsJaws) {
  constexpr double kRadius = 0.018;  // m
  const math::Vec3 pin{0.0, 0.0, -0.083};
  struct Motion {
    double spin, rolling, friction;  // rad/s; of them as it rolls
  };
  for (const Motion& motion : {Motion{10.0, 0.0, 0.0}, {20.0, 0.0, 0.0}, {21.0, 0.0, 0.0}, {20.1, 20.1, 0.5}}) {
    World world(Flail::weightless());
    scene::PlacedGeometry grip;
    grip.geometry.shape = scene::Shape::cylinder;
    grip.geometry.radius = kRadius;
    grip.geometry.height = 0.2;
    BodyDefinition definition = parameters(0.2, {grip}, {0.0, 0.0, kRadius});
    definition.inertia = math::Vec3{3.4e-4, 3.4e-4, 1.5e-5};
    definition.T_world_body.orientation = math::exp(math::Vec3{0.0, 0.5 * kPi, 0.0});
    definition.surface.friction = motion.friction;
    definition.surface.rolling_friction = definition.surface.restitution = 0.0;
    definition.surface.linear_damping = definition.surface.angular_damping = 0.0;
    Body wall(parameters(0.0, {ground()}, {})), hand(definition);
    const math::Pose at = hand.com_pose();
    BodyDefinition finger = mass_only(0.006, {2e-7, 2e-7, 7.5e-9}, {at * (pin + math::Vec3{0.0, 0.0, -0.01}), {}});
    finger.T_world_body.orientation = at.orientation;
    Body jaw(finger), other_jaw(finger);
    scene::Joint hinge;
    hinge.type = state::JointType::revolute;
    hinge.parent_pivot = pin;
    hinge.child_pivot = {0.0, 0.0, 0.01};
    hinge.limits = {0.0, 0.6};
    hinge.parent_axis = hinge.child_axis = {1.0, 0.0, 0.0};
    Joint joint(hinge, hand, jaw);
    hinge.parent_axis = hinge.child_axis = {-1.0, 0.0, 0.0};
    Joint other_joint(hinge, hand, other_jaw);
    for (Body* body : {&wall, &hand, &jaw, &other_jaw}) world.add(*body);
    for (Body* body : {&hand, &jaw, &other_jaw})
      body->set_twist({{0.0, -kRadius * motion.rolling, 0.0}, {motion.spin, 0.0, 0.0}});
    for (Joint* each : {&joint, &other_joint}) world.add(*each);
    double gap = 0.0, beyond = 0.0;
    for (int step = 0; step < 300; ++step) {
      hand.apply_force({0.0, 0.0, -500.0}, hand.com_pose() * pin);
      world.step();
      for (const Joint* each : {&joint, &other_joint}) {
        gap = std::max(gap, each->gap().position);
        beyond = std::max({beyond, -each->position(), each->position() - 0.6});
      }
    }
    EXPECT_NEAR(hand.twist().angular.x, motion.friction == 0.0 ? motion.spin : 0.0, 0.1);
    EXPECT_LT(gap, 0.01e-3) << "0.06 to 0.12 mm where rows count on what is expected without the wall";
    EXPECT_LT(beyond, 0.1e-3) << "likewise 0.7 to 1.4 mrad";
    world.remove(joint);
    world.remove(other_joint);
  }
}

// The cone of a lamp on its ball joint: what hits it makes it turn by more than half a radian in that very step.
TEST(FastTurn, ABallJointThatIsHitStaysClosed) {
  World world(Flail::weightless());
  Body base(mass_only(0.0, {})), cone(mass_only(0.05, {4.6e-4, 4.6e-4, 2.5e-4}, {{0.0, 0.0, -0.25}, {}}));
  scene::Joint ball;
  ball.type = state::JointType::p2p;
  ball.child_pivot = {0.0, 0.0, 0.25};
  Joint joint(ball, base, cone);
  world.add(base);
  world.add(cone);
  world.add(joint);
  double gap = 0.0, fastest = 0.0;
  for (int step = 0; step < 60; ++step) {
    if (step % 20 == 0) cone.apply_force({2e3, 5e3, 0.0}, cone.com_pose() * math::Vec3{0.05, 0.0, -0.2});
    world.step();
    gap = std::max(gap, joint.gap().position);
    fastest = std::max(fastest, math::norm(cone.twist().angular));
  }
  EXPECT_GT(fastest, 500.0);
  EXPECT_LT(gap, 0.1e-3);
  world.remove(joint);
}

// Parts of a step are as long as it is: what is given for a step (a motor's bound, damping) counts once.
TEST(FastTurn, PartsOfAStepMakeAStep) {
  constexpr double kRate = 900.0, kDamping = 0.5;
  const auto rate_after = [](double damping, double max_impulse) {
    World world(Flail::weightless());
    Body base(mass_only(0.0, {}));
    BodyDefinition definition = mass_only(0.1, {3e-5, 6e-5, 8e-5}, {{0.05, 0.0, 0.0}, {}});
    definition.surface.linear_damping = definition.surface.angular_damping = damping;
    Body link(definition);
    scene::Joint hinge;
    hinge.type = state::JointType::revolute;
    hinge.parent_axis = hinge.child_axis = {0.0, 0.0, 1.0};
    hinge.child_pivot = {-0.05, 0.0, 0.0};
    Joint joint(hinge, base, link);
    world.add(base);
    world.add(link);
    world.add(joint);
    link.set_twist({{0.0, 0.05 * kRate, 0.0}, {0.0, 0.0, kRate}});
    if (max_impulse > 0.0) joint.set_motor_velocity(0.0, max_impulse);
    for (int step = 0; step < 200; ++step) world.step();
    const double rate = joint.velocity();
    world.remove(joint);
    return rate;
  };
  const double free = rate_after(0.0, 0.0);
  EXPECT_NEAR(free, kRate, 0.02 * kRate);
  EXPECT_NEAR(rate_after(kDamping, 0.0) / free, std::pow(1.0 - kDamping, 0.2), 0.005);
  constexpr double kInertia = 8e-5 + 0.1 * 0.05 * 0.05, kImpulse = 2e-4;  // about the hinge; Nms a step
  EXPECT_NEAR(free - rate_after(0.0, kImpulse), 200.0 * kImpulse / kInertia, 5.0);
}

// A shaft of 0.3 kg, with a wrist of 2 g and two jaws of 1 g, over a table; the wrist is pitched and the jaws are yawed
// by so many rad.
struct Wrist {
  Wrist(double pitched, double yawed)
      : wrist(light(0.002, {2e-8, 2e-8, 1e-8}, box(0.005, 0.005, 0.008, {{0.0, 0.0, -0.0045}, {}}), turned(pitched))) {
    for (Body* body : {&base, &table, &shaft, &wrist}) world.add(*body);
    scene::Joint insertion, pitch;
    insertion.type = state::JointType::prismatic;
    insertion.parent_axis = insertion.child_axis = {0.0, 0.0, 1.0};
    insertion.parent_pivot = kAt;
    insertion.limits = {-0.06, 0.01};
    pitch.type = state::JointType::revolute;
    pitch.parent_axis = pitch.child_axis = {1.0, 0.0, 0.0};
    pitch.limits = {-1.4, 1.4};
    joints.push_back(std::make_unique<Joint>(insertion, base, shaft));
    joints.push_back(std::make_unique<Joint>(pitch, shaft, wrist));
    const math::Pose at = turned(pitched) * math::Pose{kPin, math::exp(math::Vec3{0.0, yawed, 0.0})};
    for (const double side : {1.0, -1.0}) {
      const auto blade = box(0.002, 0.004, 0.01, {{0.001 * side, 0.0, -0.005}, {}});
      jaws.push_back(std::make_unique<Body>(light(0.001, {1e-8, 1e-8, 2e-9}, blade, at)));
      world.add(*jaws.back());
      scene::Joint yaw;
      yaw.type = state::JointType::revolute;
      yaw.parent_axis = yaw.child_axis = {0.0, side, 0.0};
      yaw.parent_pivot = kPin;
      yaw.limits = {-1.4, 1.4};
      joints.push_back(std::make_unique<Joint>(yaw, wrist, *jaws.back()));
    }
    for (auto& joint : joints) world.add(*joint);
  }
  ~Wrist() {
    for (auto& joint : joints) world.remove(*joint);
  }
  static math::Pose turned(double pitched) {
    return math::Pose{kAt, math::exp(math::Vec3{0.0, 0.0, 0.7})} *
           math::Pose{{}, math::exp(math::Vec3{pitched, 0.0, 0.0})};
  }
  static BodyDefinition light(double mass, const math::Vec3& inertia, const scene::PlacedGeometry& part,
                              const math::Pose& at) {
    BodyDefinition definition = parameters(mass, {part}, at.position);
    definition.T_world_body.orientation = at.orientation;
    definition.inertia = inertia;
    definition.surface.friction = 0.3;
    definition.surface.linear_damping = definition.surface.angular_damping = 0.0;
    return definition;
  }

  static constexpr math::Vec3 kAt{0.0, 0.0, 0.06}, kPin{0.0, 0.0, -0.009};
  World world;
  Body base{mass_only(0.0, {})}, table{parameters(0.0, {ground()}, {})},
      shaft{mass_only(0.3, {3e-4, 3e-4, 5e-6}, turned(0.0))}, wrist;
  std::vector<std::unique_ptr<Body>> jaws;
  std::vector<std::unique_ptr<Joint>> joints;
};

// It slips off the table as it is pressed on it, and spins between its limits. All rounds of solving leave that wrong,
// and the step is taken in parts; as a whole, jaws pass their limits by up to 29 mrad, and gaps are 0.2 to 0.8 mm.
TEST(FastTurn, AWristThatAShaftPressesOnATableKeepsItsJaws) {
  for (const double pitched : {0.1, 0.102, 0.105}) {
    for (const double yawed : {0.2, 0.3, 0.4, 0.48}) {
      Wrist tool(pitched, yawed);
      double gap = 0.0, beyond = 0.0, fastest = 0.0;
      for (int step = 0; step < 120; ++step) {
        tool.shaft.apply_force({0.0, 0.0, -200.0}, tool.shaft.com_pose().position);
        tool.world.step();
        fastest = std::max(fastest, math::norm(tool.wrist.twist().angular));
        for (const auto& joint : tool.joints) {
          gap = std::max(gap, joint->gap().position);
          beyond =
              std::max({beyond, (*joint->limits())[0] - joint->position(), joint->position() - (*joint->limits())[1]});
        }
      }
      EXPECT_GT(fastest, 100.0);
      EXPECT_LT(gap, 0.05e-3) << pitched << ' ' << yawed;
      EXPECT_LT(beyond, 0.2e-3) << pitched << ' ' << yawed;
    }
  }
}

}  // namespace
}  // namespace ambf::physics
