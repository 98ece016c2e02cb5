// What is joined to something immovable and stands in the floor: the joint holds, the contact gives. Depth that joints
// allow to leave is left gently; depth that they do not allow stays, and nothing winds up meanwhile.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

#include "tests/physics/fixtures.h"

namespace ambf::physics {
namespace {

using namespace testing;

constexpr double kMillimetre = 1e-3;
constexpr double kGravity = 9.8;

scene::Joint joint(state::JointType type, const math::Vec3& axis, const math::Vec3& parent, const math::Vec3& child) {
  scene::Joint result;
  result.type = type;
  result.parent_axis = result.child_axis = axis;
  result.parent_pivot = parent;
  result.child_pivot = child;
  return result;
}

WorldOptions awake() {
  WorldOptions options;
  options.sleeping = false;
  return options;
}

// A floor, a post in the air, and what a test adds.
struct Scene {
  Scene() {
    add(parameters(0.0, {ground()}, {}));
    add(mass_only(0.0, {}, {{0, 0, 0.5}, {}}));
  }
  Body& add(const BodyDefinition& p) {
    bodies.push_back(std::make_unique<Body>(p));
    world.add(*bodies.back());
    return *bodies.back();
  }
  Joint& join(const scene::Joint& description, Body& parent, Body& child) {
    joints.push_back(std::make_unique<Joint>(description, parent, child));
    world.add(*joints.back());
    return *joints.back();
  }
  Body& post() { return *bodies[1]; }

  double force() const {  // of all contacts, N
    std::array<Contact, 32> contacts;
    double sum = 0.0;
    for (std::size_t i = 0; i < std::min(world.contacts(contacts), contacts.size()); ++i)
      sum += contacts[i].normal_impulse / world.options().step;
    return sum;
  }
  double depth() const {
    std::array<Contact, 32> contacts;
    double largest = 0.0;
    for (std::size_t i = 0; i < std::min(world.contacts(contacts), contacts.size()); ++i)
      largest = std::max(largest, -contacts[i].distance);
    return largest;
  }

  World world{awake()};
  std::vector<std::unique_ptr<Body>> bodies;
  std::vector<std::unique_ptr<Joint>> joints;  // leave before their bodies
};

struct Seen {
  double gap = 0.0, angle = 0.0, speed = 0.0, force = 0.0;  // largest ones; m, rad, m/s, N
  double moved = 0.0;                                       // in the last second, m
};

Seen watch(Scene& scene, double seconds) {
  Seen seen;
  std::vector<math::Vec3> from;
  const int steps = static_cast<int>(seconds * 1000.0);
  for (int i = 0; i < steps; ++i) {
    scene.world.step();
    for (const auto& joint : scene.joints) {
      const JointGap gap = joint->gap();
      seen.gap = std::max(seen.gap, gap.position);
      seen.angle = std::max(seen.angle, gap.angle);
    }
    for (const auto& body : scene.bodies) seen.speed = std::max(seen.speed, math::norm(body->twist().linear));
    seen.force = std::max(seen.force, scene.force());
    if (i < steps - 1000) continue;
    if (from.empty()) {
      for (const auto& body : scene.bodies) from.push_back(body->pose().position);
    }
    for (std::size_t k = 0; k < from.size(); ++k)
      seen.moved = std::max(seen.moved, math::norm(scene.bodies[k]->pose().position - from[k]));
  }
  return seen;
}

constexpr std::array kDepths{1 * kMillimetre, 5 * kMillimetre, 20 * kMillimetre, 45 * kMillimetre};
constexpr std::array kMasses{0.1, 20.0};

using Type = state::JointType;

// A joint of a box; its pivot in the box.
struct Case {
  const char* name;
  Type type;
  math::Vec3 axis, pivot;
};

// A box of 10 cm, `depth` in the floor, on the post by a joint whose pivot is at `pivot` in the box.
void add_box_on_post(Scene& scene, state::JointType type, const math::Vec3& axis, const math::Vec3& pivot, double mass,
                     double depth) {
  const math::Vec3 at{0, 0, 0.05 - depth};
  Body& body = scene.add(parameters(mass, {box(0.1, 0.1, 0.1)}, at));
  scene.join(joint(type, axis, at + pivot - math::Vec3{0, 0, 0.5}, pivot), scene.post(), body);
}

TEST(JointedContact, JointsThatGiveNoWayHoldABodyInTheFloor) {
  for (const Case& c :
       {Case{"fixed", Type::fixed, {0, 0, 1}, {0, 0, 0}}, Case{"fixed far away", Type::fixed, {0, 0, 1}, {0.3, 0, 0.4}},
        Case{"upright hinge", Type::revolute, {0, 0, 1}, {0, 0, 0.05}},
        Case{"level hinge through the middle", Type::revolute, {0, 1, 0}, {0, 0, 0}},
        Case{"level slide", Type::prismatic, {1, 0, 0}, {0, 0, 0}}}) {
    for (const double mass : kMasses) {
      for (const double depth : kDepths) {
        SCOPED_TRACE(std::string(c.name) + ", " + std::to_string(mass) + " kg, " + std::to_string(depth) + " m");
        Scene scene;
        add_box_on_post(scene, c.type, c.axis, c.pivot, mass, depth);
        const Seen seen = watch(scene, 10.0);
        EXPECT_LT(seen.gap, 1e-4 * kMillimetre);
        EXPECT_LT(seen.angle, 1e-6);
        EXPECT_LT(seen.speed, 1e-4);
        EXPECT_LT(seen.moved, 1e-3 * kMillimetre);
        EXPECT_LT(seen.force, 20.0 * mass * kGravity) << "winds up";
        EXPECT_GT(scene.depth(), 0.99 * depth);
      }
    }
  }
}

TEST(JointedContact, DepthThatJointsAllowToLeaveIsLeftWithoutSpeed) {
  for (const Case& c : {Case{"hinge beside it", Type::revolute, {0, 1, 0}, {1, 0, 0}},
                        Case{"upright slide", Type::prismatic, {0, 0, 1}, {0, 0, 0}},
                        Case{"slanting slide", Type::prismatic, {1, 0, 0.2}, {0, 0, 0}}}) {
    for (const double mass : kMasses) {
      for (const double depth : kDepths) {
        SCOPED_TRACE(std::string(c.name) + ", " + std::to_string(mass) + " kg, " + std::to_string(depth) + " m");
        Scene scene;
        add_box_on_post(scene, c.type, c.axis, c.pivot, mass, depth);
        const Seen seen = watch(scene, 3.0);
        EXPECT_LT(seen.gap, 0.002 * kMillimetre);
        EXPECT_LT(seen.speed, 0.01) << "was thrown out";
        EXPECT_LT(scene.depth(), 1e-3 * kMillimetre);
        EXPECT_LT(scene.force(), 1.2 * mass * kGravity);
      }
    }
  }
}

TEST(JointedContact, ABallJointOrAChainThatBucklesIsNotThrown) {
  for (const double mass : kMasses) {
    for (const double depth : kDepths) {
      SCOPED_TRACE(std::to_string(mass) + " kg, " + std::to_string(depth) + " m");
      Scene ball;
      add_box_on_post(ball, state::JointType::p2p, {0, 0, 1}, {0, 0, 0.05}, mass, depth);
      const Seen of_ball = watch(ball, 10.0);
      EXPECT_LT(of_ball.gap, 0.05 * kMillimetre);
      EXPECT_LT(of_ball.speed, 0.2);

      Scene chain;
      const double top = 0.6 - depth;
      Body& upper = chain.add(parameters(mass, {box(0.05, 0.05, 0.2)}, {0, 0, top - 0.15}));
      Body& lower = chain.add(parameters(mass, {box(0.05, 0.05, 0.3)}, {0, 0, top - 0.45}));
      const auto hinge = state::JointType::revolute;
      chain.join(joint(hinge, {0, 1, 0}, {0, 0, top - 0.5}, {0, 0, 0.15}), chain.post(), upper);
      chain.join(joint(hinge, {0, 1, 0}, {0, 0, -0.15}, {0, 0, 0.15}), upper, lower);
      const Seen of_chain = watch(chain, 10.0);
      EXPECT_LT(of_chain.gap, 0.05 * kMillimetre);
      EXPECT_LT(of_chain.speed, 0.2);
      EXPECT_LT(chain.force(), 10.0 * mass * kGravity);
    }
  }
}

TEST(JointedContact, AFourBarLoweredIntoTheFloorStaysClosed) {
  constexpr double kCrank = 0.4;
  const auto hinge = state::JointType::revolute;
  for (const double angle : {0.0, 0.5}) {  // upright cranks cannot give way (but sideways), slanting ones can
    for (const double mass : kMasses) {
      for (const double depth : kDepths) {
        SCOPED_TRACE(std::to_string(angle) + " rad, " + std::to_string(mass) + " kg, " + std::to_string(depth) + " m");
        Scene scene;
        const math::Vec3 crank{kCrank * std::sin(angle), 0, -kCrank * std::cos(angle)};
        const double height = 0.025 - depth - crank.z;
        const math::Quat turn = math::exp(math::Vec3{0, -angle, 0});
        std::array<Body*, 2> cranks{};
        for (const int i : {0, 1}) {
          const math::Vec3 pivot{0.5 * i, 0, height};
          cranks[static_cast<std::size_t>(i)] =
              &scene.add(mass_only(mass, {0.01 * mass, 0.01 * mass, 0.001 * mass}, {pivot + crank * 0.5, turn}));
        }
        Body& coupler = scene.add(parameters(mass, {box(0.6, 0.05, 0.05)}, {crank.x + 0.25, 0, height + crank.z}));
        for (const int i : {0, 1}) {
          Body& link = *cranks[static_cast<std::size_t>(i)];
          scene.join(joint(hinge, {0, 1, 0}, {0.5 * i, 0, height - 0.5}, {0, 0, kCrank / 2}), scene.post(), link);
          scene.join(joint(hinge, {0, 1, 0}, {0, 0, -kCrank / 2}, {0.5 * i - 0.25, 0, 0}), link, coupler);
        }
        const Seen seen = watch(scene, 10.0);
        EXPECT_LT(seen.gap, 0.05 * kMillimetre);
        EXPECT_LT(seen.speed, 0.1);
        EXPECT_LT(seen.force, 40.0 * 3.0 * mass * kGravity);
      }
    }
  }
}

TEST(JointedContact, AHeavyLoadPressesThroughNoJoint) {
  for (const auto type : {state::JointType::fixed, state::JointType::p2p}) {
    for (const double load : {1.0, 20.0, 200.0}) {
      for (const double depth : {0.0, 1 * kMillimetre, 5 * kMillimetre}) {
        SCOPED_TRACE(std::to_string(load) + " kg, " + std::to_string(depth) + " m");
        Scene scene;
        add_box_on_post(scene, type, {0, 0, 1}, {0, 0, 0.05}, 0.5, depth);
        scene.add(parameters(load, {box(0.1, 0.1, 0.1)}, {0, 0, 0.15 - depth}));
        const Seen seen = watch(scene, 10.0);
        EXPECT_LT(seen.gap, 0.01 * kMillimetre);
        EXPECT_LT(seen.speed, 2.0);  // of a load that falls off
      }
    }
  }
}

// The contact knows only the tip's own mass, a hundredth and a thousandth of what presses on it.
TEST(JointedContact, ALightTipUnderAHeavyArmLeavesTheFloorAndCarriesTheArm) {
  for (const double arm : {0.1, 1.0, 10.0}) {
    SCOPED_TRACE(arm);
    constexpr double kDepth = 2 * kMillimetre;
    Scene scene;
    Body& heavy = scene.add(mass_only(arm, {0.01 * arm, 0.01 * arm, 0.01 * arm}, {{0, 0, 0.3}, {}}));
    Body& tip = scene.add(parameters(0.01, {box(0.02, 0.02, 0.04)}, {0, 0, 0.02 - kDepth}));
    scene.join(joint(state::JointType::prismatic, {0, 0, 1}, {0, 0, -0.2}, {}), scene.post(), heavy);
    scene.join(joint(state::JointType::fixed, {0, 0, 1}, {0, 0, -0.28 - kDepth}, {}), heavy, tip);
    const Seen seen = watch(scene, 3.0);
    EXPECT_LT(seen.gap, 0.001 * kMillimetre);
    EXPECT_LT(seen.speed, 0.2);
    EXPECT_LT(scene.depth(), 0.01 * kMillimetre);
    EXPECT_NEAR(scene.force(), (arm + 0.01) * kGravity, 0.01 * arm * kGravity);
  }
}

// What a contact held against a motor is what is left to it when the motor lets go.
TEST(JointedContact, NothingIsThrownWhenAJointLetsGo) {
  for (const double depth : {1 * kMillimetre, 20 * kMillimetre}) {
    Scene scene;
    add_box_on_post(scene, state::JointType::fixed, {0, 0, 1}, {0.3, 0, 0.4}, 1.0, depth);
    watch(scene, 10.0);
    scene.world.remove(*scene.joints.back());
    scene.joints.clear();
    double highest = 0.0;
    for (int i = 0; i < 1000; ++i) {
      scene.world.step();
      highest = std::max(highest, scene.bodies.back()->pose().position.z);
    }
    EXPECT_LT(highest, 0.055) << depth;
    EXPECT_NEAR(scene.bodies.back()->pose().position.z, 0.05, 0.5 * kMillimetre) << depth;
  }
}

}  // namespace
}  // namespace ambf::physics
