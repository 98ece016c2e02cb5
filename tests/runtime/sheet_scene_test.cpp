// Sheets of scene files: their keys, what is reported about wrong ones, what holds them, snapshots and resets.
#include <gtest/gtest.h>

#include <fstream>

#include "mesh/appearance.h"
#include "mesh/mesh.h"
#include "state/actuators.h"
#include "tissue_rig.h"

namespace ambf::runtime {
namespace {

using test::tissue::Scene;
using test::tissue::with_swab;

// n x n squares, 0.06 m wide, about the origin.
std::string grid(int n, const std::string& more = "") {
  const std::string path = ::testing::TempDir() + "/sheet.obj";
  std::ofstream file(path);
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) file << "v " << 0.06 * i / n - 0.03 << ' ' << 0.06 * j / n - 0.03 << " 0\n";
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i + 1;
      file << "f " << a << ' ' << a + 1 << ' ' << a + n + 1 << "\nf " << a + 1 << ' ' << a + n + 2 << ' ' << a + n + 1
           << '\n';
    }
  file << more;
  return path;
}

// Above a ball that may move.
std::string text(const std::string& mesh, const std::string& tissue) {
  return "bodies: [Floor, Tool]\nsoft bodies: [Sheet]\nnamespace: /test/\n"
         "Floor: {name: Floor, mass: 0, collision shape: PLANE, collision geometry: {normal: {x: 0, y: 0, z: 1}}}\n"
         "Tool: {name: Tool, mass: 0.1, collision shape: SPHERE, collision geometry: {radius: 0.01},\n"
         "  location: {position: {x: 0.0, y: 0.0, z: 0.01}}}\n"
         "Sheet:\n  name: Sheet\n  mesh: " +
         mesh + "\n  collision mesh: " + mesh +
         "\n  collision margin: 0.001\n  location: {position: {x: 0, y: 0, z: 0.022}}\n  tissue: {kind: sheet, " +
         tissue + "}\n";
}
const std::string kSheet = "young modulus: 100000, thickness: 0.0005, ";

TEST(SheetScene, LiesOverABallRepeatsAndResets) {
  Scene scene(text(grid(8), kSheet + "density: 1000, relaxation: {share: 0.6, time: 0.1}"));
  ASSERT_TRUE(scene.outcome.success) << scene.outcome.message;
  ASSERT_EQ(scene.count(), 1U);
  EXPECT_TRUE(scene.reports("128 triangles, 81 nodes", base::Severity::information));
  const state::SoftBodyInfo& info = scene.info();
  EXPECT_EQ(info.shape->faces.size(), 128U);
  EXPECT_NEAR(info.mass, 0.06 * 0.06 * 0.0005 * 1000.0, 1e-9);
  ASSERT_NE(info.appearance, nullptr);
  EXPECT_EQ(info.shape->skin.size(), info.appearance->parts.at(0).mesh->vertex_count());
  const auto loaded = scene.nodes();
  ASSERT_TRUE(scene.simulation.step(500));
  EXPECT_FALSE(scene.state().frozen);
  EXPECT_GT(scene.nodes()[40].z, 0.0208) << "on the ball";
  EXPECT_LT(scene.nodes()[0].z, 0.018) << "its corners hang down";
  ASSERT_TRUE(scene.simulation.snapshot("here").success);
  ASSERT_TRUE(scene.simulation.step(100));
  const auto there = scene.nodes();
  const std::uint64_t hash = state::state_hash(scene.simulation.frame());
  ASSERT_TRUE(scene.simulation.step(50));
  ASSERT_TRUE(scene.simulation.restore("here").success);
  ASSERT_TRUE(scene.simulation.step(100));
  EXPECT_EQ(scene.nodes(), there);
  EXPECT_EQ(state::state_hash(scene.simulation.frame()), hash);
  scene.simulation.reset();
  EXPECT_EQ(scene.nodes(), loaded);
}

// What is far stiffer than steps can bear was thrown about, by metres, as soon as it touched something.
TEST(SheetScene, IsNoStifferThanStepsCanBear) {
  for (const std::string modulus : {"1.0e+9", "1.0e+12"}) {
    SCOPED_TRACE(modulus);
    Scene scene(text(grid(14), "young modulus: " + modulus + ", thickness: 0.00005"));
    ASSERT_TRUE(scene.outcome.success) << scene.outcome.message;
    EXPECT_TRUE(scene.reports("and nothing in it is stiffer than", base::Severity::warning));
    for (int i = 0; i < 40; ++i) {
      ASSERT_TRUE(scene.simulation.step(5));
      ASSERT_FALSE(scene.state().frozen) << i;
      for (const math::Vec3& node : scene.nodes()) ASSERT_LT(math::norm(node), 0.06) << i;
    }
  }
}

// What it hangs on may come with another file, and what is misspelled never does.
TEST(SheetScene, ABodyThatItHangsOnAndThatIsNotThereIsReported) {
  const std::string region = ", regions: [{vertices: [0], attach to: ";
  Scene misspelled(text(grid(8), kSheet + "density: 1000" + region + "Tol}]"));
  EXPECT_TRUE(misspelled.reports("there is no body \"Tol\" yet", base::Severity::information));
  Scene soft(text(grid(8), kSheet + "density: 1000" + region + "Sheet}]"));
  EXPECT_TRUE(soft.reports("there is no body \"Sheet\" yet", base::Severity::information));
  Scene right(text(grid(8), kSheet + "density: 1000" + region + "Tool}]"));
  EXPECT_FALSE(right.reports("there is no body", base::Severity::information));
}

// A swab of links falls on a sheet that hangs between two sides, or through it; what both do then can be saved.
TEST(SheetScene, SoftBodiesOfConfigRestOnItUnlessItTouchesNone) {
  for (const std::string touches : {"all", "none"}) {
    SCOPED_TRACE(touches);
    Scene scene(with_swab(
        text(
            grid(8),
            kSheet + "touches: " + touches +
                ", regions: [{box: {x: 0.001, y: 1, z: 1}, location: {position: {x: -0.03, y: 0, z: 0}}, fixed: true}, "
                "{box: {x: 0.001, y: 1, z: 1}, location: {position: {x: 0.03, y: 0, z: 0}}, fixed: true}]"),
        0.001));
    ASSERT_TRUE(scene.outcome.success) << scene.outcome.message;
    ASSERT_TRUE(scene.simulation.step(1000));
    const auto swab = [&] {
      return state::rows(scene.simulation.frame(), state::soft_body_kind().column).at(1).T_world_object.position.z;
    };
    if (touches == "none") {
      EXPECT_LT(swab(), 0.009) << "on the ground";
      continue;
    }
    const double sheet = scene.nodes()[40].z;
    EXPECT_LT(sheet, 0.021) << "it bears the swab";
    EXPECT_NEAR(swab() - sheet, 0.006 + 0.001 + 0.00025, 0.001);
    ASSERT_TRUE(scene.simulation.snapshot("here").success);
    ASSERT_TRUE(scene.simulation.step(100));
    const std::uint64_t hash = state::state_hash(scene.simulation.frame());
    ASSERT_TRUE(scene.simulation.step(50));
    ASSERT_TRUE(scene.simulation.restore("here").success);
    ASSERT_TRUE(scene.simulation.step(100));
    EXPECT_EQ(state::state_hash(scene.simulation.frame()), hash);
    ASSERT_TRUE(scene.simulation.remove("Sheet").success);
    ASSERT_TRUE(scene.simulation.step(300));
    EXPECT_LT(state::rows(scene.simulation.frame(), state::soft_body_kind().column).at(0).T_world_object.position.z,
              0.009);
  }
}

TEST(SheetScene, HangsByRegionsAndIsHeldByActuators) {
  Scene scene(
      "actuators: [ACTUATOR grip]\nACTUATOR grip: {name: grip, type: Constraint, parent: Tool, hardness: 500}\n" +
      text(grid(8), kSheet + "regions: [{box: {x: 0.001, y: 1, z: 1}, location: {position: {x: -0.03, y: 0, z: 0}}, "
                             "fixed: true}, {vertices: [8, 17], stiffness: 5, density: 2}]"));
  ASSERT_TRUE(scene.outcome.success) << scene.outcome.message;
  int fixed = 0;
  for (const bool each : scene.info().fixed) fixed += each ? 1 : 0;
  EXPECT_EQ(fixed, 9);
  EXPECT_NEAR(scene.info().mass / (0.06 * 0.06 * 0.0005 * 1060.0), 1.0, 0.15) << "less what is fixed";
  auto grip = scene.simulation.bind(scene.id("grip", state::actuator_kind().kind), state::Source::plugin);
  auto tool = scene.simulation.bind(scene.id("Tool", state::ObjectKind::rigid_body), state::Source::plugin);
  grip->hold();
  tool->hold();
  state::ActuatorCommand close;
  close.actuate = true;
  close.body = scene.id("Sheet", state::soft_body_kind().kind);
  grip->post(state::KindCommand{close});
  state::RigidBodyCommand lift;
  lift.type = state::CartesianCommandType::force;
  lift.wrench_world.force = {0, 0, 1.4};
  tool->post(lift);
  ASSERT_TRUE(scene.simulation.step(400));
  ASSERT_EQ(state::held_nodes(scene.simulation.frame()).size(), 1U);
  EXPECT_GT(scene.tool().z, 0.02) << "it is lifted";
  EXPECT_LT(scene.tool().z, 0.2) << "and held back by the fixed side";
  EXPECT_LT(math::norm(scene.nodes()[0] - math::Vec3{-0.03, -0.03, 0.022}), 1e-7);
}

TEST(SheetScene, WhatCannotBeASheetIsReported) {
  const auto judge = [](const std::string& mesh, const std::string& tissue, const std::string& wanted) {
    Scene scene(text(mesh, tissue));
    EXPECT_TRUE(scene.reports(wanted, base::Severity::error)) << wanted;
    EXPECT_EQ(scene.count(), 0U) << wanted;
  };
  const std::string mesh = grid(8);
  judge(mesh, "young modulus: 100000", "missing: a sheet has one, above 0");
  judge(mesh, "thickness: 0", "found the number 0");
  judge(mesh, kSheet + "poisson ratio: 0.5", "below 0.5, found 0.5");
  judge(mesh, "young modulus: -1, thickness: 0.001", "found the number -1");
  judge(mesh, "thickness: 0.01", "too fine for a sheet that is 0.01 m thick");
  judge(mesh, kSheet + "element size: 0.0001", "makes some 7.2e+05 triangles; at most 2e+04");
  judge(grid(1), kSheet, "triangles of 0.0683 m are too coarse for a sheet of 0.06 m");
  judge(grid(8, "v 0 0 0.01\nl 1 82\n"), kSheet, "of its 82 vertices 1 are in none");
  judge(grid(8, "v 0 0 0.01\nf 41 42 82\n"), kSheet, "more than two triangles meet at 1 of its edges");
}

TEST(SheetScene, WhatHasNoEffectIsReported) {
  Scene scene(text(grid(1), kSheet + "element size: 0.012, radius: 0.001"));
  EXPECT_TRUE(scene.reports("has no effect on sheets", base::Severity::warning));
  ASSERT_EQ(scene.count(), 1U);
  EXPECT_GT(scene.info().shape->faces.size(), 50U) << "its edges are divided";
  Scene stiff(text(grid(8), "thickness: 0.001, young modulus: 1.0e+9"));
  EXPECT_TRUE(stiff.reports("and 100 are made", base::Severity::warning));
  EXPECT_EQ(stiff.count(), 1U);
  Scene solid(test::tissue::block("thickness: 0.001"));
  EXPECT_TRUE(solid.reports("has no effect on solids", base::Severity::warning));
}

// The tool falls through it, edge first. What is drawn parts with it; what follows repeats from the middle of the cut.
TEST(SheetScene, ABladeCutsItAndSnapshotsCutOn) {
  const std::string mesh = grid(8);
  const std::string rim =
      "regions: [{box: {x: 0.002, y: 1, z: 1}, location: {position: {x: -0.03, y: 0, z: 0}}, fixed: "
      "true}, {box: {x: 0.002, y: 1, z: 1}, location: {position: {x: 0.03, y: 0, z: 0}}, fixed: true}]";
  std::string falling = text(mesh, kSheet + "max nodes: 300, " + rim);
  falling.replace(falling.find("z: 0.01}}}"), 7, "z: 0.03");
  Scene scene(test::tissue::blade("trigger: contact, sharpness: 2, edge: [{x: 0.001, y: -0.04, z: 0}, {x: 0.001, y: "
                                  "0.04, z: 0}]") +
              falling);
  ASSERT_TRUE(scene.outcome.success) << scene.outcome.message;
  const state::SoftBodyInfo& info = scene.info();
  EXPECT_EQ(info.nodes, 3U * 128U);
  ASSERT_NE(info.appearance, nullptr);
  const mesh::Mesh& drawn = *info.appearance->parts.at(0).mesh;
  EXPECT_EQ(drawn.vertex_count(), 3U * 128U);
  ASSERT_EQ(info.shape->skin.size(), drawn.vertex_count());
  const auto loaded = scene.nodes();
  for (std::size_t i = 0; i < drawn.vertex_count(); ++i) {
    const math::Vec3 at = drawn.submeshes.at(0).vertex(i) + math::Vec3{0, 0, 0.022};
    EXPECT_LT(math::norm(loaded[info.shape->skin[i].node[0]] - at), 1e-6);
  }
  const auto parted = [&] {  // how far nodes are from those that were at their place
    const auto now = scene.nodes();
    double most = 0.0;
    for (std::size_t i = 0; i < now.size(); ++i)
      for (std::size_t k = i + 1; k < now.size(); ++k)
        if (math::norm(loaded[i] - loaded[k]) < 1e-9) most = std::max(most, math::norm(now[i] - now[k]));
    return most;
  };
  double force = 0.0;  // N, on the sheet
  for (int i = 0; i < 100 && !(force < -0.001); ++i) {
    ASSERT_TRUE(scene.simulation.step(1));
    force = state::rows(scene.simulation.frame(), state::actuator_kind().column).at(0).force_world.z;
  }
  EXPECT_LT(force, -0.001) << "it is felt";
  EXPECT_LT(parted(), 0.0005) << "it has hardly begun to";
  ASSERT_TRUE(scene.simulation.snapshot("cutting").success);
  ASSERT_TRUE(scene.simulation.step(150));
  const auto there = scene.nodes();
  const std::uint64_t hash = state::state_hash(scene.simulation.frame());
  EXPECT_GT(parted(), 0.01) << "both halves hang down";
  EXPECT_LT(scene.tool().z, 0.02) << "through it";
  ASSERT_TRUE(scene.simulation.restore("cutting").success);
  ASSERT_TRUE(scene.simulation.step(150));
  EXPECT_EQ(scene.nodes(), there);
  EXPECT_EQ(state::state_hash(scene.simulation.frame()), hash);
  scene.simulation.reset();
  EXPECT_LT(parted(), 1e-12);
}

// It falls on a sheet whose rim is held, and draws a thread through it.
TEST(SheetScene, ANeedleDrawsItsThreadThrough) {
  std::string scene_text =
      "actuators: [ACTUATOR needle]\nACTUATOR needle: {name: needle, type: Needle, parent: Tool, puncture force: 0.05, "
      "friction: 2, thread: Suture,\n  arc: [{x: 0.0011, y: 0.0007, z: -0.022}, {x: 0.0011, y: 0.0007, z: -0.012}]}\n" +
      text(grid(8), kSheet +
                        "regions: [{box: {x: 0.1, y: 0.016, z: 0.01}, location: {position: {x: 0, y: 0.03, z: 0}}, "
                        "fixed: true},\n    {box: {x: 0.1, y: 0.016, z: 0.01}, location: {position: {x: 0, y: "
                        "-0.03, z: 0}}, fixed: true}]") +
      "Suture:\n  name: Suture\n  location: {position: {x: 0.0011, y: 0.0007, z: 0.033}}\n"
      "  tissue: {kind: thread, points: [{x: 0, y: 0, z: 0}, {x: 0.1, y: 0, z: 0}], radius: 0.0002, young modulus: "
      "1.0e+8,\n    element size: 0.004}\n";
  scene_text.replace(scene_text.find("[Sheet]"), 7, "[Sheet, Suture]");
  scene_text.replace(scene_text.find("z: 0.01}}}"), 10, "z: 0.045}}}");
  Scene scene(scene_text);
  ASSERT_TRUE(scene.outcome.success) << scene.outcome.message;
  const auto row = [&] { return state::rows(scene.simulation.frame(), state::actuator_kind().column).at(0); };
  for (int i = 0; i < 100 && row().bites == 0; ++i) ASSERT_TRUE(scene.simulation.step(5));
  EXPECT_EQ(row().bites, 1U);
  EXPECT_EQ(row().stitches, 1U);
  EXPECT_EQ(row().held_nodes, 1U);
  EXPECT_LT(scene.tool().z, 0.035) << "its needle is below the sheet";
  ASSERT_TRUE(scene.simulation.snapshot("sewn").success);
  ASSERT_TRUE(scene.simulation.step(20));
  const std::uint64_t hash = state::state_hash(scene.simulation.frame());
  ASSERT_TRUE(scene.simulation.restore("sewn").success);
  ASSERT_TRUE(scene.simulation.step(20));
  EXPECT_EQ(state::state_hash(scene.simulation.frame()), hash);
  scene.simulation.reset();
  EXPECT_EQ(row().stitches, 0U);
}

TEST(SheetScene, ABladeSaysThatItCannotBeCut) {
  Scene scene(test::tissue::blade("trigger: contact, " + std::string(test::tissue::kEdge)) + text(grid(8), kSheet));
  ASSERT_EQ(scene.count(), 1U);
  scene.log.expect_warning("cannot be cut: solids and sheets of `tissue`");
  ASSERT_TRUE(scene.simulation.step(20));
}

}  // namespace
}  // namespace ambf::runtime
