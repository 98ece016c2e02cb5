// What pulls a device's effector: EQUATIONS 5 and 9, letter by letter, and samples that are slower than steps.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "effector_rig.h"

namespace ambf::runtime {
namespace {

using namespace test;

math::Quat random_rotation(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return math::normalized(math::Quat{normal(random), normal(random), normal(random), normal(random)});
}

// (a), (b), and where the force acts.
TEST(EffectorLaw, PullsTowardsTheReferenceWhateverTheBodysOrientation) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 20; ++trial) {
    scene::Body body = floating_box("tool", 1.0, {0.1, 0.2, 0.3});
    body.T_world_body.orientation = random_rotation(random);
    body.inertial_offset = math::Pose{{0.01, -0.02, 0.03}, random_rotation(random)};
    EffectorRig rig({body});
    Hand hand = rig.hand("tool");
    const math::Pose start = rig.pose("tool");
    const math::Quat turn = math::from_axis_angle(math::normalized(math::Vec3{1, 2, -1}), 0.3);
    const math::Vec3 offset{0.02, 0, 0};
    hand.set_point.T_world_ref = {start.position + offset, turn * start.orientation};
    hand.post();
    ASSERT_TRUE(rig.simulation.step());
    const auto share = rig.share(0, "tool");
    ASSERT_TRUE(share);
    expect_near(share->force, {10.0, 0, 0}, 1e-9);
    const math::Vec3 com = start * body.inertial_offset->position;
    expect_near(share->torque, math::log(turn) * 2.0 + math::cross(start.position - com, share->force), 1e-9);
    for (int i = 0; i < 20; ++i) {
      hand.post();
      ASSERT_TRUE(rig.simulation.step());
    }
    EXPECT_LT(math::norm(start.position + offset - rig.pose("tool").position), math::norm(offset));
  }
}

// (c): where the error passes half a turn, its axis flips; nothing may spike.
TEST(EffectorLaw, AReferenceThatSweepsPastHalfATurnPullsWithinItsGains) {
  scene::Body body = floating_box("tool", 1.0);
  body.inertia = math::Vec3{1e4, 1e4, 1e4};  // it hardly turns
  EffectorRig rig({body});
  Hand hand = rig.hand("tool");
  constexpr double kRate = 4.0;
  const double bound = 2.0 * std::numbers::pi + 0.05 * (kRate + 0.5);
  double max_torque = 0.0;
  for (int i = 1; i <= 1600; ++i) {
    hand.set_point.T_world_ref.orientation = math::from_axis_angle({1, 0, 0}, kRate * i * kStep_s);
    hand.post();
    ASSERT_TRUE(rig.simulation.step());
    max_torque = std::max(max_torque, math::norm(rig.share(0, "tool")->torque));
  }
  EXPECT_LE(max_torque, bound);
  EXPECT_GT(max_torque, 0.9 * 2.0 * std::numbers::pi) << "it passed half a turn";
}

math::Vec3 ellipse(double t_s) {
  constexpr double kRate = 4.0, kScale = 0.1;
  return {kScale * std::sin(kRate * t_s), kScale * (std::cos(kRate * t_s) - 1.0), 2 * kScale * std::sin(kRate * t_s)};
}

// Iterations of 1/rate, each with its newest sample: rms of the position error over the last second, m.
double rms_at(double rate_hz, double mass) {
  EffectorRig rig({floating_box("tool", mass)});
  Hand hand = rig.hand("tool");
  hand.set_point.gains.angular_stiffness = hand.set_point.gains.angular_damping = {};
  const auto steps = static_cast<unsigned>(std::lround(1e3 / rate_hz));
  double sum = 0.0;
  int count = 0;
  for (unsigned step = 0; step < 3000; step += steps) {
    const math::Vec3 goal = ellipse((step + steps) * kStep_s);
    hand.at(goal);
    EXPECT_TRUE(rig.simulation.step(steps));
    if (step < 2000) continue;
    const math::Vec3 error = goal - rig.position("tool");
    sum += math::dot(error, error);
    ++count;
  }
  return std::sqrt(sum / count);
}

// (e): the dissertation's Fig. 3.20 without its limit.
TEST(EffectorLaw, FollowsTheEllipseAtAnyRateOfIterations) {
  for (const double mass : {1.0, 0.1}) {
    const double fast = rms_at(1000, mass);
    std::printf("ellipse, %g kg: %.2f mm at 1000 Hz", mass, 1e3 * fast);
    for (const double rate : {250.0, 100.0, 50.0, 25.0, 10.0}) {
      const double rms = rms_at(rate, mass);
      std::printf(", %.2f at %g", 1e3 * rms, rate);
      EXPECT_LE(rms, 1.2 * fast) << rate << " Hz, " << mass << " kg";
    }
    std::printf("\n");
  }
}

// The largest force of a device whose samples come at a rate of their own, and late by up to `delay_s`.
double peak_force(double rate_hz, double delay_s = 0.0) {
  EffectorRig rig({floating_box("tool", 1.0)});
  Hand hand = rig.hand("tool");
  hand.set_point.period_s = 1.0 / rate_hz;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> delays(0.0, delay_s);
  double peak = 0.0, arrives_s = 0.0;
  int sample = 0;
  for (int step = 0; step < 2500; ++step) {
    for (; arrives_s <= step * kStep_s; arrives_s = std::max(arrives_s, sample / rate_hz + delays(random))) {
      hand.at(ellipse(sample / rate_hz));
      ++sample;
    }
    EXPECT_TRUE(rig.simulation.step());
    if (step > 700) peak = std::max(peak, math::norm(rig.share(0, "tool")->force));
  }
  return peak;
}

TEST(EffectorLaw, SlowDevicesPullNoHarderThanFastOnes) {
  const double fast = peak_force(1000);
  for (const double rate : {300.0, 100.0, 60.0}) {
    const double slow = peak_force(rate);
    std::printf("peak force at %g Hz: %.2f N, at 1000 Hz %.2f N\n", rate, slow, fast);
    EXPECT_LT(slow, 2.0 * fast) << rate << " Hz";
  }
  const double delayed = peak_force(1000, 0.02);
  std::printf("delayed by up to 20 ms: %.2f N\n", delayed);
  EXPECT_LT(delayed, 10.0 * fast) << "it must stay stable";
}

// Samples go on while no step runs; the hand is no faster than it was.
TEST(EffectorLaw, WhatAHandDoesDuringAPauseGivesNoJerk) {
  EffectorRig rig({floating_box("tool", 1.0)});
  Hand hand = rig.hand("tool");
  hand.at({});
  ASSERT_TRUE(rig.simulation.step());
  for (int i = 1; i <= 100; ++i) {  // at 0.2 m/s
    hand.at({2e-4 * i, 0, 0});
    ASSERT_TRUE(rig.simulation.step(0));
  }
  ASSERT_TRUE(rig.simulation.step());
  EXPECT_NEAR(rig.share(0, "tool")->force.x, 500 * 0.02 + 10 * 0.2, 0.1);
}

TEST(EffectorLaw, TwoDevicesWhoseAxesSumToOneMoveTheBodyAsOne) {
  const auto run = [](bool split) {
    EffectorRig rig({floating_box("tool", 1.0)});
    Hand first = rig.hand("tool", 0);
    std::optional<Hand> second;
    if (split) {
      second = rig.hand("tool", 1);
      for (auto gain : {&state::EffectorGains::linear_stiffness, &state::EffectorGains::linear_damping,
                        &state::EffectorGains::angular_stiffness, &state::EffectorGains::angular_damping}) {
        math::Vec3 &a = first.set_point.gains.*gain, &b = second->set_point.gains.*gain;
        a.z = 0.0;
        b.x = b.y = 0.0;
      }
    }
    for (int i = 1; i <= 400; ++i) {
      const math::Pose goal{kCentre + ellipse(i * kStep_s),
                            math::exp({0.5 * std::sin(0.01 * i), 0.002 * i, -0.001 * i})};
      for (Hand* hand : {&first, split ? &*second : nullptr}) {
        if (hand == nullptr) continue;
        hand->set_point.T_world_ref = goal;
        hand->post();
      }
      EXPECT_TRUE(rig.simulation.step());
    }
    return rig.pose("tool");
  };
  const math::Pose one = run(false), two = run(true);
  expect_near(one.position, two.position, 1e-12);
  expect_near(math::log(one.orientation), math::log(two.orientation), 1e-12);
}

// Each of them alone, and a controller, are as stiff as a step can bear.
TEST(EffectorLaw, ThreeDevicesAndAControllerAtTheBoundStayStable) {
  constexpr double kMass = 0.1, kInertia = kMass * 0.01 / 6.0;
  const double k = 0.25 * kMass / (kStep_s * kStep_s), b = 0.5 * kMass / kStep_s;
  const double ka = 0.25 * kInertia / (kStep_s * kStep_s), ba = 0.5 * kInertia / kStep_s;
  scene::Body body = floating_box("tool", kMass);
  body.linear = {{k, k, k}, {}, {b, b, b}, scene::ControllerOutput::force};
  body.angular = {{ka, ka, ka}, {}, {ba, ba, ba}, scene::ControllerOutput::force};
  EffectorRig rig({body});
  rig.log.expect_warning("the gains of its input devices and controllers add up to more");
  const auto ros = rig.simulation.bind(rig.id("tool"), state::Source::ros);
  std::vector<Hand> hands;
  for (int i = 0; i < 3; ++i) {
    hands.push_back(rig.hand("tool", i));
    hands.back().set_point.gains = {{k, k, k}, {b, b, b}, {ka, ka, ka}, {ba, ba, ba}};
  }
  const math::Pose goal{kCentre + math::Vec3{0.01, -0.02, 0.005}, math::exp({0.1, -0.2, 0.3})};
  for (int i = 0; i < 1500; ++i) {
    ros->post(model::test::pose(goal));
    for (Hand& hand : hands) {
      hand.set_point.T_world_ref = goal;
      hand.post();
    }
    ASSERT_TRUE(rig.simulation.step());
  }
  expect_near(rig.pose("tool").position, goal.position, 1e-6);
  expect_near(math::log(rig.pose("tool").orientation), math::log(goal.orientation), 1e-6);
  ASSERT_NE(rig.row(1, "tool"), nullptr);
  EXPECT_TRUE(rig.row(1, "tool")->bounded);
  EXPECT_NEAR(rig.row(1, "tool")->gains.linear_stiffness.x, 0.25 * k, 1e-6 * k);
}

TEST(EffectorLaw, GainsWithinTheBoundsAreLeftAlone) {
  EffectorRig rig({floating_box("tool", 1.0)});
  Hand hand = rig.hand("tool");
  hand.post();
  ASSERT_TRUE(rig.simulation.step());
  ASSERT_NE(rig.row(0, "tool"), nullptr);
  EXPECT_FALSE(rig.row(0, "tool")->bounded);
  EXPECT_EQ(rig.row(0, "tool")->gains.linear_damping.y, 10.0);
  EXPECT_EQ(rig.row(0, "tool")->gains.angular_stiffness.z, 2.0);
}

}  // namespace
}  // namespace ambf::runtime
