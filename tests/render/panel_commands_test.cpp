// Who commands what, and how that fares, as the panel shows it.
#include <gtest/gtest.h>

#include <limits>

#include "panel_rig.h"
#include "render/panel/detail/command_watch.h"

namespace ambf::render {
namespace {

using testing::PanelRig;

state::RigidBodyCommand push_up() {
  state::RigidBodyCommand command;
  command.type = state::CartesianCommandType::force;
  command.wrench_world.force = {0, 0, 1};
  return command;
}

// --- 22: commands.

TEST(PanelCommands, ShowsWhoCommandsWhatAndForHowLong) {
  PanelRig rig;
  rig.tab("Physics");
  EXPECT_TRUE(rig.model.commands.list().empty());
  const std::uint32_t elbow = rig.slot("elbow", state::ObjectKind::joint);
  rig.model.hold_joint(elbow, {state::JointCommandType::position, 0.5});
  rig.run(100);
  ASSERT_EQ(rig.model.commands.list().size(), 1u);
  EXPECT_EQ(rig.model.commands.list()[0].object, rig.rig.id("BODY upper")) << "through the body above the joint";
  EXPECT_EQ(rig.model.commands.list()[0].joints, std::vector<std::uint32_t>{elbow});
  EXPECT_TRUE(rig.shown("commands//test/upper/this panel"));
  const double so_far_s = rig.model.commands.list()[0].for_s;
  rig.pictures(50);
  EXPECT_NEAR(rig.model.commands.list()[0].for_s - so_far_s, 1.0, 0.05);
  EXPECT_NEAR(rig.model.commands.list()[0].unchanged_s - so_far_s, 1.0, 0.05);
  rig.model.hold_joint(elbow, {state::JointCommandType::position, 0.6});
  rig.run(40);
  EXPECT_LT(rig.model.commands.list()[0].unchanged_s, 0.1) << "told something else";
  EXPECT_GT(rig.model.commands.list()[0].for_s, 1.0);
  rig.model.held.release_all();
  rig.run(100);
  ASSERT_EQ(rig.model.commands.list().size(), 1u);
  EXPECT_TRUE(rig.shown("commands//test/upper/ended"));
  EXPECT_EQ(rig.model.commands.list()[0].status.expired, 0u) << "let go";
  rig.pictures(550);
  EXPECT_TRUE(rig.model.commands.list().empty()) << "no news any more";
}

TEST(PanelCommands, OfAnotherClientAreNotThePanels) {
  PanelRig rig;
  rig.tab("Physics");
  const auto port = rig.rig.simulation.bind(rig.rig.id("BODY box"), state::Source::ros);
  port->post(push_up());
  rig.run(40);
  EXPECT_TRUE(rig.shown("commands//test/box/topic"));
  rig.click("commands//test/box", 0.1);
  EXPECT_EQ(rig.model.selection.id(), rig.rig.id("BODY box"));
  EXPECT_TRUE(rig.shown("commands/in full//test/box"));
}

TEST(PanelCommands, WarnWhenTheWatchdogNearsAndSayThatItCame) {
  PanelRig rig;
  rig.tab("Physics");
  const auto port = rig.rig.simulation.bind(rig.rig.id("BODY box"), state::Source::ros);
  port->post(push_up());
  rig.run(100);
  ASSERT_EQ(rig.model.commands.list().size(), 1u);
  EXPECT_LT(rig.model.commands.list()[0].silence, CommandWatch::kNear);
  EXPECT_GT(rig.model.commands.list()[0].age_s, 0.0);
  EXPECT_TRUE(rig.shown("commands//test/box/age"));
  rig.run(200);
  EXPECT_GT(rig.model.commands.list()[0].silence, CommandWatch::kNear);
  EXPECT_TRUE(rig.shown("commands//test/box/age near its end"));
  rig.run(300);
  EXPECT_TRUE(rig.shown("commands//test/box/ended"));
  EXPECT_EQ(rig.model.commands.list()[0].status.expired, 1u);
}

TEST(PanelCommands, ShowWhatWasRefusedThoughNothingIsInForce) {
  PanelRig rig;
  rig.tab("Physics");
  const std::uint32_t elbow = rig.slot("elbow", state::ObjectKind::joint);
  rig.model.hold_joint(elbow, {state::JointCommandType::position, std::numeric_limits<double>::quiet_NaN()});
  rig.run(40);
  ASSERT_EQ(rig.model.commands.list().size(), 1u);
  EXPECT_EQ(rig.model.commands.list()[0].status.refused, 1u);
  EXPECT_EQ(rig.model.commands.list()[0].status.received, 0u);
  EXPECT_TRUE(rig.shown("commands//test/upper/nobody"));
}

TEST(PanelCommands, AreFoldedAwayByModel) {
  PanelRig rig;
  rig.tab("Physics");
  const auto box = rig.rig.simulation.bind(rig.rig.id("BODY box"), state::Source::ros);
  const auto base = rig.rig.simulation.bind(rig.rig.id("BODY base"), state::Source::ros);
  box->post(push_up()), base->post(push_up());
  rig.model.hold_joint(rig.slot("elbow", state::ObjectKind::joint), {state::JointCommandType::position, 0.5});
  rig.run(40);
  EXPECT_TRUE(rig.shown("commands//test/base/topic")) << "also where the panel holds a joint further down";
  ASSERT_EQ(rig.model.commands.arms().size(), 1u);
  EXPECT_EQ(rig.model.commands.arms()[0].in_force, 3u);
  const std::string name = "commands/model/" + rig.rig.simulation.structure()->models.back().name;
  ASSERT_TRUE(rig.shown(name));
  EXPECT_TRUE(rig.shown("commands//test/box"));
  rig.click(name, 0.05);
  EXPECT_FALSE(rig.shown("commands//test/box"));
}

// --- Numbers, from frames made by hand.

class Watched {
 public:
  Watched() {
    auto all = std::make_shared<state::Structure>();
    for (std::uint32_t i = 0; i < 3; ++i) {
      state::ObjectInfo object;
      object.id = {i, 0};
      object.model = i == 1 ? 7 : 3;
      object.slot = i;
      all->objects.push_back(object);
      all->bodies.emplace_back().object = i;
    }
    frame = state::make_frame(all);
    frame->run.watchdog_s = 0.5;
    frame->steady_ns = 50'000'000'000;
  }
  state::CommandState& told(std::uint32_t object) {
    for (state::CommandState& each : frame->commands)
      if (each.object == object) return each;
    state::CommandState& made = frame->commands.emplace_back();
    made.object = object;
    made.in_force = true;
    return made;
  }
  void after(double seconds) {
    frame->steady_ns += static_cast<std::int64_t>(seconds * 1e9);
    watch.take(*frame, frame->steady_ns);
  }

  std::unique_ptr<state::Frame> frame;
  CommandWatch watch;
};

TEST(CommandWatch, TellsRatesOfTheLastTwoSeconds) {
  Watched rig;
  rig.told(0);
  rig.after(0);
  const auto go_on = [&](double seconds, unsigned received_hz, unsigned applied_hz) {
    for (int i = 0; i < 10.0 * seconds; ++i) {
      rig.told(0).received += received_hz / 10;
      rig.told(0).applied += applied_hz / 10;
      rig.after(0.1);
    }
  };
  go_on(3, 1000, 900);
  EXPECT_NEAR(rig.watch.list()[0].received_hz, 1000, 1);
  EXPECT_NEAR(rig.watch.list()[0].applied_hz, 900, 1);
  go_on(3, 200, 200);
  EXPECT_NEAR(rig.watch.list()[0].received_hz, 200, 1);
  go_on(3, 0, 0);
  EXPECT_EQ(rig.watch.list()[0].received_hz, 0);
}

TEST(CommandWatch, PutsSecondsTogetherAndForgetsThemAfterHalfAMinute) {
  Watched rig;
  rig.told(0).period = {1, 100, 0.008F, 0.010F, 0.012F, 0.001F};
  rig.after(1);
  rig.told(0).period = {2, 300, 0.001F, 0.002F, 0.003F, 0.0F};
  rig.after(1);
  rig.after(1);  // the same one again: once is enough
  const state::Spread all = rig.watch.list()[0].period;
  EXPECT_EQ(all.count, 400u);
  EXPECT_FLOAT_EQ(all.min_s, 0.001F);
  EXPECT_FLOAT_EQ(all.mean_s, 0.004F);
  EXPECT_FLOAT_EQ(all.max_s, 0.012F);
  // The variance within the seconds and between them: (100 (1 + 36) + 300 (0 + 4)) / 400 ms^2.
  EXPECT_NEAR(all.deviation_s, 0.0035, 1e-6);
  rig.after(28.5);
  EXPECT_EQ(rig.watch.list()[0].period.count, 300u);
  rig.told(0).source = state::Source::panel;
  rig.told(0).period = {};
  rig.after(0.1);
  EXPECT_EQ(rig.watch.list()[0].period.count, 0u) << "another's are not its own";
}

TEST(CommandWatch, TellsAgesAndHowNearTheWatchdogIs) {
  Watched rig;
  rig.told(0).received_ns = rig.frame->steady_ns - 20'000'000;
  rig.told(0).silent_s = 0.4;
  rig.told(1).silent_s = 0.1;  // brought by a snapshot
  rig.told(2).silent_s = 0.45;
  rig.after(0);
  ASSERT_EQ(rig.watch.list().size(), 3u);
  EXPECT_NEAR(rig.watch.list()[0].age_s, 0.02, 1e-9);
  EXPECT_NEAR(rig.watch.list()[0].silence, 0.8, 1e-9);
  // Objects 0 and 2 are of model 3, object 1 of model 7.
  ASSERT_EQ(rig.watch.arms().size(), 2u);
  EXPECT_EQ(rig.watch.arms()[0].model, 3u);
  EXPECT_EQ(rig.watch.arms()[0].count, 2u);
  EXPECT_EQ(rig.watch.arms()[0].oldest, &rig.watch.list()[1]) << "the one nearest to its end";
  EXPECT_EQ(rig.watch.list()[1].status.object, 2u);
  EXPECT_LT(rig.watch.list()[2].age_s, 0.0) << "unknown";
  rig.told(2).in_force = false;
  rig.after(1);
  EXPECT_EQ(rig.watch.arms()[0].in_force, 1u);
  EXPECT_EQ(rig.watch.arms()[0].oldest, &rig.watch.list()[0]);
}

}  // namespace
}  // namespace ambf::render
