// Proximity sensors in a live world: forms of rays, what each element senses, what moves, comes and goes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "math/rotation.h"
#include "model/saved_state.h"
#include "state/sensors.h"
#include "tests/adf/support.h"
#include "tests/model/rig.h"

namespace ambf::model {
namespace {

using test::Rig;

constexpr const char* kBodies = R"(adf version: 1.0
namespace: /test/
bodies: [BODY carrier, BODY left, BODY right]
BODY carrier: {name: carrier, mass: 0.0, location: {position: {x: 0, y: 0, z: 1}, orientation: {r: 0, p: 0, y: 1.5708}},
               inertial offset: {position: {x: 0, y: 0, z: 0.2}}, collision shape: BOX,
               collision geometry: {x: 0.1, y: 0.1, z: 0.1}}
BODY left: {name: left, mass: 1.0, location: {position: {x: -0.2, y: 0.5, z: 1}}, collision shape: SPHERE,
            collision geometry: {radius: 0.05}}
BODY right: {name: right, mass: 0.0, location: {position: {x: 0.2, y: 0.4, z: 1}}, collision shape: BOX,
             collision geometry: {x: 0.1, y: 0.1, z: 0.1}}
)";
// In the carrier's frame x is the world's y, and y is the world's -x: rays at y = 0.2, 0 and -0.2 along x.
constexpr const char* kThree = R"(sensors: [SENSOR three]
SENSOR three: {name: three, type: Proximity, parent: BODY carrier, range: 0.8, array: [
  {offset: {x: 0, y: 0.2, z: 0}, direction: {x: 1, y: 0, z: 0}},
  {offset: {x: 0, y: 0, z: 0}, direction: {x: 1, y: 0, z: 0}},
  {offset: {x: 0, y: -0.2, z: 0}, direction: {x: 0.5, y: 0, z: 0}}]}
)";

struct World {
  explicit World(const std::string& sensors = kThree, const std::string& bodies = kBodies) {
    const adf::ModelResult read = adf::parse_model(bodies + sensors, "sensors.yaml");
    EXPECT_FALSE(base::has_errors(read.diagnostics));
    prepared = rig.load(*read.model);
    EXPECT_TRUE(prepared.success);
  }
  static state::ObjectKind kind() { return state::sensor_kind().kind; }
  const state::SensorInfo& info(const std::string& name) const {
    return state::sensors(*rig.live->structure()).at(rig.slot(name, kind()));
  }
  const state::SensorState& state(const std::string& name) const {
    return state::rows(*rig.frame, state::sensor_kind().column).at(rig.slot(name, kind()));
  }
  state::ElementRange elements(const std::string& name) const {
    return state::elements_of(*rig.frame, rig.slot(name, kind()));
  }
  // "" for none.
  std::string seen(const std::string& name, std::size_t element) const {
    const state::SensedElement& sensed = elements(name)[element];
    if (!sensed.triggered()) return {};
    return rig.live->structure()->objects[rig.live->structure()->bodies[sensed.body].object].local_name;
  }
  void refill() { rig.live->fill(*rig.frame); }

  Rig rig;
  Prepared prepared;
};

TEST(Sensor, EachElementSensesForItself) {
  World world;
  ASSERT_EQ(world.info("three").elements, 3U);
  EXPECT_EQ(world.seen("three", 0), "left");
  EXPECT_EQ(world.seen("three", 1), "") << "the sensor's own body is not seen";
  EXPECT_EQ(world.seen("three", 2), "right");
  EXPECT_EQ(world.state("three").triggered, 2U);
  const auto elements = world.elements("three");
  EXPECT_NEAR(elements[0].distance_m, 0.45, 1e-5);
  EXPECT_NEAR(elements[0].fraction, 0.45 / 0.8, 1e-5);
  EXPECT_NEAR(elements[2].distance_m, 0.35, 1e-5);
  EXPECT_NEAR(elements[2].fraction, 0.35 / 0.4, 1e-5) << "the direction's length counts";
  EXPECT_NEAR(elements[2].normal_world.y, -1.0, 1e-5);
  EXPECT_NEAR(elements[0].point_world.y, 0.45, 1e-5);
  EXPECT_EQ(elements[1].fraction, 1.0);
}

TEST(Sensor, SeesWhatMovesAndWhatIsPutElsewhereBetweenSteps) {
  World world;
  const auto port = world.rig.port("left");
  port->post(test::twist({{0, 0.1, 0}, {}}));
  world.rig.step(100);
  EXPECT_NEAR(world.elements("three")[0].distance_m, 0.46, 1e-4);
  world.rig.port("right")->post(test::pose({{0.2, 0.3, 1}, {}}));
  world.rig.live->take_commands(world.rig.watchdog_s);
  world.rig.step(1);
  EXPECT_NEAR(world.elements("three")[2].distance_m, 0.25, 1e-4);
  world.rig.live->reset();
  world.refill();
  EXPECT_NEAR(world.elements("three")[0].distance_m, 0.45, 1e-5) << "a reset, without a step";
  EXPECT_NEAR(world.elements("three")[2].distance_m, 0.35, 1e-5);
}

TEST(Sensor, ForgetsABodyThatLeaves) {
  World world;
  ASSERT_TRUE(world.rig.apply(world.rig.catalogue.prepare_remove("BODY left")).success);
  EXPECT_EQ(world.seen("three", 0), "");
  EXPECT_EQ(world.seen("three", 2), "right");
  world.rig.step(1);
  EXPECT_EQ(world.seen("three", 0), "");
}

TEST(Sensor, StaysWhereItIsWithoutItsParentAndWaitsForOneThatIsAbsent) {
  World world;
  ASSERT_TRUE(world.rig.apply(world.rig.catalogue.prepare_remove("BODY carrier")).success);
  EXPECT_EQ(world.seen("three", 0), "left");
  EXPECT_NEAR(world.state("three").T_world_object.position.z, 1.0, 1e-9);

  World waits(
      "sensors: [SENSOR late]\nSENSOR late: {name: late, parent: BODY late, array: [{offset: {x: 0, y: 0, z: 0}, "
      "direction: {x: 1, y: 0, z: 0}}], range: 0.4}\n");
  EXPECT_EQ(waits.seen("late", 0), "");
  scene::Body late = test::box("late", 0.0, {-0.2, 0.4, 1.0});
  ASSERT_TRUE(waits.rig.load(test::model("late.yaml", {late})).success);
  EXPECT_EQ(waits.seen("late", 0), "right") << "on its parent now";
}

TEST(Sensor, LaysItsRaysInEveryForm) {
  const std::string mesh = ::testing::TempDir() + "/rays.obj";
  std::ofstream(mesh) << "v 0 0 0.1\nv 0.3 0 0.1\nv 0 0.3 0.1\nv 0 0 0\nv 0 0 0.3\nv 0 0.3 0\nf 1 2 3\nf 4 5 6\n";
  World world(
      "sensors: [SENSOR m, SENSOR p, SENSOR o]\n"
      "SENSOR m: {name: m, parent: BODY carrier, mesh: '" +
      mesh +
      "', range: 0.2}\n"
      "SENSOR p: {name: p, parent: BODY carrier, location: {position: {x: 0, y: 0, z: 0.5}, orientation: {r: 0, p: 0, "
      "y: 1.5708}}, parametric: {resolution: 3, horizontal angle: 1.0, vertical angle: 0.5, start offset: 0.1}, "
      "range: 0.4}\n"
      "SENSOR o: {name: o, parent: BODY carrier, location: {x: 0.1, y: 0.2, z: 0.3}, direction: {x: 0, y: 0, z: 2}, "
      "range: 0.16}\n");
  const auto& on_mesh = *world.info("m").rays;
  ASSERT_EQ(on_mesh.size(), 2U);
  EXPECT_NEAR(math::norm(on_mesh[0].start - math::Vec3{0.1, 0.1, 0.1}), 0.0, 1e-6);
  EXPECT_NEAR(math::norm(on_mesh[0].end - math::Vec3{0.1, 0.1, 0.3}), 0.0, 1e-6);
  EXPECT_NEAR(math::norm(on_mesh[1].end - on_mesh[1].start - math::Vec3{-0.2, 0, 0}), 0.0, 1e-6);

  const auto& fan = *world.info("p").rays;
  ASSERT_EQ(fan.size(), 9U);
  EXPECT_NEAR(math::norm(fan[4].start - math::Vec3{0.1, 0, 0}), 0.0, 1e-12) << "the middle ray is along x";
  EXPECT_NEAR(math::norm(fan[4].end - math::Vec3{0.5, 0, 0}), 0.0, 1e-12);
  const math::Vec3 corner = math::rotate(math::from_rpy(0, 0.25, -0.5), {1, 0, 0});
  EXPECT_NEAR(math::norm(fan[6].end - fan[6].start - corner * 0.4), 0.0, 1e-12);
  // The pose applies once (Q40).
  EXPECT_NEAR(world.state("p").T_parent_object.position.z, 0.5, 1e-12);
  const math::Vec3 middle = world.state("p").T_world_object * fan[4].end;
  EXPECT_NEAR(math::norm(middle - math::Vec3{-0.5, 0, 1.5}), 0.0, 1e-4);

  const auto& single = *world.info("o").rays;
  ASSERT_EQ(single.size(), 1U);
  EXPECT_EQ(single[0].start, (math::Vec3{0.1, 0.2, 0.3})) << "both in the parent's frame";
  EXPECT_NEAR(math::norm(single[0].end - math::Vec3{0.1, 0.2, 0.62}), 0.0, 1e-12);
  EXPECT_EQ(world.state("o").T_parent_object.position, math::Vec3{});
  EXPECT_NEAR(world.info("o").visible_size_m, 0.02, 1e-12) << "an eighth of the range";
}

TEST(Sensor, LaysRaysOnFacesEdgesAndVertices) {
  // A tetrahedron with a corner of right angles at the origin, outward.
  const std::string mesh = ::testing::TempDir() + "/corner.obj";
  std::ofstream(mesh) << "v 0 0 0\nv 0.3 0 0\nv 0 0.3 0\nv 0 0 0.3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  const auto sensor = [&](const std::string& name, const std::string& placement) {
    return "SENSOR " + name + ": {name: " + name + ", parent: BODY carrier, mesh: '" + mesh +
           "', range: 0.2, placement: " + placement + "}\n";
  };
  World world("sensors: [SENSOR f, SENSOR e, SENSOR v, SENSOR a]\n" + sensor("f", "[faces]") + sensor("e", "[edges]") +
              sensor("v", "[vertices]") + sensor("a", "[vertices, edges, faces]"));
  EXPECT_EQ(world.info("f").rays->size(), 4U);
  EXPECT_EQ(world.info("a").rays->size(), 4U + 6U + 4U);
  const auto has = [&](const char* name, const math::Vec3& at, const math::Vec3& along) {
    const auto& rays = *world.info(name).rays;
    return std::any_of(rays.begin(), rays.end(), [&](const state::SensorRay& ray) {
      return math::norm(ray.start - at) < 1e-6 &&
             math::norm(ray.end - ray.start - 0.2 * math::normalized(along)) < 1e-6;
    });
  };
  ASSERT_EQ(world.info("e").rays->size(), 6U) << "each edge once";
  EXPECT_TRUE(has("e", {0.15, 0, 0}, {0, -1, -1}));
  ASSERT_EQ(world.info("v").rays->size(), 4U);
  EXPECT_TRUE(has("v", {0, 0, 0}, {-1, -1, -1}));
  EXPECT_TRUE(has("a", {0.1, 0.1, 0.1}, {1, 1, 1}));
}

TEST(Sensor, CastsItsRaysInTurnsAndRepeatably) {
  const std::string turns =
      "sensors: [SENSOR t]\nSENSOR t: {name: t, parent: BODY carrier, rays per step: 2, range: 0.8, "
      "location: {position: {x: 0, y: 0.2, z: 0}}, "
      "parametric: {resolution: 3, horizontal angle: 0.001, vertical angle: 0.001}}\n";
  World world(turns), other(turns);
  EXPECT_EQ(world.state("t").triggered, 9U) << "all at first";
  world.rig.port("left")->post(test::twist({{1.0, 0, 0}, {}}));
  world.rig.step(1);
  EXPECT_NE(world.elements("t")[0].distance_m, world.elements("t")[8].distance_m);
  world.rig.step(150);  // 0.15 m: past all rays
  EXPECT_EQ(world.state("t").triggered, 0U);

  World fresh(turns);
  for (World* each : {&world, &other}) {
    each->rig.live->reset();
    each->rig.port("left")->post(test::twist({{1.0, 0, 0}, {}}));
    each->rig.step(41);
  }
  EXPECT_EQ(state::state_hash(*world.rig.frame), state::state_hash(*other.rig.frame));
  const auto saved = world.rig.live->save();
  world.rig.step(20);
  ASSERT_EQ(fresh.rig.live->restore(saved), "");
  fresh.rig.watchdog_s = 0.041;
  fresh.rig.step(20);
  EXPECT_EQ(state::state_hash(*fresh.rig.frame), state::state_hash(*world.rig.frame));
}

TEST(Sensor, ReportsWhatManyRaysCost) {
  World world(
      "sensors: [SENSOR a, SENSOR b]\n"
      "SENSOR a: {name: a, parent: BODY carrier, parametric: {resolution: 17, horizontal angle: 1, vertical angle: "
      "1}}\n"
      "SENSOR b: {name: b, parent: BODY carrier, parametric: {resolution: 4, horizontal angle: 1, vertical angle: "
      "1}}\n");
  EXPECT_TRUE(adf::says(world.prepared.diagnostics, "warning: \\[SENSOR b: range\\] 305 rays are cast in each step"));
  World spread(
      "sensors: [SENSOR a]\nSENSOR a: {name: a, parent: BODY carrier, rays per step: 50, "
      "parametric: {resolution: 20, horizontal angle: 1, vertical angle: 1}}\n");
  EXPECT_FALSE(adf::says(spread.prepared.diagnostics, "rays are cast in each step"));
}

// What began and ended at a sensor, as text: "+sensed -sensed".
std::string events(const World& world, const std::string& name) {
  const state::SensorEventLog& log = *state::sensor_events(*world.rig.frame);
  std::string text;
  for (std::uint64_t i = 0; i < log.total; ++i) {
    const state::SensorEvent& event = log.last.at(i % state::SensorEventLog::kSize);
    if (event.sensor != world.rig.id(name, World::kind())) continue;
    constexpr const char* kNames[] = {"sensed", "matched", "success"};
    text += std::string(text.empty() ? "" : " ") + (event.begins ? "+" : "-") +
            kNames[static_cast<std::size_t>(event.what)];
  }
  return text;
}

constexpr const char* kTasks = R"(sensors: [SENSOR door, SENSOR gone]
SENSOR door: {name: door, parent: BODY carrier, range: 0.8, success when: present, hold: 0.005,
              array: [{offset: {x: 0, y: 0.2, z: 0}, direction: {x: 1, y: 0, z: 0}}]}
SENSOR gone: {name: gone, parent: BODY carrier, range: 0.8, success when: absent, matching key: lid,
              array: [{offset: {x: 0, y: 0.2, z: 0}, direction: {x: 1, y: 0, z: 0}}]}
)";

TEST(Sensor, JudgesWhetherSomethingIsThereOrGone) {
  World world(kTasks);
  EXPECT_FALSE(world.state("door").success) << "not held yet";
  EXPECT_FALSE(world.state("gone").success);
  world.rig.step(4);
  EXPECT_FALSE(world.state("door").success);
  world.rig.step(1);
  EXPECT_TRUE(world.state("door").success);
  EXPECT_NEAR(world.state("door").success_since_s, 0.005, 1e-12);
  world.rig.step(10);
  EXPECT_NEAR(world.state("door").success_since_s, 0.005, 1e-12);
  ASSERT_TRUE(world.rig.apply(world.rig.catalogue.prepare_remove("BODY left")).success);
  EXPECT_FALSE(world.state("door").success) << "without a step";
  EXPECT_TRUE(world.state("gone").success);
  EXPECT_EQ(events(world, "door"), "+sensed +success -sensed -success");
  EXPECT_EQ(events(world, "gone"), "+sensed -sensed +success");
}

TEST(Sensor, ForgetsItsSuccessInAResetAndGoesOnWithItFromASnapshot) {
  World world(kTasks), other(kTasks);
  world.rig.step(3);
  const auto saved = world.rig.live->save();
  ASSERT_EQ(other.rig.live->restore(saved), "");
  other.rig.watchdog_s = 0.003;
  for (World* each : {&world, &other}) {
    each->rig.step(2);
    EXPECT_TRUE(each->state("door").success) << "held for three steps before";
  }
  EXPECT_EQ(state::state_hash(*other.rig.frame), state::state_hash(*world.rig.frame));
  world.rig.live->reset();
  world.refill();
  EXPECT_FALSE(world.state("door").success);
  EXPECT_EQ(events(world, "door"), "+sensed +success -sensed -success");
}

TEST(Sensor, LosesNoEventOfManyStepsBetweenTwoFrames) {
  World world(kTasks);
  const auto port = world.rig.port("left");
  const std::uint64_t before = state::sensor_events(*world.rig.frame)->total;
  for (int i = 0; i < 400; ++i) {
    port->post(test::twist({{i % 2 == 0 ? 200.0 : -200.0, 0, 0}, {}}));  // 0.2 m a step
    world.rig.live->take_commands(world.rig.watchdog_s);
    world.rig.live->step(test::kStep_s);
  }
  world.refill();
  EXPECT_EQ(state::sensor_events(*world.rig.frame)->total - before, 3U * 400U)
      << "of `door` one a step, of `gone` one and its success";
}

TEST(Sensor, OfTypeRangeMeasuresMetresWithNoiseThatRepeats) {
  const auto make = [](const std::string& noise) {
    return "sensors: [SENSOR r]\nSENSOR r: {name: r, type: Range, parent: BODY carrier, range: 0.8, location: "
           "{position: "
           "{x: 0, y: -0.2, z: 0}}, parametric: {resolution: 20, horizontal angle: 0.01, vertical angle: 0.01}" +
           noise + "}\n";
  };
  World exact(make("")), noisy(make(", range noise: {mean: 0.01, std dev: 0.002}")),
      again(make(", range noise: {mean: 0.01, std dev: 0.002}")),
      other(make(", range noise: {mean: 0.01, std dev: 0.002}, noise seed: 1"));
  for (World* world : {&exact, &noisy, &again, &other}) world->rig.step(3);
  double sum = 0.0, squares = 0.0;
  std::size_t differ = 0;
  for (std::size_t i = 0; i < 400; ++i) {
    const double truth = exact.elements("r")[i].distance_m;
    EXPECT_NEAR(truth, 0.35, 1e-4);
    const double error = noisy.elements("r")[i].distance_m - truth;
    sum += error;
    squares += (error - 0.01) * (error - 0.01);
    EXPECT_EQ(noisy.elements("r")[i].distance_m, again.elements("r")[i].distance_m);
    differ += noisy.elements("r")[i].distance_m != other.elements("r")[i].distance_m ? 1 : 0;
  }
  EXPECT_NEAR(sum / 400, 0.01, 5e-4);
  EXPECT_NEAR(std::sqrt(squares / 400), 0.002, 4e-4);
  EXPECT_EQ(differ, 400U);
  const double before = noisy.elements("r")[7].distance_m;
  noisy.rig.step(1);
  EXPECT_NE(noisy.elements("r")[7].distance_m, before) << "another step, other noise";
}

TEST(Sensor, ObeysNoPose) {
  World world;
  const auto port = world.rig.port("three", state::Source::ros, World::kind());
  port->post(state::KindCommand{state::SensorCommand{}});
  world.rig.step(1);
  EXPECT_TRUE(world.state("three").active) << "its topic's rate goes up, as for every object";
  port->post(state::PoseCommand{true, {{5, 5, 5}, {}}});
  world.rig.step(1);
  ASSERT_EQ(world.rig.frame->commands.size(), 1U);
  EXPECT_EQ(world.rig.frame->commands[0].refused, 1U);
  EXPECT_EQ(world.seen("three", 0), "left");
}

}  // namespace
}  // namespace ambf::model
