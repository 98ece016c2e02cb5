// Tissue of scene files: its keys, what is reports about wrong ones, commands, snapshots, resets.
#include <gtest/gtest.h>

#include "state/actuators.h"
#include "tissue_rig.h"

namespace ambf::runtime {
namespace {

using namespace test::tissue;

TEST(TissueScene, KeysBecomeTissueThatBearsATool) {
  Scene scene(
      block("density: 1000, regions: [{box: {x: 1, y: 1, z: 0.002}, location: {position: {x: 0, y: 0, z: -0.01}}, "
            "fixed: true}]"));
  ASSERT_TRUE(scene.outcome.success) << scene.outcome.message;
  ASSERT_EQ(scene.count(), 1U);
  EXPECT_TRUE(scene.reports("160 elements", base::Severity::information));
  EXPECT_FALSE(scene.info().shape->faces.empty());
  const auto loaded = scene.nodes();
  ASSERT_EQ(loaded.size(), scene.info().nodes);
  ASSERT_TRUE(scene.simulation.step(1000));
  const auto now = scene.nodes();
  double lowest = 1.0;
  int held = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    EXPECT_EQ(scene.info().fixed[i], loaded[i].z < 0.0021) << i;
    if (scene.info().fixed[i]) {
      EXPECT_LT(math::norm(now[i] - loaded[i]), 1e-12);
      ++held;
    } else if (loaded[i].z > 0.0219) {
      lowest = std::min(lowest, now[i].z);
    }
  }
  EXPECT_GT(held, 20);
  EXPECT_LT(lowest, 0.0215) << "the tool dents it";
  const math::Vec3 tool = scene.tool();
  EXPECT_GT(tool.z, 0.02);
  EXPECT_LT(tool.z, 0.034);
}

// A second block falls 4 mm onto the first, or through it.
TEST(TissueScene, TissueRestsOnTissueUnlessItTouchesNone) {
  for (const char* const touches : {"all", "others", "none"}) {
    SCOPED_TRACE(touches);
    std::string text = block("friction: 1");
    const std::string list = "soft bodies: [Liver]", tool = "z: 0.045";
    text.replace(text.find(list), list.size(), "soft bodies: [Liver, Upper]");
    text.replace(text.find(tool), tool.size(), "z: 0.345");
    Scene scene(text +
                "Upper:\n  name: Upper\n  collision shape: BOX\n  collision geometry: {x: 0.02, y: 0.02, z: 0.02}\n"
                "  location: {position: {x: 0.001, y: 0.002, z: 0.036}}\n"
                "  tissue: {young modulus: 20000, element size: 0.01, touches: " +
                touches + "}\n");
    ASSERT_TRUE(scene.outcome.success) << scene.outcome.message;
    ASSERT_TRUE(scene.simulation.step(200));
    const auto& rows = state::rows(scene.simulation.frame(), state::soft_body_kind().column);
    if (std::string(touches) == "none") {
      EXPECT_LT(rows.at(1).T_world_object.position.z, 0.015);
    } else {
      EXPECT_NEAR(rows.at(1).T_world_object.position.z, 0.031, 0.0015);
    }
  }
}

// A swab of links falls 4 mm onto the block, or through it.
TEST(TissueScene, SoftBodiesOfConfigRestOnItUnlessItTouchesNone) {
  for (const char* const touches : {"all", "none"}) {
    SCOPED_TRACE(touches);
    Scene scene(with_swab(block("friction: 1, touches: " + std::string(touches)), 0.002));
    ASSERT_TRUE(scene.outcome.success) << scene.outcome.message;
    ASSERT_TRUE(scene.simulation.step(1000));
    const auto& rows = state::rows(scene.simulation.frame(), state::soft_body_kind().column);
    if (std::string(touches) == "none") {
      EXPECT_LT(rows.at(1).T_world_object.position.z, 0.02) << "on the ground";
    } else {
      EXPECT_NEAR(rows.at(1).T_world_object.position.z, 0.029, 0.002);
    }
  }
}

// By a box, or by the list of the file's vertices in it: the same nodes, and all moves alike. Of the ball, the list
// leaves the middle beneath its vertices free, which the box holds.
TEST(TissueScene, FixedByABoxIsFixedByItsList) {
  struct Case {
    std::string name, collision, element_size;
    std::size_t vertices;  // of its file; more nodes divide its edges
    double below, differ;  // m; of how far it sags
  };
  const Case cases[] = {
      {"grid", "shape: BOX\n  collision geometry: {x: 0.02, y: 0.02, z: 0.08}", "0.02", 8, -0.03, 0.0},
      {"ball", "shape: SPHERE\n  collision geometry: {radius: 0.02}", "0.01", 482, -0.009, 0.2},
      {"liver", "mesh: " + std::string(AMBF_SOURCE_DIR) + "/ambf_models/meshes/gallbladder/low_res/liver.obj", "0.03",
       154, -0.0145, 0.0}};
  for (const Case& each : cases) {
    SCOPED_TRACE(each.name);
    const auto fixed_by = [&](const std::string& region) {
      return "soft bodies: [Liver]\nnamespace: /test/\nLiver:\n  name: Liver\n  collision " + each.collision +
             "\n  location: {position: {x: 0, y: 0, z: 0.5}}\n  tissue: {young modulus: 20000, element size: " +
             each.element_size + ", regions: [{" + region + ", fixed: true}]}\n";
    };
    Scene box(fixed_by(
        "box: {x: 1, y: 1, z: 1}, location: {position: {x: 0, y: 0, z: " + std::to_string(each.below - 0.5) + "}}"));
    ASSERT_TRUE(box.outcome.success) << box.outcome.message;
    std::string list;
    for (std::size_t i = 0; i < each.vertices; ++i)
      if (box.info().fixed.at(i)) list += (list.empty() ? "" : ", ") + std::to_string(i);
    Scene listed(fixed_by("vertices: [" + list + "]"));
    ASSERT_TRUE(listed.outcome.success) << listed.outcome.message;
    EXPECT_EQ(box.info().fixed, listed.info().fixed);
    const auto loaded = box.nodes();
    ASSERT_TRUE(box.simulation.step(200));
    ASSERT_TRUE(listed.simulation.step(200));
    const auto by_box = box.nodes(), by_list = listed.nodes();
    double sags = 0.0, off = 0.0;
    for (std::size_t i = 0; i < loaded.size(); ++i) {
      sags = std::max(sags, math::norm(by_box[i] - loaded[i]));
      off = std::max(off, math::norm(by_box[i] - by_list[i]));
    }
    EXPECT_GT(sags, 5e-5);
    EXPECT_LE(off, each.differ * sags);
  }
}

TEST(TissueScene, SnapshotsContinueBitForBitAndResetsBringItBack) {
  Scene scene(block("relaxation: {share: 0.5, time: 0.1}"));
  ASSERT_TRUE(scene.outcome.success) << scene.outcome.message;
  const auto loaded = scene.nodes();
  ASSERT_TRUE(scene.simulation.step(200));
  ASSERT_TRUE(scene.simulation.snapshot("here").success);
  ASSERT_TRUE(scene.simulation.step(200));
  const auto there = scene.nodes();
  const std::uint64_t hash = state::state_hash(scene.simulation.frame());
  ASSERT_TRUE(scene.simulation.step(100));
  ASSERT_TRUE(scene.simulation.restore("here").success);
  ASSERT_TRUE(scene.simulation.step(200));
  EXPECT_EQ(scene.nodes(), there);
  EXPECT_EQ(state::state_hash(scene.simulation.frame()), hash);
  scene.simulation.reset();
  const auto again = scene.nodes();
  for (std::size_t i = 0; i < again.size(); ++i) EXPECT_LT(math::norm(again[i] - loaded[i]), 1e-12);
}

TEST(TissueScene, WhatCannotBeTissueIsTold) {
  Scene rubber(block("poisson ratio: 0.5"));
  EXPECT_TRUE(rubber.reports("below 0.5, found 0.5", base::Severity::error));
  EXPECT_EQ(rubber.count(), 0U);
  Scene negative(block("density: -3"));
  EXPECT_TRUE(negative.reports("-3", base::Severity::error));
  EXPECT_EQ(negative.count(), 0U);
  std::string fine = block("friction: 1");
  fine.replace(fine.find("element size: 0.01"), 18, "element size: 0.001");
  Scene too_fine(fine);
  EXPECT_TRUE(
      too_fine.reports("makes some 1.6e+05 elements, and a step some 96 ms; at most 2e+04", base::Severity::error));
  EXPECT_EQ(too_fine.count(), 0U);
  Scene nowhere(block("regions: [{sphere: 0.01, location: {position: {x: 5, y: 0, z: 0}}, fixed: true}]"));
  EXPECT_TRUE(nowhere.reports("nothing of the tissue is in this region", base::Severity::warning));
  EXPECT_EQ(nowhere.count(), 1U);
  Scene shapeless(block("regions: [{fixed: true}]"));
  EXPECT_TRUE(shapeless.reports("expected one of `box`, `sphere` and `vertices`", base::Severity::error));
}

TEST(TissueScene, ForcesAndPosesMoveItAndRegionsHangOnBodies) {
  Scene scene(
      block("regions: [{box: {x: 1, y: 1, z: 0.002}, location: {position: {x: 0, y: 0, z: 0.01}}, attach to: Tool}]"));
  ASSERT_TRUE(scene.outcome.success) << scene.outcome.message;
  ASSERT_EQ(scene.info().attached.size(), 1U);
  EXPECT_NE(scene.info().attached[0], state::kNone);
  const double start = scene.state().T_world_object.position.z;
  auto port =
      scene.simulation.bind(scene.simulation.structure()->objects[scene.info().object].id, state::Source::plugin);
  state::SoftBodyCommand lift;
  lift.wrench_world.force = {0, 0, 1.6};  // of 0.033 kg of tissue and a tool of 0.1 kg
  port->post(state::KindCommand{lift});
  ASSERT_TRUE(scene.simulation.step(200));
  const math::Vec3 tool = scene.tool();
  EXPECT_GT(scene.state().T_world_object.position.z, start + 0.01);
  EXPECT_NEAR(tool.z - scene.state().T_world_object.position.z, 0.045 - start, 0.01) << "they go together";
}

// By the node that is nearest to the tool.
TEST(TissueScene, AnActuatorHoldsItAndSnapshotsHoldItAgain) {
  Scene scene(
      "actuators: [ACTUATOR grip]\nACTUATOR grip: {name: grip, type: Constraint, parent: Tool, hardness: 500}\n" +
      block("friction: 1"));
  ASSERT_TRUE(scene.outcome.success) << scene.outcome.message;
  const auto structure = scene.simulation.structure();
  const auto id = [&](const std::string& name, state::ObjectKind kind) {
    return structure->objects.at(state::find(*structure, name, kind)).id;
  };
  EXPECT_FALSE(scene.info().shape->links.empty()) << "what colours by strain reads";
  auto tool = scene.simulation.bind(id("Tool", state::ObjectKind::rigid_body), state::Source::plugin);
  auto grip = scene.simulation.bind(id("grip", state::actuator_kind().kind), state::Source::plugin);
  tool->hold();
  grip->hold();
  state::ActuatorCommand close;
  close.actuate = true;
  close.body = id("Liver", state::soft_body_kind().kind);
  grip->post(state::KindCommand{close});
  state::RigidBodyCommand lift;
  lift.type = state::CartesianCommandType::force;
  lift.wrench_world.force = {0, 0, 1.6};  // of 0.034 kg of tissue and a tool of 0.1 kg
  tool->post(lift);
  const double start = scene.state().T_world_object.position.z;
  ASSERT_TRUE(scene.simulation.step(200));
  ASSERT_EQ(state::held_nodes(scene.simulation.frame()).size(), 1U);
  EXPECT_GT(scene.state().T_world_object.position.z, start + 0.01);
  ASSERT_TRUE(scene.simulation.snapshot("held").success);
  ASSERT_TRUE(scene.simulation.step(50));
  const auto there = scene.nodes();
  ASSERT_TRUE(scene.simulation.restore("held").success);
  ASSERT_TRUE(scene.simulation.step(50));
  EXPECT_EQ(scene.nodes(), there);
  close.actuate = false;
  grip->post(state::KindCommand{close});
  ASSERT_TRUE(scene.simulation.step(600));
  EXPECT_TRUE(state::held_nodes(scene.simulation.frame()).empty());
  EXPECT_LT(scene.state().T_world_object.position.z, start + 0.01) << "it fell";
}

// A brush: more tips touch faces than there is room for.
TEST(TissueScene, MoreTipsThanThereIsRoomForAreReported) {
  std::string text = block("friction: 1");
  std::string brush = "compound collision shape: [";
  for (int i = 0; i < 196; ++i)
    brush += std::string(i == 0 ? "" : ", ") + "{shape: SPHERE, geometry: {radius: 0.0003}, offset: {position: {x: " +
             std::to_string(0.002 * (i % 14) - 0.0132) + ", y: " + std::to_string(0.002 * (i / 14) - 0.0127) +
             ", z: 0}}}";
  const std::string ball = "collision shape: SPHERE, collision geometry: {radius: 0.01}", high = "z: 0.045";
  text.replace(text.find(ball), ball.size(), brush + "]");
  text.replace(text.find(high), high.size(), "z: 0.0232");
  Scene scene(text);
  scene.log.expect_warning("is touched in more places than there is room for");
  ASSERT_TRUE(scene.simulation.step(20));
  Scene clear(block("friction: 1"));
  ASSERT_TRUE(clear.simulation.step(20));  // and nothing is logged
}

}  // namespace
}  // namespace ambf::runtime
