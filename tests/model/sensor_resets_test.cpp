// What a sensor senses ends with what it sensed: after resets, with or without a frame between, and while it waits for
// its parent. And what sets two sensors of one file apart.
#include <gtest/gtest.h>

#include <cmath>

#include "state/actuators.h"
#include "state/readings.h"
#include "state/sensors.h"
#include "tests/adf/support.h"
#include "tests/model/rig.h"

namespace ambf::model::test {
namespace {

struct World : Rig {
  explicit World(const std::string& text) : Rig({0, 0, -9.81}) {
    const adf::ModelResult read = adf::parse_model("namespace: /test/\n" + text, "sensors.yaml");
    EXPECT_FALSE(base::has_errors(read.diagnostics));
    model = *read.model;
    EXPECT_TRUE(load(model).success);
  }
  std::uint32_t sensor(const std::string& name) const { return slot(name, state::sensor_kind().kind); }
  const state::SensorReading& reading(const std::string& name) const { return state::reading_of(*frame, sensor(name)); }
  const state::SensedElement& first(const std::string& name) const {
    return state::elements_of(*frame, sensor(name))[0];
  }
  // A step without a frame before it; the frame after it.
  void step_at_once() {
    live->step(h_s);
    live->fill(*frame);
  }
  scene::Model model;
};

constexpr const char* kArm = R"(bodies: [BODY base, BODY arm]
joints: [JOINT hinge]
sensors: [SENSOR imu, SENSOR wrist]
BODY base: {name: base, mass: 0}
BODY arm: {name: arm, mass: 2.0, inertia: {ix: 0.01, iy: 0.02, iz: 0.02}, location: {position: {x: 0.3, y: 0, z: 0}}}
JOINT hinge: {name: hinge, type: revolute, parent: BODY base, child: BODY arm, parent axis: {x: 0, y: 0, z: 1},
              child axis: {x: 0, y: 0, z: 1}, parent pivot: {x: 0, y: 0, z: 0}, child pivot: {x: -0.3, y: 0, z: 0},
              damping: 0, enable motor: false}
SENSOR imu: {name: imu, type: IMU, parent: BODY arm}
SENSOR wrist: {name: wrist, type: Force Torque, joint: JOINT hinge}
)";

TEST(SensorResets, ReadingsOfTheFirstStepAfterAResetNeedNoFrameBetween) {
  World with(kArm), without(kArm);
  for (World* each : {&with, &without}) {
    each->port("arm")->post(force({}, {0, 0, 1.0}));
    each->step(100);
    each->live->reset();
  }
  with.live->fill(*with.frame);
  with.step_at_once();
  without.step_at_once();
  EXPECT_EQ(without.reading("imu").linear, with.reading("imu").linear);
  EXPECT_EQ(without.reading("wrist").linear, with.reading("wrist").linear);
  EXPECT_NEAR(without.reading("imu").linear.x, 0.0, 1e-6) << "nothing of the speed before";
  EXPECT_GT(without.reading("wrist").linear.z, 9.0) << "it holds the arm from the first step on";
}

// A ray that pushes, upwards from (0, 0, 0.1); `height` of the ball's centre.
std::string pushed_ball(const std::string& parent, double height) {
  return "bodies: [BODY a, BODY b]\nsensors: [SENSOR s]\nBODY a: {name: a, mass: 0, collision shape: BOX, "
         "collision geometry: {x: 0.01, y: 0.01, z: 0.01}}\n"
         "BODY b: {name: b, mass: 1000, gravity: {x: 0, y: 0, z: 0}, location: {position: {x: 0, y: 0, z: " +
         std::to_string(height) +
         "}}, collision shape: SPHERE, collision geometry: {radius: 0.05}}\n"
         "SENSOR s: {name: s, type: Resistance, parent: " +
         parent +
         ", range: 0.02, contact area: 0.1, contact stiffness: 10, contact damping: 0, friction: {static: 0, damping: "
         "0, dynamic: 0}, array: [{offset: {x: 0, y: 0, z: 0.1}, direction: {x: 0, y: 0, z: 1}}]}\n";
}

TEST(SensorResets, ForcesAfterAResetOfBodiesAreThoseOfWhereTheyThenAre) {
  constexpr double kTouching = 0.16, kAway = 0.3;
  for (const bool chosen : {false, true}) {
    World touching(pushed_ball("BODY a", kTouching)), away(pushed_ball("BODY a", kAway));
    const auto move_and_reset = [chosen](World& world, double to) {
      const auto port = world.port("b");
      const double speed = (to - world.body("b").T_world_body.position.z) / 0.3;
      port->post(twist({{0, 0, speed}, {}}));
      world.step(300);
      port->release();
      const bool pushes = world.first("s").force_world.z > 0.1;
      chosen ? world.live->reset_bodies({world.id("b")}) : world.live->reset_bodies();
      world.step_at_once();
      return pushes;
    };
    EXPECT_FALSE(move_and_reset(touching, kAway));
    EXPECT_NEAR(touching.first("s").force_world.z, 5.0, 0.1);
    EXPECT_TRUE(move_and_reset(away, kTouching));
    EXPECT_EQ(away.first("s").force_world, math::Vec3{});
  }
}

TEST(SensorResets, AResistiveSensorThatWaitsForItsParentPushesNothing) {
  World world(pushed_ball("BODY late", 0.16));
  world.step(50);
  EXPECT_EQ(world.first("s").force_world, math::Vec3{});
  EXPECT_EQ(world.body("b").twist_world.linear, math::Vec3{});
  ASSERT_TRUE(world.load(test::model("late.yaml", {box("late", 0.0, {0, 0, 0}, 0.01)})).success);
  world.step(1);
  EXPECT_GT(world.first("s").force_world.z, 0.1) << "its parent is there";
}

TEST(SensorResets, AResetOfChosenBodiesLetsThemGo) {
  World world(
      "bodies: [BODY hand, BODY cube, BODY other]\nactuators: [ACTUATOR one, ACTUATOR two]\n"
      "BODY hand: {name: hand, mass: 0}\n"
      "BODY cube: {name: cube, mass: 1, location: {position: {x: 0.2, y: 0, z: 0}}}\n"
      "BODY other: {name: other, mass: 1, location: {position: {x: -0.2, y: 0, z: 0}}}\n"
      "ACTUATOR one: {name: one, type: Constraint, parent: BODY hand}\n"
      "ACTUATOR two: {name: two, type: Constraint, parent: BODY hand}\n");
  const state::ObjectKind kind = state::actuator_kind().kind;
  const auto holds = [&](const std::string& name) {
    return state::rows(*world.frame, state::actuator_kind().column).at(world.slot(name, kind)).actuated();
  };
  const auto grasp = [&](const std::string& name, const std::string& body) {
    auto port = world.port(name, state::Source::ros, kind);
    state::ActuatorCommand command;
    command.actuate = true;
    command.body = world.id(body);
    port->post(state::KindCommand{command});
    port->hold();
    return port;
  };
  const auto one = grasp("one", "cube"), two = grasp("two", "other");
  world.step(10);
  ASSERT_TRUE(holds("one") && holds("two"));
  world.live->reset_bodies({world.id("cube")});
  world.live->fill(*world.frame);
  EXPECT_FALSE(holds("one"));
  EXPECT_TRUE(holds("two")) << "its body was not reset";
}

TEST(SensorNoise, OfTwoInstancesOfOneFileDiffers) {
  World world(
      "bodies: [BODY a, BODY b]\nsensors: [SENSOR r]\nBODY a: {name: a, mass: 0}\n"
      "BODY b: {name: b, mass: 0, location: {position: {x: 0.3, y: 0, z: 0}}, collision shape: BOX, "
      "collision geometry: {x: 0.1, y: 0.1, z: 0.1}}\n"
      "SENSOR r: {name: r, type: Range, parent: BODY a, range: 0.8, range noise: {std dev: 0.002}, "
      "array: [{offset: {x: 0, y: 0, z: 0}, direction: {x: 1, y: 0, z: 0}}]}\n");
  ASSERT_TRUE(world.load(world.model).success);
  for (int i = 0; i < 20; ++i) {
    world.step(1);
    EXPECT_NEAR(world.first("r").distance_m, 0.25, 0.02);
    EXPECT_NE(world.first("r").distance_m, world.first("r1").distance_m);
  }
}

TEST(SensorEvents, ThatWereOverwrittenAreCounted) {
  state::SensorEventLog log;
  state::SensorEventReader reader;
  std::uint32_t next = 0;
  const auto happen = [&](std::uint32_t count) {
    for (const std::uint32_t end = next + count; next < end; ++next)
      log.last[log.total++ % state::SensorEventLog::kSize].sim_step = next;
  };
  std::vector<std::uint32_t> steps;
  const auto read = [&] {
    steps.clear();
    reader.read(log, [&](const state::SensorEvent& event) { steps.push_back(event.sim_step); });
  };
  happen(2048);
  read();
  ASSERT_EQ(steps.size(), 2048u);
  EXPECT_EQ(steps.front(), 0u);
  EXPECT_EQ(reader.lost(), 0u);
  read();
  EXPECT_TRUE(steps.empty());
  happen(2050);
  read();
  ASSERT_EQ(steps.size(), 2048u);
  EXPECT_EQ(steps.front(), 2050u);
  EXPECT_EQ(reader.lost(), 2u);
  happen(10);
  reader.skip(log);
  read();
  EXPECT_TRUE(steps.empty());
  EXPECT_EQ(reader.lost(), 2u) << "nobody wanted those";
}

}  // namespace
}  // namespace ambf::model::test
