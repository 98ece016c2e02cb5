// Continuing after a restore equals continuing after the snapshot, bit for bit, also while commands run out, whatever
// commands there are and however long the simulation idled in between (promise PR6).
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <random>
#include <thread>
#include <vector>

#include "base/hash.h"
#include "simulation_rig.h"
#include "state/kinds.h"

namespace ambf::runtime {
namespace {

using test::Rig;

const std::string kBall = R"(
bodies: [BODY ball]
namespace: /test/
BODY ball: {name: ball, mass: 1, shape: SPHERE, geometry: {radius: 0.1}, collision shape: SPHERE,
  collision geometry: {radius: 0.1}, inertia: {ix: 0.004, iy: 0.004, iz: 0.004}, damping: {linear: 0, angular: 0},
  location: {position: {x: 0, y: 0, z: 1}, orientation: {r: 0, p: 0, y: 0}}}
)";
const std::string kView = R"(
cameras: [CAMERA eye]
lights: [LIGHT lamp]
namespace: /test/
CAMERA eye: {name: eye, location: {x: 2, y: 0, z: 1}, look at: {x: 0, y: 0, z: 1}, up: {x: 0, y: 0, z: 1},
  clipping plane: {near: 0.01, far: 10}, field view angle: 0.8}
LIGHT lamp: {name: lamp, location: {x: 0, y: 0, z: 3}, direction: {x: 0, y: 0, z: -1}, spot exponent: 0.3,
  shadow quality: 0, cutoff angle: 0.7}
)";

void snapshot(Rig& rig, const std::string& name, const std::string& file = {}) {
  const state::Outcome taken =
      rig.wait_for([&](state::Completion done) { rig.simulation.snapshot(name, file, std::move(done)); });
  ASSERT_TRUE(taken.success) << taken.message;
}
void restore(Rig& rig, const std::string& name, const std::string& file = {}) {
  const state::Outcome restored =
      rig.wait_for([&](state::Completion done) { rig.simulation.restore(name, file, std::move(done)); });
  ASSERT_TRUE(restored.success) << restored.message;
}

// Long enough that the physics thread idles: its wait between two checks is 20 ms, woken by requests.
void idle(int milliseconds) { std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds)); }

TEST(Restore, AForceEndsAtTheSameStep) {
  scene::World weightless = test::empty_world();
  weightless.gravity = {};
  Rig rig(test::free_running(), kBall, weightless);
  rig.simulation.set_paused(true);
  rig.simulation.begin();
  ASSERT_TRUE(rig.step(5, {test::push(rig, "BODY ball", {1, 0, 0})}).success);
  snapshot(rig, "pushed");
  const auto speed_after_its_end = [&] {
    for (int i = 0; i < 70; ++i) EXPECT_TRUE(rig.step(10).success);
    return rig.body("BODY ball").twist_world.linear.x;
  };
  const double expected = speed_after_its_end();
  restore(rig, "pushed");
  EXPECT_EQ(speed_after_its_end(), expected);
  restore(rig, "pushed");
  restore(rig, "pushed");
  EXPECT_EQ(speed_after_its_end(), expected) << "restored twice in a row";
  restore(rig, "pushed");
  idle(30);
  EXPECT_EQ(speed_after_its_end(), expected) << "idle after the restore";
  EXPECT_NEAR(expected, 0.505, 0.0015) << "the command lives 0.5 s after the last step of its request";
}

// One client of a simulation: what it does follows from `acts` alone, when it sleeps from `sleeps`.
class Client {
 public:
  explicit Client(Rig& rig) : rig_(rig) {
    const auto structure = rig.simulation.structure();
    for (const state::ObjectInfo& object : structure->objects) {
      if (!state::info_of(object.kind).has_topics || object.model == state::kWorldModel) continue;
      if (object.kind == state::ObjectKind::rigid_body && object.local_name != "box" && object.local_name != "base")
        continue;
      const auto add = [&](state::Source source) {
        targets_.push_back({object.id, object.kind, rig.simulation.bind(object.id, source)});
        ASSERT_NE(targets_.back().port, nullptr) << object.name;
      };
      add(state::Source::ros);
      add(state::Source::device_0);
    }
  }

  // What frames show after each of some acts.
  std::vector<std::uint64_t> act(int count, unsigned acts_seed, unsigned sleeps_seed) {
    std::mt19937 acts(acts_seed), sleeps(sleeps_seed);
    std::vector<std::uint64_t> shown;
    for (int i = 0; i < count; ++i) {
      if (sleeps() % 4 == 0) idle(static_cast<int>(sleeps() % 8));
      for (Target& target : targets_) use(target, acts);
      if (acts() % 5 == 0) push(acts);
      step(acts);
      shown.push_back(state_hash(rig_.frame()));
      base::Fnv1a placed;
      for (const state::CameraState& camera : rig_.frame().cameras)
        placed.add_bytes(&camera.T_parent_camera.position, sizeof(math::Vec3));
      for (const state::LightState& light : rig_.frame().lights)
        placed.add_bytes(&light.T_parent_light.position, sizeof(math::Vec3));
      shown.push_back(placed.value());
    }
    return shown;
  }

 private:
  struct Target {
    state::ObjectId id;
    state::ObjectKind kind;
    std::unique_ptr<state::CommandPort> port;
  };

  static double number(std::mt19937& acts) { return static_cast<double>(acts() % 2001) * 1e-3 - 1.0; }
  static math::Vec3 vector(std::mt19937& acts) {
    const double x = number(acts), y = number(acts);
    return {x, y, number(acts)};
  }

  state::Command command(const Target& target, std::mt19937& acts) {
    // What carries the linkage gets no poses: they would tear it.
    const bool free = target.id == rig_.id("BODY box");
    if (target.kind != state::ObjectKind::rigid_body) {
      state::PoseCommand pose;
      pose.enabled = true;
      pose.T_parent_object.position = vector(acts);
      return pose;
    }
    state::RigidBodyCommand command;
    command.type = static_cast<state::CartesianCommandType>(acts() % (free ? 4 : 2));
    command.wrench_world = {vector(acts), vector(acts) * 0.01};
    command.T_world_body.position = vector(acts) * 0.01 + math::Vec3{1, 1, 0.5};
    command.twist_world = {vector(acts) * 0.1, vector(acts) * 0.1};
    if (acts() % 2 == 0) command.joints = {{static_cast<state::JointCommandType>(acts() % 3), number(acts)}};
    return command;
  }

  // At most one sign of life of each source between two steps: the physics thread may or may not see two as one.
  void use(Target& target, std::mt19937& acts) {
    switch (acts() % 12) {
      case 0: target.port->post(command(target, acts)); break;
      case 1: target.port->keep_alive(); break;
      case 2: target.port->release(); break;
      default: break;
    }
  }

  void push(std::mt19937& acts) {
    state::Push push;
    push.force_world = vector(acts);
    push.point_body = vector(acts) * 0.05;
    push.seconds = 0.3;
    const state::ObjectId box = rig_.id("BODY box");
    rig_.wait_for([&](state::Completion done) { rig_.simulation.push(box, push, std::move(done)); });
  }

  void step(std::mt19937& acts) {
    std::vector<state::AddressedCommand> commands;
    for (const Target& target : targets_)
      if (target.kind == state::ObjectKind::rigid_body && acts() % 12 == 0 && !addresses(commands, target.id))
        commands.push_back({target.id, command(target, acts)});
    const unsigned lengths[] = {1, 3, 20, 130, 450};
    ASSERT_TRUE(rig_.step(lengths[acts() % 5], std::move(commands)).success);
  }
  static bool addresses(const std::vector<state::AddressedCommand>& commands, state::ObjectId id) {
    return std::any_of(commands.begin(), commands.end(), [&](const auto& each) { return each.object == id; });
  }

  Rig& rig_;
  std::vector<Target> targets_;
};

struct World : Rig {
  World() {
    EXPECT_TRUE(loaded.success) << loaded.message;
    const state::Outcome view = load(kView);
    EXPECT_TRUE(view.success) << view.message;
    simulation.set_paused(true);
    simulation.begin();
  }
};

TEST(Restore, ContinuesAsAfterTheSnapshotWhateverWasCommanded) {
  const std::string file = testing::TempDir() + "restore_test.ambfstate";
  for (unsigned seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    constexpr int kActs = 14;
    World world;
    Client client(world);
    client.act(kActs, seed, seed);
    snapshot(world, "here", file);
    const std::vector<std::uint64_t> expected = client.act(kActs, 1000 + seed, 1);
    restore(world, "here");
    ASSERT_EQ(client.act(kActs, 1000 + seed, 2), expected) << "restored";
    restore(world, "here");
    if (seed % 2 == 0) idle(25);
    restore(world, "here");
    ASSERT_EQ(client.act(kActs, 1000 + seed, 3), expected) << "restored twice in a row";
    World fresh;
    Client other(fresh);
    restore(fresh, "", file);
    ASSERT_EQ(other.act(kActs, 1000 + seed, 4), expected) << "in a fresh simulation";
    ASSERT_NE(expected.front(), expected.back());
  }
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace ambf::runtime
