// What world files and the blocks of cameras, lights and names in model files do to the running simulation.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "adf/adf.h"
#include "math/rotation.h"
#include "simulation_rig.h"

namespace ambf::runtime {
namespace {

using test::Rig;

struct WorldRig {
  explicit WorldRig(const std::string& text, const SimulationOptions& options = test::free_running())
      : folder(std::filesystem::temp_directory_path() /
               ("ambf_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()))) {
    std::filesystem::create_directories(folder);
    write("environment.yaml",
          "namespace: /e/\nbodies: [BODY Table]\nBODY Table: {name: Table, mass: 0, shape: BOX, "
          "geometry: {x: 1, y: 1, z: 1}}\n");
    write("broken.yaml", "bodies: [BODY Table\n");
    adf::WorldResult world = adf::parse_world(text, (folder / "world.yaml").string());
    EXPECT_TRUE(world.world);
    for (const auto& found : world.diagnostics)
      EXPECT_NE(found.severity, base::Severity::error) << base::to_string(found);
    simulation = std::make_unique<Simulation>(options, *world.world, scene::ColorTable(), log);
  }
  ~WorldRig() {
    reader.reset();  // readers must not outlive what they read
    simulation.reset();
    std::filesystem::remove_all(folder);
  }
  void write(const char* name, const std::string& text) const { std::ofstream(folder / name) << text; }

  bool has(const std::string& name) {
    return state::find(*simulation->structure(), name, state::ObjectKind::rigid_body) != state::kNone;
  }
  state::Outcome load(const std::string& text, const std::string& path = "scene.yaml") {
    state::LoadRequest request;
    request.text = text;
    request.path = path;
    return simulation->load_and_wait(request);
  }
  state::Frame frame() {
    if (!reader) {
      reader = simulation->make_reader();
      simulation->begin();
    }
    while (reader->latest()->sim_step < 5) reader->wait_newer(reader->latest()->sequence, std::chrono::seconds(1));
    return *reader->latest();
  }

  template <class Condition>
  state::Frame frame_when(Condition met) {
    const auto end = std::chrono::steady_clock::now() + test::kPatience;
    while (!met(*reader->latest()) && std::chrono::steady_clock::now() < end)
      reader->wait_newer(reader->latest()->sequence, std::chrono::seconds(1));
    return *reader->latest();
  }

  std::filesystem::path folder;
  JudgedLog log;
  std::unique_ptr<Simulation> simulation;
  std::unique_ptr<state::FrameReader> reader;
};

TEST(WorldFile, EnvironmentTakesThePlaceOfTheWalledGround) {
  WorldRig plain("namespace: /w/\n");
  EXPECT_TRUE(plain.has("Floor"));
  WorldRig with("namespace: /w/\nenvironment: environment.yaml\n");
  EXPECT_FALSE(with.has("Floor"));
  EXPECT_TRUE(with.has("/e/BODY Table"));
  EXPECT_EQ(with.simulation->structure()->world_name, "/w/World");
}

TEST(WorldFile, AnEnvironmentThatIsRefusedLeavesTheWalledGround) {
  WorldRig rig("namespace: /w/\nenvironment: broken.yaml\n");
  rig.log.expect_warning("YAML syntax error");
  rig.log.expect_warning("the environment is refused: the walled ground takes its place");
  EXPECT_TRUE(rig.has("Floor"));
}

TEST(WorldFile, EnclosureIsReadInBothSpellings) {
  for (const char* key : {"enclosure", "enclosure size"}) {
    WorldRig rig(std::string(key) + ": {length: 10, width: 6, height: 2}\n");
    const state::Frame frame = rig.frame();
    const std::uint32_t front = state::find(*frame.structure, "BODY WallFront", state::ObjectKind::rigid_body);
    const std::uint32_t left = state::find(*frame.structure, "BODY WallLeft", state::ObjectKind::rigid_body);
    ASSERT_NE(front, state::kNone) << key;
    EXPECT_NEAR(frame.bodies[frame.structure->objects[front].slot].T_world_body.position.x, 5.05, 1e-9) << key;
    EXPECT_NEAR(frame.bodies[frame.structure->objects[left].slot].T_world_body.position.y, 3.05, 1e-9) << key;
  }
}

TEST(WorldFile, MaxIterationsTightensTheCapOnStepsATurn) {
  SimulationOptions real_time;
  WorldRig plain("namespace: /w/\n", real_time), tight("max iterations: 7\n", real_time);
  EXPECT_EQ(plain.frame().run.max_steps_per_turn, 22u);
  EXPECT_EQ(tight.frame().run.max_steps_per_turn, 7u);
}

TEST(WorldFile, GravityPullsWhatHasNoneOfItsOwn) {
  WorldRig rig("gravity: {x: 3, y: 0, z: 0}\n");
  ASSERT_TRUE(
      rig.load("bodies: [B]\nB: {name: b, mass: 1, location: {position: {x: 0, y: 0, z: 1}, orientation: {r: 0, p: "
               "0, y: 0}}}\n")
          .success);
  const state::Frame frame = rig.frame();
  const std::uint32_t b = state::find(*frame.structure, "B", state::ObjectKind::rigid_body);
  const state::BodyState& body = frame.bodies[frame.structure->objects[b].slot];
  EXPECT_GT(body.twist_world.linear.x, 0.01);
  EXPECT_EQ(body.twist_world.linear.z, 0.0);
}

TEST(WorldFile, CamerasAndLightsArePublishedWhereTheyAre) {
  WorldRig rig(
      "namespace: /w/\ncameras: [C]\nlights: [L]\nC: {name: eye, namespace: cameras/, location: {x: 2, y: 0, z: 1}, "
      "look at: {x: "
      "0, y: 0, z: 1}, clipping plane: {near: 0.2, far: 30}, field view angle: 1.1, monitor: 2, controlling devices: "
      "[Falcon], mouse control multipliers: {pan: 2, rotate: 3, scroll: 4, arcball: 5}, publish frequency: {low: 7, "
      "high: 70}}\n"
      "L: {name: sun, namespace: /far/, location: {x: 0, y: 0, z: 9}, direction: {x: 0, y: 0, z: -2}, cutoff angle: "
      "0.4, spot exponent: 0.2, "
      "shadow quality: 3, attenuation: {constant: 1, linear: 2, quadratic: 3}}\n");
  const state::Frame frame = rig.frame();
  const state::Structure& s = *frame.structure;
  ASSERT_EQ(s.cameras.size(), 1u);
  ASSERT_EQ(s.lights.size(), 1u);
  const state::ObjectInfo& eye = s.objects[s.cameras[0].object];
  EXPECT_EQ(eye.name, "/w/cameras/eye");
  EXPECT_EQ(eye.rate_low_hz, 7.0);
  EXPECT_EQ(eye.rate_high_hz, 70.0);
  EXPECT_EQ(s.objects[s.lights[0].object].name, "/far/sun");
  EXPECT_EQ(s.cameras[0].lens.near_m, 0.2);
  EXPECT_EQ(s.cameras[0].lens.far_m, 30.0);
  EXPECT_EQ(s.cameras[0].lens.field_of_view_rad, 1.1);
  EXPECT_EQ(s.cameras[0].monitor, 2u);
  EXPECT_EQ(s.cameras[0].controlling_devices, std::vector<std::string>{"Falcon"});
  EXPECT_EQ(s.cameras[0].arcball, 5.0);
  EXPECT_EQ(s.lights[0].beam.cutoff_angle_rad, 0.4);
  EXPECT_EQ(s.lights[0].beam.shadow_quality, 3);
  EXPECT_EQ(s.lights[0].beam.attenuation_quadratic, 3.0);
  EXPECT_NEAR(frame.cameras[0].T_world_camera.position.x, 2.0, 1e-12);
  const math::Vec3 backwards = math::rotate(frame.cameras[0].T_world_camera.orientation, {1, 0, 0});
  EXPECT_NEAR(backwards.x, 1.0, 1e-9);
  const math::Vec3 shines = math::rotate(frame.lights[0].T_world_light.orientation, {1, 0, 0});
  EXPECT_NEAR(shines.z, -1.0, 1e-9);
}

TEST(WorldFile, LensesAndBeamsChangeWhileItRunsUntilTheWorldIsReset) {
  WorldRig rig(
      "namespace: /w/\ncameras: [C]\nlights: [L]\nC: {name: eye, location: {x: 2, y: 0, z: 0}}\nL: {name: sun}\n");
  const state::Frame before = rig.frame();
  const state::Structure& s = *before.structure;
  const state::ObjectId eye = s.objects[s.cameras[0].object].id, sun = s.objects[s.lights[0].object].id;
  state::Lens lens = before.cameras[0].lens;
  lens.field_of_view_rad = 1.25;
  lens.stereo = true;
  state::Beam beam = before.lights[0].beam;
  beam.type = state::LightType::directional;
  rig.simulation->set_lens(eye, lens);
  rig.simulation->set_beam(sun, beam);
  lens.near_m = 2.0 * lens.far_m;
  rig.simulation->set_lens(eye, lens);  // refused
  rig.simulation->set_lens(sun, lens);  // no camera
  const state::Frame after = rig.frame_when([](const state::Frame& f) { return f.cameras[0].lens.stereo; });
  EXPECT_EQ(after.cameras[0].lens.field_of_view_rad, 1.25);
  EXPECT_TRUE(after.cameras[0].lens.stereo);
  EXPECT_EQ(after.cameras[0].lens.near_m, before.cameras[0].lens.near_m);
  EXPECT_EQ(after.lights[0].beam.type, state::LightType::directional);
  rig.simulation->reset_world();
  const state::Frame reset = rig.frame_when([&](const state::Frame& f) { return f.epoch > before.epoch; });
  EXPECT_EQ(reset.cameras[0].lens.field_of_view_rad, before.cameras[0].lens.field_of_view_rad);
  EXPECT_EQ(reset.lights[0].beam.type, state::LightType::spot);
}

TEST(ModelFile, LoadedTwiceIsThereTwiceUnderNumberedNames) {
  WorldRig rig("namespace: /w/\n");
  const std::string model = "namespace: /m/\nbodies: [BODY Box 1]\nBODY Box 1: {name: Box 1, mass: 1}\n";
  ASSERT_TRUE(rig.load(model).success);
  ASSERT_TRUE(rig.load(model).success);
  EXPECT_TRUE(rig.has("/m/Box1"));
  EXPECT_TRUE(rig.has("/m/Box11"));
}

TEST(ModelFile, PrefixOfTheCommandLineStandsBeforeEveryNamespace) {
  SimulationOptions options = test::free_running();
  options.name_prefix = "/left";
  WorldRig rig("namespace: /w/\n", options);
  ASSERT_TRUE(
      rig.load("namespace: /m/\nbodies: [A, B]\nA: {name: a, mass: 1}\nB: {name: b, mass: 1, namespace: /far/}\n")
          .success);
  EXPECT_TRUE(rig.has("/left/m/a"));
  EXPECT_TRUE(rig.has("/left/far/b"));
}

TEST(ModelFile, CameraFindsItsParentInAFileThatIsLoadedLater) {
  WorldRig rig(
      "namespace: /w/\ncameras: [C]\nC: {name: eye, parent: BODY Hand, location: {x: 1, y: 0, z: 0}, look at: {x: 0, "
      "y: 0, z: 0}}\n");
  ASSERT_TRUE(
      rig.load("namespace: /m/\nbodies: [BODY Hand]\nBODY Hand: {name: hand, mass: 0, location: {position: {x: 0, y: "
               "0, z: 5}, orientation: {r: 0, p: 0, y: 0}}}\n")
          .success);
  EXPECT_NEAR(rig.frame().cameras.at(0).T_world_camera.position.z, 5.0, 1e-9);
}

TEST(ModelFile, ACameraRidesOnItsMovingParent) {
  WorldRig rig(
      "namespace: /w/\ncameras: [C]\nC: {name: eye, parent: BODY Hand, location: {x: 1, y: 0, z: 0}, look at: {x: 0, "
      "y: 0, z: 0}}\n");
  ASSERT_TRUE(
      rig.load("namespace: /m/\nbodies: [BODY Hand]\nBODY Hand: {name: hand, mass: 1, inertia: {ix: 0.1, iy: 0.1, iz: "
               "0.1}, location: {position: {x: 0, y: 0, z: 5}, orientation: {r: 0, p: 0, y: 0}}}\n")
          .success);
  state::RigidBodyCommand command;
  command.type = state::CartesianCommandType::force;
  command.wrench_world.torque = {0, 0, 1};
  rig.frame();
  const auto port = rig.simulation->bind(rig.simulation->structure()->objects.back().id, state::Source::panel);
  ASSERT_NE(port, nullptr);
  port->post(command);
  const state::Frame frame = rig.frame_when([](const state::Frame& f) {
    return f.bodies.back().T_world_body.position.z < 4.0 && std::abs(f.bodies.back().T_world_body.orientation.z) > 0.3;
  });
  const math::Pose T_world_hand = frame.bodies.back().T_world_body;
  EXPECT_LT(T_world_hand.position.z, 4.0) << "it falls";
  EXPECT_GT(std::abs(T_world_hand.orientation.z), 0.3) << "and turns";
  const math::Pose T_world_eye = frame.cameras.at(0).T_world_camera;
  EXPECT_LT(math::norm(T_world_eye.position - T_world_hand * math::Vec3{1, 0, 0}), 1e-9);
  // It looks at the hand's origin all the time: its x axis points away from that.
  const math::Vec3 back = math::rotate(T_world_eye.orientation, {1, 0, 0});
  EXPECT_LT(math::norm(back - math::rotate(T_world_hand.orientation, {1, 0, 0})), 1e-9);
}

TEST(ModelFile, WhatStateMessagesCarryIsChosenByTheBody) {
  WorldRig rig("namespace: /w/\n");
  ASSERT_TRUE(rig.load("bodies: [A, B]\nA: {name: a, mass: 1, passive: true, publish frequency: {low: 5, high: "
                       "200}}\nB: {name: b, mass: 1, "
                       "publish children names: true, publish joint names: false, publish joint positions: false}\n")
                  .success);
  const auto structure = rig.simulation->structure();
  const auto info = [&](const char* name) -> const state::ObjectInfo& {
    return structure->objects[state::find(*structure, name, state::ObjectKind::rigid_body)];
  };
  EXPECT_TRUE(info("A").passive);
  EXPECT_EQ(info("A").rate_low_hz, 5.0);
  EXPECT_EQ(info("A").rate_high_hz, 200.0);
  EXPECT_FALSE(info("B").passive);
  EXPECT_EQ(info("B").rate_low_hz, 50.0);
  EXPECT_FALSE(structure->bodies[info("A").slot].publish_children_names);
  EXPECT_TRUE(structure->bodies[info("B").slot].publish_children_names);
  EXPECT_FALSE(structure->bodies[info("B").slot].publish_joint_names);
  EXPECT_FALSE(structure->bodies[info("B").slot].publish_joint_positions);
}

}  // namespace
}  // namespace ambf::runtime
