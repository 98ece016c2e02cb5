// The force on a hand: tests of section 6 of the equation sheet.
#include "devices/hand_force.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "devices/mapping.h"
#include "tests/devices/random_motion.h"

namespace ambf::devices::testing {
namespace {

using math::Vec3;

constexpr double kNoRamp = 0.0;

HandForceInput input_with(double stiffness) {
  HandForceInput in;
  in.gains.linear_stiffness = {stiffness, stiffness, stiffness};
  in.allowed = true;
  in.ramp_s = kNoRamp;
  return in;
}

TEST(HandForce, APushedBackHandIsPushedOutOfTheWall) {
  RandomMotion random(1);
  for (int i = 0; i < 100; ++i) {
    MappingInput hand;
    hand.T_world_cam = random.pose();
    hand.T_u_iid = random.pose(0.2);
    hand.workspace_scaling = random.uniform(0.5, 10.0);
    const math::Pose tool = random.pose();
    Mapping mapping;
    mapping.start_at(tool);
    mapping.tick(hand);
    // The hand goes 1 cm along the wall's normal, as seen; the tool stays at the wall.
    const Vec3 into_wall = random.direction();
    hand.T_u_iid.position += 0.01 * rotate(inverse(hand.T_world_cam.orientation), into_wall);
    mapping.tick(hand);
    HandForceInput in = input_with(10.0);
    in.T_world_ref = mapping.frames().T_world_ref;
    in.T_world_sde = tool;
    in.R_world_u = in.R_world_u_torque = hand.T_world_cam.orientation;
    const Vec3 force_world = rotate(hand.T_world_cam.orientation, HandForce().step(in).written_u.force);
    ASSERT_NEAR(dot(force_world, into_wall), -10.0 * hand.workspace_scaling * 0.01, 1e-12);
  }
}

TEST(HandForce, AHandOfHalfAKilogramComesToRestAtTheWall) {
  HandForce force;
  HandForceInput in = input_with(100.0);
  in.gains.linear_damping = {5.0, 5.0, 5.0};
  Vec3 position{0.01, 0.0, 0.0}, velocity;
  for (int i = 0; i < 10000; ++i) {
    in.T_world_ref.position = position;
    in.twist_world_ref.linear = velocity;
    velocity += force.step(in).written_u.force * (in.dt / 0.5);
    position += velocity * in.dt;
  }
  EXPECT_LT(norm(position), 1e-5);
  EXPECT_LT(norm(velocity), 1e-5);
}

TEST(HandForce, WorkAtTheHandIsThatAtTheReference) {
  RandomMotion random(2);
  for (int i = 0; i < 100; ++i) {
    HandForceInput in = input_with(20.0);
    in.T_world_ref = random.pose();
    in.T_world_sde = random.pose();
    in.R_world_u = random.rotation();
    const double S = random.uniform(0.5, 10.0);
    const Vec3 hand_moved = random.vector(1e-3), ref_moved = S * rotate(in.R_world_u, hand_moved);
    const Vec3 force_world = -20.0 * (in.T_world_ref.position - in.T_world_sde.position);
    ASSERT_NEAR(dot(HandForce().step(in).written_u.force, hand_moved) * S, dot(force_world, ref_moved), 1e-12);
  }
}

TEST(HandForce, TorquesActAboutTheEffectorsOwnAxes) {
  RandomMotion random(3);
  HandForceInput in = input_with(0.0);
  in.torque = true;
  in.gains.angular_stiffness = {0.0, 2.0, 0.0};
  for (int i = 0; i < 100; ++i) {
    in.T_world_sde = random.pose();
    const Vec3 turned{0.1, 0.2, 0.3};  // in body axes
    in.T_world_ref = {in.T_world_sde.position, in.T_world_sde.orientation * math::exp(turned)};
    in.R_world_u_torque = random.rotation();
    const Vec3 in_world = rotate(in.R_world_u_torque, HandForce().step(in).written_u.torque);
    const Vec3 in_body = rotate(inverse(in.T_world_sde.orientation), in_world);
    ASSERT_LT(norm(in_body - Vec3{0.0, -0.4, 0.0}), 1e-12);
  }
  in.torque = false;
  EXPECT_EQ(HandForce().step(in).written_u.torque, Vec3{});
}

TEST(HandForce, LimitsActInTheirOrder) {
  HandForceInput in = input_with(100.0);
  in.T_world_ref.position = {0.03, 0.04, 0.0};  // 5 N
  in.limits.deadband_N = 1.0;
  HandForceOutput out = HandForce().step(in);
  EXPECT_NEAR(norm(out.written_u.force), 4.0, 1e-12);
  EXPECT_FALSE(out.at_limit);
  in.limits.max_force_N = 3.0;
  out = HandForce().step(in);
  EXPECT_LT(norm(out.written_u.force - Vec3{-1.8, -2.4, 0.0}), 1e-12);
  EXPECT_NEAR(norm(out.wanted_u.force), 5.0, 1e-12);
  EXPECT_TRUE(out.at_limit);
  in.limits.max_jerk_N_per_ms = 0.2;
  EXPECT_NEAR(norm(HandForce().step(in).written_u.force), 0.2, 1e-12);
  in.allowed = false;
  EXPECT_EQ(HandForce().step(in).written_u.force, Vec3{});
}

TEST(HandForce, GrowsOverItsRampAndWithoutAStepAboveMaxJerk) {
  HandForce force;
  HandForceInput in = input_with(100.0);
  in.T_world_ref.position = {0.02, 0.0, 0.0};  // the effector is held away: 2 N
  in.ramp_s = 0.5;
  in.limits.max_jerk_N_per_ms = 0.2;
  double last = 0.0;
  for (int i = 0; i < 1000; ++i) {
    in.allowed = i >= 100 && i != 700;  // clutched until then, and once again
    const double now = norm(force.step(in).written_u.force);
    ASSERT_LE(std::abs(now - last), 0.2 + 1e-12);
    if (i == 350) {
      EXPECT_NEAR(now, 1.0, 0.01);
    }
    if (i == 699) {
      EXPECT_NEAR(now, 2.0, 1e-12);
    }
    last = now;
  }
}

TEST(HandForce, AFaultEndsItWithin30MillisecondsWhateverMaxJerkSays) {
  for (const double dt : {1e-3, 1.0 / 300.0, 0.05}) {
    HandForce force;
    HandForceInput in = input_with(100.0);
    in.dt = dt;
    in.T_world_ref.position = {0.1, 0.0, 0.0};
    const double before = norm(force.step(in).written_u.force);
    in.limits.max_jerk_N_per_ms = 1e-3;
    in.fault = true;
    double last = before;
    for (double t = dt; t < state::kDeviceReleaseS + dt - 1e-9; t += dt) {
      const double now = norm(force.step(in).written_u.force);
      EXPECT_NEAR(now, std::max(0.0, before * (1.0 - t / state::kDeviceReleaseS)), 1e-9);
      EXPECT_LE(now, last);
      last = now;
    }
    EXPECT_NEAR(last, 0.0, 1e-12);
  }
}

TEST(HandForce, StiffnessAtTheHandStaysWithinTheDevices) {
  state::EffectorGains gains;
  gains.linear_stiffness = {1000.0, 10.0, 0.0};
  gains.linear_damping = {10.0, 1.0, 0.0};
  const state::EffectorGains out = bounded(gains, 500.0, 5.0);
  EXPECT_EQ(out.linear_stiffness, (Vec3{100.0, 10.0, 0.0}));
  EXPECT_EQ(out.linear_damping, (Vec3{1.0, 1.0, 0.0}));
  EXPECT_EQ(bounded(gains, 0.0, 5.0).linear_stiffness, gains.linear_stiffness);
}

TEST(HandForce, TheSmallerLimitCounts) {
  EXPECT_EQ(combined({0.0, 10.0, 0.0, 0.0}, 5.0, 0.3).max_force_N, 5.0);
  EXPECT_EQ(combined({0.0, 2.0, 0.0, 0.0}, 5.0, 0.3).max_force_N, 2.0);
  EXPECT_EQ(combined({0.0, 0.0, 0.0, 0.0}, 5.0, 0.3).max_torque_Nm, 0.3);
  EXPECT_EQ(combined({0.0, 2.0, 0.0, 0.0}, 0.0, 0.0).max_force_N, 2.0);
}

}  // namespace
}  // namespace ambf::devices::testing
