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

TEST(NeedleScene, WhatCannotBeIsRefused) {
  const std::string tissue = block("friction: 1");
  Scene point(needle("arc: [{x: 0, y: 0, z: 0}]") + tissue);
  EXPECT_TRUE(point.reports("expected at least two places that differ, found 1", base::Severity::error));
  Scene thread(needle("arc: [{x: 0, y: 0, z: 0}, {x: 0, y: 0, z: 1}], thread: Liver") + tissue);
  EXPECT_TRUE(thread.reports("cannot draw a thread yet", base::Severity::error));
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

}  // namespace
}  // namespace ambf::runtime
