// What rests costs nothing and is where it would be awake; what happens to it wakes it. And what is awake rests too: no
// drift.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "tests/runtime/model_rig.h"

namespace ambf::runtime {
namespace {

using namespace test;

constexpr double kSleepBar = 0.1e-3;  // m

struct Scene {
  const char* name;
  bool compat;
  const char* file;
  double least_asleep;  // share of the moving bodies that must rest after 10 s
};

class SleepingScene : public testing::TestWithParam<Scene> {};

TEST_P(SleepingScene, NobodyIsElsewhereThanAwakeAfterTenSeconds) {
  const Scene& scene = GetParam();
  if (scene.compat) AMBF_NEEDS_COMPAT();
  const scene::World world =
      scene.compat ? world_of((compat::descriptions() / "world/world.yaml").string()) : own_world();
  const std::string file = scene.compat ? compat::model(scene.file) : own_model(scene.file);
  ModelRig sleeping(world, steps_on_request(true)), awake(world, steps_on_request(false));
  ASSERT_TRUE(sleeping.load(file).success);
  ASSERT_TRUE(awake.load(file).success);
  ASSERT_TRUE(sleeping.run(10.0).success);
  ASSERT_TRUE(awake.run(10.0).success);

  const auto structure = awake.simulation.structure();
  const state::Frame& rested = sleeping.frame();
  const state::Frame& all_awake = awake.frame();
  ASSERT_EQ(rested.bodies.size(), all_awake.bodies.size());
  double largest = 0.0;
  std::string whose;
  std::size_t asleep = 0, moving = 0;
  for (std::size_t slot = 0; slot < rested.bodies.size(); ++slot) {
    if (structure->bodies[slot].mass <= 0.0) continue;
    ++moving;
    asleep += rested.bodies[slot].asleep;
    EXPECT_FALSE(all_awake.bodies[slot].asleep);
    const double apart =
        math::norm(rested.bodies[slot].T_world_body.position - all_awake.bodies[slot].T_world_body.position);
    if (apart <= largest) continue;
    largest = apart;
    whose = structure->objects[structure->bodies[slot].object].name;
  }
  std::printf("%-14s %zu of %zu asleep, largest difference %.7f mm (%s)\n", scene.name, asleep, moving, largest * 1e3,
              whose.c_str());
  EXPECT_LT(largest, kSleepBar) << whose;
  EXPECT_GE(static_cast<double>(asleep), scene.least_asleep * static_cast<double>(moving));
}

INSTANTIATE_TEST_SUITE_P(Scenes, SleepingScene,
                         testing::Values(Scene{"puzzle1", true, "puzzles/puzzle1.yaml", 0.9},
                                         Scene{"cubes_300", false, "puzzles/cubes_300.yaml", 1.0},
                                         Scene{"peg_transfer", false, "puzzles/peg_transfer.yaml", 0.9}),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

// A box on a table that can be taken away, another on a flap that turns.
const std::string kResting = R"(
bodies: [BODY ground, BODY table, BODY box, BODY post, BODY flap, BODY parcel]
joints: [JOINT post-flap]
namespace: /test/
BODY ground: {name: ground, mass: 0, collision shape: BOX, collision geometry: {x: 4, y: 4, z: 0.2}, shape: BOX,
  geometry: {x: 4, y: 4, z: 0.2},
  location: {position: {x: 0, y: 0, z: -0.1}, orientation: {r: 0, p: 0, y: 0}}}
BODY table: {name: table, mass: 0, collision shape: BOX, collision geometry: {x: 0.4, y: 0.4, z: 0.1}, shape: BOX,
  geometry: {x: 0.4, y: 0.4, z: 0.1},
  location: {position: {x: 0, y: 0, z: 0.45}, orientation: {r: 0, p: 0, y: 0}}}
BODY box: {name: box, mass: 1, collision shape: BOX, collision geometry: {x: 0.1, y: 0.1, z: 0.1}, shape: BOX,
  geometry: {x: 0.1, y: 0.1, z: 0.1},
  location: {position: {x: 0, y: 0, z: 0.55}, orientation: {r: 0, p: 0, y: 0}}}
BODY post: {name: post, mass: 0, collision shape: BOX, collision geometry: {x: 0.02, y: 0.02, z: 0.02}, shape: BOX,
  geometry: {x: 0.02, y: 0.02, z: 0.02},
  location: {position: {x: 1, y: 0, z: 0.5}, orientation: {r: 0, p: 0, y: 0}}}
BODY flap: {name: flap, mass: 0.5, collision shape: BOX, collision geometry: {x: 0.3, y: 0.3, z: 0.02}, shape: BOX,
  geometry: {x: 0.3, y: 0.3, z: 0.02},
  location: {position: {x: 1.2, y: 0, z: 0.5}, orientation: {r: 0, p: 0, y: 0}}}
BODY parcel: {name: parcel, mass: 0.2, collision shape: BOX, collision geometry: {x: 0.1, y: 0.1, z: 0.1}, shape: BOX,
  geometry: {x: 0.1, y: 0.1, z: 0.1},
  location: {position: {x: 1.2, y: 0, z: 0.562}, orientation: {r: 0, p: 0, y: 0}}}
JOINT post-flap: {name: post-flap, parent: BODY post, child: BODY flap, type: revolute, max motor impulse: 0.1,
  joint limits: {low: -1, high: 1},
  parent pivot: {x: 0, y: 0, z: 0}, child pivot: {x: -0.2, y: 0, z: 0}, parent axis: {x: 0, y: 1, z: 0},
  child axis: {x: 0, y: 1, z: 0}}
)";

const std::string kBall = R"(
bodies: [BODY ball]
namespace: /test/
BODY ball: {name: ball, mass: 0.1, collision shape: SPHERE, collision geometry: {radius: 0.02}, shape: SPHERE,
  geometry: {radius: 0.02},
  location: {position: {x: 0.03, y: 0, z: 0.72}, orientation: {r: 0, p: 0, y: 0}}}
)";

class Waking : public testing::Test {
 protected:
  Waking() : rig(bare_world(), steps_on_request(true)) {
    EXPECT_TRUE(rig.load_text(kResting).success);
    EXPECT_TRUE(rig.run(4.0).success);
    EXPECT_TRUE(rig.body("BODY box").asleep);
    EXPECT_TRUE(rig.body("BODY parcel").asleep);
    EXPECT_TRUE(rig.body("BODY flap").asleep);
    at_rest = rig.body("BODY box").T_world_body.position;
  }
  double box_moved() { return math::norm(rig.body("BODY box").T_world_body.position - at_rest); }

  ModelRig rig;
  math::Vec3 at_rest;
};

TEST_F(Waking, ByTouch) {
  ASSERT_TRUE(rig.load_text(kBall).success);
  ASSERT_TRUE(rig.step(10).success);
  EXPECT_TRUE(rig.body("BODY box").asleep);  // the ball is still falling
  bool woke = false;
  for (int i = 0; i < 60 && !woke; ++i) {
    ASSERT_TRUE(rig.step(5).success);
    woke = !rig.body("BODY box").asleep;
  }
  EXPECT_TRUE(woke);
  EXPECT_TRUE(rig.body("BODY parcel").asleep);  // what nothing happened to rests on
}

TEST_F(Waking, ByAForceCommand) {
  state::RigidBodyCommand command;
  command.type = state::CartesianCommandType::force;
  command.wrench_world.force = {20, 0, 0};
  ASSERT_TRUE(rig.step(100, {{rig.id("BODY box"), command}}).success);
  EXPECT_FALSE(rig.body("BODY box").asleep);
  EXPECT_GT(box_moved(), 0.01);
}

TEST_F(Waking, ByLossOfItsSupport) {
  const state::Outcome removed = rig.remove("BODY table");
  ASSERT_TRUE(removed.success) << removed.message;
  ASSERT_TRUE(rig.step(200).success);
  EXPECT_NEAR(at_rest.z - rig.body("BODY box").T_world_body.position.z, 0.5 * 9.81 * 0.04, 0.01);
}

TEST_F(Waking, ByAChangeOfGravity) {
  rig.simulation.set_gravity({0, 0, 2});
  ASSERT_TRUE(rig.step(200).success);
  EXPECT_NEAR(rig.body("BODY box").T_world_body.position.z - at_rest.z, 0.5 * 2 * 0.04, 0.005);
}

TEST_F(Waking, ByPicking) {
  std::promise<std::pair<bool, state::PickHit>> picked;
  const auto pointer = rig.simulation.make_pick_port();
  pointer->pick({0.02, 0, 2}, {0.02, 0, 0}, [&](bool hit, const state::PickHit& where) {
    picked.set_value({hit, where});
  });
  const auto [hit, where] = picked.get_future().get();
  ASSERT_TRUE(hit);
  ASSERT_EQ(where.object, rig.id("BODY box"));
  pointer->drag({0.02, 0, 0.8});
  ASSERT_TRUE(rig.step(500).success);
  EXPECT_FALSE(rig.body("BODY box").asleep);
  EXPECT_GT(rig.body("BODY box").T_world_body.position.z - at_rest.z, 0.05);
}

TEST_F(Waking, ByTheMotionOfAJointBelowIt) {
  const math::Vec3 before = rig.body("BODY parcel").T_world_body.position;
  ASSERT_TRUE(rig.step(300, {rig.joint_command("BODY post", state::JointCommandType::position, {{"post-flap", -0.3}})})
                  .success);
  EXPECT_FALSE(rig.body("BODY flap").asleep);
  EXPECT_FALSE(rig.body("BODY parcel").asleep);
  EXPECT_GT(rig.body("BODY parcel").T_world_body.position.z - before.z, 0.01);  // lifted
  EXPECT_TRUE(rig.body("BODY box").asleep);
}

TEST(Resting, ABoxDoesNotDriftInAMinute) {
  ModelRig rig(bare_world());
  ASSERT_TRUE(rig.load_text(kResting).success);
  ASSERT_TRUE(rig.run(1.0).success);
  const math::Pose start = rig.body("BODY box").T_world_body;
  ASSERT_TRUE(rig.run(60.0).success);
  const math::Pose end = rig.body("BODY box").T_world_body;
  const double drift = math::norm(end.position - start.position);
  const double turn = math::norm(math::log(math::inverse(start.orientation) * end.orientation));
  std::printf("resting box after 60 s: %.9f mm, %.9f mrad\n", drift * 1e3, turn * 1e3);
  EXPECT_LT(drift, 0.01e-3);
  EXPECT_LT(turn, 1e-4);
}

// Ten towers of five boxes, a little out of line.
TEST(Resting, TowersStand) {
  std::string names, blocks;
  for (int tower = 0; tower < 10; ++tower) {
    for (int level = 0; level < 5; ++level) {
      const std::string name = "t" + std::to_string(tower) + "l" + std::to_string(level);
      names += ", BODY " + name;
      char block[512];
      std::snprintf(
          block, sizeof block,
          "BODY %s: {name: %s, mass: 0.5, collision shape: BOX, collision geometry: {x: 0.1, y: 0.1, z: 0.1}, "
          "shape: BOX, geometry: {x: 0.1, y: 0.1, z: 0.1}, location: {position: {x: %.4f, y: %.4f, z: %.4f}, "
          "orientation: {r: 0, p: 0, y: %.2f}}}\n",
          name.c_str(), name.c_str(), 0.3 * tower - 1.5 + 0.004 * (level % 2), -1.0 + 0.003 * (level % 3),
          0.051 + 0.101 * level, 0.1 * tower);
      blocks += block;
    }
  }
  ModelRig rig(bare_world());
  const std::string ground =
      "BODY ground: {name: ground, mass: 0, collision shape: BOX, collision geometry: {x: 4, y: 4, z: 0.2}, shape: "
      "BOX, "
      "geometry: {x: 4, y: 4, z: 0.2}, location: {position: {x: 0, y: 0, z: -0.1}, orientation: {r: 0, p: 0, y: 0}}}\n";
  ASSERT_TRUE(rig.load_text("bodies: [BODY ground" + names + "]\nnamespace: /test/\n" + ground + blocks).success);
  ASSERT_TRUE(rig.run(1.0).success);
  std::vector<math::Vec3> start;
  for (const state::BodyState& body : rig.frame().bodies) start.push_back(body.T_world_body.position);
  ASSERT_TRUE(rig.run(9.0).success);
  double largest = 0.0;
  for (std::size_t slot = 0; slot < start.size(); ++slot)
    largest = std::max(largest, math::norm(rig.frame().bodies[slot].T_world_body.position - start[slot]));
  std::printf("towers of five, largest motion from 1 s to 10 s: %.5f mm\n", largest * 1e3);
  EXPECT_LT(largest, 0.5e-3);
}

}  // namespace
}  // namespace ambf::runtime
