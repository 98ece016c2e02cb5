// Needles of scene files: what they report, what is refused, and that a stitch goes on after a restore, in another
// process, and when what takes part in it goes.
#include <gtest/gtest.h>

#include <filesystem>

#include "state/actuators.h"
#include "tissue_rig.h"

namespace ambf::runtime {
namespace {

using namespace test::tissue;

// 20 mm below the tool, which falls with it onto the block; friction holds the tool by the needle.
std::string needle(const std::string& more = "arc: [{x: 0, y: 0, z: -0.02}, {x: 0, y: 0, z: 0}], puncture force: 0.1") {
  return "actuators: [ACTUATOR needle]\nACTUATOR needle: {name: needle, type: Needle, parent: Tool, friction: 60, " +
         more + "}\n";
}
std::string scene_text() { return needle() + block("friction: 1"); }

const state::ActuatorState& row(const Scene& scene) {
  return state::rows(scene.simulation.frame(), state::actuator_kind().column).at(0);
}

TEST(NeedleScene, ItPuncturesReportsAndSnapshotsGoOn) {
  Scene scene(scene_text());
  ASSERT_TRUE(scene.outcome.success) << scene.outcome.message;
  ASSERT_TRUE(scene.simulation.step(20));
  EXPECT_EQ(row(scene).held_nodes, 0U);
  ASSERT_TRUE(scene.simulation.step(50));
  ASSERT_EQ(row(scene).held_nodes, 1U);
  EXPECT_LT(row(scene).force_world.z, -0.05);
  const state::HeldNode& held = state::held_nodes(scene.simulation.frame()).at(0);
  EXPECT_NEAR(held.target_world.z, 0.022, 0.004) << "on the surface";
  EXPECT_LT(math::norm(scene.nodes().at(held.node) - held.target_world), 0.01);
  ASSERT_TRUE(scene.simulation.snapshot("sewing").success);
  ASSERT_TRUE(scene.simulation.step(30));
  const std::uint64_t hash = state::state_hash(scene.simulation.frame());
  ASSERT_TRUE(scene.simulation.restore("sewing").success);
  ASSERT_TRUE(scene.simulation.step(30));
  EXPECT_EQ(state::state_hash(scene.simulation.frame()), hash);
  scene.simulation.reset();
  EXPECT_EQ(row(scene).held_nodes, 0U);
  ASSERT_TRUE(scene.simulation.step(70));
  EXPECT_EQ(row(scene).held_nodes, 1U);
}

// 20 mm of needle 12 mm below the tool: it falls through the block, and draws a thread after it.
std::string threaded_text() {
  std::string text =
      needle("arc: [{x: 0, y: 0, z: -0.032}, {x: 0, y: 0, z: -0.012}], puncture force: 0.05, thread: Suture");
  const std::string thread =
      "Suture:\n  name: Suture\n  location: {position: {x: 0, y: 0, z: 0.048}}\n"
      "  tissue: {kind: thread, points: [{x: 0, y: 0, z: 0}, {x: 0.1, y: 0, z: 0}], radius: 0.0002, young modulus: "
      "1.0e+8,\n    element size: 0.004}\n";
  text.replace(text.find("friction: 60"), 12, "friction: 2");
  std::string rest = block("friction: 1") + thread;
  const std::string list = "soft bodies: [Liver]";
  rest.replace(rest.find(list), list.size(), "soft bodies: [Liver, Suture]");
  rest.replace(rest.find("0.045"), 5, "0.060");
  return text + rest;
}

TEST(NeedleScene, WhatCannotBeIsRefused) {
  const std::string tissue = block("friction: 1");
  Scene point(needle("arc: [{x: 0, y: 0, z: 0}]") + tissue);
  EXPECT_TRUE(point.reports("expected at least two places that differ, found 1", base::Severity::error));
  Scene thread(needle("arc: [{x: 0, y: 0, z: 0}, {x: 0, y: 0, z: 1}], thread: Liver") + tissue);
  EXPECT_TRUE(thread.reports("is no thread: the needle draws none", base::Severity::warning));
  std::string two = threaded_text();
  two.replace(two.find("[ACTUATOR needle]"), 17, "[ACTUATOR needle, ACTUATOR more]");
  Scene both(two +
             "ACTUATOR more: {name: more, type: Needle, parent: Tool, thread: Suture, arc: [{x: 0, y: 0, z: 0}, "
             "{x: 0, y: 0, z: 1}]}\n");
  EXPECT_TRUE(both.reports("is drawn by 'ACTUATOR needle', too", base::Severity::warning));
  Scene negative(needle("arc: [{x: 0, y: 0, z: 0}, {x: 0, y: 0, z: 1}], puncture force: -2") + tissue);
  EXPECT_TRUE(negative.reports("-2", base::Severity::error));
  Scene triggered(needle("arc: [{x: 0, y: 0, z: 0}, {x: 0, y: 0, z: 1}], trigger: sensor") + tissue);
  EXPECT_TRUE(triggered.reports("has no effect: a needle sews", base::Severity::warning));
  Scene knife(blade(std::string("arc: [{x: 0, y: 0, z: 0}], ") + kEdge) + tissue);
  EXPECT_TRUE(knife.reports("is of needles, and has no effect", base::Severity::warning));
}

TEST(NeedleScene, ASavedStitchGoesOnInAnotherProcess) {
  const std::string file = testing::TempDir() + "needle.ambfstate";
  std::uint64_t after = 0;
  for (const bool fresh : {false, true}) {
    test::Rig rig(test::free_running(), scene_text());
    ASSERT_TRUE(rig.loaded.success) << rig.loaded.message;
    rig.simulation.set_paused(true);
    rig.simulation.begin();
    if (!fresh) {
      ASSERT_TRUE(rig.step(70).success);
    }
    const state::Outcome done = rig.wait_for([&](state::Completion end) {
      if (fresh) return rig.simulation.restore("", file, std::move(end));
      rig.simulation.snapshot("sewing", file, std::move(end));
    });
    ASSERT_TRUE(done.success) << done.message;
    ASSERT_TRUE(rig.step(40).success);
    EXPECT_EQ(state::rows(rig.frame(), state::actuator_kind().column).at(0).held_nodes, 1U);
    if (fresh) {
      EXPECT_EQ(state::state_hash(rig.frame()), after);
    }
    after = state::state_hash(rig.frame());
  }
  std::filesystem::remove(file);
}

// With the needle in the tissue: the rest goes on, and what went can be loaded again and sewn anew.
TEST(NeedleScene, WhatTakesPartInAStitchMayGo) {
  Scene scene(scene_text());
  ASSERT_TRUE(scene.outcome.success) << scene.outcome.message;
  state::LoadRequest again;
  again.text = scene_text();
  again.path = "tissue.yaml";
  for (const char* const gone : {"needle", "Tool", "Liver", ""}) {
    SCOPED_TRACE(gone);
    ASSERT_TRUE(scene.simulation.step(70));
    EXPECT_EQ(row(scene).held_nodes, 1U);
    const std::string model = scene.outcome.model;
    if (*gone != '\0') {
      const state::Outcome removed = scene.simulation.remove(gone);
      ASSERT_TRUE(removed.success) << removed.message;
    }
    ASSERT_TRUE(scene.simulation.snapshot("after").success);
    ASSERT_TRUE(scene.simulation.step(20));
    if (scene.count() > 0) {
      EXPECT_FALSE(scene.state().frozen);
    } else {
      EXPECT_EQ(row(scene).held_nodes, 0U);
    }
    ASSERT_TRUE(scene.simulation.unload(model).success);
    ASSERT_TRUE(scene.simulation.step(2));
    scene.outcome = scene.simulation.load(again);
    ASSERT_TRUE(scene.outcome.success) << scene.outcome.message;
  }
}

TEST(NeedleScene, ItsThreadIsTiedByCommandAndSnapshotsGoOn) {
  Scene scene(threaded_text());
  ASSERT_TRUE(scene.outcome.success) << scene.outcome.message;
  ASSERT_TRUE(scene.simulation.step(250));
  ASSERT_EQ(row(scene).held_nodes, 2U) << "in and out";
  EXPECT_EQ(row(scene).tied, 0U);
  EXPECT_EQ(row(scene).bites, 1U);
  EXPECT_GE(row(scene).stitches, 3U) << "what is within, too";
  auto hand = scene.simulation.bind(scene.id("needle", state::actuator_kind().kind), state::Source::plugin);
  hand->hold();
  state::ActuatorCommand tie;
  tie.actuate = true;
  hand->post(state::KindCommand{tie});
  ASSERT_TRUE(scene.simulation.step(5));
  EXPECT_EQ(row(scene).tied, row(scene).stitches);
  hand->post(state::KindCommand{state::ActuatorCommand{}});  // it lets go of the knot, which stays
  ASSERT_TRUE(scene.simulation.step(5));
  const std::uint32_t tied = row(scene).tied;
  EXPECT_GE(tied, 2U);
  ASSERT_TRUE(scene.simulation.snapshot("tied").success);
  ASSERT_TRUE(scene.simulation.step(20));
  const std::uint64_t hash = state::state_hash(scene.simulation.frame());
  ASSERT_TRUE(scene.simulation.restore("tied").success);
  EXPECT_EQ(row(scene).tied, tied);
  ASSERT_TRUE(scene.simulation.step(20));
  EXPECT_EQ(state::state_hash(scene.simulation.frame()), hash);
  tie.use_sensor = true;
  hand->post(state::KindCommand{tie});
  ASSERT_TRUE(scene.simulation.step(5));
  EXPECT_EQ(row(scene).tied, 0U);
  EXPECT_GE(row(scene).held_nodes, 1U);
  scene.simulation.reset();
  EXPECT_EQ(row(scene).held_nodes, 0U);
  ASSERT_TRUE(scene.simulation.step(250));
  EXPECT_GE(row(scene).held_nodes, 1U);
}

// As the thread is fixed in more places than are felt.
TEST(NeedleScene, WhatItCannotDoIsReportedOnce) {
  std::string text = threaded_text();
  const std::string end = "element size: 0.004}";
  text.replace(
      text.find(end), end.size(),
      "element size: 0.0005,\n    regions: [{box: {x: 0.06, y: 1, z: 1}, location: {position: {x: 0.09, y: 0, z: "
      "0}}, fixed: true}]}");
  Scene scene(text);
  ASSERT_TRUE(scene.outcome.success) << scene.outcome.message;
  auto hand = scene.simulation.bind(scene.id("needle", state::actuator_kind().kind), state::Source::plugin);
  hand->hold();
  state::ActuatorCommand tie;
  tie.actuate = true;
  for (int time = 0; time < 3; ++time) {
    hand->post(state::KindCommand{tie});
    ASSERT_TRUE(scene.simulation.step(2));
    hand->post(state::KindCommand{state::ActuatorCommand{}});
    ASSERT_TRUE(scene.simulation.step(2));
  }
  ASSERT_TRUE(scene.simulation.step(240));
  EXPECT_GE(row(scene).stitches, 2U);
  std::size_t untied = 0, held = 0;
  for (base::LogRecord record; scene.log.take(record);) {
    untied += record.text.find("needle' tied nothing: a knot takes two places") != std::string::npos ? 1U : 0U;
    held += record.text.find("more than 64 places of its thread are held") != std::string::npos ? 1U : 0U;
  }
  EXPECT_EQ(untied, 1U);
  EXPECT_EQ(held, 1U);
}

TEST(NeedleScene, OnlyANeedleWithAThreadIsTold) {
  Scene plain(scene_text()), threaded(threaded_text());
  for (Scene* scene : {&plain, &threaded}) {
    const auto structure = scene->simulation.structure();
    const std::uint32_t object = state::find(*structure, "needle", state::actuator_kind().kind);
    state::ActuatorCommand tie;
    tie.actuate = true;
    EXPECT_EQ(state::check(tie, *structure, object).empty(), scene == &threaded);
  }
}

// In another process, and when what takes part in it goes.
TEST(NeedleScene, AThreadedStitchIsSavedAndMayGo) {
  const std::string file = testing::TempDir() + "stitch.ambfstate";
  std::uint64_t after = 0;
  for (const bool fresh : {false, true}) {
    test::Rig rig(test::free_running(), threaded_text());
    ASSERT_TRUE(rig.loaded.success) << rig.loaded.message;
    rig.simulation.set_paused(true);
    rig.simulation.begin();
    if (!fresh) {
      ASSERT_TRUE(rig.step(150).success);
    }
    const state::Outcome done = rig.wait_for([&](state::Completion end) {
      if (fresh) return rig.simulation.restore("", file, std::move(end));
      rig.simulation.snapshot("stitch", file, std::move(end));
    });
    ASSERT_TRUE(done.success) << done.message;
    ASSERT_TRUE(rig.step(40).success);
    if (fresh) {
      EXPECT_EQ(state::state_hash(rig.frame()), after);
    }
    after = state::state_hash(rig.frame());
  }
  std::filesystem::remove(file);
  state::LoadRequest again;
  again.text = threaded_text();
  again.path = "tissue.yaml";
  Scene scene(threaded_text());
  for (const char* const gone : {"needle", "Tool", "Liver", "Suture"}) {
    SCOPED_TRACE(gone);
    ASSERT_TRUE(scene.simulation.step(250));
    EXPECT_GE(row(scene).held_nodes, 1U);
    const state::Outcome removed = scene.simulation.remove(gone);
    ASSERT_TRUE(removed.success) << removed.message;
    ASSERT_TRUE(scene.simulation.snapshot("after").success);
    ASSERT_TRUE(scene.simulation.step(20));
    ASSERT_TRUE(scene.simulation.unload(scene.outcome.model).success);
    scene.outcome = scene.simulation.load(again);
    ASSERT_TRUE(scene.outcome.success) << scene.outcome.message;
  }
}

}  // namespace
}  // namespace ambf::runtime
