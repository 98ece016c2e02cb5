// A kind that the product does not know is read, loaded, stepped, commanded, hashed, saved, restored, reset, listed,
// documented and removed like any other.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "adf/check.h"
#include "base/log.h"
#include "beacon.h"
#include "inputs/physics_records.h"
#include "inputs/recording.h"
#include "model/dry_load.h"
#include "scene/keys.h"
#include "tests/adf/support.h"
#include "tests/model/rig.h"

namespace ambf::test {
namespace {

using model::test::kStep_s;
using model::test::Rig;

constexpr const char* kLighthouse = R"(adf version: 1.0
namespace: /test/
bodies: [BODY tower, BODY rock]
beacons: [BEACON lamp, BEACON buoy]
BODY tower: {name: tower, mass: 1.0, location: {position: {x: 0, y: 0, z: 1}}, collision shape: BOX,
             collision geometry: {x: 0.1, y: 0.1, z: 0.1}, inertia: {ix: 0.1, iy: 0.1, iz: 0.1}}
BODY rock: {name: rock, mass: 0.0, location: {position: {x: 3, y: 0, z: 0}}, collision shape: BOX,
            collision geometry: {x: 0.1, y: 0.1, z: 0.1}}
BEACON lamp: {name: lamp, parent: BODY tower, position: {x: 0, y: 0, z: 0.5}, blink rate: 10.0}
BEACON buoy: {name: buoy, position: {x: 5, y: 0, z: 0}}
)";

scene::Model lighthouse() { return *adf::parse_model(kLighthouse, "lighthouse.yaml").model; }

struct World {
  World() { loaded = rig.load(lighthouse()).success; }

  std::uint32_t slot(const std::string& name) const { return rig.slot(name, beacon_kind().kind); }
  const BeaconState& beacon(const std::string& name) const {
    return state::rows(*rig.frame, beacon_kind().column).at(slot(name));
  }
  std::unique_ptr<state::CommandPort> port(const std::string& name) {
    return rig.port(name, state::Source::ros, beacon_kind().kind);
  }
  static state::Command rate(double rate_hz) { return state::KindCommand{BeaconCommand{rate_hz}}; }

  Rig rig{{0, 0, -9.81}};
  bool loaded = false;
};

TEST(MadeUpKind, IsListedByItsName) {
  EXPECT_EQ(state::find_kind("beacon"), beacon_kind().kind);
  EXPECT_EQ(state::info_of(beacon_kind().kind).plural, "beacons");
  const World world;
  const state::Structure& structure = *world.rig.live->structure();
  EXPECT_EQ(state::table<BeaconInfo>(structure, beacon_kind().kind).size(), 2u);
  EXPECT_NE(state::find(structure, "BEACON lamp", beacon_kind().kind), state::kNone);
  EXPECT_EQ(state::find(structure, "BEACON lamp", state::ObjectKind::camera), state::kNone);
}

TEST(MadeUpKind, IsReadFromItsBlocks) {
  const adf::ModelResult read = adf::parse_model(kLighthouse, "lighthouse.yaml");
  EXPECT_TRUE(adf::no_worse_than_information(read.diagnostics));
  const World world;
  const auto& infos = state::table<BeaconInfo>(*world.rig.live->structure(), beacon_kind().kind);
  EXPECT_EQ(infos[world.slot("lamp")].rate_hz, 10.0);
  EXPECT_EQ(infos[world.slot("lamp")].parent_name, "BODY tower");
  EXPECT_EQ(infos[world.slot("lamp")].parent_object, world.rig.object("tower"));
  EXPECT_EQ(infos[world.slot("buoy")].rate_hz, 1.0) << "the default";
}

TEST(MadeUpKind, IsCheckedLikeAnyOther) {
  const std::string path = ::testing::TempDir() + "/wrong_lighthouse.yaml";
  std::ofstream(path) << "namespace: /test/\nbeacons: [BEACON lamp, BEACON buoy, BEACON bay]\n"
                         "BEACON lamp: {name: lamp, blink rate: often}\n"
                         "BEACON buoy: {name: buoy, blink rat: 2.0}\n"
                         "BEACON bay: {name: bay, parent: BODY rock}\n"
                         "cameras: [CAMERA eye]\n"
                         "CAMERA eye: {name: eye, parent: BEACON buoy, location: {x: 1, y: 0, z: 0}}\n";
  const base::Diagnostics found = adf::check_file(path, model::dry_load);
  EXPECT_TRUE(adf::says(found, "wrong_lighthouse.yaml:3:39: error: \\[BEACON lamp: blink rate\\] expected a number"));
  EXPECT_TRUE(adf::says(found, "wrong_lighthouse.yaml:4:27: warning: .*unknown key.*did you mean `blink rate`"));
  EXPECT_TRUE(adf::says(found, "wrong_lighthouse.yaml:5:\\d+: info: \\[BEACON bay: parent\\] .*\"BODY rock\""));
  EXPECT_FALSE(adf::says(found, "CAMERA eye: parent")) << "a beacon is a parent as good as any";
}

// Both files, made with this kind linked in; test_beacon.py reads them.
TEST(MadeUpKind, IsInTheGeneratedDocumentation) {
  const std::string docs = scene::keys_as_markdown();
  std::ofstream(::testing::TempDir() + "/adf.md") << docs;
  std::ofstream(::testing::TempDir() + "/adf.schema.json") << scene::keys_as_json_schema();
  for (const char* line : {"### beacon\n", "| `beacons` | a list of names |  |  | Beacon blocks to load. |",
                           "| `blink rate` | a number | Hz | 1 | Blinks a second. >= 0. At most 1000. |"})
    EXPECT_NE(docs.find(line), std::string::npos) << line;
}

TEST(MadeUpKind, LeavesWithItsModel) {
  World world;
  const auto loaded = world.rig.load(lighthouse());
  ASSERT_TRUE(loaded.success);
  EXPECT_EQ(world.slot("lamp1"), 2u) << "the same file again";
  ASSERT_TRUE(world.rig.apply(world.rig.catalogue.prepare_unload("lighthouse.yaml")).success);
  EXPECT_EQ(state::rows(*world.rig.frame, beacon_kind().column).size(), 2u);
  EXPECT_NEAR(world.beacon("lamp1").T_world_object.position.z, 1.5, 1e-12);
}

TEST(MadeUpKind, HangsOnItsParentAndMovesWithIt) {
  World world;
  world.rig.step(100);  // the tower falls
  const math::Vec3 tower = world.rig.body("tower").T_world_body.position;
  EXPECT_LT(tower.z, 0.99);
  EXPECT_NEAR(world.beacon("lamp").T_world_object.position.z, tower.z + 0.5, 1e-12);
  EXPECT_EQ(world.beacon("buoy").T_world_object.position, (math::Vec3{5, 0, 0}));
}

TEST(MadeUpKind, ActsInEveryStep) {
  World world;
  world.rig.step(100);
  EXPECT_NEAR(world.beacon("lamp").phase, 100 * kStep_s * 10.0, 1e-9);
  EXPECT_NEAR(world.beacon("buoy").phase, 100 * kStep_s * 1.0, 1e-9);
}

TEST(MadeUpKind, ObeysItsOwnCommandAndNoOther) {
  World world;
  const auto port = world.port("lamp");
  port->post(World::rate(50.0));
  world.rig.step(1);
  EXPECT_EQ(world.beacon("lamp").rate_hz, 50.0);
  EXPECT_TRUE(world.beacon("lamp").active);
  EXPECT_FALSE(world.beacon("buoy").active);
  port->post(model::test::force({1, 0, 0}));
  port->post(state::PoseCommand{true, {}});
  world.rig.step(1);
  ASSERT_EQ(world.rig.frame->commands.size(), 1u);
  EXPECT_EQ(world.rig.frame->commands[0].object, world.rig.object("lamp", beacon_kind().kind));
  EXPECT_EQ(world.rig.frame->commands[0].received, 1u);
  EXPECT_EQ(world.rig.frame->commands[0].refused, 2u);
  EXPECT_EQ(world.beacon("lamp").rate_hz, 50.0);
  world.rig.step(600);  // beyond its watchdog's 0.5 s
  EXPECT_FALSE(world.beacon("lamp").active);
}

TEST(MadeUpKind, ItsCommandIsPartOfARecordingOfInputs) {
  const std::string path = testing::TempDir() + "ambf_beacon_" + std::to_string(getpid());
  base::Log log;
  std::string problem;
  World world, other;
  {
    const auto recorder = inputs::Recorder::create(path, {}, log, problem);
    ASSERT_NE(recorder, nullptr) << problem;
    world.rig.live->record_to(&recorder->make_channel(inputs::kPhysicsStream));
    world.port("lamp")->post(World::rate(50.0));
    world.rig.step(1);
    world.rig.live->record_to(nullptr);
  }
  const auto recording = inputs::Recording::open(path, problem);
  ASSERT_NE(recording, nullptr) << problem;
  const inputs::RawRecord* raw = recording->next(inputs::kPhysicsStream);
  ASSERT_NE(raw, nullptr) << "it has a form in the file";
  const auto found = raw->as<inputs::KindCommandRecord>();
  ASSERT_TRUE(found);
  const model::CommandTable::Replayed posted{found->object, found->source, found->received_ns, found->posted_ns};
  EXPECT_TRUE(other.rig.commands.replay(posted, found->bytes));
  other.rig.step(1);
  EXPECT_EQ(state::state_hash(*other.rig.frame), state::state_hash(*world.rig.frame));
  EXPECT_EQ(other.beacon("lamp").rate_hz, 50.0);
  EXPECT_FALSE(other.rig.commands.replay(posted, std::vector<std::uint8_t>{1, 2})) << "no such command";
  std::filesystem::remove(path);
}

TEST(MadeUpKind, IsPartOfTheHash) {
  World world;
  world.rig.step(1);
  const std::uint64_t before = state::state_hash(*world.rig.frame);
  state::rows(*world.rig.frame, beacon_kind().column)[0].phase += 1.0;
  EXPECT_NE(state::state_hash(*world.rig.frame), before);
}

TEST(MadeUpKind, GoesOnFromASavedState) {
  World world, other;
  const auto port = world.port("lamp");
  port->post(World::rate(20.0));
  world.rig.step(50);
  const std::vector<std::uint8_t> saved = world.rig.live->save();
  world.rig.step(50);
  ASSERT_EQ(other.rig.live->restore(saved), "");
  other.rig.watchdog_s = 0.05;
  other.rig.step(50);
  EXPECT_EQ(other.beacon("lamp").rate_hz, 20.0);
  EXPECT_TRUE(other.beacon("lamp").active) << "its command was saved, too";
  EXPECT_EQ(other.beacon("lamp").phase, world.beacon("lamp").phase);
  EXPECT_EQ(state::state_hash(*other.rig.frame), state::state_hash(*world.rig.frame));
}

TEST(MadeUpKind, RefusesADamagedState) {
  World world, other;
  world.rig.step(1);
  std::vector<std::uint8_t> saved = world.rig.live->save();
  saved[saved.size() - 20] ^= 0x40;  // within the last beacon's values
  EXPECT_NE(other.rig.live->restore(saved), "");
}

TEST(MadeUpKind, ResetBringsItBack) {
  World world;
  world.port("lamp")->post(World::rate(50.0));
  world.rig.step(100);
  world.rig.live->reset();
  world.rig.live->fill(*world.rig.frame);
  EXPECT_EQ(world.beacon("lamp").phase, 0.0);
  EXPECT_EQ(world.beacon("lamp").rate_hz, 10.0);
  EXPECT_FALSE(world.beacon("lamp").active);
}

TEST(MadeUpKind, GetsAnotherParentAndStaysWhereItIs) {
  World world;
  const math::Vec3 before = world.beacon("lamp").T_world_object.position;
  const state::ObjectId lamp = world.rig.id("lamp", beacon_kind().kind);
  ASSERT_TRUE(world.rig.apply(world.rig.catalogue.prepare_set_parent(lamp, "BODY rock")).success);
  EXPECT_EQ(world.beacon("lamp").T_world_object.position, before);
  EXPECT_EQ(world.beacon("lamp").T_parent_object.position, (math::Vec3{-3, 0, 1.5}));
  const state::Structure& structure = *world.rig.live->structure();
  EXPECT_EQ(state::table<BeaconInfo>(structure, beacon_kind().kind)[world.slot("lamp")].parent_object,
            world.rig.object("rock"));
}

TEST(MadeUpKind, StaysWhereItIsWhenItsParentIsRemoved) {
  World world;
  const math::Vec3 before = world.beacon("lamp").T_world_object.position;
  ASSERT_TRUE(world.rig.apply(world.rig.catalogue.prepare_remove("BODY tower")).success);
  EXPECT_EQ(world.beacon("lamp").T_world_object.position, before);
}

TEST(MadeUpKind, IsRemovedByName) {
  World world;
  const auto port = world.port("buoy");
  world.rig.apply(world.rig.catalogue.prepare_remove("BEACON buoy"));
  EXPECT_EQ(state::rows(*world.rig.frame, beacon_kind().column).size(), 1u);
  ASSERT_EQ(world.rig.catalogue.description(1)->blocks.size(), 1u);
  EXPECT_EQ(world.rig.catalogue.description(1)->blocks[0].identity.name, "lamp");
  port->post(World::rate(2.0));  // nobody is there any more
  world.rig.step(1);
  EXPECT_EQ(world.beacon("lamp").rate_hz, 10.0);
}

TEST(MadeUpKind, ShowsItsLastGoodStateInADivergedWorld) {
  World world;
  world.rig.step(10);
  auto good = state::make_frame(world.rig.live->structure());
  world.rig.live->fill(*good);
  world.rig.step(10);
  state::keep_last_good(*good, *world.rig.frame);
  EXPECT_EQ(world.beacon("lamp").phase, state::rows(*good, beacon_kind().column)[world.slot("lamp")].phase);
}

TEST(Kinds, AreRegisteredOnceAndBeforeTheFirstWorld) {
  const World world;
  using Rows = state::PlacedRows<BeaconInfo, BeaconState>;
  EXPECT_THROW(state::register_kind({"late", "late one", "late ones"}, std::make_unique<Rows>()), std::logic_error);
  EXPECT_THROW(state::register_column<BeaconState>({"late"}), std::logic_error);
}

TEST(Kinds, NewFramesAreFilledWithNaNWhenAsked) {
  const World world;
  state::fill_nan(*world.rig.frame);
  EXPECT_TRUE(std::isnan(world.rig.frame->sim_time));
  EXPECT_TRUE(std::isnan(world.rig.frame->bodies[0].T_world_body.orientation.w));
  EXPECT_TRUE(std::isnan(world.beacon("lamp").phase));
}

}  // namespace
}  // namespace ambf::test
