// Blades of scene files: what makes them cut, what they are reported to be unable to, and that a cut goes on after a
// restore, in another process, and when what takes part in it goes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "state/actuators.h"
#include "tissue_rig.h"

namespace ambf::runtime {
namespace {

using namespace test::tissue;

double force(const Scene& scene) {  // upwards, on the tissue; N
  return state::rows(scene.simulation.frame(), state::actuator_kind().column).at(0).force_world.z;
}

// How far from each other points are that were at one place, at most; m.
double parted(const std::vector<math::Vec3>& loaded, const std::vector<math::Vec3>& now) {
  double most = 0.0;
  for (std::size_t i = 0; i < loaded.size(); ++i)
    for (std::size_t k = i + 1; k < loaded.size(); ++k)
      if (math::norm(loaded[i] - loaded[k]) < 1e-9) most = std::max(most, math::norm(now[i] - now[k]));
  return most;
}

std::string falling_blade() {
  return blade(std::string("trigger: contact, sharpness: 2, ") + kEdge) + block("max nodes: 600");
}

// The tool falls through the block, edge first, and what follows repeats from the middle of the cut.
TEST(TissueCutScene, ABladeCutsAndSnapshotsCutOn) {
  Scene scene(falling_blade());
  ASSERT_TRUE(scene.outcome.success) << scene.outcome.message;
  const auto loaded = scene.nodes();
  ASSERT_TRUE(scene.simulation.step(75));
  EXPECT_NEAR(force(scene), -2.0 * 0.04, 0.01) << "N/m times the length in tissue, downwards";
  ASSERT_TRUE(scene.simulation.snapshot("cutting").success);
  ASSERT_TRUE(scene.simulation.step(60));
  const auto there = scene.nodes();
  const std::uint64_t hash = state::state_hash(scene.simulation.frame());
  EXPECT_LT(scene.tool().z, 0.0115);
  EXPECT_GT(parted(loaded, there), 1e-5);
  ASSERT_TRUE(scene.simulation.restore("cutting").success);
  ASSERT_TRUE(scene.simulation.step(60));
  EXPECT_EQ(scene.nodes(), there);
  EXPECT_EQ(state::state_hash(scene.simulation.frame()), hash);
  scene.simulation.reset();
  const auto again = scene.nodes();
  for (std::size_t i = 0; i < again.size(); ++i) EXPECT_LT(math::norm(again[i] - loaded[i]), 1e-12);
}

TEST(TissueCutScene, BladesThatCannotCutAreReported) {
  Scene short_of_room(blade(std::string("trigger: contact, ") + kEdge) + block("max nodes: 3"));
  EXPECT_TRUE(short_of_room.reports("leaves no room for cuts", base::Severity::warning));
  short_of_room.log.expect_warning("cannot be cut");
  ASSERT_TRUE(short_of_room.simulation.step(3));
  Scene point(blade("edge: [{x: 0, y: 0, z: 0}]") + block("friction: 1"));
  EXPECT_TRUE(point.reports("expected at least two places that differ, found 1", base::Severity::error));
  Scene negative(blade(std::string("sharpness: -1, ") + kEdge) + block("friction: 1"));
  EXPECT_TRUE(negative.reports("-1", base::Severity::error));
}

TEST(TissueCutScene, ASavedStrokeGoesOnInAProcessThatLoadedWhatIsUncut) {
  const std::string file = testing::TempDir() + "tissue_cut.ambfstate";
  std::uint64_t after = 0;
  for (const bool fresh : {false, true}) {
    test::Rig rig(test::free_running(), falling_blade());
    ASSERT_TRUE(rig.loaded.success) << rig.loaded.message;
    rig.simulation.set_paused(true);
    rig.simulation.begin();
    if (!fresh) {
      ASSERT_TRUE(rig.step(75).success);
    }
    const state::Outcome done = rig.wait_for([&](state::Completion end) {
      if (fresh) return rig.simulation.restore("", file, std::move(end));
      rig.simulation.snapshot("cutting", file, std::move(end));
    });
    ASSERT_TRUE(done.success) << done.message;
    ASSERT_TRUE(rig.step(1).success);
    const auto& knife = state::rows(rig.frame(), state::actuator_kind().column).at(0);
    EXPECT_NEAR(knife.force_world.z, -2.0 * 0.04, 0.01) << "it holds on to the tissue that it was in";
    ASSERT_TRUE(rig.step(60).success);
    EXPECT_LT(rig.body("Tool").T_world_body.position.z, 0.0115);
    if (fresh) {
      EXPECT_EQ(state::state_hash(rig.frame()), after);
    }
    after = state::state_hash(rig.frame());
  }
  std::filesystem::remove(file);
}

// The finger of a jaw has the edge, and goes down through the block as the jaw closes.
TEST(TissueCutScene, ScissorsCutOnlyWhileTheyAreNearlyClosed) {
  std::string text = block("max nodes: 600");
  text.replace(text.find("[Floor, Tool]"), 13, "[Floor, Tool, Hand]");
  const std::string ball = "collision shape: SPHERE, collision geometry: {radius: 0.01}";  // would not let it in
  text.replace(text.find(ball), ball.size(), "inertia: {ix: 1e-4, iy: 1e-4, iz: 1e-4}");
  Scene scene(
      blade(std::string("trigger: {jaw: Hand, below: 0.3}, sharpness: 2, ") + kEdge) + text +
      "joints: [jaw]\nHand: {name: Hand, mass: 0, location: {position: {x: 0, y: 0, z: 0.06}}}\n"
      "jaw: {name: jaw, type: prismatic, parent: Hand, child: Tool, parent axis: {x: 0, y: 0, z: 1},\n"
      "  child axis: {x: 0, y: 0, z: 1}, parent pivot: {x: 0, y: 0, z: -0.06}, child pivot: {x: 0, y: 0, z: 0},\n"
      "  joint limits: {low: 0, high: 0.045}, max motor impulse: 1}\n");
  ASSERT_TRUE(scene.outcome.success) << scene.outcome.message;
  const auto loaded = scene.nodes();
  auto jaw = scene.simulation.bind(scene.id("Hand", state::ObjectKind::rigid_body), state::Source::plugin);
  jaw->hold();
  const auto close_to = [&](double height) {  // at 0.3 m/s
    const double way = height - scene.tool().z;
    state::RigidBodyCommand command;
    command.joints = {{state::JointCommandType::velocity, way > 0.0 ? 0.3 : -0.3}};
    jaw->post(command);
    ASSERT_TRUE(scene.simulation.step(static_cast<unsigned>(std::abs(way) / 0.0003)));
    ASSERT_NEAR(scene.tool().z, height, 0.001);
  };
  close_to(0.0155);  // 0.34 of its opening, a third of the block's height below its top
  EXPECT_EQ(force(scene), 0.0);
  EXPECT_LT(parted(loaded, scene.nodes()), 1e-12);
  close_to(0.002);
  EXPECT_NE(force(scene), 0.0);
  EXPECT_GT(parted(loaded, scene.nodes()), 1e-9);
  close_to(0.03);
  EXPECT_EQ(force(scene), 0.0) << "out of the tissue";
}

TEST(TissueCutScene, ABladeCutsWhatItsSensorSees) {
  for (const double up : {-1.0, 1.0}) {
    SCOPED_TRACE(up);
    Scene scene(blade(std::string("trigger: sensor, sensor: eye, sharpness: 2, ") + kEdge) +
                "sensors: [eye]\neye: {name: eye, type: Proximity, parent: Tool, range: 0.03, array: [{offset: {x: 0, "
                "y: 0, z: 0}, direction: {x: 0, y: 0, z: " +
                std::to_string(up) + "}}]}\n" + block("max nodes: 600"));
    ASSERT_TRUE(scene.outcome.success) << scene.outcome.message;
    const auto loaded = scene.nodes();
    ASSERT_TRUE(scene.simulation.step(75));
    EXPECT_EQ(force(scene) != 0.0, up < 0.0);
    ASSERT_TRUE(scene.simulation.step(60));
    EXPECT_EQ(scene.tool().z < 0.0115, up < 0.0) << "it passes, or rests on the block";
    EXPECT_EQ(parted(loaded, scene.nodes()) > 1e-9, up < 0.0);
  }
}

// With the edge in the tissue: the rest goes on, and what went can be loaded again and cut anew.
TEST(TissueCutScene, WhatTakesPartInAStrokeMayGo) {
  Scene scene(falling_blade());
  ASSERT_TRUE(scene.outcome.success) << scene.outcome.message;
  state::LoadRequest again;
  again.text = falling_blade();
  again.path = "tissue.yaml";
  for (const char* const gone : {"knife", "Tool", "Liver", ""}) {
    SCOPED_TRACE(gone);
    ASSERT_TRUE(scene.simulation.step(75));
    EXPECT_NEAR(force(scene), -2.0 * 0.04, 0.01);
    const std::string model = scene.outcome.model;
    if (*gone != '\0') {
      const state::Outcome removed = scene.simulation.remove(gone);
      ASSERT_TRUE(removed.success) << removed.message;
    }
    ASSERT_TRUE(scene.simulation.snapshot("after").success);
    ASSERT_TRUE(scene.simulation.step(20));
    if (scene.count() > 0) {
      EXPECT_FALSE(scene.state().frozen);
      for (const math::Vec3& node : scene.nodes()) EXPECT_LT(math::norm(node), 0.1);
    }
    ASSERT_TRUE(scene.simulation.unload(model).success);
    ASSERT_TRUE(scene.simulation.step(2));
    EXPECT_EQ(scene.count(), 0U);
    scene.outcome = scene.simulation.load(again);
    ASSERT_TRUE(scene.outcome.success) << scene.outcome.message;
  }
}

}  // namespace
}  // namespace ambf::runtime
