// Steps asked for by several at once: each is shown the frame of its own last step.
#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "base/clock.h"
#include "exchange/frame_pool.h"
#include "runtime/detail/answers.h"
#include "simulation_rig.h"

namespace ambf::runtime {
namespace {

using test::Rig;

const std::string kFloating = R"(
bodies: [BODY box]
BODY box:
  {name: box, mass: 2, shape: BOX, geometry: {x: 0.1, y: 0.1, z: 0.1}, collision shape: BOX,
   collision geometry: {x: 0.1, y: 0.1, z: 0.1}, gravity: {x: 0, y: 0, z: 0}, damping: {linear: 0, angular: 0},
   location: {position: {x: 0, y: 0, z: 5}, orientation: {r: 0, p: 0, y: 0}}}
)";

state::AddressedCommand push(Rig& rig) { return test::push(rig, "BODY box", {2.0, 0.0, 0.0}); }

TEST(Steps, EachOfSeveralClientsGetsTheFrameOfItsVeryLastStep) {
  Rig rig;
  rig.simulation.begin();
  const std::uint32_t start = rig.step(1) /* from now on the world waits for requests */.sim_step;
  constexpr unsigned kCalls = 300;
  std::vector<std::thread> clients;
  std::vector<std::set<std::uint32_t>> ends(3);
  std::atomic<unsigned> wrong{0};
  for (unsigned client = 0; client < 3; ++client) {
    clients.emplace_back([&, client] {
      for (unsigned call = 0; call < kCalls; ++call) {
        const auto ticket = rig.simulation.step(1 + client, {}, true);
        if (!ticket->wait(test::kPatience) || !ticket->outcome().success) {
          ++wrong;
          return;
        }
        std::this_thread::yield();  // the others step on
        const state::Frame* frame = ticket->frame();
        if (frame == nullptr || frame->sim_step != ticket->outcome().sim_step) ++wrong;
        ends[client].insert(ticket->outcome().sim_step);
      }
    });
  }
  for (std::thread& client : clients) client.join();
  EXPECT_EQ(wrong, 0u);
  std::set<std::uint32_t> all;
  for (const auto& own : ends) {
    EXPECT_EQ(own.size(), kCalls);
    all.insert(own.begin(), own.end());
  }
  EXPECT_EQ(all.size(), 3 * kCalls) << "no two requests end with the same step";
  EXPECT_EQ(*all.rbegin(), start + kCalls * (1 + 2 + 3)) << "none lost, none doubled";
}

TEST(Steps, AClientThatPausesLetsPhysicsSleep) {
  Rig rig;
  rig.simulation.begin();
  for (int call = 0; call < 200; ++call) rig.step(1);  // quickly: physics has got used to it
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  const std::int64_t begin = base::steady_ns(), cpu = base::process_cpu_ns();
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  EXPECT_LT(base::process_cpu_ns() - cpu, (base::steady_ns() - begin) / 4);
  EXPECT_TRUE(rig.step(1).success);
}

TEST(Steps, ACommandThatComesWithThemIsReceivedWhenItsRequestIs) {
  Rig rig;
  rig.simulation.begin();
  rig.step(1);
  const std::int64_t before = base::steady_ns();
  const auto long_one = rig.simulation.step(5000, {}, false);
  const auto ticket = rig.simulation.step(1, {push(rig)}, true);
  const std::int64_t asked = base::steady_ns();
  ASSERT_TRUE(long_one->wait(test::kPatience));
  ASSERT_TRUE(ticket->wait(test::kPatience));
  const state::Frame& frame = *ticket->frame();
  ASSERT_EQ(frame.commands.size(), 1u);
  EXPECT_EQ(frame.commands[0].source, state::Source::step_service);
  EXPECT_GE(frame.commands[0].received_ns, before);
  EXPECT_LE(frame.commands[0].received_ns, asked) << "not when its turn came";
  EXPECT_GT(frame.commands[0].applied_ns, asked) << "after thousands of steps";
  EXPECT_EQ(frame.commands[0].applied, 1u);
}

TEST(Steps, RefusedCommandsAreCountedForTheirObject) {
  Rig rig;
  rig.simulation.begin();
  rig.step(1);
  const std::uint64_t before = rig.frame().run.commands_refused;
  rig.simulation.count_refused_command(rig.id("BODY box"));
  rig.simulation.count_refused_command({});
  rig.step(1);
  EXPECT_EQ(rig.frame().run.commands_refused, before + 2);
  ASSERT_EQ(rig.frame().commands.size(), 1u);
  EXPECT_EQ(rig.frame().commands[0].refused, 1u);
}

TEST(Steps, MoreThanThereArePlacesForCanBeMadeOneAfterTheOther) {
  Rig rig;
  rig.simulation.begin();
  for (std::size_t i = 0; i < 2 * kMaxRequests; ++i) {
    const auto ticket = rig.simulation.step(1, {}, true);
    ASSERT_TRUE(ticket->wait(test::kPatience));
    ASSERT_TRUE(ticket->outcome().success) << i << ": " << ticket->outcome().message;
  }
}

TEST(Steps, AreRefusedWhenTheirFrameCannotBeKept) {
  Rig rig;
  rig.simulation.begin();
  std::vector<std::unique_ptr<state::FrameReader>> readers;
  for (int i = 0; i < base::kMaxReaders; ++i) readers.push_back(rig.simulation.make_reader());
  const auto kept = rig.simulation.step(1, {}, true);
  ASSERT_TRUE(kept->wait({}));
  EXPECT_FALSE(kept->outcome().success);
  EXPECT_EQ(kept->frame(), nullptr);
  EXPECT_TRUE(rig.step(1).success) << "which does not ask for one";
  readers.clear();
  const auto again = rig.simulation.step(1, {}, true);
  ASSERT_TRUE(again->wait(test::kPatience));
  EXPECT_TRUE(again->outcome().success) << again->outcome().message;
}

TEST(Steps, GoOnWhenTheirTicketIsLetGo) {
  Rig rig;
  rig.simulation.begin();
  const std::uint32_t start = rig.step(1).sim_step;
  for (int i = 0; i < 20; ++i) rig.simulation.step(100, {}, i < 3);
  EXPECT_EQ(rig.step(1).sim_step, start + 2001);
}

constexpr unsigned kWithoutEnd = 4'000'000'000u;

TEST(Steps, WithoutEndAreEndedByAReleaseOfTheWorld) {
  Rig rig;
  rig.simulation.begin();
  const std::uint32_t start = rig.step(1).sim_step;
  const auto ticket = rig.simulation.step(kWithoutEnd, {}, true);
  ASSERT_TRUE(rig.wait_until([&](const state::Frame& frame) { return frame.sim_step > start; }));
  EXPECT_FALSE(ticket->wait({}));
  rig.simulation.post_world({});  // as whoever finds the world busy with steps of a client that died
  ASSERT_TRUE(ticket->wait(test::kPatience));
  EXPECT_FALSE(ticket->outcome().success);
  EXPECT_NE(ticket->outcome().message.find("paused or released"), std::string::npos) << ticket->outcome().message;
  ASSERT_NE(ticket->frame(), nullptr);
  EXPECT_EQ(ticket->frame()->sim_step, ticket->outcome().sim_step);
  const std::uint32_t at = ticket->outcome().sim_step;
  EXPECT_TRUE(rig.wait_until([&](const state::Frame& frame) { return frame.sim_step > at && !frame.run.throttled; }))
      << "it runs by itself";
  const std::uint32_t next = rig.step(1).sim_step;
  EXPECT_EQ(rig.step(10).sim_step, next + 10) << "later steps are whole";
}

TEST(Steps, WithoutEndAreEndedByAPause) {
  Rig rig;
  rig.simulation.begin();
  const std::uint32_t start = rig.step(1).sim_step;
  const auto ticket = rig.simulation.step(kWithoutEnd, {}, false);
  ASSERT_TRUE(rig.wait_until([&](const state::Frame& frame) { return frame.sim_step > start; }));
  rig.simulation.set_paused(true);
  ASSERT_TRUE(ticket->wait(test::kPatience));
  EXPECT_FALSE(ticket->outcome().success);
  const std::uint32_t at = rig.frame().sim_step;
  EXPECT_EQ(rig.step(10).sim_step, at + 10) << "what is asked for while it is paused is run";
}

TEST(Steps, UnderWayAreFinishedBeforeAReleaseOrAPauseIfTheySoonAre) {
  Rig rig;
  rig.simulation.begin();
  const std::uint32_t start = rig.step(1).sim_step;
  for (unsigned i = 1; i <= 20; ++i) {
    const auto ticket = rig.simulation.step(100, {}, true);
    rig.simulation.set_paused(i % 2 == 0);
    if (i % 2 == 1) rig.simulation.post_world({true, false, 1, 0});
    ASSERT_TRUE(ticket->wait(test::kPatience));
    EXPECT_TRUE(ticket->outcome().success) << ticket->outcome().message;
    EXPECT_EQ(ticket->outcome().sim_step, start + 100 * i);
  }
  const auto ticket = rig.simulation.step(100, {}, true);
  rig.simulation.post_world({});
  ASSERT_TRUE(ticket->wait(test::kPatience));
  EXPECT_TRUE(ticket->outcome().success) << ticket->outcome().message;
}

TEST(Steps, HoldTheirCommandsToTheLastHoweverLongItTakes) {
  Rig rig(test::free_running(), kFloating);
  rig.simulation.begin();
  ASSERT_TRUE(rig.step(1).success);
  const double before = rig.body("BODY box").twist_world.linear.x;
  // Far longer than the watchdog's half second, and many turns of the physics thread.
  constexpr unsigned kSteps = 50'000;
  const auto at = rig.frame().sim_step;
  ASSERT_TRUE(rig.step(kSteps, {push(rig)}).success);
  EXPECT_EQ(rig.frame().sim_step, at + kSteps);
  EXPECT_NEAR(rig.body("BODY box").twist_world.linear.x - before, 1e-3 * kSteps, 1e-6);
}

TEST(Steps, LetACommandExpireAtTheSameStepHoweverTheyAreAskedFor) {
  std::vector<double> speeds;
  for (const unsigned at_once : {1000u, 100u, 1u}) {
    Rig rig(test::free_running(), kFloating);
    rig.simulation.begin();
    rig.step(1);
    ASSERT_TRUE(rig.step(1, {push(rig)}).success);
    for (unsigned steps = 0; steps < 1000; steps += at_once) rig.step(at_once);
    speeds.push_back(rig.body("BODY box").twist_world.linear.x);
  }
  EXPECT_NEAR(speeds[0], 0.5, 5e-3) << "half a second";
  EXPECT_EQ(speeds[1], speeds[0]);
  EXPECT_EQ(speeds[2], speeds[0]);
}

// Reads the steps that there are; returns their numbers.
std::vector<std::uint32_t> read_all(state::StepReader& steps) {
  std::vector<std::uint32_t> numbers;
  while (const state::Frame* frame = steps.next()) numbers.push_back(frame->sim_step);
  return numbers;
}

std::vector<std::uint32_t> numbers(std::uint32_t first, std::uint32_t count) {
  std::vector<std::uint32_t> out(count);
  std::iota(out.begin(), out.end(), first);
  return out;
}

TEST(Steps, EachIsReadByTheReaderOfSteps) {
  Rig rig;
  rig.simulation.begin();
  const std::uint32_t start = rig.step(1).sim_step;
  const auto steps = rig.simulation.read_steps();
  ASSERT_NE(steps, nullptr);
  EXPECT_EQ(rig.simulation.read_steps(), nullptr) << "one reader";
  EXPECT_EQ(steps->next(), nullptr) << "none was run since";
  rig.step(100);
  EXPECT_EQ(read_all(*steps), numbers(start + 1, 100));
  rig.load(kFloating);  // frames of another size
  rig.step(100);
  EXPECT_EQ(read_all(*steps), numbers(start + 101, 100));
}

TEST(Steps, WaitForTheirReaderWhereTimeDoes) {
  Rig rig;
  rig.simulation.begin();
  const std::uint32_t start = rig.step(1).sim_step;
  auto steps = rig.simulation.read_steps();
  const auto ticket = rig.simulation.step(2000, {}, false);
  EXPECT_FALSE(ticket->wait(std::chrono::milliseconds(50))) << "the reader has not read";
  std::vector<std::uint32_t> seen;
  while (seen.size() < 2000) {
    const auto more = read_all(*steps);
    seen.insert(seen.end(), more.begin(), more.end());
  }
  EXPECT_EQ(seen, numbers(start + 1, 2000));
  EXPECT_TRUE(ticket->wait(test::kPatience));
  const auto unread = rig.simulation.step(2000, {}, false);
  steps.reset();
  EXPECT_TRUE(unread->wait(test::kPatience)) << "nobody reads any more";
}

TEST(Steps, ARequestKnowsTheFirstStepThatObeysIt) {
  Rig rig;
  rig.simulation.begin();
  const std::uint32_t start = rig.step(1).sim_step;
  for (const unsigned n : {5U, 0U}) {
    const auto ticket = rig.simulation.step(n, {}, true);
    ASSERT_TRUE(ticket->wait(test::kPatience));
    EXPECT_EQ(ticket->first_step() + n, ticket->frame()->sim_step + 1);
    EXPECT_EQ(ticket->first_step(), n == 5 ? start + 1 : start + 6);
  }
}

}  // namespace
}  // namespace ambf::runtime
