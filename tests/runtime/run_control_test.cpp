// The modes of the physics loop: one test per transition of docs/run_states.md, and what each mode runs.
#include "runtime/detail/run_control.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ambf::runtime {
namespace {

constexpr std::int64_t kSecondNs = 1'000'000'000;

class RunControlTest : public ::testing::Test {
 protected:
  static TimeConfig time() {
    TimeConfig config;
    config.mode = TimeMode::fixed_step;
    return config;
  }
  state::WorldCommand throttle(bool enable, bool clock = false, unsigned steps = 10) {
    state::WorldCommand command;
    command.enable_step_throttling = enable;
    command.step_clock = clock;
    command.n_skip_steps = steps;
    return command;
  }
  // Plans an iteration and runs all of it, or `steps` of it.
  RunControl::Finished iterate(std::uint64_t steps = ~std::uint64_t{0}) {
    planned = control.plan(now_ns).steps;
    ran = std::min(planned, steps);
    return control.steps_done(ran, now_ns);
  }
  RunControl begun() {
    RunControl out(keeper, false);
    out.begin();
    return out;
  }

  std::int64_t now_ns = kSecondNs;
  TimeKeeper keeper{time()};
  RunControl control{keeper, false};
  std::uint64_t planned = 0, ran = 0;
};

TEST_F(RunControlTest, WaitingRunsNothingUntilBegin) {
  EXPECT_EQ(control.mode(), RunMode::waiting);
  iterate();
  EXPECT_EQ(planned, 0u);
  EXPECT_TRUE(control.idle());
  control.begin();
  EXPECT_EQ(control.mode(), RunMode::clock);
  iterate();
  EXPECT_EQ(planned, 1u);
}

TEST_F(RunControlTest, WhatArrivesWhileWaitingIsInForceAtBegin) {
  RunControl paused(keeper, false), throttled(keeper, false), stepping(keeper, false);
  paused.set_paused(true, now_ns);
  throttled.world_command(throttle(true), now_ns);
  stepping.start_steps(3);
  for (RunControl* waiting : {&paused, &throttled, &stepping}) {
    EXPECT_EQ(waiting->mode(), RunMode::waiting);
    EXPECT_EQ(waiting->plan(now_ns).steps, 0u);
    waiting->begin();
  }
  EXPECT_EQ(paused.mode(), RunMode::paused);
  EXPECT_EQ(throttled.mode(), RunMode::throttled);
  EXPECT_EQ(stepping.mode(), RunMode::stepping);
}

TEST_F(RunControlTest, PauseStopsTheClockAndResumeStartsIt) {
  control.begin();
  control.set_paused(true, now_ns);
  EXPECT_EQ(control.mode(), RunMode::paused);
  EXPECT_TRUE(control.shown_paused());
  iterate();
  EXPECT_EQ(planned, 0u);
  EXPECT_TRUE(control.idle());
  control.set_paused(false, now_ns);
  EXPECT_EQ(control.mode(), RunMode::clock);
}

TEST_F(RunControlTest, ManualStepsRunOnceWhilePausedAndEndWithThePause) {
  control.begin();
  control.set_paused(true, now_ns);
  control.step_paused(5);
  EXPECT_FALSE(control.idle());
  iterate(2);
  EXPECT_EQ(planned, 5u);
  iterate();
  EXPECT_EQ(planned, 3u) << "what the budget cut off is run next";
  EXPECT_TRUE(control.idle());
  control.step_paused(5);
  control.set_paused(true, now_ns);
  EXPECT_TRUE(control.idle()) << "a new pause discards them";
}

TEST_F(RunControlTest, ThrottlingHoldsTheClockAndItsReleaseStartsIt) {
  control.begin();
  control.world_command(throttle(true), now_ns);
  EXPECT_EQ(control.mode(), RunMode::throttled);
  EXPECT_TRUE(control.idle());
  control.world_command(throttle(true, true, 10), now_ns);
  EXPECT_FALSE(control.idle());
  EXPECT_FALSE(iterate(4).toggle);
  EXPECT_EQ(planned, 10u);
  EXPECT_TRUE(iterate().toggle);
  EXPECT_EQ(planned, 6u);
  EXPECT_TRUE(control.idle());
  control.world_command(throttle(false, true), now_ns);
  EXPECT_EQ(control.mode(), RunMode::clock);
}

TEST_F(RunControlTest, SilenceReleasesTheThrottleOnlyByOption) {
  for (const bool release : {false, true}) {
    RunControl silent(keeper, release);
    silent.begin();
    silent.world_command(throttle(true), now_ns);
    silent.world_command_silent();
    EXPECT_EQ(silent.mode(), release ? RunMode::clock : RunMode::throttled);
  }
}

TEST_F(RunControlTest, PauseWinsOverTheThrottleAndReturnsToIt) {
  control.begin();
  control.world_command(throttle(true), now_ns);
  control.set_paused(true, now_ns);
  control.world_command(throttle(true, true, 10), now_ns);
  EXPECT_EQ(control.mode(), RunMode::paused);
  EXPECT_TRUE(control.idle()) << "toggles wait for the end of the pause";
  control.set_paused(false, now_ns);
  EXPECT_EQ(control.mode(), RunMode::throttled);
  EXPECT_FALSE(control.idle());
}

TEST_F(RunControlTest, AStepRequestLeavesTheWorldThrottled) {
  control.begin();
  control.start_steps(3);
  EXPECT_EQ(control.mode(), RunMode::stepping);
  EXPECT_FALSE(iterate(1).service_steps);
  EXPECT_EQ(planned, 3u);
  EXPECT_EQ(control.mode(), RunMode::stepping);
  EXPECT_TRUE(iterate().service_steps);
  EXPECT_EQ(planned, 2u);
  EXPECT_EQ(control.mode(), RunMode::throttled) << "the world waits for the next request";
}

TEST_F(RunControlTest, AStepRequestRunsWhilePausedAndReturnsToThePause) {
  control.begin();
  control.set_paused(true, now_ns);
  control.start_steps(3);
  EXPECT_EQ(control.mode(), RunMode::stepping);
  EXPECT_TRUE(iterate().service_steps);
  EXPECT_EQ(control.mode(), RunMode::paused);
}

TEST_F(RunControlTest, AnIterationServesAtMostAFifthOfASecondOfAStepRequest) {
  control.begin();
  control.start_steps(100'000);
  iterate();
  EXPECT_EQ(planned, 200u);
}

TEST_F(RunControlTest, PauseAndReleaseLimitAStepRequestToASecond) {
  for (const bool by_pause : {true, false}) {
    RunControl stepping = begun();
    stepping.start_steps(100'000);
    if (by_pause) {
      stepping.set_paused(true, now_ns);
    } else {
      stepping.world_command(throttle(false), now_ns);
    }
    stepping.steps_done(stepping.plan(now_ns).steps, now_ns + kSecondNs / 2);
    EXPECT_EQ(stepping.mode(), RunMode::stepping);
    EXPECT_FALSE(stepping.service_steps_cut());
    EXPECT_TRUE(stepping.steps_done(stepping.plan(now_ns).steps, now_ns + kSecondNs + 1).service_steps);
    EXPECT_TRUE(stepping.service_steps_cut());
    EXPECT_EQ(stepping.mode(), by_pause ? RunMode::paused : RunMode::clock);
    stepping.steps_answered();
    EXPECT_FALSE(stepping.service_steps_cut());
  }
}

TEST_F(RunControlTest, DivergenceEndsEveryModeAndRecoveryReturnsToIt) {
  for (const RunMode mode : {RunMode::clock, RunMode::paused, RunMode::throttled}) {
    RunControl diverging = begun();
    if (mode == RunMode::paused) diverging.set_paused(true, now_ns);
    if (mode == RunMode::throttled) diverging.world_command(throttle(true, true, 10), now_ns);
    if (mode == RunMode::paused) diverging.step_paused(2);
    const std::uint64_t steps = diverging.plan(now_ns).steps;
    ASSERT_GT(steps, 0u);
    diverging.diverge();
    diverging.steps_done(1, now_ns);
    EXPECT_EQ(diverging.mode(), RunMode::diverged);
    EXPECT_TRUE(diverging.idle());
    EXPECT_TRUE(diverging.shown_paused());
    EXPECT_EQ(diverging.plan(now_ns).steps, 0u);
    diverging.recover();
    EXPECT_EQ(diverging.mode(), mode);
    EXPECT_EQ(diverging.idle(), mode == RunMode::paused) << "manual steps are discarded, toggles go on";
  }
}

TEST_F(RunControlTest, DivergenceEndsAStepRequestAndRefusesTheNext) {
  control.begin();
  control.start_steps(10);
  control.plan(now_ns);
  control.diverge();
  EXPECT_TRUE(control.steps_done(1, now_ns).service_steps);
  EXPECT_EQ(control.mode(), RunMode::diverged);
  control.start_steps(10);
  control.step_paused(10);
  EXPECT_EQ(control.service_steps_left(), 0u);
  EXPECT_EQ(control.mode(), RunMode::diverged);
  control.recover();
  EXPECT_EQ(control.mode(), RunMode::throttled);
}

TEST_F(RunControlTest, AnIterationOfFixedStepsIsRunInPiecesAndEndsWithAHold) {
  TimeConfig config = time();
  config.speed = 100.0;  // 100 steps per iteration
  TimeKeeper long_keeper(config);
  RunControl pieces(long_keeper, false);
  pieces.begin();
  EXPECT_EQ(pieces.plan(now_ns).steps, 100u);
  pieces.steps_done(30, now_ns);
  EXPECT_TRUE(pieces.iteration_unfinished());
  EXPECT_EQ(pieces.plan(now_ns).steps, 70u);
  pieces.steps_done(30, now_ns);
  pieces.set_paused(true, now_ns);
  pieces.steps_done(pieces.plan(now_ns).steps, now_ns);
  pieces.set_paused(false, now_ns);
  EXPECT_FALSE(pieces.iteration_unfinished());
  EXPECT_EQ(pieces.plan(now_ns).steps, 100u);
}

TEST_F(RunControlTest, OnlyARestingWorldIsStill) {
  control.begin();
  control.set_paused(true, now_ns);
  EXPECT_TRUE(control.still(control.plan(now_ns)));
  control.step_paused(1);
  EXPECT_FALSE(control.still(control.plan(now_ns)));
  control.diverge();
  EXPECT_FALSE(control.still(control.plan(now_ns)));
}

}  // namespace
}  // namespace ambf::runtime
