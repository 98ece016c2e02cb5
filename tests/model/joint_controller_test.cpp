// Joints under command: convergence, stability at gains that break explicit controllers, limits, the shorter way round.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rig.h"

namespace ambf::model::test {
namespace {

constexpr double kPi = std::numbers::pi;

// One light link on a static base, hinged about z.
scene::Model wrist(const scene::JointGains& gains, double mass = 0.05, double side = 0.02) {
  scene::Model out = model("wrist.yaml", {box("base", 0.0, {0, 0, 0}), box("hand", mass, {0.2, 0, 0}, side)});
  scene::Joint hinge = joint("hinge", "base", "hand");
  hinge.parent_pivot = {0.1, 0, 0};
  hinge.child_pivot = {-0.1, 0, 0};
  hinge.controller = gains;
  out.joints.push_back(hinge);
  return out;
}

scene::JointGains force_gains(double p, double i, double d) { return {p, i, d, scene::ControllerOutput::force}; }

void command(Rig& rig, int steps, const state::JointCommand& entry) {
  const auto port = rig.port("base");
  rig.step(steps, [&](int) { port->post(joints({entry})); });
}

TEST(JointController, DefaultVelocityServoConverges) {
  Rig rig({0, 0, -9.8});
  rig.load(wrist({}));
  command(rig, 3000, to_position(0.7));
  EXPECT_NEAR(rig.joint_state("hinge").position, 0.7, 1e-4);
  EXPECT_NEAR(rig.joint_state("hinge").velocity, 0.0, 1e-3);
}

// v = P e - D v settles at v = P e / (1 + D): the approach is an exponential with that rate, without the ripple of a
// law that feeds last step's velocity back.
TEST(JointController, VelocityServoApproachesAtTheRateOfItsLaw) {
  Rig rig;
  rig.load(wrist({}));
  command(rig, 1, to_position(0.5));
  double last_velocity = rig.joint_state("hinge").velocity;
  const auto port = rig.port("base");
  rig.step(200, [&](int) {
    port->post(joints({to_position(0.5)}));
    const double velocity = rig.joint_state("hinge").velocity;
    EXPECT_LE(velocity, last_velocity + 1e-6);
    last_velocity = velocity;
  });
  const double rate = 10.0 / (1.0 + 1.0 + 10.0 * kStep_s);
  EXPECT_NEAR(rig.joint_state("hinge").position, 0.5 * (1.0 - std::exp(-rate * 0.2)), 2e-3);
}

TEST(JointController, ForcePidConvergesAndItsIntegralTakesTheSagAway) {
  const auto sag = [](double i) {
    Rig rig({0, -9.8, 0});  // pulls the hand about the hinge
    rig.load(wrist(force_gains(20, i, 1), 1.0, 0.1));
    command(rig, 6000, to_position(0.3));
    return std::abs(rig.joint_state("hinge").position - 0.3);
  };
  EXPECT_GT(sag(0), 0.03);
  EXPECT_LT(sag(40), 0.002);
}

// The original's users report that a position command to 0 makes a robot explode: D h is far beyond the inertia of
// wrist links.
TEST(JointController, GainsThatBreakExplicitControlStayCalm) {
  Rig rig;
  rig.load(wrist(force_gains(1000, 0, 60)));
  double fastest = 0.0;
  const auto port = rig.port("base");
  rig.step(2000, [&](int i) {
    port->post(joints({to_position(i < 1000 ? 0.5 : 0.0)}));
    if (i > 900 && i < 1000) {
      EXPECT_NEAR(rig.joint_state("hinge").position, 0.5, 1e-3);
    }
    fastest = std::max(fastest, std::abs(rig.joint_state("hinge").velocity));
  });
  EXPECT_NEAR(rig.joint_state("hinge").position, 0.0, 1e-3);
  EXPECT_LT(fastest, 0.5 * 1000 / 60 * 1.2);  // the approach of an overdamped PD, not a jump in one step
}

TEST(JointController, FollowsASinusoid) {
  for (const scene::JointGains& gains : {scene::JointGains{}, force_gains(50, 0, 2)}) {
    Rig rig;
    rig.load(wrist(gains, 0.5, 0.1));
    const auto port = rig.port("base");
    double worst = 0.0;
    rig.step(6000, [&](int i) {
      const double target = 0.6 * std::sin(kPi * i * kStep_s);  // 0.5 Hz
      port->post(joints({to_position(target)}));
      if (i > 2000) worst = std::max(worst, std::abs(rig.joint_state("hinge").position - target));
    });
    EXPECT_LT(worst, 0.21);  // velocity servo: e = v / P * ...; both far below the swing of 0.6
    if (gains.output == scene::ControllerOutput::force) {
      EXPECT_LT(worst, 0.02);
    }
  }
}

TEST(JointController, ContinuousJointTakesTheShorterWay) {
  Rig rig;
  rig.load(wrist({}));
  command(rig, 2000, to_position(2.5));
  EXPECT_NEAR(rig.joint_state("hinge").position, 2.5, 1e-3);
  double least = 10.0;
  const auto port = rig.port("base");
  rig.step(2500, [&](int) {
    port->post(joints({to_position(-2.5)}));
    least = std::min(least, rig.joint_state("hinge").position);
  });
  EXPECT_GT(least, 2.4);  // on through pi, not back through 0
  EXPECT_NEAR(std::remainder(rig.joint_state("hinge").position + 2.5, 2 * kPi), 0.0, 1e-3);
}

TEST(JointController, LimitedJointStopsAtItsLimitAndDoesNotWindUp) {
  Rig rig;
  scene::Model hand = wrist(force_gains(5, 20, 0.5), 0.5, 0.1);
  hand.joints[0].limits = {{-0.4, 0.4}};
  rig.load(hand);
  command(rig, 8000, to_position(2.0));
  EXPECT_NEAR(rig.joint_state("hinge").position, 0.4, 2e-3);
  command(rig, 1000, to_position(0.0));
  EXPECT_LT(rig.joint_state("hinge").position, 0.3);  // 256 Nm of wound-up integral would hold it for seconds
}

// As in the original: `max motor impulse` is the motor's, and forces act without the motor.
TEST(JointController, TheMotorsBoundIsTheMotorsAlone) {
  constexpr double kWeight_Nm = 1.0 * 9.8 * 0.1;  // of the hand about the hinge, stretched out
  const auto angle = [&](const scene::JointGains& gains, double max_motor_impulse, const state::JointCommand& entry) {
    Rig rig({0, -9.8, 0});
    scene::Model heavy = wrist(gains, 1.0, 0.1);
    heavy.joints[0].max_motor_impulse = max_motor_impulse;
    rig.load(heavy);
    command(rig, 400, entry);
    return rig.joint_state("hinge").position;
  };
  const double enough = 2.0 * kWeight_Nm * kStep_s, too_little = 0.5 * kWeight_Nm * kStep_s;
  EXPECT_NEAR(angle({}, enough, to_position(0.0)), 0.0, 1e-3);
  EXPECT_LT(angle({}, too_little, to_position(0.0)), -0.2);  // falls
  EXPECT_LT(angle({}, too_little, to_velocity(0.0)), -0.2);
  // A sag of weight / P, whatever the motor could do.
  EXPECT_NEAR(angle(force_gains(500, 0, 20), too_little, to_position(0.0)), -kWeight_Nm / 500, 2e-4);
  EXPECT_NEAR(angle(force_gains(500, 0, 20), too_little, to_effort(kWeight_Nm)), 0.0, 2e-2);
}

TEST(JointController, VelocityAndEffortCommands) {
  Rig rig;
  rig.load(wrist({}, 0.5, 0.1));
  command(rig, 200, to_velocity(1.5));
  EXPECT_NEAR(rig.joint_state("hinge").velocity, 1.5, 1e-6);
  EXPECT_EQ(rig.joint_state("hinge").commanded, 1.5);
  Rig other;
  scene::Model hand = wrist({}, 0.5, 0.1);
  hand.bodies[1].surface.linear_damping = hand.bodies[1].surface.angular_damping = 0.0;
  other.load(hand);
  command(other, 100, to_effort(0.01));  // the motor is off: nothing holds it
  const double inertia = other.info("hand").inertia.z + 0.5 * 0.01;
  EXPECT_NEAR(other.joint_state("hinge").velocity, 0.01 * 0.1 / inertia, 1e-3 * 0.01 * 0.1 / inertia);
}

TEST(JointController, PrismaticJointConverges) {
  Rig rig({0, 0, -9.8});
  scene::Model slide = wrist({}, 0.5, 0.05);
  slide.joints[0].type = state::JointType::prismatic;
  slide.joints[0].limits = {{-0.2, 0.2}};
  rig.load(slide);
  command(rig, 3000, to_position(0.1));  // upwards, against gravity
  EXPECT_NEAR(rig.joint_state("hinge").position, 0.1, 1e-4);
  EXPECT_NEAR(rig.body("hand").T_world_body.position.z, 0.1, 1e-3);
}

TEST(JointController, NeverCommandedMotorsHoldAndForceControlledJointsSwing) {
  Rig holding({0, -9.8, 0});
  holding.load(wrist({}, 0.5, 0.05));
  holding.step(500);
  EXPECT_NEAR(holding.joint_state("hinge").position, 0.0, 1e-3);
  Rig swinging({0, -9.8, 0});
  swinging.load(wrist(force_gains(5, 0, 1), 0.5, 0.05));
  swinging.step(300);
  EXPECT_LT(swinging.joint_state("hinge").position, -0.3);
  scene::Model off = wrist({}, 0.5, 0.05);
  off.joints[0].enable_motor = false;
  Rig unpowered({0, -9.8, 0});
  unpowered.load(off);
  unpowered.step(300);
  EXPECT_LT(unpowered.joint_state("hinge").position, -0.3);
}

TEST(JointFeedback, IsPublishedOnlyWhereEnabled) {
  for (const bool enabled : {false, true}) {
    Rig rig({0, 0, -9.8});
    scene::Model hand = wrist({}, 0.5, 0.05);
    hand.joints[0].enable_feedback = enabled;
    rig.load(hand);
    rig.step(200);
    const state::BodyState& base = rig.body("base");
    // The base carries the hand: its weight, and its moment about the base's centre (0.2 m along x).
    EXPECT_NEAR(base.wrench_body.force.z, enabled ? -0.5 * 9.8 : 0.0, 0.01);
    EXPECT_NEAR(base.wrench_body.torque.y, enabled ? 0.2 * 0.5 * 9.8 : 0.0, 0.01);
    if (!enabled) {
      EXPECT_EQ(rig.joint_state("hinge").effort, 0.0);
    }
  }
}

}  // namespace
}  // namespace ambf::model::test
