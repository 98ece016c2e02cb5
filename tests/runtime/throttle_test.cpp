// Step throttling (Fig. 3.18): steps are exactly what the toggles granted, whoever sends them and whenever they come.
#include "runtime/detail/throttle.h"

#include <gtest/gtest.h>

#include <random>

namespace ambf::runtime {
namespace {

state::WorldCommand message(bool enable, bool clock, unsigned n_skip, std::uint64_t client = 0) {
  state::WorldCommand m;
  m.enable_step_throttling = enable;
  m.step_clock = clock;
  m.n_skip_steps = n_skip;
  m.client = client;
  return m;
}

// Runs everything that is granted; returns the steps.
std::uint64_t run_all(Throttle& throttle) {
  std::uint64_t steps = 0;
  while (throttle.toggle_waiting()) {
    const unsigned left = throttle.steps_left();
    steps += left;
    throttle.steps_done(left);
  }
  return steps;
}

TEST(Throttle, IsOffBeforeTheFirstMessage) {
  Throttle throttle;
  EXPECT_FALSE(throttle.engaged());
  EXPECT_FALSE(throttle.toggle_waiting());
}

TEST(Throttle, GrantsStepsForEachToggleAndNoneWithout) {
  Throttle throttle;
  throttle.on_command(message(true, false, 5));
  EXPECT_TRUE(throttle.engaged());
  EXPECT_EQ(run_all(throttle), 0u) << "enabling alone grants nothing";
  throttle.on_command(message(true, true, 5));
  EXPECT_EQ(run_all(throttle), 5u);
  for (int i = 0; i < 100; ++i) throttle.on_command(message(true, true, 5));  // a client that repeats its command
  EXPECT_EQ(run_all(throttle), 0u);
  throttle.on_command(message(true, false, 7));
  EXPECT_EQ(run_all(throttle), 7u) << "the falling edge counts too, with its own number";
  EXPECT_EQ(throttle.toggles_finished(), 2u);
}

TEST(Throttle, TheEnablingMessageMayToggle) {
  Throttle throttle;
  throttle.on_command(message(true, true, 5));
  EXPECT_EQ(run_all(throttle), 5u);
}

TEST(Throttle, FinishesAToggleWithItsLastStepOnly) {
  Throttle throttle;
  throttle.on_command(message(true, true, 5));
  EXPECT_FALSE(throttle.steps_done(2));
  EXPECT_EQ(throttle.steps_left(), 3u);
  EXPECT_EQ(throttle.toggles_finished(), 0u);
  throttle.on_command(message(true, false, 9));  // arrives in the middle
  EXPECT_EQ(throttle.steps_left(), 3u);
  EXPECT_TRUE(throttle.steps_done(3));
  EXPECT_EQ(throttle.toggles_finished(), 1u);
  EXPECT_EQ(throttle.steps_left(), 9u);
}

TEST(Throttle, AToggleOfNoStepsIsFinishedWithoutAny) {
  Throttle throttle;
  throttle.on_command(message(true, true, 0));
  throttle.on_command(message(true, false, 3));
  ASSERT_TRUE(throttle.toggle_waiting());
  EXPECT_EQ(throttle.steps_left(), 0u);
  EXPECT_TRUE(throttle.steps_done(0));
  EXPECT_EQ(throttle.steps_left(), 3u);
  EXPECT_FALSE(throttle.steps_done(0)) << "nothing was done";
  EXPECT_EQ(throttle.steps_left(), 3u);
}

TEST(Throttle, RunsExactlyTheSumOfAHundredThousandRandomToggles) {
  for (unsigned seed : {1u, 2u, 3u}) {
    std::mt19937 rng(seed);
    Throttle throttle;
    throttle.on_command(message(true, false, 1));
    std::uint64_t granted = 0, run = 0;
    bool clock = false;
    unsigned n_skip = 1;
    for (int i = 0; i < 100000; ++i) {
      if (rng() % 50 == 0) n_skip = static_cast<unsigned>(rng() % 101);
      if (rng() % 4 != 0) clock = !clock, granted += n_skip;  // else the same message again
      throttle.on_command(message(true, clock, n_skip));
      if (rng() % 3 == 0) {  // the simulation is slower than the client: it does a part now and then
        const unsigned left = throttle.steps_left();
        const unsigned part = left == 0 ? 0 : static_cast<unsigned>(rng() % (left + 1));
        throttle.steps_done(part);
        run += part;
      }
    }
    run += run_all(throttle);
    EXPECT_EQ(run, granted);
    EXPECT_EQ(throttle.toggles_finished(), throttle.toggles_received());
  }
}

TEST(Throttle, LosesNoStepWhenEveryWaitingToggleIsDifferent) {
  Throttle throttle;
  std::uint64_t granted = 0;
  bool clock = false;
  for (unsigned i = 0; i < 100000; ++i) {
    granted += i % 101;
    throttle.on_command(message(true, clock = !clock, i % 101));
  }
  EXPECT_EQ(run_all(throttle), granted);
  EXPECT_EQ(throttle.toggles_finished(), 100000u);
}

TEST(Throttle, DisablingReleasesAndForgetsWhatWaited) {
  Throttle throttle;
  throttle.on_command(message(true, true, 5));
  throttle.on_command(message(true, false, 5));
  throttle.steps_done(2);
  throttle.on_command(message(false, false, 5));
  EXPECT_FALSE(throttle.engaged());
  EXPECT_FALSE(throttle.toggle_waiting());
  throttle.on_command(message(true, false, 5));
  EXPECT_EQ(run_all(throttle), 0u);
  throttle.on_command(message(true, true, 5));
  EXPECT_EQ(run_all(throttle), 5u);
}

TEST(Throttle, ClockChangesWhileDisabledAreNoToggles) {
  Throttle throttle;
  throttle.on_command(message(false, true, 5));
  throttle.on_command(message(true, true, 5));
  EXPECT_EQ(run_all(throttle), 0u);
}

TEST(Throttle, ASilentClientKeepsItUnlessAllowed) {
  Throttle keeps;
  keeps.on_command(message(true, true, 5));
  keeps.on_silence();
  EXPECT_TRUE(keeps.engaged());
  EXPECT_EQ(run_all(keeps), 5u);
  Throttle releases(true);
  releases.on_command(message(true, true, 5));
  releases.on_silence();
  EXPECT_FALSE(releases.engaged());
}

// The shipped clients toggle before they send: the first message of each says "high".
TEST(Throttle, AReplacedClientTakesOverWhateverLevelTheOldOneLeft) {
  for (int toggles_of_the_first = 0; toggles_of_the_first < 4; ++toggles_of_the_first) {
    Throttle throttle;
    bool clock = false;
    throttle.on_command(message(true, clock, 5, 11));
    for (int i = 0; i < toggles_of_the_first; ++i) {
      throttle.on_command(message(true, clock = !clock, 5, 11));
      ASSERT_EQ(run_all(throttle), 5u);
    }
    clock = false;  // client 11 is killed, client 12 begins
    for (int i = 0; i < 6; ++i) {
      throttle.on_command(message(true, clock = !clock, 3, 12));
      ASSERT_EQ(run_all(throttle), 3u) << "neither stuck nor twice, toggle " << i << " after " << toggles_of_the_first;
    }
  }
}

TEST(Throttle, ANewClientThatOnlyEnablesGrantsNothing) {
  Throttle throttle;
  throttle.on_command(message(true, true, 5, 1));
  run_all(throttle);
  throttle.on_command(message(true, false, 5, 2));
  EXPECT_EQ(run_all(throttle), 0u);
}

TEST(Throttle, SeveralClientsHaveTheirOwnClocks) {
  std::mt19937 rng(9);
  Throttle throttle;
  bool clocks[5] = {};
  std::uint64_t granted = 0, run = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto c = static_cast<unsigned>(rng() % 5);
    if (rng() % 2 == 0) clocks[c] = !clocks[c], granted += c + 1;
    throttle.on_command(message(true, clocks[c], c + 1, 100 + c));
    run += run_all(throttle);
  }
  EXPECT_EQ(run, granted);
}

TEST(Throttle, ForgetsTheClientThatWasSilentLongest) {
  Throttle throttle;
  throttle.on_command(message(true, true, 1, 1000));
  for (std::uint64_t c = 0; c < 200; ++c) {
    throttle.on_command(message(true, true, 1, 2000 + c));
    throttle.on_command(message(true, true, 1, 1000));  // keeps talking: stays known, no toggle
  }
  EXPECT_EQ(throttle.toggles_received(), 201u);
}

}  // namespace
}  // namespace ambf::runtime
