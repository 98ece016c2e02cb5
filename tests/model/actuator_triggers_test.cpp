// What makes actuators hold without a name: the bodies that a sensor senses, by command, at once, or while a jaw is
// closed; and magnets.
#include <gtest/gtest.h>

#include <algorithm>

#include "math/rotation.h"
#include "rig.h"
#include "state/actuators.h"
#include "state/sensors.h"
#include "tests/adf/support.h"

namespace ambf::model::test {
namespace {

// A palm with two fingers that slide along y, and three rays along z that meet two cubes, one of them twice.
constexpr const char* kGripper = R"(adf version: 1.0
namespace: /test/
bodies: [BODY palm, BODY left, BODY right, BODY cube, BODY ball]
joints: [JOINT l, JOINT r]
sensors: [SENSOR eyes]
BODY palm: {name: palm, mass: 2.0, gravity: {x: 0, y: 0, z: 0}, inertia: {ix: 1, iy: 1, iz: 1}}
BODY left: {name: left, mass: 0.1, gravity: {x: 0, y: 0, z: 0}, inertia: {ix: 0.01, iy: 0.01, iz: 0.01}}
BODY right: {name: right, mass: 0.1, gravity: {x: 0, y: 0, z: 0}, inertia: {ix: 0.01, iy: 0.01, iz: 0.01}}
BODY cube: {name: cube, mass: 0.2, location: {position: {x: 0, y: 0, z: 0.2}}, collision shape: BOX,
            collision geometry: {x: 0.1, y: 0.1, z: 0.1}}
BODY ball: {name: ball, mass: 0.2, location: {position: {x: 0.2, y: 0, z: 0.2}}, collision shape: SPHERE,
            collision geometry: {radius: 0.05}}
JOINT l: {name: l, type: prismatic, parent: BODY palm, child: BODY left, parent axis: {x: 0, y: 1, z: 0},
          child axis: {x: 0, y: 1, z: 0}, parent pivot: {x: 0, y: 0, z: 0}, child pivot: {x: 0, y: 0, z: 0},
          joint limits: {low: 0.0, high: 0.1}, max motor impulse: 1}
JOINT r: {name: r, type: prismatic, parent: BODY palm, child: BODY right, parent axis: {x: 0, y: -1, z: 0},
          child axis: {x: 0, y: -1, z: 0}, parent pivot: {x: 0, y: 0, z: 0}, child pivot: {x: 0, y: 0, z: 0},
          joint limits: {low: 0.0, high: 0.1}, max motor impulse: 1}
SENSOR eyes: {name: eyes, type: Proximity, parent: BODY palm, range: 0.3, array: [
  {offset: {x: -0.02, y: 0, z: 0}, direction: {x: 0, y: 0, z: 1}},
  {offset: {x: 0.02, y: 0, z: 0}, direction: {x: 0, y: 0, z: 1}},
  {offset: {x: 0.2, y: 0, z: 0}, direction: {x: 0, y: 0, z: 1}}]}
actuators: [ACTUATOR grip]
ACTUATOR grip: {name: grip, parent: BODY palm, )";

struct World {
  explicit World(const std::string& actuator) {
    const adf::ModelResult read = adf::parse_model(kGripper + actuator + "}\n", "gripper.yaml");
    EXPECT_TRUE(adf::no_worse_than_information(read.diagnostics));
    EXPECT_TRUE(rig.load(*read.model).success);
  }
  const state::ActuatorState& grip() const { return state::rows(*rig.frame, state::actuator_kind().column).at(0); }
  std::unique_ptr<state::CommandPort> port() {
    auto made = rig.port("grip", state::Source::ros, state::actuator_kind().kind);
    made->hold();
    return made;
  }
  bool holds(const std::string& body) const {
    const auto end = grip().held.begin() + grip().held_count;
    return std::find(grip().held.begin(), end, rig.slot(body)) != end;
  }
  void open_jaw(double opening) {
    const auto fingers = rig.port("palm");
    fingers->post(joints({to_position(0.1 * opening), to_position(0.1 * opening)}));
    fingers->hold();
    rig.step(400);
  }

  Rig rig{{0, 0, 0}};
};

const state::ActuatorCommand kBySensor = [] {
  state::ActuatorCommand command;
  command.actuate = command.use_sensor = true;
  return command;
}();

TEST(ActuatorTriggers, ACommandTakesEachSensedBodyOnce) {
  World world("type: Constraint, sensor: SENSOR eyes");
  world.rig.step(10);
  EXPECT_FALSE(world.grip().actuated());
  const auto port = world.port();
  port->post(state::KindCommand{kBySensor});
  world.rig.step(1);
  EXPECT_EQ(world.grip().held_count, 2u);
  EXPECT_TRUE(world.holds("cube"));
  EXPECT_TRUE(world.holds("ball"));
  port->post(state::KindCommand{state::ActuatorCommand{}});
  world.rig.step(1);
  EXPECT_FALSE(world.grip().actuated());
  state::ActuatorCommand named = kBySensor;
  named.sensor = world.rig.id("eyes", state::sensor_kind().kind);
  port->post(state::KindCommand{named});
  world.rig.step(1);
  EXPECT_EQ(world.grip().held_count, 2u);
}

TEST(ActuatorTriggers, ASensorThatSensesNothingIsAwaited) {
  World world("type: Constraint, sensor: SENSOR eyes");
  const auto palm = world.rig.port("palm"), port = world.port();
  palm->hold();
  palm->post(twist({{0, 1, 0}, {}}));
  world.rig.step(300);
  port->post(state::KindCommand{kBySensor});
  world.rig.step(10);
  EXPECT_FALSE(world.grip().actuated());
  palm->post(twist({{0, -1, 0}, {}}));
  world.rig.step(300);
  EXPECT_TRUE(world.grip().actuated());
}

TEST(ActuatorTriggers, ASensorAloneTakesWhatItSensesAndACommandOverrulesIt) {
  World world("type: Constraint, sensor: SENSOR eyes, trigger: sensor");
  world.rig.step(2);
  EXPECT_EQ(world.grip().held_count, 2u);
  const auto port = world.port();
  port->post(state::KindCommand{state::ActuatorCommand{}});
  world.rig.step(2);
  EXPECT_FALSE(world.grip().actuated());
  port->release();
  world.rig.step(2);
  EXPECT_TRUE(world.grip().actuated());
}

TEST(ActuatorTriggers, AJawTakesWhenItClosesAndLetsGoALittleWiderOpen) {
  World world("type: Constraint, sensor: SENSOR eyes, trigger: {jaw: BODY palm, below: 0.5}");
  world.open_jaw(0.8);
  EXPECT_FALSE(world.grip().actuated());
  world.open_jaw(0.4);
  EXPECT_TRUE(world.grip().actuated());
  world.open_jaw(0.53);
  EXPECT_TRUE(world.grip().actuated()) << "within the hysteresis";
  world.open_jaw(0.6);
  EXPECT_FALSE(world.grip().actuated());
  world.open_jaw(0.53);
  EXPECT_FALSE(world.grip().actuated()) << "within the hysteresis, from the other side";
}

TEST(ActuatorTriggers, ASnapshotKeepsTheJaw) {
  const char* actuator = "type: Constraint, sensor: SENSOR eyes, trigger: {jaw: BODY palm, below: 0.5}";
  World one(actuator), two(actuator);
  one.open_jaw(0.4);
  one.open_jaw(0.53);
  ASSERT_EQ(two.rig.live->restore(one.rig.live->save()), "");
  for (int i = 0; i < 50; ++i) {
    one.rig.step(1);
    two.rig.step(1);
    ASSERT_EQ(state::state_hash(*one.rig.frame), state::state_hash(*two.rig.frame)) << i;
  }
  EXPECT_TRUE(two.grip().actuated());
}

TEST(ActuatorTriggers, WrongBlocksAreReported) {
  const auto found = [](const std::string& actuator) {
    return adf::parse_model(kGripper + actuator + "}\n", "gripper.yaml").diagnostics;
  };
  EXPECT_TRUE(adf::says(found("type: Constraint, trigger: sensor"), "error: \\[ACTUATOR grip: sensor\\] missing"));
  EXPECT_TRUE(adf::says(found("type: Magnet, strength: 1"), "error: \\[ACTUATOR grip: sensor\\] missing"));
  EXPECT_TRUE(adf::says(found("type: Magnet, sensor: SENSOR eyes"), "warning: \\[ACTUATOR grip: strength\\] 0"));
  EXPECT_TRUE(adf::says(found("type: Constraint, trigger: later"), "warning: \\[ACTUATOR grip: trigger\\] expected"));
  EXPECT_TRUE(adf::says(found("type: Constraint, sensor: SENSOR eyes, trigger: {below: 0.4}"), "error: .*jaw"));
}

TEST(ActuatorTriggers, AJawRootWithoutLimitedJointsIsNamed) {
  const auto found = [](const std::string& root) {
    return adf::parse_model(kGripper + ("type: Constraint, sensor: SENSOR eyes, trigger: {jaw: BODY " + root + "}}\n"),
                            "gripper.yaml")
        .diagnostics;
  };
  EXPECT_TRUE(
      adf::says(found("left"), "warning: \\[ACTUATOR grip: trigger/jaw\\] no joint with limits is below .*BODY left"));
  EXPECT_TRUE(adf::no_worse_than_information(found("palm")));
  EXPECT_TRUE(adf::no_worse_than_information(found("of another file")));
}

// A static magnet over a block that hangs on it: it stays up to the magnet's strength and falls beyond.
constexpr const char* kMagnet = R"(adf version: 1.0
namespace: /test/
bodies: [BODY magnet, BODY block]
sensors: [SENSOR face]
actuators: [ACTUATOR coil]
BODY magnet: {name: magnet, mass: 0.0, collision shape: BOX, collision geometry: {x: 0.1, y: 0.1, z: 0.1},
              location: {position: {x: 0, y: 0, z: 1}}}
BODY block: {name: block, mass: 0.5, collision shape: BOX, collision geometry: {x: 0.1, y: 0.1, z: 0.1},
             location: {position: {x: 0, y: 0, z: 0.88}}, damping: {linear: 0.0, angular: 0.0}}
SENSOR face: {name: face, type: Proximity, parent: BODY magnet, range: 0.05, array: [
  {offset: {x: 0, y: 0, z: -0.0498}, direction: {x: 0, y: 0, z: -1}}]}
ACTUATOR coil: {name: coil, type: Magnet, parent: BODY magnet, sensor: SENSOR face, trigger: sensor, strength: 10}
)";

TEST(Magnet, AttractsHoldsAndIsPulledOffAtItsStrength) {
  for (const double share : {0.98, 1.02}) {
    Rig rig({0, 0, 0});
    const adf::ModelResult read = adf::parse_model(kMagnet, "magnet.yaml");
    ASSERT_TRUE(adf::no_worse_than_information(read.diagnostics));
    ASSERT_TRUE(rig.load(*read.model).success);
    const auto coil = [&]() -> const state::ActuatorState& {
      return state::rows(*rig.frame, state::actuator_kind().column).at(0);
    };
    rig.step(1);
    EXPECT_NEAR(coil().force_world.z, 10.0 * 0.6 * 0.6, 0.1) << "0.02 m of 0.05 m away";
    rig.step(1500);
    EXPECT_NEAR(rig.body("block").T_world_body.position.z, 0.9, 1e-3) << "it came and stays";
    const auto port = rig.port("block");
    port->hold();
    for (int i = 0; i <= 100; ++i) {
      port->post(force({0, 0, -0.1 * share * i}));
      rig.step(10);
    }
    rig.step(500);
    if (share < 1.0) {
      EXPECT_NEAR(rig.body("block").T_world_body.position.z, 0.9, 1e-3);
    } else {
      EXPECT_LT(rig.body("block").T_world_body.position.z, 0.8);
    }
  }
}

// The rays meet it equally near: none of them may turn it.
TEST(Magnet, KeepsFlatWhatLiesFlat) {
  Rig rig({0, 0, 0});
  std::string text = kMagnet;
  const std::string one = "{offset: {x: 0, y: 0, z: -0.0498}, direction: {x: 0, y: 0, z: -1}}";
  std::string four;
  for (const char* at : {"x: -0.04, y: -0.04", "x: 0.04, y: -0.04", "x: -0.04, y: 0.04", "x: 0.04, y: 0.04"})
    four += (four.empty() ? "{offset: {" : ", {offset: {") + std::string(at) +
            ", z: -0.0498}, direction: {x: 0, y: 0, z: -1}}";
  text.replace(text.find(one), one.size(), four);
  ASSERT_TRUE(rig.load(*adf::parse_model(text, "magnet.yaml").model).success);
  rig.step(40);  // on its way
  EXPECT_GT(rig.body("block").twist_world.linear.z, 0.05);
  EXPECT_LT(math::norm(rig.body("block").twist_world.angular), 1e-9);
  rig.step(1500);
  EXPECT_NEAR(rig.body("block").T_world_body.position.z, 0.9, 1e-3);
  EXPECT_LT(math::norm(math::log(rig.body("block").T_world_body.orientation)), 1e-3);
}

TEST(Magnet, PushesNothingFromOutside) {
  Rig rig({0, 0, 0});
  std::string text = kMagnet;
  text.replace(text.find("mass: 0.0"), 9, "mass: 0.7, damping: {linear: 0.0, angular: 0.0}");
  ASSERT_TRUE(rig.load(*adf::parse_model(text, "magnet.yaml").model).success);
  rig.step(40);  // before they meet
  const math::Vec3 momentum = rig.body("magnet").twist_world.linear * 0.7 + rig.body("block").twist_world.linear * 0.5;
  EXPECT_GT(rig.body("block").twist_world.linear.z, 0.05);
  EXPECT_LT(math::norm(momentum), 1e-12);
}

}  // namespace
}  // namespace ambf::model::test
