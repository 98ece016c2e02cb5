// The time logic against simulated clocks: jitter, stalls, machines that are too slow, modes. Nothing here reads a real
// clock.
#include "runtime/detail/time_keeper.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace ambf::runtime {
namespace {

constexpr std::int64_t kMs = 1000000;
constexpr std::int64_t kSecond = 1000 * kMs;

TimeConfig config(TimeMode mode, double frequency_hz, double speed = 1.0) {
  TimeConfig c;
  c.mode = mode;
  c.frequency_hz = frequency_hz;
  c.speed = speed;
  return c;
}

// A machine on which a step and an iteration cost given times and sleeps end late.
struct Machine {
  explicit Machine(const TimeConfig& c) : keeper(c) { keeper.start(now); }

  void iterate() {
    const IterationPlan plan = keeper.begin_iteration(now);
    longest_iteration = std::max(longest_iteration, plan.steps);
    worst_lateness = std::max(worst_lateness, plan.lateness_ns);
    now += plan.steps * step_cost + iteration_cost;
    steps += static_cast<std::uint64_t>(plan.steps);
    ++iterations;
    keeper.end_iteration(now, plan.steps);
    const std::int64_t deadline = keeper.next_deadline(now);
    if (deadline > now) now = deadline + wake_late();
    worst_error_s = std::max(worst_error_s, std::abs(1e-9 * static_cast<double>(now - begin) - simulated()));
  }
  void run_until(std::int64_t end) {
    while (now < end) iterate();
  }
  double simulated() const { return keeper.sim_time_s(); }

  static constexpr std::int64_t begin = 5 * kSecond + 123;
  std::int64_t now = begin;
  TimeKeeper keeper;
  std::int64_t step_cost = 100000, iteration_cost = 20000;
  std::function<std::int64_t()> wake_late = [] { return std::int64_t{50000}; };
  std::uint64_t steps = 0, iterations = 0;
  std::int64_t longest_iteration = 0;
  std::int64_t worst_lateness = 0;
  double worst_error_s = 0.0;
};

TEST(RealTimeMode, LosesNothingInJitteredTurns) {  // property (a) of Eq. 3.1
  TimeKeeper keeper(config(TimeMode::real_time, 1000.0));
  std::mt19937 rng(1);
  std::uniform_int_distribution<std::int64_t> dt(200000, 3200000);
  const std::int64_t begin = 77;
  std::int64_t now = begin;
  keeper.start(now);
  double momentum = 0.0;  // property (b): 1 N applied in every step, as the laws are
  while (now - begin < 100 * kSecond) {
    now += dt(rng);
    const IterationPlan plan = keeper.begin_iteration(now);
    for (int i = 0; i < plan.steps; ++i) momentum += 1.0 * keeper.step_s();
    keeper.end_iteration(now, plan.steps);
    ASSERT_LT(std::abs(keeper.sim_time_s() - 1e-9 * static_cast<double>(now - begin)), keeper.step_s() * 1.0001);
  }
  EXPECT_EQ(keeper.steps_given_up(), 0u);
  EXPECT_NEAR(momentum, 1e-9 * static_cast<double>(now - begin), keeper.step_s() * 1.0001);
}

TEST(RealTimeMode, AThousandHertzAreAThousandStepsAndTurnsASecond) {
  Machine m(config(TimeMode::real_time, 1000.0));
  std::mt19937 rng(2);
  std::exponential_distribution<double> late(1.0 / 60e3);
  m.wake_late = [&] { return std::min<std::int64_t>(static_cast<std::int64_t>(late(rng)), 800000); };
  m.run_until(Machine::begin + 60 * kSecond);
  EXPECT_NEAR(static_cast<double>(m.steps), 60000.0, 1.0);
  EXPECT_NEAR(static_cast<double>(m.iterations), 60000.0, 2.0);
  EXPECT_EQ(m.longest_iteration, 1) << "an iteration that begins within its period has exactly one step";
  EXPECT_NEAR(m.keeper.real_time_factor(), 1.0, 0.002);
  EXPECT_NEAR(m.keeper.iterations_per_second(), 1000.0, 2.0);
  EXPECT_LT(m.worst_error_s, 0.002);
}

TEST(RealTimeMode, TwoKilohertzMeansHalfMillisecondStepsAndADifferentStepEachTurn) {
  Machine m(config(TimeMode::real_time, 2000.0));
  EXPECT_DOUBLE_EQ(m.keeper.step_s(), 0.0005);
  m.run_until(Machine::begin + 10 * kSecond);
  EXPECT_NEAR(static_cast<double>(m.steps), 20000.0, 2.0);
  EXPECT_EQ(m.longest_iteration, 1);
  EXPECT_NEAR(m.keeper.real_time_factor(), 1.0, 0.002);
}

TEST(RealTimeMode, DoesNotDriftAtFrequenciesThatDivideNothing) {
  for (double f : {30.0, 60.0, 120.0, 333.3, 700.0, 1500.0, 4999.0}) {
    Machine m(config(TimeMode::real_time, f));
    m.step_cost = 1000;
    m.iteration_cost = 1000;
    m.wake_late = [] { return std::int64_t{3000}; };
    m.run_until(Machine::begin + 100 * kSecond);
    EXPECT_NEAR(static_cast<double>(m.iterations), 100.0 * f, 2.0) << f;
    EXPECT_LT(m.worst_error_s, 2.0 / f + 0.001) << f;
    EXPECT_EQ(m.keeper.steps_given_up(), 0u) << f;
  }
}

TEST(RealTimeMode, SlowTurnsThatWereAskedForRunAllTheirSteps) {
  Machine m(config(TimeMode::real_time, 10.0));  // below 45 Hz, but wanted
  m.step_cost = 10000;
  m.run_until(Machine::begin + 10 * kSecond);
  EXPECT_NEAR(m.simulated(), 10.0, 0.11);
  EXPECT_EQ(m.keeper.steps_given_up(), 0u);
  Machine fifty(config(TimeMode::real_time, 50.0));
  fifty.step_cost = 10000;
  fifty.run_until(Machine::begin + 10 * kSecond);
  EXPECT_NEAR(static_cast<double>(fifty.iterations), 500.0, 2.0) << "iterations of 20 steps on the grid";
}

TEST(RealTimeMode, SpeedScalesSimulatedTime) {
  for (double speed : {0.1, 0.5, 2.0, 5.0}) {
    Machine m(config(TimeMode::real_time, 1000.0, speed));
    m.run_until(Machine::begin + 5 * kSecond);
    EXPECT_NEAR(m.simulated(), 5.0 * speed, 0.01 * speed) << speed;
    EXPECT_NEAR(m.keeper.real_time_factor(), speed, 0.01 * speed) << speed;
    EXPECT_LE(m.keeper.step_s(), 1e-3) << speed;
  }
}

TEST(RealTimeMode, AStallCostsAtMostOneCappedTurnAndIsToldTruly) {  // property (c)
  Machine m(config(TimeMode::real_time, 1000.0));
  m.run_until(Machine::begin + 3 * kSecond);
  EXPECT_EQ(m.longest_iteration, 1);
  const std::int64_t before = m.now;
  const double simulated_before = m.simulated();
  m.now += 200 * kMs;
  m.iterate();
  EXPECT_EQ(m.longest_iteration, 22);
  EXPECT_NEAR(static_cast<double>(m.keeper.steps_given_up()), 178.0, 1.0);
  EXPECT_GE(m.worst_lateness, 199 * kMs);
  m.run_until(before + 500 * kMs);
  EXPECT_EQ(m.longest_iteration, 22);
  const double truth = m.simulated() - simulated_before;
  EXPECT_NEAR(truth, 0.5 - 0.178, 0.003);
  EXPECT_NEAR(m.keeper.real_time_factor(), 1.0 - 0.178, 0.01) << "over the last second";
  m.run_until(before + 1800 * kMs);
  EXPECT_NEAR(m.keeper.real_time_factor(), 1.0, 0.003) << "recovered";
}

TEST(RealTimeMode, AShortStallIsMadeUpForInOneTurn) {
  Machine m(config(TimeMode::real_time, 1000.0));
  m.run_until(Machine::begin + kSecond);
  m.now += 8 * kMs;
  m.iterate();
  EXPECT_GE(m.longest_iteration, 8);
  EXPECT_EQ(m.keeper.steps_given_up(), 0u);
  EXPECT_LT(m.worst_error_s, 0.012);
}

// Steps that cost more than they simulate: the spiral of death, if there were one.
TEST(RealTimeMode, OnAMachineThatIsTooSlowNothingSpiralsAndNoTimeIsWasted) {
  for (std::int64_t cost : {1001000, 1300000, 2000000, 20000000}) {
    Machine m(config(TimeMode::real_time, 1000.0));
    m.run_until(Machine::begin + kSecond);
    m.step_cost = cost;
    const std::int64_t begin = m.now;
    const std::uint64_t steps = m.steps, iterations = m.iterations;
    m.longest_iteration = 0;
    m.run_until(begin + 20 * kSecond);
    const double wall = 1e-9 * static_cast<double>(m.now - begin);
    const double possible = wall * 1e9 / static_cast<double>(cost);
    EXPECT_GT(static_cast<double>(m.steps - steps), 0.97 * possible) << cost << ": the core is used";
    EXPECT_LE(m.longest_iteration, 22) << cost;
    const double iterations_possible = std::min(45.0, 1e9 / static_cast<double>(cost));
    EXPECT_GT(static_cast<double>(m.iterations - iterations) / wall, 0.9 * iterations_possible)
        << cost << ": devices still feel it";
    EXPECT_NEAR(m.keeper.real_time_factor(), static_cast<double>(m.steps - steps) * 1e-3 / wall, 0.02) << cost;
    EXPECT_NEAR(static_cast<double>(m.keeper.steps_given_up() + m.steps - steps), wall * 1000.0, 50.0)
        << "all are told";

    m.step_cost = 100000;  // fast again
    m.longest_iteration = 0;
    for (int i = 0; i < 3; ++i) m.iterate();
    const std::uint64_t given_up = m.keeper.steps_given_up();
    m.run_until(m.now + 1200 * kMs);
    EXPECT_LE(m.longest_iteration, 22) << cost;
    EXPECT_EQ(m.keeper.steps_given_up(), given_up) << cost;
    EXPECT_NEAR(m.keeper.real_time_factor(), 1.0, 0.005) << cost;
  }
}

TEST(RealTimeMode, TheWorldsLimitTightensTheCapOnly) {
  TimeConfig c = config(TimeMode::real_time, 1000.0);
  EXPECT_EQ(TimeKeeper(c).step_cap(), 22);
  c.max_steps_per_iteration = 50;
  EXPECT_EQ(TimeKeeper(c).step_cap(), 22);
  c.max_steps_per_iteration = 5;
  EXPECT_EQ(TimeKeeper(c).step_cap(), 5);
  TimeKeeper keeper(c);
  keeper.set_max_steps_per_iteration(0);
  EXPECT_EQ(keeper.step_cap(), 22);
}

TEST(RealTimeMode, WhatIsLoadedTightensTheCapWhileItIsThere) {
  TimeKeeper keeper(config(TimeMode::real_time, 1000.0));
  keeper.set_loaded_step_limit(10);
  EXPECT_EQ(keeper.step_cap(), 10);
  keeper.set_max_steps_per_iteration(5);
  EXPECT_EQ(keeper.step_cap(), 5);
  keeper.set_max_steps_per_iteration(0);
  EXPECT_EQ(keeper.step_cap(), 10);
  keeper.set_loaded_step_limit(0);
  EXPECT_EQ(keeper.step_cap(), 22);
}

TEST(RealTimeMode, RestsInEveryTurnWhenToldToAlthoughLate) {
  TimeConfig c = config(TimeMode::real_time, 1000.0);
  c.rest_when_behind_ns = 200000;
  Machine m(c);
  m.step_cost = 1500000;
  m.wake_late = [] { return std::int64_t{0}; };
  for (int i = 0; i < 100; ++i) m.iterate();
  const std::int64_t deadline = m.keeper.next_deadline(m.now);
  EXPECT_GE(deadline, m.now + 200000);
}

TEST(FixedStepMode, CutsATurnIntoEqualStepsOfAtMostAMillisecond) {
  struct {
    double frequency, speed, step;
    int steps;
  } cases[] = {{1000, 1, 1e-3, 1},         {120, 1, 1.0 / 1080, 9}, {2000, 1, 5e-4, 1},  {100000, 100, 1e-3, 1},
               {1000, 2.5, 2.5e-3 / 3, 3}, {50, 1, 1e-3, 20},       {1000, 0.5, 5e-4, 1}};
  for (const auto& c : cases) {
    TimeKeeper keeper(config(TimeMode::fixed_step, c.frequency, c.speed));
    EXPECT_DOUBLE_EQ(keeper.step_s(), c.step) << c.frequency;
    keeper.start(0);
    std::mt19937 rng(4);
    std::int64_t now = 0;
    for (int i = 0; i < 100; ++i) {
      const IterationPlan plan = keeper.begin_iteration(now += rng() % 50000000);  // whatever the clock says
      ASSERT_EQ(plan.steps, c.steps) << c.frequency;
      keeper.end_iteration(now, plan.steps);
      keeper.next_deadline(now);
    }
    EXPECT_NEAR(keeper.sim_time_s(), 100.0 * c.speed / c.frequency, 1e-12) << c.frequency;
  }
}

TEST(FixedStepMode, IsPacedMakesUpForFewTurnsAndNotForMany) {
  Machine m(config(TimeMode::fixed_step, 1000.0));
  m.run_until(Machine::begin + 2 * kSecond);
  EXPECT_NEAR(static_cast<double>(m.iterations), 2000.0, 2.0);
  m.now += 8 * kMs;
  m.run_until(Machine::begin + 3 * kSecond);
  EXPECT_NEAR(static_cast<double>(m.iterations), 3000.0, 2.0) << "eight late iterations were made up for";
  m.now += 300 * kMs;
  m.run_until(Machine::begin + 4 * kSecond);
  EXPECT_NEAR(static_cast<double>(m.iterations), 3700.0, 4.0) << "three hundred were not";
  EXPECT_NEAR(static_cast<double>(m.keeper.steps_given_up()), 300.0, 4.0);
}

TEST(FreeRunningMode, NeverSleepsAndTellsItsSpeed) {
  Machine m(config(TimeMode::free_running, 1000.0));
  m.step_cost = 40000;
  m.iteration_cost = 10000;
  m.run_until(Machine::begin + 2 * kSecond);
  EXPECT_NEAR(static_cast<double>(m.iterations), 40000.0, 2.0);
  EXPECT_NEAR(m.keeper.real_time_factor(), 20.0, 0.1);
}

TEST(Hold, AsksForNothingAfterwardsInAnyMode) {
  for (TimeMode mode : {TimeMode::real_time, TimeMode::fixed_step}) {
    Machine m(config(mode, 1000.0));
    m.run_until(Machine::begin + kSecond);
    for (int i = 0; i < 10; ++i) {  // paused for 10 s, looking round once a second only
      const IterationPlan plan = m.keeper.hold(m.now);
      EXPECT_EQ(plan.steps, 0);
      m.keeper.end_iteration(m.now, 0);
      EXPECT_GT(m.keeper.next_deadline(m.now), m.now);
      EXPECT_LE(m.keeper.next_deadline(m.now), m.now + kMs);
      m.now += kSecond;
    }
    EXPECT_LT(m.keeper.real_time_factor(), 0.05) << "nothing was simulated";
    const std::uint64_t steps = m.steps;
    const std::int64_t begin = m.now;
    m.longest_iteration = 0;
    m.worst_lateness = 0;
    m.run_until(begin + kSecond);
    EXPECT_LT(m.worst_lateness, kMs) << "the hold is no lateness";
    EXPECT_NEAR(static_cast<double>(m.steps - steps), 1000.0, 2.0);
    EXPECT_EQ(m.longest_iteration, 1);
    EXPECT_EQ(m.keeper.steps_given_up(), 0u);
  }
}

TEST(WatchTime, IsTheWallsInRealTimeStandsInAHoldAndIsSimulatedOtherwise) {
  Machine m(config(TimeMode::real_time, 1000.0));
  m.run_until(Machine::begin + kSecond);
  EXPECT_NEAR(static_cast<double>(m.keeper.watch_ns()), 1e9, 3e6);
  std::int64_t before = m.keeper.watch_ns();
  for (int i = 0; i < 100; ++i) {
    m.keeper.hold(m.now += 100 * kMs);
    m.keeper.end_iteration(m.now, 0);
  }
  EXPECT_EQ(m.keeper.watch_ns(), before);
  m.keeper.hold(m.now);
  m.keeper.end_iteration(m.now, 10);  // a throttle toggle of ten steps
  EXPECT_EQ(m.keeper.watch_ns(), before + 10 * kMs);
  m.now += 30 * kSecond;
  m.iterate();
  EXPECT_LT(m.keeper.watch_ns(), before + 15 * kMs) << "the hold itself is nobody's time";

  before = m.keeper.watch_ns();
  m.now += 5 * kSecond;  // a stall of the machine
  m.iterate();
  EXPECT_LE(m.keeper.watch_ns(), before + 25 * kMs) << "commands that wait behind a stall are not expired by it";

  Machine fixed(config(TimeMode::fixed_step, 1000.0));
  for (int i = 0; i < 250; ++i) fixed.iterate();
  EXPECT_EQ(fixed.keeper.watch_ns(), 250 * kMs);
}

TEST(TimeConfig, NonsenseBecomesTheDefault) {
  TimeConfig c;
  c.frequency_hz = -1.0;
  c.speed = 0.0;
  c.longest_step_s = std::nan("");
  const TimeKeeper keeper(c);
  EXPECT_DOUBLE_EQ(keeper.step_s(), 1e-3);
  EXPECT_DOUBLE_EQ(keeper.steps_per_iteration(), 1.0);
}

TEST(Speed, ChangesWhileRunningAndStepsStayAsLong) {
  Machine machine(config(TimeMode::real_time, 1000.0));
  const double step_s = machine.keeper.step_s();
  const auto steps_in_a_second = [&] {
    const std::uint64_t steps = machine.steps, iterations = machine.iterations;
    machine.worst_lateness = 0;
    machine.run_until(machine.now + kSecond);
    EXPECT_LT(machine.iterations - iterations, 1100u) << "it waits between iterations";
    EXPECT_LT(machine.worst_lateness, 2 * kMs);
    return static_cast<double>(machine.steps - steps);
  };
  EXPECT_NEAR(steps_in_a_second(), 1000, 3);
  machine.keeper.set_speed(0.25, machine.now);
  EXPECT_NEAR(steps_in_a_second(), 250, 3);
  machine.keeper.set_speed(3.0, machine.now);
  EXPECT_NEAR(steps_in_a_second(), 3000, 9);
  EXPECT_EQ(machine.keeper.step_s(), step_s);
  machine.keeper.set_speed(-1.0, machine.now);
  EXPECT_EQ(machine.keeper.speed(), 3.0);
}

TEST(Speed, FixedStepsComeAtAnotherPace) {
  Machine machine(config(TimeMode::fixed_step, 1000.0));
  const double step_s = machine.keeper.step_s();
  machine.keeper.set_speed(0.5, machine.now);
  machine.run_until(machine.now + kSecond);
  EXPECT_NEAR(static_cast<double>(machine.steps), 500, 3);
  EXPECT_EQ(machine.keeper.step_s(), step_s);
}

TEST(Speed, IsUnknownToFreeRuns) {
  TimeKeeper keeper(config(TimeMode::free_running, 1000.0));
  keeper.set_speed(0.5, 0);
  EXPECT_EQ(keeper.speed(), 1.0);
}

}  // namespace
}  // namespace ambf::runtime
