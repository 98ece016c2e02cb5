// Soft bodies of links that are full, not hollow, and whose parts differ: `inner lattice` and `regions` of `config`.
#include <gtest/gtest.h>

#include <algorithm>

#include "state/actuators.h"
#include "tests/support/compat_models.h"
#include "tissue_rig.h"

namespace ambf::runtime {
namespace {

using test::tissue::Scene;

const math::Vec3 kMiddle{0, 0, 0.5};  // of the ball; the room has a floor of its own below

// A ball of 5 cm just above a floor, and a body beside it.
std::string ball(const std::string& config, const std::string& bodies = "") {
  return "soft bodies: [Ball]\nnamespace: /test/\nbodies: [Floor" + std::string(bodies.empty() ? "" : ", Rib") +
         "]\nFloor: {name: Floor, mass: 0, collision shape: PLANE, collision geometry: {normal: {x: 0, y: 0, z: 1}},\n"
         "  location: {position: {x: 0, y: 0, z: 0.448}}}\n" +
         bodies +
         "Ball:\n  name: Ball\n  shape: SPHERE\n  geometry: {radius: 0.05}\n  collision shape: SPHERE\n"
         "  collision geometry: {radius: 0.05}\n  collision margin: 0.001\n  mass: 0.2\n"
         "  location: {position: {x: 0, y: 0, z: 0.5}}\n"
         "  config: {kDP: 0.02, piterations: 4, " +
         config + "}\n";
}

double height(Scene& scene) {
  double low = 1.0, high = -1.0;
  for (const math::Vec3& node : scene.nodes()) low = std::min(low, node.z), high = std::max(high, node.z);
  return high - low;
}

double lowest(Scene& scene) {
  double low = 1.0;
  for (const math::Vec3& node : scene.nodes()) low = std::min(low, node.z);
  return low;
}

TEST(SoftRegions, AnInnerLatticeBearsWhatIsHollowWithout) {
  Scene hollow(ball("kLST: 0.5")), full(ball("kLST: 0.5, inner lattice: 0.02"));
  ASSERT_EQ(full.count(), 1U);
  const std::uint32_t surface = hollow.info().nodes;
  EXPECT_GT(full.info().nodes, surface + 30);
  EXPECT_LT(full.info().nodes, surface + 90);
  EXPECT_NEAR(full.info().mass, 0.2, 1e-12);
  const auto nodes = full.nodes();
  for (std::size_t i = surface; i < nodes.size(); ++i)
    EXPECT_LT(math::norm(nodes[i] - kMiddle), 0.045) << "it is within";
  ASSERT_TRUE(hollow.simulation.step(1000));
  ASSERT_TRUE(full.simulation.step(1000));
  EXPECT_LT(height(hollow), 0.06) << "m: it collapsed";
  EXPECT_GT(height(full), 0.085);
}

// Nine others were measured by hand (docs/benchmarks.md).
TEST(SoftRegions, AMeshOfOldFilesIsFilled) {
  AMBF_NEEDS_COMPAT();
  const std::string mesh =
      (compat::descriptions() / "multi-bodies/grippers/resistive/gripper1/low_res/LeftL1.STL").string();
  const auto text = [&](const std::string& more) {
    return "soft bodies: [Link]\nnamespace: /test/\nLink: {name: Link, mesh: " + mesh + ", collision mesh: " + mesh +
           ", mass: 0.1, location: {position: {x: 0, y: 0, z: 0.5}}, config: {kDP: 0.02" + more + "}}\n";
  };
  Scene hollow(text("")), full(text(", inner lattice: 0.0073"));
  ASSERT_EQ(full.count(), 1U);
  EXPECT_EQ(hollow.info().nodes, 26U);
  EXPECT_EQ(full.info().nodes, 404U);
  ASSERT_TRUE(full.simulation.step(20));
  EXPECT_FALSE(full.state().frozen);
}

TEST(SoftRegions, PartsAreFixedDenserAndStiffer) {
  const std::string top = "{sphere: 0.02, location: {position: {x: 0, y: 0, z: 0.05}}, ";
  Scene held(ball("kLST: 0.2, inner lattice: 0.02, regions: [" + top + "fixed: true}]"));
  const auto loaded = held.nodes();
  std::size_t fixed = 0;
  for (std::size_t i = 0; i < loaded.size(); ++i) {
    EXPECT_EQ(held.info().fixed[i], math::norm(loaded[i] - kMiddle - math::Vec3{0, 0, 0.05}) < 0.02) << i;
    fixed += held.info().fixed[i] ? 1 : 0;
  }
  EXPECT_GT(fixed, 3U);
  // Without a floor near it hangs: stiffer, it hangs less; denser below, its centre is lower as it falls and turns.
  Scene soft(ball("kLST: 0.05, inner lattice: 0.02, regions: [" + top + "fixed: true}]")),
      stiff(ball("kLST: 0.05, inner lattice: 0.02, regions: [" + top + "fixed: true}, {sphere: 0.1, stiffness: 10}]"));
  for (Scene* each : {&soft, &stiff}) ASSERT_TRUE(each->simulation.step(300));
  EXPECT_LT(lowest(soft), lowest(stiff) - 0.0005);
  Scene even(ball("kLST: 0.5")), heavy(ball("kLST: 0.5, regions: [" + top + "density: 20, fixed: true}]"));
  EXPECT_LT(heavy.info().mass, 0.85 * even.info().mass) << "most of it is in what is fixed";
}

TEST(SoftRegions, NodesHangOnABody) {
  const std::string rib = "Rib: {name: Rib, mass: 0, location: {position: {x: 0, y: 0, z: 0.7}}}\n";
  Scene scene(
      ball("kLST: 0.8, inner lattice: 0.02, regions: [{sphere: 0.02, location: {position: {x: 0, y: 0, z: 0.05}}, "
           "attach to: Rib}]",
           rib));
  const auto loaded = scene.nodes();
  const auto gap = [&] {
    const auto now = scene.nodes();
    double most = 0.0;
    for (std::size_t i = 0; i < now.size(); ++i)
      if (math::norm(loaded[i] - kMiddle - math::Vec3{0, 0, 0.05}) < 0.02)
        most = std::max(most, math::norm(now[i] - loaded[i]));
    return most;
  };
  // On the floor it would be lower by 1 mm, and pressed flat.
  ASSERT_TRUE(scene.simulation.step(500));
  EXPECT_LT(gap(), 0.0005);
  scene.simulation.reset();
  ASSERT_TRUE(scene.simulation.step(500));
  EXPECT_LT(gap(), 0.0005) << "m: it hangs again";
}

// Also when a reset came between: what is attached acts before what held it earlier.
TEST(SoftRegions, AttachedAndHeldItGoesOnFromASavedStateToTheBit) {
  std::string text =
      ball("kLST: 0.8, regions: [{sphere: 0.03, location: {position: {x: 0, y: 0, z: 0.05}}, attach to: Rib}]",
           "Rib: {name: Rib, mass: 0.5, location: {position: {x: 0.01, y: 0, z: 0.6}},\n"
           "  inertia: {ix: 0.001, iy: 0.001, iz: 0.001}}\n"
           "actuators: [grip]\ngrip: {name: grip, type: Constraint, parent: Rib, hardness: 2000}\n");
  Scene scene(text);
  ASSERT_TRUE(scene.outcome.success) << scene.outcome.message;
  auto grip = scene.simulation.bind(scene.id("grip", state::actuator_kind().kind), state::Source::plugin);
  grip->hold();
  state::ActuatorCommand close;
  close.actuate = true;
  close.body = scene.id("Ball", state::soft_body_kind().kind);
  grip->post(state::KindCommand{close});
  ASSERT_TRUE(scene.simulation.step(60));
  ASSERT_EQ(state::held_nodes(scene.simulation.frame()).size(), 1U) << "of the actuator alone";
  ASSERT_TRUE(scene.simulation.snapshot("held").success);
  ASSERT_TRUE(scene.simulation.step(50));
  const std::uint64_t there = state::state_hash(scene.simulation.frame());
  for (const bool anew : {false, true}) {
    if (anew) scene.simulation.reset();
    ASSERT_TRUE(scene.simulation.restore("held").success);
    ASSERT_TRUE(scene.simulation.step(50));
    EXPECT_EQ(state::state_hash(scene.simulation.frame()), there) << anew;
  }
}

TEST(SoftRegions, WhatCannotBeIsReported) {
  const auto warns = [](const std::string& config, const std::string& text) {
    Scene scene(ball(config));
    return scene.reports(text, base::Severity::warning) && scene.count() == 1;
  };
  EXPECT_TRUE(warns("inner lattice: 0.0004", "nodes"));
  EXPECT_TRUE(warns("inner lattice: 0.2", "is within the mesh"));
  EXPECT_TRUE(warns("regions: [{sphere: 0.01, fixed: true}]", "there is no node in this region"));
  EXPECT_TRUE(warns("regions: [{vertices: [3, 100000], fixed: true}]", "there is no vertex 100000"));
  EXPECT_TRUE(warns("regions: [{sphere: 1, stiffness: 3}]", "above 1, where links overshoot"));
  EXPECT_TRUE(warns("regions: [{sphere: 1}]", "the region changes nothing"));
  Scene none(ball("regions: [{fixed: true}]"));
  EXPECT_TRUE(none.reports("expected one of `box`, `sphere` and `vertices`, found 0", base::Severity::error));
}

}  // namespace
}  // namespace ambf::runtime
