// Ghost objects and sensors that measure in a running simulation: any step length, repeats, snapshots, and the removal
// of what they hang on.
#include <gtest/gtest.h>

#include "runtime/local_simulation.h"
#include "simulation_rig.h"
#include "state/ghosts.h"
#include "state/readings.h"

namespace ambf::runtime {
namespace {

// An arm that a motor turns through a ghost with drag, over a table with a box, and a sensor of each type on it.
constexpr const char* kScene = R"(
bodies: [BODY base, BODY arm, BODY table, BODY box, BODY ball]
joints: [JOINT hinge]
ghost objects: [GHOST tip, GHOST syrup]
sensors: [SENSOR imu, SENSOR wrist, SENSOR feel]
namespace: /test/
BODY base: {name: base, mass: 0}
BODY arm: {name: arm, mass: 1, location: {position: {x: 0.2, y: 0, z: 0.3}}, collision shape: BOX,
           collision geometry: {x: 0.4, y: 0.02, z: 0.02}, inertial offset: {position: {x: 0.05, y: 0, z: 0}}}
JOINT hinge: {name: hinge, type: revolute, parent: BODY base, child: BODY arm, parent axis: {x: 0, y: 0, z: 1},
              child axis: {x: 0, y: 0, z: 1}, parent pivot: {x: 0, y: 0, z: 0.3}, child pivot: {x: -0.2, y: 0, z: 0},
              controller: {P: 50, D: 5}}
BODY table: {name: table, mass: 0, collision shape: BOX, collision geometry: {x: 2, y: 2, z: 0.1}}
BODY box: {name: box, mass: 1, location: {position: {x: -0.3, y: 0, z: 0.11}}, collision shape: BOX,
           collision geometry: {x: 0.1, y: 0.1, z: 0.1}}
BODY ball: {name: ball, mass: 0.1, location: {position: {x: 0.3, y: 0.3, z: 0.5}}, collision shape: SPHERE,
            collision geometry: {radius: 0.03}}
GHOST tip: {name: tip, parent: BODY arm, location: {position: {x: 0.2, y: 0, z: 0}}, collision shape: SPHERE,
            collision geometry: {radius: 0.1}}
GHOST syrup: {name: syrup, parent: BODY arm, drag: 0.98, collision shape: BOX,
              collision geometry: {x: 1, y: 1, z: 0.2}}
SENSOR imu: {name: imu, type: IMU, parent: GHOST tip, noise: {linear: 0.01}}
SENSOR wrist: {name: wrist, type: Force Torque, joint: JOINT hinge}
SENSOR feel: {name: feel, type: Contact, parent: BODY box, distance threshold: 0.002}
)";

struct Scene {
  explicit Scene(const std::string& text = kScene, double step_s = 0.001)
      : simulation(options(step_s), test::empty_world(), {}, log) {
    state::LoadRequest request;
    request.text = text;
    EXPECT_TRUE(simulation.load(request).success);
  }
  static SimulationOptions options(double step_s) {
    SimulationOptions options = test::free_running();
    options.speed_factor = step_s * options.physics_rate_hz;
    return options;
  }
  std::uint32_t object(const std::string& name, state::ObjectKind kind) const {
    const auto structure = simulation.structure();
    return state::find(*structure, name, kind);
  }
  void command(const std::string& body, state::RigidBodyCommand command) {
    const auto structure = simulation.structure();
    port =
        simulation.bind(structure->objects.at(object(body, state::ObjectKind::rigid_body)).id, state::Source::plugin);
    port->post(std::move(command));
  }
  void swing() {
    state::RigidBodyCommand command;
    command.joints = {{state::JointCommandType::position, 1.5}};
    this->command("BODY base", command);
  }

  JudgedLog log;
  LocalSimulation simulation;
  std::unique_ptr<state::CommandPort> port;
};

TEST(Feeling, RepeatsBitForBit) {
  Scene a, b;
  a.swing(), b.swing();
  bool felt = false;
  for (int i = 0; i < 40; ++i) {
    ASSERT_TRUE(a.simulation.step(10));
    ASSERT_TRUE(b.simulation.step(10));
    ASSERT_EQ(state::state_hash(a.simulation.frame()), state::state_hash(b.simulation.frame())) << i;
    felt = felt || state::contacts_of(a.simulation.frame(), 2).size() > 0;
  }
  EXPECT_TRUE(felt) << "the box lies on the table";
}

TEST(Feeling, GoesOnFromASnapshotInTheMidstOfIt) {
  Scene scene;
  scene.swing();
  ASSERT_TRUE(scene.simulation.step(150));
  ASSERT_TRUE(scene.simulation.snapshot("here").success);
  ASSERT_TRUE(scene.simulation.step(150));
  const std::uint64_t first = state::state_hash(scene.simulation.frame());
  ASSERT_TRUE(scene.simulation.restore("here").success);
  ASSERT_TRUE(scene.simulation.step(150));
  EXPECT_EQ(state::state_hash(scene.simulation.frame()), first);
}

TEST(Feeling, OutlivesWhateverItHangsOn) {
  for (const char* leaving : {"BODY arm", "BODY base", "BODY box", "BODY table", "BODY ball", "JOINT hinge",
                              "GHOST tip", "GHOST syrup", "SENSOR imu"}) {
    Scene scene;
    scene.swing();
    ASSERT_TRUE(scene.simulation.step(120));
    ASSERT_TRUE(scene.simulation.remove(leaving).success) << leaving;
    ASSERT_TRUE(scene.simulation.step(50));
    scene.simulation.reset();
    ASSERT_TRUE(scene.simulation.step(50));
    const state::Frame& frame = scene.simulation.frame();
    for (std::uint32_t slot = 0; slot < state::ghosts(*frame.structure).size(); ++slot)
      for (const state::GhostTouch& touch : state::touches_of(frame, slot))
        EXPECT_LT(touch.object, frame.structure->objects.size()) << leaving;
  }
}

// drag^(h / 1 ms).
TEST(GhostDrag, KeepsAsMuchOfAVelocityInStepsOfAnyLength) {
  constexpr const char* kSyrup = R"(
bodies: [BODY ball]
ghost objects: [GHOST syrup]
namespace: /test/
BODY ball: {name: ball, mass: 0.1, location: {position: {x: 0, y: 0, z: 1}}, collision shape: SPHERE,
            collision geometry: {radius: 0.03},
            damping: {linear: 0, angular: 0}}
GHOST syrup: {name: syrup, drag: 0.9, location: {position: {x: 0, y: 0, z: 1}}, collision shape: BOX,
              collision geometry: {x: 1, y: 1, z: 1}}
)";
  for (const double step_s : {0.00025, 0.0005, 0.001}) {
    Scene scene(kSyrup, step_s);
    state::RigidBodyCommand command;
    command.type = state::CartesianCommandType::velocity;
    command.twist_world = {{0.3, 0, 0}, {0, 0, 2}};
    scene.command("BODY ball", command);
    ASSERT_TRUE(scene.simulation.step());
    scene.port->post(state::RigidBodyCommand{});
    ASSERT_TRUE(scene.simulation.step());
    const std::uint32_t ball =
        scene.simulation.structure()->objects.at(scene.object("BODY ball", state::ObjectKind::rigid_body)).slot;
    const math::Twist before = scene.simulation.frame().bodies[ball].twist_world;
    ASSERT_GT(before.linear.x, 0.1);
    ASSERT_TRUE(scene.simulation.step(static_cast<unsigned>(std::lround(0.004 / step_s))));
    const math::Twist after = scene.simulation.frame().bodies[ball].twist_world;
    EXPECT_NEAR(after.linear.x, before.linear.x * std::pow(0.9, 4), 1e-9) << step_s;
    EXPECT_NEAR(after.angular.z, before.angular.z * std::pow(0.9, 4), 1e-9) << step_s;
    EXPECT_NEAR(after.linear.z, 0.0, 1e-9) << "no gravity inside";
  }
}

}  // namespace
}  // namespace ambf::runtime
