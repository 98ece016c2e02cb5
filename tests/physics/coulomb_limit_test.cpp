// Coulomb's limit, exactly: a box that two clamps hold by friction alone stays at 1.005 times the friction that it
// needs and slides at 0.995, pulled, pushed or twisted, whatever the force and the step; and it feels the force with
// which it is clamped.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/physics/fixtures.h"

namespace ambf::physics {
namespace {

using namespace testing;

constexpr double kSide = 0.04;        // m, of the box
constexpr double kMass = 0.5;         // kg, of steel
constexpr double kPerMinute = 10e-6;  // m: what may creep in a minute
constexpr double kFriction = 0.5;
const double kReach = kSide * std::sqrt(0.5);  // m, from the box's middle to where it touches

enum class Load { pull, push, twist };

struct Case {
  Load load;
  double force;  // N, of each clamp
  double step;   // s
};

std::string name_of(Load load) { return load == Load::pull ? "pulled" : load == Load::push ? "pushed" : "twisted"; }

// Two plates on prismatic joints press on a box from both sides with `force`; nothing weighs anything.
struct Clamp {
  Clamp(const Case& given, double friction) : which(given), world(options(given.step)), box(box_of(friction)) {
    for (Body* body : {&post, &left, &right, &box}) world.add(*body);
    for (Joint* joint : {&left_slide, &right_slide}) world.add(*joint);
  }
  static WorldOptions options(double step) {
    WorldOptions options;
    options.gravity = {};
    options.step = step;
    return options;
  }
  static BodyDefinition box_of(double friction) {
    BodyDefinition p = parameters(kMass, {testing::box(kSide, kSide, kSide)}, {});
    p.surface.friction = friction;
    p.surface.linear_damping = p.surface.angular_damping = 0.0;
    return p;
  }
  static BodyDefinition plate(double x) {
    BodyDefinition p = parameters(0.5, {testing::box(0.01, 0.2, 0.2)}, {x, 0, 0});
    p.surface.friction = 1.0;
    return p;
  }
  static scene::Joint slide(const math::Vec3& axis, double x) {
    scene::Joint joint;
    joint.type = state::JointType::prismatic;
    joint.parent_axis = joint.child_axis = axis;
    joint.parent_pivot = {x, 0, 0};
    return joint;
  }
  void step(double share) {
    left_slide.set_effort(which.force);
    right_slide.set_effort(which.force);
    // What the friction 1 of both plates would just hold, times `share`.
    const double f = 2.0 * which.force * share;
    const math::Pose at = box.com_pose();
    if (which.load == Load::pull) box.apply_force({0, 0, f}, at.position);
    if (which.load == Load::push) box.apply_force({0, -f, 0}, at * math::Vec3{0, 0.5 * kSide, 0});
    if (which.load == Load::twist) box.apply_torque({f * kReach, 0, 0});
    world.step();
  }
  void run_with(double share, double seconds) {
    for (double t = 0.0; t < seconds; t += which.step) step(share);
  }
  void start() { before = relative(); }
  // How far the box's corners have slipped on the plates since start(), m.
  double slipped() const {
    const math::Pose now = relative();
    return which.load == Load::twist ? angle_between(before.orientation, now.orientation) * kReach
                                     : math::norm(now.position - before.position);
  }
  math::Pose relative() const { return math::inverse(left.com_pose()) * box.com_pose(); }
  // Of the left plate on the box, N.
  double normal_force() const {
    std::array<Contact, 32> contacts;
    const std::size_t count = world.contacts(contacts);
    double impulse = 0.0;
    for (std::size_t i = 0; i < count; ++i)
      if (contacts[i].body_a == &left || contacts[i].body_b == &left) impulse += contacts[i].normal_impulse;
    return impulse / which.step;
  }

  Case which;
  World world;
  Body post{mass_only(0.0, {})};
  Body left{plate(-0.5 * kSide - 0.005)}, right{plate(0.5 * kSide + 0.005)};
  Body box;
  Joint left_slide{slide({1, 0, 0}, -0.5 * kSide - 0.005), post, left};
  Joint right_slide{slide({-1, 0, 0}, 0.5 * kSide + 0.005), post, right};
  math::Pose before;
};

class CoulombLimit : public ::testing::TestWithParam<Load> {};

TEST_P(CoulombLimit, HoldsJustAboveAndSlidesJustBelow) {
  constexpr double kRise_s = 0.5, kWatched_s = 2.0;
  for (const double force : {1.0, 10.0, 100.0}) {
    for (const double step : {0.0005, 0.001, 0.004}) {
      const Case each{GetParam(), force, step};
      const std::string what =
          name_of(each.load) + " at " + std::to_string(force) + " N, steps of " + std::to_string(step);
      const double settle_s = 4000 * step;
      for (const double margin : {1.005, 0.995}) {
        Clamp clamp(each, kFriction);
        clamp.run_with(0.0, settle_s);
        EXPECT_NEAR(clamp.normal_force(), force, 1e-3 * force) << what;
        // The load comes slowly: what it adds at the end is what decides.
        for (double t = 0.0; t < kRise_s; t += step) clamp.step(kFriction / margin * t / kRise_s);
        clamp.run_with(kFriction / margin, settle_s);
        clamp.start();
        if (margin > 1.0) {
          clamp.run_with(kFriction / margin, kWatched_s);
          EXPECT_LT(clamp.slipped() * 60.0 / kWatched_s, kPerMinute) << what;
          EXPECT_NEAR(clamp.normal_force(), force, 1e-3 * force) << what;
        } else {
          clamp.run_with(kFriction / margin, 0.2);
          EXPECT_GT(clamp.slipped(), 1e-4) << what;
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Loads, CoulombLimit, ::testing::Values(Load::pull, Load::push, Load::twist),
                         [](const auto& parameter) { return name_of(parameter.param); });

// No joint is near; the box lies on a floor, and a torque turns it that the friction of its four corners bears.
TEST(CoulombTorque, BelowTheLimitOfFrictionTurnsNothing) {
  for (const double share : {0.5, 0.95, 1.05}) {
    World world;
    BodyDefinition p = parameters(kMass, {box(kSide, kSide, kSide)}, {0, 0, 0.5 * kSide});
    p.surface.friction = kFriction;
    BodyDefinition ground_of = parameters(0.0, {ground()}, {});
    ground_of.surface.friction = 1.0;
    Body floor(ground_of), cube(p);
    world.add(floor);
    world.add(cube);
    run(world, 0.5);
    const double torque = share * kFriction * kMass * -world.options().gravity.z * kReach;
    for (int i = 0; i < 500; ++i) {
      cube.apply_torque({0, 0, torque * std::min(1.0, i / 200.0)});
      world.step();
    }
    const double turned = angle_between({}, cube.pose().orientation);
    if (share < 1.0) {
      EXPECT_LT(turned, 1e-5) << share;
    } else {
      EXPECT_GT(turned, 0.1) << share;
    }
  }
}

}  // namespace
}  // namespace ambf::physics
