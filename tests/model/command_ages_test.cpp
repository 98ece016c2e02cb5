// What frames tell of commands: when they came and when a step obeyed them, from whom, how regularly, and what became
// of each.
#include <gtest/gtest.h>

#include <chrono>
#include <limits>
#include <thread>

#include "base/clock.h"
#include "model/detail/spread_meter.h"
#include "rig.h"
#include "tests/support/views.h"

namespace ambf::model::test {
namespace {

using state::ObjectKind;
using state::Source;

// A box and a camera.
struct AgesRig : Rig {
  AgesRig() {
    scene::Model scene = model("a", {box("a", 1.0, {0, 0, 0})});
    scene.cameras.push_back(test_camera());
    load(scene);
  }
  // Without a step, as while paused.
  void turn() {
    live->take_commands(watchdog_s);
    live->fill(*frame);
  }
  // Null when the frame tells nothing of it.
  const state::CommandState* told(const std::string& name, ObjectKind kind = ObjectKind::rigid_body) const {
    for (const state::CommandState& each : frame->commands)
      if (each.object == object(name, kind)) return &each;
    return nullptr;
  }
};

TEST(CommandAges, TellNothingOfWhatNobodyCommanded) {
  AgesRig rig;
  const auto port = rig.port("a");
  rig.step();
  EXPECT_TRUE(rig.frame->commands.empty());
  EXPECT_EQ(rig.frame->run.watchdog_s, 0.5);
}

TEST(CommandAges, SayWhenACommandCameAndWhenAStepObeyedIt) {
  AgesRig rig;
  const auto port = rig.port("a");
  const std::int64_t before = base::steady_ns();
  port->post(force({1, 0, 0}));
  const std::int64_t between = base::steady_ns();
  rig.step();
  ASSERT_NE(rig.told("a"), nullptr);
  const state::CommandState told = *rig.told("a");
  EXPECT_TRUE(told.in_force);
  EXPECT_GE(told.received_ns, before);
  EXPECT_LE(told.received_ns, between);
  EXPECT_GE(told.applied_ns, between);
  EXPECT_LE(told.applied_ns, base::steady_ns());
  EXPECT_EQ(told.received, 1u);
  EXPECT_EQ(told.applied, 1u);
  EXPECT_EQ(told.coalesced, 0u);
  rig.step(100);
  EXPECT_EQ(rig.told("a")->applied, 1u) << "obeyed in many steps, applied once";
  EXPECT_EQ(rig.told("a")->applied_ns, told.applied_ns);
  EXPECT_NEAR(rig.told("a")->silent_s, 0.1, 0.0021);
  port->keep_alive();
  rig.step();
  EXPECT_LT(rig.told("a")->silent_s, 0.0021) << "a sign of life";
  EXPECT_EQ(rig.told("a")->received_ns, told.received_ns) << "but no other command";
  EXPECT_EQ(rig.told("a")->received, 1u);
}

TEST(CommandAges, OfACommandThatWaitedBeginWhereItsSenderLetGoOfIt) {
  AgesRig rig;
  const auto port = rig.port("a", Source::step_service);
  const std::int64_t long_ago = base::steady_ns() - 70'000'000;
  port->post(force({1, 0, 0}), long_ago);
  rig.step();
  EXPECT_EQ(rig.told("a")->received_ns, long_ago);
  EXPECT_GE(rig.told("a")->applied_ns - long_ago, 70'000'000);
}

TEST(CommandAges, CountWhatANewerOneReplacedBeforeAnyStepObeyedIt) {
  AgesRig rig;
  const auto port = rig.port("a");
  for (int i = 0; i < 3; ++i) port->post(force({1, 0, 0}));
  rig.step();
  EXPECT_EQ(rig.told("a")->received, 3u);
  EXPECT_EQ(rig.told("a")->applied, 1u);
  EXPECT_EQ(rig.told("a")->coalesced, 2u);
  // While paused they are looked at, one by one, and none is obeyed.
  for (int i = 0; i < 4; ++i) {
    port->post(force({1, 0, 0}));
    rig.turn();
    EXPECT_TRUE(rig.told("a")->in_force);
    EXPECT_EQ(rig.told("a")->applied_ns, 0);
  }
  EXPECT_EQ(rig.told("a")->received, 7u);
  EXPECT_EQ(rig.told("a")->applied, 1u);
  EXPECT_EQ(rig.told("a")->coalesced, 5u) << "the last one still waits";
  rig.step();
  EXPECT_EQ(rig.told("a")->applied, 2u);
  EXPECT_EQ(rig.told("a")->coalesced, 5u);
  EXPECT_GT(rig.told("a")->applied_ns, rig.told("a")->received_ns);
}

TEST(CommandAges, CountWhatEndedBeforeAnyStepObeyedItAsNotApplied) {
  AgesRig rig;
  const auto port = rig.port("a");
  port->post(force({1, 0, 0}));
  port->release();  // before anybody looked
  rig.step();
  port->post(force({1, 0, 0}));
  rig.turn();
  port->release();  // after that, before a step
  rig.step();
  port->post(force({1, 0, 0}));
  rig.turn();
  rig.live->reset();
  rig.step();
  EXPECT_EQ(rig.told("a")->received, 3u);
  EXPECT_EQ(rig.told("a")->applied, 0u);
  EXPECT_EQ(rig.told("a")->coalesced, 3u);
  EXPECT_EQ(rig.told("a")->expired, 0u);
  EXPECT_FALSE(rig.told("a")->in_force);
}

TEST(CommandAges, OfACameraEndWithoutAStepBecauseItObeysAtOnce) {
  AgesRig rig;
  const auto port = rig.port("eye", Source::pointer, ObjectKind::camera);
  port->post(state::PoseCommand{true, {{1, 0, 0}, {}}});
  rig.turn();
  const state::CommandState* told = rig.told("eye", ObjectKind::camera);
  ASSERT_NE(told, nullptr);
  EXPECT_EQ(told->source, Source::pointer);
  EXPECT_EQ(told->applied, 1u);
  EXPECT_GE(told->applied_ns, told->received_ns);
}

TEST(CommandAges, CountWhatTheWatchdogEnded) {
  AgesRig rig;
  const auto port = rig.port("a");
  port->post(force({1, 0, 0}));
  rig.step(450);
  EXPECT_EQ(rig.told("a")->expired, 0u);
  EXPECT_GT(rig.told("a")->silent_s, 0.9 * rig.frame->run.watchdog_s);
  rig.step(100);
  EXPECT_EQ(rig.told("a")->expired, 1u);
  EXPECT_FALSE(rig.told("a")->in_force);
  EXPECT_EQ(rig.told("a")->sources, 0u);
  port->post(force({1, 0, 0}));
  rig.step();
  port->release();
  rig.step(600);
  EXPECT_EQ(rig.told("a")->expired, 1u) << "let go, not expired";
}

TEST(CommandAges, CountWhatWasRefused) {
  AgesRig rig;
  rig.commands.count_refused(rig.id("a"));
  rig.commands.count_refused(rig.id("a"));
  rig.commands.count_refused({1234, 1});  // none that is there
  rig.step();
  ASSERT_NE(rig.told("a"), nullptr);
  EXPECT_EQ(rig.told("a")->refused, 2u);
  EXPECT_EQ(rig.told("a")->received, 0u);
  EXPECT_FALSE(rig.told("a")->in_force);
  EXPECT_EQ(rig.frame->commands.size(), 1u);
  rig.port("a")->post(state::PoseCommand{});  // for another kind of object
  rig.step();
  EXPECT_EQ(rig.told("a")->refused, 3u);
  EXPECT_EQ(rig.told("a")->received, 0u);
}

TEST(CommandAges, CountCommandsForMoreJointsThanThereAre) {
  Rig rig;
  rig.load(chain(3));  // two joints
  const auto port = rig.port("link0");
  port->post(joints({to_effort(0), to_effort(0)}));
  rig.step();
  ASSERT_EQ(rig.frame->commands.size(), 1u);
  EXPECT_EQ(rig.frame->commands[0].beyond, 0u);
  port->post(joints({to_effort(0), to_effort(0), to_effort(0)}));
  rig.step();
  EXPECT_EQ(rig.frame->commands[0].beyond, 1u);
  EXPECT_EQ(rig.frame->commands[0].applied, 2u);
}

TEST(CommandAges, AreThoseOfTheSourceThatPostedLastAndThenOfWhoeverIsLeft) {
  AgesRig rig;
  const auto ros = rig.port("a", Source::ros), panel = rig.port("a", Source::panel);
  ros->post(force({1, 0, 0}));
  rig.step();
  EXPECT_EQ(rig.told("a")->source, Source::ros);
  const std::int64_t of_ros = rig.told("a")->received_ns;
  panel->post(force({0, 1, 0}));
  rig.step();
  EXPECT_EQ(rig.told("a")->source, Source::panel);
  EXPECT_GT(rig.told("a")->received_ns, of_ros);
  EXPECT_EQ(rig.told("a")->sources, (1u << int(Source::ros)) | (1u << int(Source::panel)));
  EXPECT_EQ(rig.told("a")->received, 2u) << "of all sources";
  panel->release();
  rig.step();
  EXPECT_EQ(rig.told("a")->source, Source::ros);
  EXPECT_EQ(rig.told("a")->received_ns, of_ros);
  EXPECT_EQ(rig.told("a")->sources, 1u << int(Source::ros));
  ros->release();
  rig.step();
  EXPECT_FALSE(rig.told("a")->in_force);
  EXPECT_EQ(rig.told("a")->source, Source::panel) << "the last of all";
}

// Stamps are handed in, so that the machine's own jitter plays no part.
TEST(CommandAges, MeasurePeriodsOfAllThatCameAlsoOfThoseNoStepSaw) {
  AgesRig rig;
  const auto port = rig.port("a");
  std::int64_t stamp = base::steady_ns() - 5'000'000'000;
  const auto stream = [&](int count) {
    for (int i = 0; i < count; ++i) {
      stamp += i % 2 == 0 ? 1'000'000 : 3'000'000;
      port->post(force({1, 0, 0}), stamp);
    }
  };
  stream(600);  // 1.2 s
  rig.step();
  const state::Spread period = rig.told("a")->period;
  EXPECT_EQ(period.number, 1u);
  EXPECT_NEAR(period.count, 500.0, 2.0);
  EXPECT_NEAR(period.min_s, 0.001, 1e-7);
  EXPECT_NEAR(period.mean_s, 0.002, 1e-5);
  EXPECT_NEAR(period.max_s, 0.003, 1e-7);
  EXPECT_NEAR(period.deviation_s, 0.001, 1e-5);
  EXPECT_EQ(rig.told("a")->coalesced, 599u);
  // A break in which the command would have expired is no period.
  stamp += 2'000'000'000;
  stream(600);
  rig.step();
  EXPECT_GE(rig.told("a")->period.number, 2u);
  EXPECT_LT(rig.told("a")->period.max_s, 0.004);
}

TEST(CommandAges, MeasureHowLongCommandsWaitForAStep) {
  AgesRig rig;
  const auto port = rig.port("a");
  for (int i = 0; i < 12; ++i) {
    port->post(force({1, 0, 0}), base::steady_ns() - 200'000'000);
    rig.step();
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  const state::Spread delay = rig.told("a")->delay;
  ASSERT_EQ(delay.number, 1u);
  EXPECT_GE(delay.min_s, 0.2F);
  EXPECT_GE(delay.mean_s, delay.min_s);
  EXPECT_LE(delay.mean_s, delay.max_s);
}

TEST(CommandAges, SurviveOtherModelsAndGoWithTheirObject) {
  AgesRig rig;
  const auto port = rig.port("a");
  port->post(force({1, 0, 0}));
  rig.step();
  rig.load(model("b", {box("b", 1.0, {1, 0, 0})}));
  rig.port("b")->post(force({1, 0, 0}));
  rig.step();
  ASSERT_EQ(rig.frame->commands.size(), 2u);
  EXPECT_EQ(rig.told("a")->received, 1u);
  EXPECT_EQ(rig.told("b")->received, 1u);
  rig.apply(rig.catalogue.prepare_remove("/test/a"));
  rig.step();
  ASSERT_EQ(rig.frame->commands.size(), 1u);
  EXPECT_EQ(rig.told("b")->received, 1u);
}

TEST(CommandAges, OfWhatASnapshotBroughtAreUnknown) {
  AgesRig rig;
  const auto port = rig.port("a");
  port->post(force({1, 0, 0}));
  rig.step(100);
  const auto saved = rig.live->save();
  rig.step(1000);
  EXPECT_FALSE(rig.told("a")->in_force);
  ASSERT_EQ(rig.live->restore(saved), "");
  rig.step();
  EXPECT_TRUE(rig.told("a")->in_force);
  EXPECT_EQ(rig.told("a")->received_ns, 0);
  EXPECT_EQ(rig.told("a")->applied_ns, 0);
  EXPECT_NEAR(rig.told("a")->silent_s, 0.1, 0.0021);
  EXPECT_EQ(rig.told("a")->received, 1u);
  port->post(force({1, 0, 0}));
  rig.step();
  EXPECT_GT(rig.told("a")->received_ns, 0);
}

TEST(SpreadMeter, TellsOfWholeSecondsOnly) {
  SpreadMeter meter;
  std::int64_t now = 0;
  meter.add(0.5, now);
  EXPECT_EQ(meter.last().number, 0u);
  meter.add(0.1, now += 900'000'000);
  meter.add(0.9, now += 200'000'000);  // begins the next
  EXPECT_EQ(meter.last().number, 1u);
  EXPECT_EQ(meter.last().count, 2u);
  EXPECT_FLOAT_EQ(meter.last().min_s, 0.1F);
  EXPECT_FLOAT_EQ(meter.last().max_s, 0.5F);
  EXPECT_FLOAT_EQ(meter.last().mean_s, 0.3F);
  EXPECT_FLOAT_EQ(meter.last().deviation_s, 0.2F);
}

}  // namespace
}  // namespace ambf::model::test
