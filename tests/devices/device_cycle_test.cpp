// A device's cycle: start, clutch, faults and return, partners, cameras, buttons.
#include "devices/detail/device_cycle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/devices/cycle_rig.h"

namespace ambf::devices::testing {
namespace {

using math::Pose;
using math::Vec3;
using state::DeviceFault;
using state::DeviceParameter;

TEST(DeviceCycle, NothingMovesBeforeTheHoldAtTheStartIsOver) {
  CycleRig rig;
  rig.start();
  const Pose start = rig.body();
  for (int i = 0; i < 90; ++i) {
    rig.driver.next.T_u_tip.position += Vec3{1e-4, 0.0, 0.0};
    rig.step();
    ASSERT_FALSE(rig.status().engaged);
    ASSERT_EQ(rig.force(), 0.0);
  }
  rig.run_until_engaged();
  EXPECT_LT(norm(rig.body().position - start.position), 1e-12);
  const Pose before = rig.body();
  rig.driver.next.T_u_tip.position += Vec3{0.0, 2e-3, 0.0};
  rig.run(0.005);
  const Vec3 expected = 2.0 * rotate(rig.frame.cameras[0].T_world_camera.orientation, Vec3{0.0, 2e-3, 0.0});
  EXPECT_LT(norm(rig.body().position - before.position - expected), 1e-12);
}

TEST(DeviceCycle, AWallIsFeltOnceForcesHaveRampedUp) {
  CycleRig rig;
  rig.start();
  rig.run_until_engaged();
  rig.blocked = true;
  const Pose wall = rig.body();
  rig.driver.next.T_u_tip.position += Vec3{5e-3, 0.0, 0.0};
  rig.run(0.2);
  // 5 mm, S = 2, 10 N/m; against the hand's motion.
  EXPECT_LT(norm(rig.driver.written.force - Vec3{-0.1, 0.0, 0.0}), 1e-9);
  EXPECT_LT(norm(rig.body().position - wall.position), 1e-15);
  rig.inbox.forces = false;
  rig.step();
  EXPECT_EQ(rig.force(), 0.0);
}

// Every cause that ends a device's force.
struct Cause {
  const char* name;
  DeviceFault fault;
  void (*begin)(CycleRig&);
  void (*end)(CycleRig&);
};

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

const Cause kCauses[] = {
    {"Lost", DeviceFault::lost, [](CycleRig& rig) { rig.driver.reading = Reading::lost; },
     [](CycleRig& rig) {
       rig.driver.reading = Reading::sample;
       rig.inbox.driver = DriverState::open;
     }},
    {"Silent", DeviceFault::silent, [](CycleRig& rig) { rig.driver.reading = Reading::nothing_new; },
     [](CycleRig& rig) { rig.driver.reading = Reading::sample; }},
    {"NotANumber", DeviceFault::bad_sample, [](CycleRig& rig) { rig.driver.next.T_u_tip.position.x = kNan; },
     [](CycleRig& rig) { rig.driver.next.T_u_tip.position.x = 0.1; }},
    {"NoRotation", DeviceFault::bad_sample, [](CycleRig& rig) { rig.driver.next.T_u_tip.orientation.w = 3.0; },
     [](CycleRig& rig) { rig.driver.next.T_u_tip.orientation = {}; }},
    {"BackwardStamps", DeviceFault::backward_stamp,
     [](CycleRig& rig) {
       rig.stamps = false;
       rig.driver.next.stamp_ns = 1;
     },
     [](CycleRig& rig) { rig.stamps = true; }},
    {"NotReady", DeviceFault::not_ready, [](CycleRig& rig) { rig.driver.next.ready = false; },
     [](CycleRig& rig) { rig.driver.next.ready = true; }},
    {"Paused", DeviceFault::paused, [](CycleRig& rig) { rig.frame.run.paused = true; },
     [](CycleRig& rig) { rig.frame.run.paused = false; }},
    {"Diverged", DeviceFault::diverged, [](CycleRig& rig) { rig.frame.bodies[0].frozen = true; },
     [](CycleRig& rig) { rig.frame.bodies[0].frozen = false; }},
    {"Reset", DeviceFault::restarted, [](CycleRig& rig) { ++rig.frame.epoch; }, [](CycleRig&) {}},
    {"NoFrame", DeviceFault::no_frame, [](CycleRig& rig) { rig.frames_come = false; },
     [](CycleRig& rig) { rig.frames_come = true; }},
    {"Removed", DeviceFault::no_effector,
     [](CycleRig& rig) {
       auto structure = std::make_shared<state::Structure>(*rig.frame.structure);
       structure->version = 2;
       structure->objects[0].id = {7, 1};
       rig.frame.structure = structure;
     },
     [](CycleRig& rig) {
       auto structure = std::make_shared<state::Structure>(*rig.frame.structure);
       structure->version = 3;
       structure->objects[0].id = rig.body_id;
       rig.frame.structure = structure;
     }},
};

class Fault : public ::testing::TestWithParam<Cause> {};

TEST_P(Fault, EndsTheForceWithin30MillisecondsAndReturnsWithoutAJump) {
  CycleRig rig;
  rig.settings.limits.max_jerk_N_per_ms = 1e-3;
  rig.start();
  rig.run_until_engaged();
  rig.pushed = {{0.1, 0.0, 0.0}, {}};
  rig.run(0.4);
  ASSERT_NEAR(rig.force(), 0.1, 1e-9);

  GetParam().begin(rig);
  for (int i = 0; i < 400 && rig.status().fault != GetParam().fault; ++i) rig.step();
  ASSERT_EQ(rig.status().fault, GetParam().fault);
  EXPECT_FALSE(rig.status().engaged);
  EXPECT_TRUE(!rig.posted.engaged || rig.status().fault == DeviceFault::no_effector);
  rig.run(state::kDeviceReleaseS - CycleRig::kStep_s);
  EXPECT_NEAR(norm(rig.status().wrench_u_written.force), 0.0, 1e-12);
  EXPECT_EQ(rig.status().faults, 1u);

  // The hand goes elsewhere meanwhile.
  rig.run(0.2);
  GetParam().end(rig);
  rig.driver.next.T_u_tip.position = Vec3{0.1, -0.2, 0.3};
  const Pose left = rig.body();
  double moved = 0.0, step = 0.0, last = norm(rig.status().wrench_u_written.force);
  for (int i = 0; i < 1000 && (!rig.status().engaged || rig.force() < 0.1 - 1e-9); ++i) {
    rig.step();
    moved = std::max(moved, norm(rig.body().position - left.position));
    const double now = norm(rig.status().wrench_u_written.force);
    step = std::max(step, std::abs(now - last));
    last = now;
  }
  ASSERT_TRUE(rig.status().engaged);
  EXPECT_NEAR(rig.force(), 0.1, 1e-6);
  EXPECT_LT(moved, 1e-3);
  EXPECT_LE(step, 1e-3 + 1e-12);
}

INSTANTIATE_TEST_SUITE_P(All, Fault, ::testing::ValuesIn(kCauses),
                         [](const auto& parameter) { return parameter.param.name; });

TEST(DeviceCycle, AJumpOfTheHandMovesNothing) {
  CycleRig rig;
  rig.start();
  rig.run_until_engaged();
  const Pose before = rig.body();
  rig.driver.next.T_u_tip.position += Vec3{0.3, 0.0, 0.0};
  rig.step();
  EXPECT_EQ(rig.status().fault, DeviceFault::jump);
  rig.run(0.1);
  EXPECT_TRUE(rig.status().engaged);
  EXPECT_LT(norm(rig.body().position - before.position), 1e-12);
}

TEST(DeviceCycle, ALostDeviceHoldsItsToolOrLetsGoOfIt) {
  for (const state::OnLoss on_loss : {state::OnLoss::hold, state::OnLoss::release}) {
    CycleRig rig;
    rig.settings.on_loss = on_loss;
    rig.start();
    rig.run_until_engaged();
    rig.driver.reading = Reading::lost;
    rig.run(0.1);
    EXPECT_EQ(rig.posted.pulls, on_loss == state::OnLoss::hold);
    EXPECT_FALSE(rig.posted.engaged);
    EXPECT_EQ(rig.inbox.driver.load(), DriverState::lost);
  }
}

TEST(DeviceCycle, ADeviceThatNeverAnsweredPullsNothing) {
  CycleRig rig;
  rig.start();
  rig.inbox.driver = DriverState::closed;
  rig.run(0.5);
  EXPECT_EQ(rig.status().fault, DeviceFault::not_found);
  EXPECT_FALSE(rig.posted.pulls);
}

TEST(DeviceCycle, AfterAClutchTheToolGoesOnFromWhereAPartnerBroughtIt) {
  CycleRig rig;
  rig.start();
  rig.run_until_engaged();
  rig.press(0, true);
  rig.step();
  EXPECT_TRUE(rig.status().clutched);
  EXPECT_FALSE(rig.posted.engaged);
  for (int i = 0; i < 100; ++i) {
    rig.frame.effectors[0].T_world_ref.position += Vec3{1e-3, 0.0, 0.0};  // physics: REF follows the body
    rig.driver.next.T_u_tip.position += Vec3{0.0, 1e-3, 0.0};
    rig.step();
  }
  const Pose brought = rig.frame.effectors[0].T_world_ref;
  rig.press(0, false);
  rig.run(0.01);
  EXPECT_TRUE(rig.posted.engaged);
  EXPECT_LT(norm(rig.posted.T_world_ref.position - brought.position), 1e-12);
}

TEST(DeviceCycle, ExternalWrenchesEndAfterATenthOfASecond) {
  CycleRig rig;
  rig.start();
  rig.run_until_engaged();
  rig.run(0.2);
  rig.inbox.external.post({{{1.0, 0.0, 0.0}, {}}, false, {}}, rig.now_ns);
  rig.run(0.09);
  EXPECT_NEAR(rig.force(), 1.0, 1e-9);
  rig.run(0.02);
  EXPECT_NEAR(rig.force(), 0.0, 1e-9);
}

TEST(DeviceCycle, TheCameraClutchMovesAllCamerasInTheirParentsFrames) {
  CycleRig rig;
  rig.start();
  rig.run_until_engaged();
  const Pose ref = rig.posted.T_world_ref;
  rig.press(1, true);
  rig.step();
  Pose parents[2], before[2];
  for (int i = 0; i < 2; ++i) {
    before[i] = rig.frame.cameras[i].T_world_camera;
    parents[i] = before[i] * inverse(rig.frame.cameras[i].T_parent_camera);
  }
  rig.driver.next.T_u_tip.position += Vec3{0.0, 2e-3, 0.0};
  rig.step();
  EXPECT_TRUE(rig.status().camera_locked);
  for (int i = 0; i < 2; ++i) {
    const Pose wanted = parents[i] * rig.camera_commands[i].back();
    const Vec3 moved = rotate(inverse(before[i].orientation), wanted.position - before[i].position);
    EXPECT_LT(norm(moved - Vec3{0.0, 0.02, 0.0}), 1e-12);
  }
  EXPECT_LT(norm(rig.posted.T_world_ref.position - ref.position), 1e-12);
}

TEST(DeviceCycle, ACameraThatSomebodyElseMovesIsLeftAlone) {
  CycleRig rig;
  rig.start();
  rig.run_until_engaged();
  ASSERT_TRUE(rig.camera_locks[0]->acquire(state::Source(6)));
  rig.frame.commands.resize(1);
  rig.frame.commands[0].object = 2;  // the second camera, by the mouse
  rig.frame.commands[0].source = state::Source::pointer;
  rig.frame.commands[0].in_force = true;
  rig.press(1, true);
  rig.run(0.01);
  EXPECT_FALSE(rig.status().camera_locked);
  EXPECT_TRUE(rig.camera_commands[0].empty());
  EXPECT_TRUE(rig.camera_commands[1].empty());
  rig.camera_locks[0]->release(state::Source(6));
  rig.frame.commands[0].in_force = false;
  rig.run(0.01);
  EXPECT_TRUE(rig.status().camera_locked);
  EXPECT_FALSE(rig.camera_commands[0].empty());
  EXPECT_FALSE(rig.camera_commands[1].empty());
  rig.press(1, false);
  rig.run(0.01);
  EXPECT_TRUE(rig.camera_locks[0]->acquire(state::Source(6))) << "it holds no camera after its clutch is released";
  EXPECT_EQ(rig.camera_releases[0], 1u) << "ROS and mouse may move it at once";
  rig.camera_locks[0]->release(state::Source(6));
}

TEST(DeviceCycle, ACameraThatPhysicsGaveToSomebodyElseIsLetGo) {
  CycleRig rig;
  rig.start();
  rig.run_until_engaged();
  rig.press(1, true);
  rig.run(0.01);
  ASSERT_TRUE(rig.status().camera_locked);
  rig.frame.commands.resize(2);
  for (std::uint32_t i = 0; i < 2; ++i) {  // by ROS, in the step in which the clutch was pressed
    rig.frame.commands[i].object = i + 1;
    rig.frame.commands[i].in_force = true;
    rig.frame.commands[i].source = state::Source::ros;
  }
  rig.run(0.01);
  EXPECT_FALSE(rig.status().camera_locked);
}

// Physics gives the jaw to a hand whose opening passes the tool's: it must see where a button comes from.
TEST(DeviceCycle, AButtonPassesTheToolsOpeningInOneSample) {
  CycleRig rig;
  rig.settings.buttons.gripper = 3;
  rig.start();
  rig.run_until_engaged();
  EXPECT_EQ(rig.posted.jaw, 1.0);
  EXPECT_FALSE(rig.posted.moves_jaw);
  rig.press(3, true);
  rig.run(0.01);
  EXPECT_EQ(rig.posted.jaw, 0.0);
  EXPECT_TRUE(rig.posted.moves_jaw);
}

TEST(DeviceCycle, ButtonsGoThroughModesAndChangeGains) {
  CycleRig rig;
  rig.settings.buttons.next_mode = 2;
  rig.settings.buttons.previous_mode = 3;
  rig.start();
  rig.run_until_engaged();
  const auto click = [&](int button) {
    rig.press(button, true);
    rig.step();
    rig.press(button, false);
    rig.step();
  };
  click(2), click(2);
  EXPECT_EQ(rig.status().mode, state::DeviceMode::linear_stiffness);
  click(0), click(0), click(1);
  EXPECT_EQ(rig.posted.gains.linear_stiffness, (Vec3{510.0, 510.0, 510.0}));
  EXPECT_FALSE(rig.status().clutched) << "a1 is the clutch in the first mode alone";
  click(3), click(3), click(3);
  EXPECT_EQ(rig.status().mode, state::DeviceMode::haptic_angular);
}

TEST(DeviceCycle, DominanceIsSlewedAndGainsOfPositionOnlyDevicesHaveNoRotation) {
  CycleRig rig;
  rig.driver.traits_.orientation = false;
  rig.start();
  rig.run_until_engaged();
  EXPECT_EQ(rig.posted.gains.angular_stiffness, Vec3{});
  rig.inbox.settings.try_push({DeviceParameter::dominance, {1.0, 0.0, 0.0}});
  double last = 500.0;
  for (int i = 0; i < 300; ++i) {
    rig.step();
    const double now = rig.posted.gains.linear_stiffness.x;
    ASSERT_LE(now - last, 2.0 * 500.0 * LiveSettings::kDominanceRate * CycleRig::kStep_s + 1e-9);
    last = now;
  }
  EXPECT_NEAR(last, 1000.0, 1e-9);
}

TEST(DeviceCycle, ARatioIsAShareOfTheEffectorsGains) {
  CycleRig rig;
  rig.settings.haptic_is_ratio = true;
  rig.settings.haptic_linear = {0.03, 0.03, 0.0};
  rig.driver.traits_.max_stiffness_N_m = 20.0;
  rig.start();
  rig.run_until_engaged();
  // 0.03 x 500 = 15 N/m, bounded by 20 / S = 10 N/m.
  EXPECT_EQ(rig.status().hand_gains.linear_stiffness, (Vec3{10.0, 10.0, 0.0}));
}

// With iterations of physics this long. Every 20 ms there is a frame; between slow iterations it shows the same step
// again.
void expect_smooth_force(int iteration_ms) {
  CycleRig rig;
  rig.start();
  rig.run_until_engaged();
  rig.run(0.1);
  // The body follows 10 mm behind REF at 0.1 m/s.
  const Vec3 along = rotate(rig.frame.cameras[0].T_world_camera.orientation, Vec3{0.0, 1.0, 0.0});
  const double speed = 0.1;
  rig.blocked = true;
  const Pose start = rig.status().frames.T_world_ref;
  double low = 1e9, high = 0.0;
  for (int i = 1; i <= 400; ++i) {
    rig.driver.next.T_u_tip.position += Vec3{0.0, speed / 2.0 * CycleRig::kStep_s, 0.0};
    rig.frames_come = i % 20 == 0;
    rig.steps = i % iteration_ms == 0;
    if (rig.steps) {
      rig.frame.bodies[0].T_world_body.position = start.position + along * (speed * CycleRig::kStep_s * i - 0.01);
      rig.frame.bodies[0].twist_world.linear = along * speed;
    }
    rig.step();
    if (i > 200) {
      low = std::min(low, rig.force());
      high = std::max(high, rig.force());
    }
  }
  EXPECT_NEAR(high, 0.1, 0.01);
  EXPECT_LT(high - low, 0.05 * high);
}

TEST(DeviceCycle, SlowPhysicsGivesASmoothForce) {
  for (const int iteration_ms : {20, 40, 100}) expect_smooth_force(iteration_ms);
}

TEST(DeviceCycle, PercentilesAreThoseOfTheWholeRun) {
  CycleRig rig;
  rig.start();
  rig.run(1.5);
  rig.now_ns += 50000000;  // the thread was stopped once
  rig.run(1.5);
  const state::DeviceStatus& status = rig.status();
  EXPECT_NEAR(status.period.p50_s, 1e-3, 4e-5);
  EXPECT_NEAR(status.period.max_s, 0.051, 1e-6);
  EXPECT_GT(status.period.count, 2500u);
  EXPECT_GT(status.set_point_age.count, 1000u);
  EXPECT_GT(status.sample_to_force.p50_s, 0.0);
}

TEST(DeviceCycle, TheStatusIsPublishedWhole) {
  CycleRig rig;
  rig.start();
  rig.run(0.01);
  state::DeviceStatus seen;
  ASSERT_TRUE(rig.inbox.status.read(seen));
  EXPECT_EQ(seen.cycle, rig.status().cycle);
  EXPECT_EQ(seen.frames.T_world_ref, rig.status().frames.T_world_ref);
}

}  // namespace
}  // namespace ambf::devices::testing
