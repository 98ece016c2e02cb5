// What cameras and lights hang on, when it was changed while the simulation ran: a snapshot keeps it, a reset of the
// world undoes it.
#include <gtest/gtest.h>

#include <cstdio>

#include "simulation_rig.h"

namespace ambf::runtime {
namespace {

using test::Rig;

const std::string kViews = R"(
bodies: [BODY tool, BODY stand]
cameras: [CAMERA scope]
lights: [LIGHT lamp]
namespace: /test/
BODY tool: {name: tool, mass: 1, shape: BOX, geometry: {x: 0.1, y: 0.1, z: 0.1}, location: {position: {x: 3, y: 0,
  z: 1}}}
BODY stand: {name: stand, mass: 0, shape: BOX, geometry: {x: 0.1, y: 0.1, z: 0.1}, location: {position: {x: 0, y: 2,
  z: 0}}}
CAMERA scope: {name: scope, parent: BODY stand, location: {x: 0, y: 0, z: 0.5}, look at: {x: 1, y: 0, z: 0.5},
  up: {x: 0, y: 0, z: 1},
  clipping plane: {near: 0.05, far: 7}, field view angle: 0.8}
LIGHT lamp: {name: lamp, location: {x: 0, y: 0, z: 4}, direction: {x: 0, y: 0, z: -1}, cutoff angle: 0.7,
  spot exponent: 0.3}
)";

class LiveParents : public ::testing::Test {
 protected:
  LiveParents() {
    rig.simulation.begin();
    rig.step(1);
  }
  static std::uint32_t object(Rig& rig, const std::string& name, state::ObjectKind kind) {
    return state::find(*rig.simulation.structure(), name, kind);
  }
  static bool hang(Rig& rig, const std::string& name, state::ObjectKind kind, const std::string& parent) {
    const state::ObjectId id = rig.simulation.structure()->objects[object(rig, name, kind)].id;
    return rig.wait_for([&](auto done) { rig.simulation.set_parent(id, parent, done); }).success;
  }
  static std::string scope_hangs_on(const state::Frame& frame) {
    const std::uint32_t parent =
        frame.structure->cameras[slot(frame, "scope", state::ObjectKind::camera)].parent_object;
    return parent == state::kNone ? "" : frame.structure->objects[parent].name;
  }
  static std::uint32_t slot(const state::Frame& frame, const std::string& name, state::ObjectKind kind) {
    return frame.structure->objects[state::find(*frame.structure, name, kind)].slot;
  }
  static math::Pose T_world_scope(const state::Frame& frame) {
    return frame.cameras[slot(frame, "scope", state::ObjectKind::camera)].T_world_camera;
  }
  static math::Pose T_world_lamp(const state::Frame& frame) {
    return frame.lights[slot(frame, "lamp", state::ObjectKind::light)].T_world_light;
  }

  Rig rig{test::free_running(), kViews};
};

TEST_F(LiveParents, ASnapshotKeepsThemInThisAndInAFreshSimulation) {
  ASSERT_TRUE(hang(rig, "scope", state::ObjectKind::camera, "BODY tool"));
  ASSERT_TRUE(hang(rig, "lamp", state::ObjectKind::light, "CAMERA scope"));
  rig.step(100);  // the tool falls, and takes both along
  const std::string file = ::testing::TempDir() + "/ambf_live_parents.state";
  ASSERT_TRUE(rig.wait_for([&](auto done) { rig.simulation.snapshot("s", file, done); }).success);
  rig.step(0);
  const math::Pose scope = T_world_scope(rig.frame()), lamp = T_world_lamp(rig.frame());
  rig.step(50);
  const math::Pose scope_later = T_world_scope(rig.frame());

  ASSERT_TRUE(hang(rig, "lamp", state::ObjectKind::light, ""));
  ASSERT_TRUE(hang(rig, "scope", state::ObjectKind::camera, "LIGHT lamp"));  // the other way round
  rig.step(10);
  Rig fresh(test::free_running(), kViews);
  fresh.simulation.begin();
  fresh.step(1);
  for (Rig* each : {&rig, &fresh}) {
    const std::string from = each == &rig ? "" : file;
    const state::Outcome outcome = each->wait_for([&](auto done) { each->simulation.restore("s", from, done); });
    ASSERT_TRUE(outcome.success) << outcome.message;
    each->step(0);
    EXPECT_EQ(scope_hangs_on(each->frame()), "/test/tool");
    EXPECT_EQ(T_world_scope(each->frame()), scope);
    EXPECT_EQ(T_world_lamp(each->frame()), lamp);
    EXPECT_EQ(each->simulation.structure()->version, each->frame().structure->version);
    each->step(50);
    EXPECT_EQ(T_world_scope(each->frame()), scope_later);
  }
  std::remove(file.c_str());
}

TEST_F(LiveParents, AResetOfTheWorldHangsThemAsTheirFilesSay) {
  const math::Pose scope = T_world_scope(rig.frame()), lamp = T_world_lamp(rig.frame());
  ASSERT_TRUE(hang(rig, "scope", state::ObjectKind::camera, "BODY tool"));
  ASSERT_TRUE(hang(rig, "lamp", state::ObjectKind::light, "CAMERA scope"));
  rig.step(100);
  EXPECT_EQ(scope_hangs_on(rig.frame()), "/test/tool");
  rig.simulation.reset_world();
  ASSERT_TRUE(rig.wait_until([&](const state::Frame& frame) { return scope_hangs_on(frame) == "/test/stand"; }));
  EXPECT_EQ(T_world_scope(rig.frame()), scope);
  EXPECT_EQ(T_world_lamp(rig.frame()), lamp);
  EXPECT_EQ(rig.frame().sim_step, 0u);
}

TEST_F(LiveParents, ABadStateFileLeavesThemAlone) {
  ASSERT_TRUE(hang(rig, "scope", state::ObjectKind::camera, "BODY tool"));
  const std::string file = ::testing::TempDir() + "/ambf_bad_parents.state";
  ASSERT_TRUE(rig.wait_for([&](auto done) { rig.simulation.snapshot("s", file, done); }).success);
  ASSERT_TRUE(hang(rig, "scope", state::ObjectKind::camera, ""));
  std::FILE* damaged = std::fopen(file.c_str(), "r+b");
  std::fseek(damaged, 300, SEEK_SET);
  std::fputc(0x55, damaged);
  std::fclose(damaged);
  const std::uint64_t version = rig.simulation.structure()->version;
  const state::Outcome outcome = rig.wait_for([&](auto done) { rig.simulation.restore("", file, done); });
  EXPECT_FALSE(outcome.success);
  EXPECT_NE(outcome.message.find("damaged"), std::string::npos) << outcome.message;
  EXPECT_EQ(rig.simulation.structure()->version, version);
  rig.step(1);
  EXPECT_EQ(scope_hangs_on(rig.frame()), "");
  std::remove(file.c_str());
}

}  // namespace
}  // namespace ambf::runtime
