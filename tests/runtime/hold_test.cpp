// `hold`: position targets that stay in force when their command ends.
#include <gtest/gtest.h>

#include <string>

#include "simulation_rig.h"
#include "state/columns.h"

namespace ambf::runtime {
namespace {

using test::Rig;

constexpr unsigned kLong = 1500;  // steps: three times the watchdog's time

// An arm that sinks when nothing moves its joint, and a box that falls when nothing holds it.
std::string scene(const std::string& of_joint, const std::string& of_box) {
  return R"(
bodies: [BODY base, BODY arm, BODY box]
joints: [JOINT elbow]
BODY base: {name: base, mass: 0, shape: BOX, geometry: {x: 0.1, y: 0.1, z: 0.1}}
BODY arm: {name: arm, mass: 1, shape: BOX, geometry: {x: 0.4, y: 0.05, z: 0.05},
  location: {position: {x: 0.2, y: 0, z: 0}, orientation: {r: 0, p: 0, y: 0}}}
BODY box: {name: box, mass: 1, shape: BOX, geometry: {x: 0.1, y: 0.1, z: 0.1},
  location: {position: {x: 0, y: 5, z: 5}, orientation: {r: 0, p: 0, y: 0}})" +
         of_box + R"(}
JOINT elbow: {name: elbow, parent: BODY base, child: BODY arm, type: revolute,
  parent pivot: {x: 0, y: 0, z: 0}, child pivot: {x: -0.2, y: 0, z: 0}, parent axis: {x: 0, y: 1, z: 0},
  child axis: {x: 0, y: 1, z: 0})" +
         of_joint + "}\n";
}

class Hold : public ::testing::Test {
 protected:
  void start(const std::string& of_joint, const std::string& of_box) {
    rig.emplace(test::free_running(), scene(of_joint, of_box));
    ASSERT_TRUE(rig->loaded.success) << rig->loaded.message;
    rig->simulation.begin();
    rig->step(0);
  }
  // Both get a target and are there when it ends.
  void command() {
    state::RigidBodyCommand elbow, pose;
    elbow.type = state::CartesianCommandType::none;
    elbow.joints = {{state::JointCommandType::position, -0.5}};
    pose.type = state::CartesianCommandType::position;
    pose.T_world_body = {{0, 5, 6}, {}};
    for (int i = 0; i < 20; ++i) rig->step(100, {{rig->id("BODY base"), elbow}, {rig->id("BODY box"), pose}});
    ASSERT_NEAR(angle(), -0.5, 0.01);
    ASSERT_NEAR(height(), 6.0, 0.05);
  }
  double angle() { return rig->frame().joints[0].position; }
  double height() { return rig->body("BODY box").T_world_body.position.z; }
  bool elbow_is_held() { return std::abs(angle() + 0.5) < 0.01; }
  bool box_is_held() { return std::abs(height() - 6.0) < 0.05; }
  bool set_hold(state::ObjectId object, bool hold) {
    return rig->wait_for([&](state::Completion done) { rig->simulation.set_hold(object, hold, std::move(done)); })
        .success;
  }
  state::ObjectId elbow() { return rig->frame().structure->objects[rig->frame().structure->joints[0].object].id; }

  std::optional<Rig> rig;
};

TEST_F(Hold, WithoutItWhatNothingCommandsIsLetGo) {
  start("", "");
  command();
  rig->step(kLong);
  EXPECT_FALSE(elbow_is_held());
  EXPECT_FALSE(box_is_held());
}

TEST_F(Hold, AJointAndABodyKeepTheirTargets) {
  start(", hold: true", ", hold: true");
  command();
  rig->step(kLong);
  EXPECT_TRUE(elbow_is_held());
  EXPECT_TRUE(box_is_held());
  // Until another command, which is the target to keep then, or none.
  state::RigidBodyCommand effort;
  effort.type = state::CartesianCommandType::none;
  effort.joints = {{state::JointCommandType::effort, 0.0}};
  rig->step(1, {{rig->id("BODY base"), effort}, test::push(*rig, "BODY box", {})});
  rig->step(kLong);
  EXPECT_FALSE(elbow_is_held());
  EXPECT_FALSE(box_is_held());
}

TEST_F(Hold, IsSwitchedWhileItRuns) {
  start("", "");
  EXPECT_TRUE(set_hold(rig->id("BODY base"), true)) << "of the joints that are commanded through it";
  EXPECT_TRUE(set_hold(rig->id("BODY box"), true));
  EXPECT_FALSE(set_hold({}, true));
  command();
  rig->step(kLong);
  EXPECT_TRUE(elbow_is_held());
  EXPECT_TRUE(box_is_held());
  EXPECT_TRUE(set_hold(rig->id("BODY base"), false));
  EXPECT_TRUE(set_hold(rig->id("BODY box"), false));
  rig->step(kLong);
  EXPECT_FALSE(elbow_is_held());
  EXPECT_FALSE(box_is_held());
  EXPECT_TRUE(set_hold(elbow(), true));
  rig->simulation.reset_world();
  rig->step(0);
  command();
  rig->step(kLong);
  EXPECT_FALSE(elbow_is_held()) << "a reset goes back to what was loaded";
}

TEST_F(Hold, ContinuesAfterARestoreAsAfterTheSnapshot) {
  start(", hold: true", "");
  set_hold(rig->id("BODY box"), true);
  command();
  rig->step(kLong);
  const auto kept =
      rig->wait_for([&](state::Completion done) { rig->simulation.snapshot("kept", "", std::move(done)); });
  ASSERT_TRUE(kept.success) << kept.message;
  rig->step(kLong);
  const std::uint64_t hash = state::state_hash(rig->frame());
  EXPECT_TRUE(elbow_is_held() && box_is_held());
  set_hold(rig->id("BODY box"), false);
  rig->step(kLong);
  EXPECT_FALSE(box_is_held());
  ASSERT_TRUE(
      rig->wait_for([&](state::Completion done) { rig->simulation.restore("kept", "", std::move(done)); }).success);
  rig->step(kLong);
  EXPECT_EQ(state::state_hash(rig->frame()), hash);
}

}  // namespace
}  // namespace ambf::runtime
