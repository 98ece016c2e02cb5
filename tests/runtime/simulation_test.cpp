// The running simulation through its abilities: stepping, throttling, pausing, resets, divergence, loading while it
// runs.
#include "runtime/simulation.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <random>
#include <thread>

#include "simulation_rig.h"

namespace ambf::runtime {
namespace {

using test::Rig;

SimulationOptions real_time() { return {}; }

TEST(Simulation, HoldsStillUntilItBegins) {
  Rig rig;
  ASSERT_TRUE(rig.loaded.success) << rig.loaded.message;
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(rig.frame().sim_step, 0u);
  rig.simulation.begin();
  EXPECT_TRUE(rig.wait_until([](const state::Frame& frame) { return frame.sim_step > 100; }));
}

TEST(Simulation, KeepsRealTime) {
  Rig rig(real_time());
  rig.simulation.begin();
  ASSERT_TRUE(rig.wait_until([](const state::Frame& frame) { return frame.sim_step > 10; }));
  const state::Frame first = rig.frame();
  std::this_thread::sleep_for(std::chrono::seconds(2));
  const state::Frame last = rig.frame();
  const double wall = static_cast<double>(last.steady_ns - first.steady_ns) * 1e-9;
  const double given_up = static_cast<double>(last.run.steps_given_up - first.run.steps_given_up) * 1e-3;
  // What was not simulated was counted as given up: together they are the wall time, to a turn's length.
  EXPECT_NEAR(last.sim_time - first.sim_time + given_up, wall, 0.025);
  EXPECT_NEAR(last.sim_time, last.sim_step * 1e-3, 1e-9);
}

TEST(Simulation, StepServiceRunsExactlyTheStepsAskedAndShowsTheirFrame) {
  Rig rig;
  rig.simulation.begin();
  std::uint32_t at = rig.step(1).sim_step;
  for (const unsigned n : {1u, 7u, 250u, 0u, 3u}) {
    const state::Outcome outcome = rig.step(n);
    ASSERT_TRUE(outcome.success) << outcome.message;
    EXPECT_EQ(outcome.sim_step, at + n);
    EXPECT_EQ(rig.frame().sim_step, at + n);
    at += n;
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(rig.frame().sim_step, at) << "the world waits for the next Step";
}

TEST(Simulation, StepsAskedForByManyClientsAllHappen) {
  Rig rig;
  rig.simulation.begin();
  const std::uint32_t before = rig.step(1).sim_step;
  std::vector<std::thread> clients;
  std::atomic<int> good{0};
  for (int c = 0; c < 4; ++c) {
    clients.emplace_back([&] {
      for (int i = 0; i < 50; ++i) good += rig.step(3).success;
    });
  }
  for (std::thread& client : clients) client.join();
  EXPECT_EQ(good, 200);
  EXPECT_EQ(rig.frame().sim_step, before + 600);
}

TEST(Simulation, ThrottleTogglesAreNeverLost) {
  Rig rig;
  state::WorldCommand command;
  command.enable_step_throttling = true;
  command.client = 7;
  rig.simulation.post_world(command);
  rig.simulation.begin();
  std::mt19937 random(5);
  std::uniform_int_distribution<unsigned> skip(1, 20);
  std::uint64_t granted = 0;
  constexpr unsigned kToggles = 2000;
  for (unsigned i = 0; i < kToggles; ++i) {
    command.step_clock = !command.step_clock;
    command.n_skip_steps = skip(random);
    granted += command.n_skip_steps;
    rig.simulation.post_world(command);
  }
  ASSERT_TRUE(rig.wait_until([&](const state::Frame& frame) { return frame.toggles == kToggles; }));
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(rig.frame().sim_step, granted);
  EXPECT_TRUE(rig.frame().run.throttled);
  command.enable_step_throttling = false;
  rig.simulation.post_world(command);
  EXPECT_TRUE(rig.wait_until([&](const state::Frame& frame) { return frame.sim_step > granted + 10; }));
}

TEST(Simulation, PausesStepsAndGoesOn) {
  Rig rig;
  rig.simulation.set_paused(true);
  rig.simulation.begin();
  rig.simulation.step_paused(5);
  ASSERT_TRUE(rig.wait_until([](const state::Frame& frame) { return frame.sim_step == 5; }));
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(rig.frame().sim_step, 5u);
  EXPECT_TRUE(rig.frame().run.paused);
  rig.simulation.set_paused(false);
  EXPECT_TRUE(rig.wait_until([](const state::Frame& frame) { return frame.sim_step > 50; }));
}

TEST(Simulation, ForcesActInEveryStep) {
  Rig rig(test::free_running(), R"(
bodies: [BODY puck]
namespace: /test/
gravity: {x: 0, y: 0, z: 0}
BODY puck: {name: puck, mass: 2, damping: {linear: 0, angular: 0}, collision shape: SPHERE,
  collision geometry: {radius: 0.1},
  shape: SPHERE, geometry: {radius: 0.1}, location: {position: {x: 0, y: 0, z: 1}, orientation: {r: 0, p: 0, y: 0}}}
)");
  ASSERT_TRUE(rig.loaded.success) << rig.loaded.message;
  rig.simulation.begin();
  rig.step(1);
  // 200 steps of 1 N, well within the watchdog: momentum 0.2 Ns (the dissertation's bursts must not multiply or lose
  // forces).
  rig.step(200, {test::push(rig, "BODY puck", {1, 0, 0})});
  EXPECT_NEAR(2.0 * rig.body("BODY puck").twist_world.linear.x, 0.2, 1e-9);
}

TEST(Simulation, WatchdogEndsACommandThatNobodyRenews) {
  Rig rig(test::free_running(), test::kScene);
  rig.simulation.begin();
  rig.step(1);
  rig.step(100, {test::push(rig, "BODY box", {5, 0, 0})});
  EXPECT_TRUE(rig.body("BODY box").active);
  rig.step(700);  // 0.5 s of simulated time are over
  EXPECT_FALSE(rig.body("BODY box").active);
}

TEST(Simulation, ResetBringsBackPosesTimeAndSteps) {
  Rig rig;
  rig.simulation.begin();
  rig.step(1);
  rig.step(500);
  const std::uint64_t epoch = rig.frame().epoch;
  EXPECT_LT(rig.body("BODY box").T_world_body.position.z, 0.2);
  rig.simulation.reset_world();
  ASSERT_TRUE(rig.wait_until([&](const state::Frame& frame) { return frame.epoch > epoch; }));
  EXPECT_EQ(rig.frame().sim_step, 0u);
  EXPECT_EQ(rig.frame().sim_time, 0.0);
  EXPECT_NEAR(rig.body("BODY box").T_world_body.position.z, 0.3, 1e-12);
}

TEST(Simulation, DivergenceStopsTheWorldAndKeepsTheLastGoodFrame) {
  Rig rig;
  rig.simulation.begin();
  rig.step(1);
  rig.simulation.set_gravity({1e12, 0, -1e12});  // of all that moves
  rig.step(100);
  const state::Frame& frame = rig.frame();
  EXPECT_TRUE(frame.run.diverged);
  EXPECT_TRUE(frame.run.paused);
  for (const state::BodyState& body : frame.bodies) {
    EXPECT_TRUE(math::is_finite(body.T_world_body));
    EXPECT_LT(math::norm(body.T_world_body.position), 100.0);
  }
  bool named = false;
  for (base::LogRecord record; rig.log.take(record);) named |= record.text.find("/test/box") != std::string::npos;
  EXPECT_TRUE(named) << "the log says which body";
  rig.simulation.reset_world();
  ASSERT_TRUE(rig.wait_until([](const state::Frame& f) { return !f.run.diverged; }));
  EXPECT_TRUE(rig.step(10).success);
}

TEST(Simulation, FramesTellWhatDrawingAndCommReported) {
  Rig rig(real_time());
  rig.simulation.begin();
  rig.simulation.report_graphics(25.0, 0.012);
  rig.simulation.report_comm(4e-5);
  EXPECT_TRUE(rig.wait_until([](const state::Frame& frame) {
    return frame.run.graphics_rate == 25.0 && frame.run.seconds_per_picture == 0.012 &&
           frame.run.comm_seconds_per_frame == 4e-5;
  }));
}

TEST(Simulation, LoadsAndUnloadsWhileItRuns) {
  Rig rig(real_time());
  rig.simulation.begin();
  const std::size_t before = rig.frame().bodies.size();
  const state::Outcome again = rig.load(test::kScene);
  ASSERT_TRUE(again.success) << again.message;
  ASSERT_TRUE(rig.wait_until([&](const state::Frame& frame) { return frame.bodies.size() == before + 6; }));
  EXPECT_TRUE(rig.id("/test/box1").valid()) << "the second one is renamed";
  const state::Outcome gone =
      rig.wait_for([&](state::Completion done) { rig.simulation.unload(again.model, std::move(done)); });
  ASSERT_TRUE(gone.success) << gone.message;
  EXPECT_TRUE(rig.wait_until([&](const state::Frame& frame) { return frame.bodies.size() == before; }));
  EXPECT_FALSE(rig.id("/test/box1").valid());
}

TEST(Simulation, ABadFileChangesNothing) {
  Rig rig;
  rig.log.expect_warning("YAML syntax error");
  rig.simulation.begin();
  const auto structure = rig.simulation.structure();
  const state::Outcome outcome = rig.load("bodies: [BODY a\n");
  EXPECT_FALSE(outcome.success);
  EXPECT_TRUE(base::has_errors(outcome.diagnostics));
  EXPECT_EQ(rig.simulation.structure(), structure);
}

TEST(Simulation, AnswersRequestsThatAreInFlightWhenItEnds) {
  std::atomic<int> answers{0};
  std::vector<std::unique_ptr<state::StepTicket>> tickets;
  {
    Rig rig;
    rig.log.allow("nothing of that name");  // of those that came before the end
    rig.simulation.begin();
    for (int i = 0; i < 20; ++i) {
      tickets.push_back(rig.simulation.step(1'000'000, {}, false));
      rig.simulation.remove("nothing of that name", [&](const state::Outcome&) { ++answers; });
    }
  }
  EXPECT_EQ(answers, 20);
  for (const auto& ticket : tickets) EXPECT_TRUE(ticket->wait({}));
}

}  // namespace
}  // namespace ambf::runtime
