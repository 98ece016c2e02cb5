// Threads of scene files: their keys, what is reported about wrong ones, what hangs on them, snapshots and resets.
#include <gtest/gtest.h>

#include <fstream>

#include "mesh/appearance.h"
#include "mesh/mesh.h"
#include "tissue_rig.h"

namespace ambf::runtime {
namespace {

using test::tissue::Scene;

std::string hanging(const std::string& more,
                    const std::string& points = "points: [{x: 0, y: 0, z: 0}, {x: 0, y: 0, z: -0.05}], ") {
  return "bodies: [Weight]\nsoft bodies: [Suture]\nnamespace: /test/\n"
         "Weight: {name: Weight, mass: 0.02, collision shape: BOX, collision geometry: {x: 0.01, y: 0.01, z: 0.01},\n"
         "  location: {position: {x: 0.0, y: 0.0, z: 0.245}}}\n"
         "Suture:\n  name: Suture\n  location: {position: {x: 0, y: 0, z: 0.3}}\n"
         "  tissue: {kind: thread, " +
         points + "radius: 0.0002, density: 1150, element size: 0.002, " + more + "}\n";
}
const char* const kRegions =
    "regions: [{sphere: 0.0005, fixed: true}, {sphere: 0.0005, location: {position: {x: 0, y: 0, z: -0.05}}, "
    "attach to: Weight}]";

TEST(ThreadScene, CarriesAWeightRepeatsAndResets) {
  Scene scene(hanging(kRegions));
  ASSERT_TRUE(scene.outcome.success) << scene.outcome.message;
  ASSERT_EQ(scene.count(), 1U);
  EXPECT_TRUE(scene.reports("a thread of 25 segments", base::Severity::information));
  const state::SoftBodyInfo& info = scene.info();
  ASSERT_EQ(info.nodes, 26U);
  EXPECT_TRUE(info.fixed.front());
  EXPECT_FALSE(info.fixed.back());
  EXPECT_TRUE(info.shape->faces.empty());
  EXPECT_EQ(info.shape->lines.size(), 25U);
  ASSERT_NE(info.appearance, nullptr);
  EXPECT_EQ(info.shape->skin.size(), info.appearance->parts.at(0).mesh->vertex_count());
  const auto loaded = scene.nodes();
  ASSERT_TRUE(scene.simulation.step(500));
  EXPECT_NEAR(scene.nodes().back().z, 0.25, 0.00025) << "0.5 % of its length";
  ASSERT_TRUE(scene.simulation.snapshot("here").success);
  ASSERT_TRUE(scene.simulation.step(200));
  const std::uint64_t hash = state::state_hash(scene.simulation.frame());
  ASSERT_TRUE(scene.simulation.restore("here").success);
  ASSERT_TRUE(scene.simulation.step(200));
  EXPECT_EQ(state::state_hash(scene.simulation.frame()), hash);
  scene.simulation.reset();
  EXPECT_EQ(scene.nodes(), loaded);
}

TEST(ThreadScene, WrongKeysAreReported) {
  for (const auto& [points, text] :
       {std::pair("", "found 0"), std::pair("points: [{x: 1, y: 0, z: 0}, {x: 1, y: 0, z: 0}], ", "found 2")}) {
    Scene scene(hanging(kRegions, points));
    EXPECT_TRUE(scene.reports(text, base::Severity::error)) << text;
    EXPECT_EQ(scene.count(), 0U);
  }
  Scene scene(
      hanging("max nodes: 9, regions: [{sphere: 0.001, location: {position: {x: 1, y: 0, z: 0}}, fixed: true}]"));
  EXPECT_TRUE(scene.reports("has no effect on threads", base::Severity::warning));
  EXPECT_TRUE(scene.reports("nothing of the thread is in this region", base::Severity::warning));
  EXPECT_EQ(scene.count(), 1U);
}

// A thread along what `lines` of an OBJ file say of six vertices.
std::string drawn(const std::string& lines, const std::string& more = ", element size: 0.005",
                  const std::string& key = "mesh") {
  const std::string path = ::testing::TempDir() + "/polyline.obj";
  std::ofstream(path) << "v 0.02 0 0\nv 0.01 0 0\nv 0.01 0.01 0\nv 0 0.01 0\nv 0 0 0.01\nv 0 0.02 0.01\n" << lines;
  return "soft bodies: [Suture]\nnamespace: /test/\nSuture:\n  name: Suture\n  " + key + ": " + path +
         "\n  location: {position: {x: 0, y: 0, z: 0.3}}\n  tissue: {kind: thread" + more + "}\n";
}

TEST(ThreadScene, FollowsThePolylineOfAMesh) {
  for (const char* const key : {"mesh", "collision mesh"}) {
    // Out of order and either way round: from the end that comes first.
    Scene scene(drawn("l 2 3\nl 4 3\nl 1 2\n",
                      ", element size: 0.005, regions: [{sphere: 0.001, location: {position: {x: 0, y: 0.01, z: 0}}, "
                      "fixed: true}]",
                      key));
    ASSERT_EQ(scene.count(), 1U) << key;
    EXPECT_TRUE(scene.outcome.diagnostics.size() == 1) << "what it is made of, and nothing else";
    EXPECT_TRUE(scene.reports("a thread of 6 segments", base::Severity::information));
    ASSERT_EQ(scene.nodes().size(), 7U);
    EXPECT_NEAR(math::norm(scene.nodes().front() - math::Vec3{0, 0.01, 0.3}), 0.0, 1e-7);
    EXPECT_NEAR(math::norm(scene.nodes().back() - math::Vec3{0.02, 0, 0.3}), 0.0, 1e-7);
    EXPECT_TRUE(scene.info().fixed.front());
    ASSERT_TRUE(scene.simulation.step(10));
    EXPECT_FALSE(scene.state().frozen);
  }
}

TEST(ThreadScene, MeshesThatAreNoPolylineAreReported) {
  for (const auto& [lines, text] :
       {std::pair("f 1 2 3\n", "found a mesh of 1 triangles and no lines"),
        std::pair("l 1 2 3\nl 2 5\n", "found 3 segments that meet at (0.01, 0, 0) m"),
        std::pair("l 1 2 3\nl 5 6\n", "found 2, of which the second begins at (0, 0, 0.01) m"),
        std::pair("l 1 2 3 1\n", "found a closed one through (0.02, 0, 0) m"),
        std::pair("l 1 2\nl 3 4 5 3\n", "found 2, of which the second begins at (0.01, 0.01, 0) m")}) {
    Scene scene(drawn(lines));
    EXPECT_TRUE(scene.reports(text, base::Severity::error)) << text;
    EXPECT_EQ(scene.count(), 0U) << text;
  }
  Scene both(drawn("l 1 2 3\nf 4 5 6\n"));
  EXPECT_TRUE(both.reports("1 triangles beside the polyline have no effect", base::Severity::warning));
  EXPECT_EQ(both.count(), 1U);
  Scene twice(drawn("l 1 2\n", ", points: [{x: 0, y: 0, z: 0}, {x: 0, y: 0, z: 0.01}]"));
  EXPECT_TRUE(twice.reports("has no effect on a thread with `points`", base::Severity::warning));
  EXPECT_EQ(twice.count(), 1U);
  Scene long_one(drawn("l 1 2 3 4\n", ", radius: 0.0001, element size: 0.00001"));
  EXPECT_TRUE(long_one.reports("at most 2000 nodes, and 3000 segments were asked for", base::Severity::error));
  EXPECT_EQ(long_one.count(), 0U);
  Scene fine(drawn("l 1 2 3 4\n", ", radius: 0.0001"));
  EXPECT_TRUE(fine.reports("ms while it moves", base::Severity::information));
}

}  // namespace
}  // namespace ambf::runtime
