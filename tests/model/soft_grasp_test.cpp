// Sensors sense soft bodies, and actuators hold their nodes: by name, by sensor, by jaw; until the command, its
// watchdog or either body ends.
#include <gtest/gtest.h>

#include <fstream>

#include "math/rotation.h"
#include "rig.h"
#include "state/actuators.h"
#include "state/sensors.h"
#include "state/soft_bodies.h"
#include "tests/adf/support.h"

namespace ambf::model::test {
namespace {

constexpr int kSide = 9;

// kSide x kSide places 2.5 cm apart about the origin.
std::string write_sheet() {
  const std::string path = ::testing::TempDir() + "/soft_grasp_sheet.obj";
  std::ofstream file(path);
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i) file << "v " << 0.025 * i - 0.1 << " " << 0.025 * j - 0.1 << " 0\n";
  for (int j = 0; j + 1 < kSide; ++j)
    for (int i = 0; i + 1 < kSide; ++i) {
      const int a = 1 + kSide * j + i;
      file << "f " << a << " " << a + 1 << " " << a + kSide << "\nf " << a + 1 << " " << a + kSide + 1 << " "
           << a + kSide << "\n";
    }
  return path;
}

// A hand 5 cm above a corner of a cloth that lies on a table; its ray looks down on it. A jaw of one finger.
const char* const kLinks = "mass: 0.05, config: {kDP: 0.03, piterations: 4, kKHR: 1.0}";
std::string scene(const std::string& actuator, const std::string& sensor = {}, const std::string& soft = kLinks) {
  return R"(adf version: 1.0
namespace: /test/
bodies: [BODY hand, BODY finger, BODY table]
soft bodies: [Sheet]
joints: [JOINT jaw]
sensors: [SENSOR eye]
actuators: [ACTUATOR grip]
Sheet: {name: Sheet, mesh: )" +
         write_sheet() + R"(, collision margin: 0.002, location: {position: {x: 0, y: 0, z: 0.5}}, )" + soft + R"(}
BODY hand: {name: hand, mass: 1.0, gravity: {x: 0, y: 0, z: 0}, inertia: {ix: 0.1, iy: 0.1, iz: 0.1},
            location: {position: {x: -0.09, y: -0.085, z: 0.55}}}
BODY finger: {name: finger, mass: 0.1, gravity: {x: 0, y: 0, z: 0}, inertia: {ix: 0.01, iy: 0.01, iz: 0.01},
              location: {position: {x: -0.09, y: -0.085, z: 0.6}}}
BODY table: {name: table, mass: 0, collision shape: BOX, collision geometry: {x: 1, y: 1, z: 0.1},
             location: {position: {x: 0, y: 0, z: 0.445}}}
JOINT jaw: {name: jaw, type: prismatic, parent: BODY hand, child: BODY finger, parent axis: {x: 0, y: 1, z: 0},
            child axis: {x: 0, y: 1, z: 0}, parent pivot: {x: 0, y: 0, z: 0.05}, child pivot: {x: 0, y: 0, z: 0},
            joint limits: {low: 0.0, high: 0.1}, max motor impulse: 1}
SENSOR eye: {name: eye, type: Proximity, parent: BODY hand, range: 0.1, )" +
         sensor + R"(
             array: [{offset: {x: 0, y: 0, z: 0}, direction: {x: 0, y: 0, z: -1}}]}
ACTUATOR grip: {name: grip, type: Constraint, parent: BODY hand, sensor: SENSOR eye, hardness: 5000, damping: 2, )" +
         actuator + "}\n";
}

struct World {
  explicit World(const std::string& actuator = {}, const std::string& sensor = {}, const std::string& soft = kLinks) {
    const adf::ModelResult read = adf::parse_model(scene(actuator, sensor, soft), "soft_grasp.yaml");
    EXPECT_TRUE(adf::no_worse_than_information(read.diagnostics)) << adf::all_of(read.diagnostics);
    EXPECT_TRUE(rig.load(*read.model).success);
  }
  const state::ActuatorState& grip() const { return state::rows(*rig.frame, state::actuator_kind().column).at(0); }
  const std::vector<state::HeldNode>& held() const {
    return state::held_nodes(static_cast<const state::Frame&>(*rig.frame));
  }
  math::Vec3 node(std::size_t number) const { return state::nodes_of(*rig.frame, 0)[number].position_world; }
  std::vector<math::Vec3> nodes() const {
    std::vector<math::Vec3> all;
    for (const state::SoftNode& each : state::nodes_of(*rig.frame, 0)) all.push_back(each.position_world);
    all.push_back(rig.body("hand").T_world_body.position);
    return all;
  }
  const state::SensedElement& sensed() const { return state::elements_of(*rig.frame, 0)[0]; }
  std::unique_ptr<state::CommandPort> port(bool lasting = true) {
    auto made = rig.port("grip", state::Source::ros, state::actuator_kind().kind);
    if (lasting) made->hold();
    return made;
  }
  state::ActuatorCommand by_name() const {
    state::ActuatorCommand command;
    command.actuate = true;
    command.body = rig.id("Sheet", state::soft_body_kind().kind);
    return command;
  }
  // The hand goes up at 0.1 m/s, and stops.
  void lift(double height) {
    const auto hand = rig.port("hand");
    hand->hold();
    hand->post(twist({{0, 0, 0.1}, {}}));
    rig.step(static_cast<int>(height * 1e4));
    hand->post(twist({}));
    rig.step(300);
  }

  Rig rig{{0, 0, -9.81}};
};

const state::ActuatorCommand kBySensor = [] {
  state::ActuatorCommand command;
  command.actuate = command.use_sensor = true;
  return command;
}();

TEST(SoftGrasp, SensorsNameTheSoftBodyItsFaceAndTheExactPoint) {
  World world({}, "success when: present,");
  const state::SensedElement& element = world.sensed();
  ASSERT_TRUE(element.triggered());
  EXPECT_EQ(element.soft_body, 0U);
  EXPECT_EQ(element.body, state::kNone);
  const state::Structure& structure = *world.rig.live->structure();
  EXPECT_EQ(structure.objects[state::sensed_object(structure, element)].name, "/test/Sheet");
  EXPECT_NEAR(element.distance_m, 0.05, 1e-12);
  EXPECT_LT(math::norm(element.point_world - math::Vec3{-0.09, -0.085, 0.5}), 1e-12);
  const auto& face = state::soft_bodies(structure)[0].shape->faces.at(static_cast<std::size_t>(element.triangle));
  double widest = 0.0;
  for (const std::uint32_t corner : face)
    widest = std::max(widest, math::norm(world.node(corner) - element.point_world));
  EXPECT_LT(widest, 0.03) << "the face is where the point is";
  world.rig.step(1);
  const state::SensorEventLog& log = *state::sensor_events(static_cast<const state::Frame&>(*world.rig.frame));
  ASSERT_EQ(log.total, 2U);
  EXPECT_EQ(log.last[0].object, world.rig.id("Sheet", state::soft_body_kind().kind));
  EXPECT_EQ(log.last[1].what, state::SensorEvent::What::success);
  EXPECT_TRUE(world.rig.apply(world.rig.catalogue.prepare_remove("Sheet")).success);
  EXPECT_EQ(world.sensed().soft_body, state::kNone);
  EXPECT_EQ(world.sensed().body, world.rig.slot("table"));
}

TEST(SoftGrasp, ACommandByNameTakesTheNearestNodeWithinReachUntilItEnds) {
  World world;
  const auto port = world.port(false);
  const auto before = world.nodes();
  std::size_t nearest = 0;
  while (math::norm(before[nearest] - math::Vec3{-0.1, -0.075, 0.5}) > 1e-6) ++nearest;
  port->post(state::KindCommand{world.by_name()});
  world.rig.step(2);
  ASSERT_EQ(world.held().size(), 1U);
  EXPECT_EQ(world.held()[0].node, nearest);
  EXPECT_TRUE(world.grip().actuated());
  EXPECT_EQ(world.grip().held_count, 0U);
  EXPECT_LT(math::norm(world.node(nearest) - before[nearest]), 1e-4) << "nothing jumps";
  world.rig.step(500);
  EXPECT_FALSE(world.grip().actuated()) << "the watchdog lets go";
  state::ActuatorCommand offset = world.by_name();
  offset.use_offset = true;
  EXPECT_NE(state::check(offset, *world.rig.live->structure(), world.rig.object("grip", state::actuator_kind().kind)),
            "");
  world.lift(0.1);
  const auto again = world.port();
  again->post(state::KindCommand{world.by_name()});
  world.rig.step(10);
  EXPECT_FALSE(world.grip().actuated()) << "no node is within 0.1 m";
}

TEST(SoftGrasp, ACommandBySensorTakesTheCornersOfTheFaceAndLiftsThem) {
  World world;
  world.rig.step(300);
  const auto port = world.port();
  const auto& faces = state::soft_bodies(*world.rig.live->structure())[0].shape->faces;
  const auto face = faces.at(static_cast<std::size_t>(world.sensed().triangle));
  port->post(state::KindCommand{kBySensor});
  world.rig.step(1);
  ASSERT_EQ(world.held().size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(world.held()[i].node, face[i]);
  world.lift(0.3);
  EXPECT_GT(world.node(face[0]).z, 0.75);
  for (const state::HeldNode& each : world.held())
    EXPECT_LT(math::norm(each.target_world - world.node(each.node)), 1e-3);
  EXPECT_NEAR(world.grip().force_world.z, 0.05 * 9.81, 0.05) << "all of the cloth hangs on it";
  port->post(state::KindCommand{state::ActuatorCommand{}});
  world.rig.step(1000);
  EXPECT_FALSE(world.grip().actuated());
  EXPECT_LT(world.node(face[0]).z, 0.6) << "it fell on the table";
  EXPECT_GT(world.node(face[0]).z, 0.48);
}

TEST(SoftGrasp, ATriggerHoldsWhatItsSensorSensesAtOnceOrWhileTheJawIsClosed) {
  World at_once("trigger: sensor");
  at_once.rig.step(2);
  EXPECT_EQ(at_once.held().size(), 3U);
  at_once.lift(0.1);
  EXPECT_EQ(at_once.held().size(), 3U) << "it still senses it";

  World by_jaw("trigger: {jaw: BODY hand, below: 0.5}");
  const auto jaw = by_jaw.rig.port("hand");
  jaw->hold();
  jaw->post(joints({to_position(0.09)}));
  by_jaw.rig.step(400);
  EXPECT_FALSE(by_jaw.grip().actuated());
  jaw->post(joints({to_position(0.01)}));
  by_jaw.rig.step(400);
  EXPECT_EQ(by_jaw.held().size(), 3U);
  jaw->post(joints({to_position(0.09)}));
  by_jaw.rig.step(400);
  EXPECT_FALSE(by_jaw.grip().actuated());
}

TEST(SoftGrasp, ASnapshotInMidGraspContinuesBitForBitInAFreshWorld) {
  World one, two;
  one.rig.step(100);
  const auto port = one.port();
  port->post(state::KindCommand{kBySensor});
  one.rig.step(50);
  const auto hand = one.rig.port("hand");
  hand->hold();
  hand->post(twist({{0.02, 0, 0.1}, {}}));
  one.rig.step(500);
  ASSERT_EQ(two.rig.live->restore(one.rig.live->save()), "");
  one.rig.live->fill(*one.rig.frame);
  two.rig.live->fill(*two.rig.frame);
  EXPECT_EQ(two.nodes(), one.nodes());
  EXPECT_EQ(two.held().size(), 3U);
  EXPECT_EQ(two.sensed().distance_m, one.sensed().distance_m);
  for (int i = 0; i < 5; ++i) {
    one.rig.step(100);
    two.rig.step(100);
    ASSERT_EQ(two.nodes(), one.nodes()) << i;
    EXPECT_EQ(two.held()[0].force_world, one.held()[0].force_world);
    EXPECT_EQ(two.sensed().fraction, one.sensed().fraction);
  }
  EXPECT_GT(one.node(0).z, 0.55);
}

TEST(SoftGrasp, APointerDragsTheFaceThatItPicksByNoMoreThanItsBound) {
  World world;
  LiveWorld& live = *world.rig.live;
  state::PickHit hit;
  ASSERT_TRUE(live.pick(0, 1, {0.05, 0.04, 1.0}, {0.05, 0.04, 0.0}, hit));
  EXPECT_EQ(hit.object, world.rig.id("Sheet", state::soft_body_kind().kind));
  EXPECT_NEAR(hit.point_world.z, 0.5, 1e-12);
  const auto picks = [&]() -> const std::vector<state::SoftPick>& {
    live.fill(*world.rig.frame);
    return state::soft_picks(static_cast<const state::Frame&>(*world.rig.frame));
  };
  const auto drag = [&](double z, int steps) {
    live.pick_table()[0].target.post({1, {0.05, 0.04, z}}, 0);
    for (int i = 0; i < steps; ++i) {
      live.take_picks(false);
      world.rig.step();
    }
  };
  drag(0.75, 1500);
  ASSERT_EQ(picks().size(), 1U);
  EXPECT_GT(picks()[0].point_world.z, 0.72);
  EXPECT_NEAR(picks()[0].force_world.z, 0.05 * 9.81, 0.05) << "it carries all of the cloth";
  live.pick_table()[0].target.post({1, {0.05, 0.04, 100.0}}, 0);
  live.take_picks(false);
  world.rig.step();
  EXPECT_LT(math::norm(picks()[0].force_world), 10.001 * 0.05 * 9.81);
  EXPECT_GT(math::norm(picks()[0].force_world), 9.0 * 0.05 * 9.81);
  live.pick_table()[0].ended.store(1);
  live.take_picks(false);
  EXPECT_TRUE(picks().empty());
  ASSERT_TRUE(live.pick(0, 2, {0.05, 0.04, 100.0}, {0.05, 0.04, 0.0}, hit));
  EXPECT_TRUE(world.rig.apply(world.rig.catalogue.prepare_remove("Sheet")).success);
  live.take_picks(false);
  world.rig.step(10);
  EXPECT_TRUE(picks().empty()) << "what it held is gone";
}

// It is picked where it lies, and follows; without that it lies still to the bit.
TEST(SoftGrasp, APointerWakesWhatSleeps) {
  const std::string links = "mass: 0.05, config: {kDP: 0.03, piterations: 4, kLST: 0.5, kDF: 0.8}";
  const std::string tissue =
      "collision mesh: " + write_sheet() +
      ", tissue: {kind: sheet, thickness: 0.001, young modulus: 200000, density: 1000, friction: 0.5}";
  for (const std::string& soft : {links, tissue}) {
    SCOPED_TRACE(soft);
    World world({}, {}, soft);
    world.rig.step(6000);
    const std::vector<math::Vec3> rest = world.nodes();
    world.rig.step(500);
    ASSERT_EQ(world.nodes(), rest) << "it sleeps";
    LiveWorld& live = *world.rig.live;
    state::PickHit hit;
    ASSERT_TRUE(live.pick(0, 1, {0.05, 0.04, 1.0}, {0.05, 0.04, 0.0}, hit));
    live.pick_table()[0].target.post({1, {0.05, 0.04, 0.55}}, 0);
    for (int i = 0; i < 20; ++i) {
      live.take_picks(false);
      world.rig.step();
    }
    EXPECT_GT(world.node(58).z, rest[58].z + 0.005) << "at 0.05, 0.05";
  }
}

TEST(SoftGrasp, EndsWithABodyTheActuatorAndResets) {
  for (const char* leaving : {"Sheet", "hand", "grip", "soft_grasp.yaml", "finger"}) {
    World world;
    const auto port = world.port();
    port->post(state::KindCommand{kBySensor});
    world.rig.step(100);
    ASSERT_EQ(world.held().size(), 3U);
    Catalogue& catalogue = world.rig.catalogue;
    const bool all = std::string(leaving) == "soft_grasp.yaml";
    ASSERT_TRUE(world.rig.apply(all ? catalogue.prepare_unload(leaving) : catalogue.prepare_remove(leaving)).success);
    world.rig.step(100);
    const std::size_t expected = std::string(leaving) == "finger" ? 3U : 0U;
    EXPECT_EQ(world.held().size(), expected) << leaving;
  }
  World world;
  const auto loaded = world.nodes();
  const auto port = world.port();
  port->post(state::KindCommand{kBySensor});
  world.rig.step(100);
  world.lift(0.1);
  world.rig.live->reset();
  world.rig.live->fill(*world.rig.frame);
  EXPECT_EQ(world.nodes(), loaded);
  EXPECT_TRUE(world.held().empty());
  world.rig.step(1);
  EXPECT_EQ(world.held().size(), 3U) << "its command outlives the reset, and takes what is there";
}

}  // namespace
}  // namespace ambf::model::test
