// The simulation under adversity: floods of requests, turns that last for ever, divergence, senseless numbers, ends at
// bad moments.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <thread>

#include "runtime/detail/answers.h"
#include "simulation_rig.h"

namespace ambf::runtime {
namespace {

using test::Rig;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

const std::string kBall = R"(
bodies: [BODY ball]
namespace: /test/
BODY ball: {name: ball, mass: 1, collision shape: SPHERE, collision geometry: {radius: 0.1}, shape: SPHERE,
  geometry: {radius: 0.1},
  location: {position: {x: -3, y: 0, z: 5}, orientation: {r: 0, p: 0, y: 0}}}
)";

// Absurdly fast after one step.
const std::string kBomb = R"(
bodies: [BODY bomb]
namespace: /test/
gravity: {x: 0, y: 0, z: -1.0e+6}
BODY bomb: {name: bomb, mass: 1, collision shape: SPHERE, collision geometry: {radius: 0.1}, shape: SPHERE,
  geometry: {radius: 0.1},
  location: {position: {x: -3, y: 0, z: 90}, orientation: {r: 0, p: 0, y: 0}}}
)";

void expect_good(const state::Frame& frame) {
  for (const state::BodyState& body : frame.bodies) {
    EXPECT_TRUE(math::is_finite(body.T_world_body));
    EXPECT_LT(math::norm(body.T_world_body.position), 100.0);
    EXPECT_LT(math::norm(body.twist_world.linear), 1e4);
  }
}

// Everything at once: nothing is left that moves.
const math::Vec3 kAbsurdGravity{1e12, 0, -1e12};

void diverge(Rig& rig) {
  rig.log.allow("diverged");
  rig.step(1);
  rig.simulation.set_gravity(kAbsurdGravity);
  EXPECT_FALSE(rig.step(100, {test::push(rig, "BODY box", {1, 0, 0})}).success);
  ASSERT_TRUE(rig.frame().run.diverged);
}

class Counted final : public Request {
 public:
  explicit Counted(std::atomic<int>& answers) : answers_(answers) {}
  Progress run(RequestScope&) override { return Progress::done; }
  void answer(bool) override { ++answers_; }

 private:
  std::atomic<int>& answers_;
};

TEST(Answers, EndOnlyAfterTheLastOne) {
  constexpr int kRounds = 5000;
  std::atomic<int> answers{0};
  for (int i = 0; i < kRounds; ++i) {
    Answers queue;
    ASSERT_TRUE(queue.reserve());
    for (volatile int wait = 0; wait < i * 148 % 20000;) wait = wait + 1;  // meets the thread at other places each time
    queue.push(std::make_unique<Counted>(answers), true);
  }
  EXPECT_EQ(answers, kRounds);
}

// A client that steps in a loop never finds the places taken by its own steps of before, however late the answering
// thread is.
TEST(Answers, WhoComesNextTakesAwayWhatNobodyWaitsFor) {
  std::atomic<int> answers{0};
  Answers queue;
  for (int i = 0; i < 10000; ++i) {
    ASSERT_TRUE(queue.reserve(4)) << i;
    queue.dispose(std::make_unique<Counted>(answers));
  }
  EXPECT_EQ(answers, 0);
}

TEST(Adversity, StructuralChangesAndPauseAreTakenHoweverManyStepsWait) {
  constexpr int kFlood = 2 * static_cast<int>(kMaxRequests);
  std::vector<std::unique_ptr<state::StepTicket>> tickets;
  {
    Rig rig;
    rig.log.expect_warning("are in flight");
    rig.simulation.begin();
    for (int i = 0; i < kFlood; ++i) tickets.push_back(rig.simulation.step(1'000'000'000, {}, false));
    const state::Outcome outcome = rig.load(kBall);
    EXPECT_TRUE(outcome.success) << outcome.message;
    EXPECT_TRUE(rig.id("BODY ball").valid());
    rig.simulation.set_paused(true);
    EXPECT_TRUE(rig.wait_until([](const state::Frame& frame) { return frame.run.paused; }));
  }
  for (const auto& ticket : tickets) EXPECT_TRUE(ticket->wait({})) << "each is answered, taken or not";
}

TEST(Adversity, ATurnOfMillionsOfStepsStillTakesRequests) {
  SimulationOptions options;
  options.fixed_step = true;
  options.physics_rate_hz = 1000;
  options.speed_factor = 1e7;  // 10 million steps a turn
  Rig rig(options);
  rig.simulation.begin();
  ASSERT_TRUE(rig.wait_until([](const state::Frame& frame) { return frame.sim_step > 1000; }));
  rig.simulation.set_paused(true);
  ASSERT_TRUE(rig.wait_until([](const state::Frame& frame) { return frame.run.paused; }));
  EXPECT_LT(rig.frame().sim_step, 10'000'000u);
}

TEST(Adversity, RequestsDoNotWaitForTheNextOfSlowTurns) {
  SimulationOptions options;
  options.physics_rate_hz = 1.0;
  Rig rig(options);
  rig.simulation.begin();
  const auto pointer = rig.simulation.make_pick_port();
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < 10; ++i) {
    std::promise<void> answered;
    pointer->pick({0, 0, 9}, {0, 0, 8}, [&](bool, const state::PickHit&) { answered.set_value(); });
    ASSERT_EQ(answered.get_future().wait_for(test::kPatience), std::future_status::ready);
  }
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5)) << "ten turns take ten seconds";
}

TEST(Adversity, NothingMovesADivergedWorld) {
  Rig rig;
  rig.simulation.begin();
  diverge(rig);
  const std::uint32_t at = rig.frame().sim_step;
  const state::Outcome outcome = rig.step(10);
  EXPECT_FALSE(outcome.success);
  EXPECT_NE(outcome.message.find("diverged"), std::string::npos) << outcome.message;
  rig.simulation.set_paused(true);
  rig.simulation.step_paused(10);
  rig.simulation.set_paused(false);
  int reports = 0;
  rig.step(0);
  for (base::LogRecord record; rig.log.take(record);) reports += record.text.find("diverged") != std::string::npos;
  EXPECT_EQ(reports, 1) << "it diverged once";
  EXPECT_EQ(rig.frame().sim_step, at);
  expect_good(rig.frame());
}

TEST(Adversity, ModelsComeAndGoInADivergedWorldWithoutShowingBadValues) {
  Rig rig;
  rig.simulation.begin();
  diverge(rig);
  const double box_x = rig.body("BODY box").T_world_body.position.x;
  ASSERT_TRUE(rig.load(kBall).success);
  expect_good(rig.frame());
  EXPECT_EQ(rig.body("BODY box").T_world_body.position.x, box_x);
  EXPECT_NEAR(rig.body("BODY ball").T_world_body.position.z, 5.0, 1e-9);
  ASSERT_TRUE(
      rig.wait_for([&](state::Completion done) { rig.simulation.remove("BODY crank", std::move(done)); }).success);
  expect_good(rig.frame());
  EXPECT_EQ(rig.body("BODY box").T_world_body.position.x, box_x);
  ASSERT_TRUE(
      rig.wait_for([&](state::Completion done) { rig.simulation.remove("BODY box", std::move(done)); }).success);
  rig.simulation.reset_world();
  ASSERT_TRUE(rig.wait_until([](const state::Frame& frame) { return !frame.run.diverged; }));
  EXPECT_TRUE(rig.step(10).success);
}

TEST(Adversity, CommandStatisticsStayTrueInADivergedWorld) {
  Rig rig;
  rig.simulation.begin();
  diverge(rig);
  const state::ObjectId crank = rig.id("BODY crank");
  const auto received = [&](const state::Frame& frame) {
    for (const state::CommandState& command : frame.commands)
      if (frame.structure->objects[command.object].id == crank) return command.received;
    return std::uint64_t{0};
  };
  const auto port = rig.simulation.bind(crank, state::Source::panel);
  port->post(test::push(rig, "BODY crank", {1, 0, 0}).command);
  ASSERT_TRUE(rig.wait_until([&](const state::Frame& frame) { return received(frame) == 1; }));
  for (int i = 0; i < 40; ++i) {  // through every slot of the frame pool
    rig.step(0);
    ASSERT_EQ(received(rig.frame()), 1u) << "frame " << i;
    ASSERT_EQ(rig.frame().commands.size(), 2u) << "the box was commanded, too";
    ASSERT_EQ(rig.frame().run.watchdog_s, 0.5);
    expect_good(rig.frame());
  }
}

TEST(Adversity, ABodyThatDivergesSoonAfterItWasLoadedNeverShowsBadValues) {
  Rig rig;
  rig.log.expect_warning("body '/test/bomb' diverged");
  rig.simulation.begin();
  ASSERT_TRUE(rig.load(kBomb).success);
  ASSERT_TRUE(rig.wait_until([](const state::Frame& frame) { return frame.frozen_bodies == 1; }));
  expect_good(rig.frame());
  EXPECT_FALSE(rig.frame().run.diverged);
  EXPECT_TRUE(rig.body("BODY bomb").frozen);
  EXPECT_TRUE(rig.step(100).success) << "the rest goes on";
  expect_good(rig.frame());
}

TEST(Adversity, ARestoredWorldGoesOnAfterDivergence) {
  Rig rig;
  rig.log.expect_warning("diverged");
  ASSERT_TRUE(
      rig.wait_for([&](state::Completion done) { rig.simulation.snapshot("good", "", std::move(done)); }).success);
  rig.simulation.begin();
  rig.simulation.set_gravity(kAbsurdGravity);
  ASSERT_TRUE(rig.wait_until([](const state::Frame& frame) { return frame.run.diverged; }));
  EXPECT_FALSE(
      rig.wait_for([&](state::Completion done) { rig.simulation.snapshot("bad", "", std::move(done)); }).success);
  ASSERT_TRUE(
      rig.wait_for([&](state::Completion done) { rig.simulation.restore("good", "", std::move(done)); }).success);
  EXPECT_TRUE(rig.wait_until([](const state::Frame& frame) { return !frame.run.diverged && frame.sim_step > 100; }));
}

TEST(Adversity, WildCommandsStopNobody) {
  Rig rig;
  rig.log.expect_warning("body '/test/box': the step service asks for more than 1000 m/s or rad/s");
  rig.log.expect_warning("body '/test/crank': the step service asks for more than 1000 m/s or rad/s");
  rig.log.allow("diverged");  // what a linkage bears within its loop is not known beforehand
  // On a busy machine the box would lie on the floor by now: spun there at 1000 rad/s it diverges, as it may.
  rig.simulation.set_gravity({0, 0, 0});
  rig.simulation.begin();
  rig.step(1);
  state::AddressedCommand fast{rig.id("BODY box"), state::RigidBodyCommand{}};
  auto& command = std::get<state::RigidBodyCommand>(fast.command);
  command.type = state::CartesianCommandType::velocity;
  command.twist_world = {{1e6, 0, 0}, {0, 0, 1e6}};
  EXPECT_TRUE(rig.step(200, {fast, test::crank_command(rig, state::JointCommandType::effort, 9e8)}).success);
  command.type = state::CartesianCommandType::position;
  command.T_world_body.position = {0, 0, 1e6};
  EXPECT_TRUE(rig.step(200, {fast, test::push(rig, "BODY crank", {0, 0, 1e9})}).success);
  EXPECT_FALSE(rig.frame().run.diverged);
  EXPECT_FALSE(rig.frame().run.paused);
  for (const state::BodyState& body : rig.frame().bodies) EXPECT_LT(math::norm(body.twist_world.linear), 1e4);
  EXPECT_FALSE(rig.body("BODY box").frozen);
}

TEST(Adversity, APauseOutlivesDivergenceAndReset) {
  Rig rig;
  rig.simulation.set_paused(true);
  rig.simulation.begin();
  diverge(rig);
  rig.simulation.reset_world();
  ASSERT_TRUE(rig.wait_until([](const state::Frame& frame) { return !frame.run.diverged; }));
  EXPECT_TRUE(rig.frame().run.paused);
}

TEST(Adversity, ResetBringsBackTheWorldsGravity) {
  Rig rig;
  rig.simulation.begin();
  rig.step(1);
  rig.simulation.set_gravity({0, 0, 0});
  const std::uint64_t epoch = rig.frame().epoch;
  rig.simulation.reset_world();
  ASSERT_TRUE(rig.wait_until([&](const state::Frame& frame) { return frame.epoch > epoch; }));
  rig.step(100);
  EXPECT_LT(rig.body("BODY box").twist_world.linear.z, -0.9);
}

TEST(Adversity, SenselessNumbersAreRefusedAndCounted) {
  Rig rig;
  rig.log.expect_warning("gravity refused");
  rig.log.expect_warning("dragging target refused");
  rig.log.expect_warning("picking ray refused");
  rig.simulation.begin();
  rig.step(1);
  rig.simulation.set_gravity({0, kNan, 0});
  const auto pointer = rig.simulation.make_pick_port();
  pointer->drag({kNan, 0, 0});
  std::promise<bool> hit;
  pointer->pick({kNan, 0, 0}, {0, 0, 0}, [&](bool found, const state::PickHit&) { hit.set_value(found); });
  EXPECT_FALSE(hit.get_future().get());
  pointer->pick({0, 0, 9}, {0, 0, 8}, {});  // nobody wants the answer
  EXPECT_TRUE(rig.step(10).success);
  EXPECT_EQ(rig.frame().run.commands_refused, 3u);
}

TEST(Adversity, AStepThatCommandsWhatIsGoneIsRefused) {
  Rig rig;
  rig.simulation.begin();
  const std::uint32_t at = rig.step(1).sim_step;
  state::AddressedCommand command = test::push(rig, "BODY box", {1, 0, 0});
  ASSERT_TRUE(
      rig.wait_for([&](state::Completion done) { rig.simulation.remove("BODY box", std::move(done)); }).success);
  EXPECT_FALSE(rig.step(10, {command}).success);
  EXPECT_EQ(rig.step(0).sim_step, at);
}

TEST(Adversity, LatenessDoesNotCountWhatNobodyPromised) {
  Rig rig((SimulationOptions()));
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));  // before it begins, as while models load
  rig.simulation.begin();
  ASSERT_TRUE(rig.wait_until([](const state::Frame& frame) { return frame.run.steps_per_second > 100; }));
  EXPECT_LT(rig.frame().run.lateness_max, 1.0);
  EXPECT_GT(rig.frame().run.seconds_per_phase[static_cast<int>(state::Phase::publish)], 0.0);
}

}  // namespace
}  // namespace ambf::runtime
