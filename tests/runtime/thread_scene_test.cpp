// Threads of scene files: their keys, what is reported about wrong ones, what hangs on them, snapshots and resets.
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace ambf::runtime
