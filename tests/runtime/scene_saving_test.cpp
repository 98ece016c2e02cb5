// A whole scene saved as a folder starts again: the same names, places, joint values and parameters.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include "adf/adf.h"
#include "math/rotation.h"
#include "runtime/local_simulation.h"
#include "simulation_rig.h"
#include "state/frame.h"

namespace ambf::runtime {
namespace {

namespace fs = std::filesystem;
using state::ObjectKind;
using state::Parameter;

constexpr double kSame = 1e-9;  // m, rad

const char* const kWorld = R"(# A world of mine
namespace: /ambf/env/
gravity: {x: 0, y: 0, z: -9.8}  # down
environment: ./room.yaml
cameras: [eye]
lights: [lamp]
eye: {name: eye, location: {x: 3, y: 0, z: 1}, look at: {x: 0, y: 0, z: 0}, up: {x: 0, y: 0, z: 1}}
lamp: {name: lamp, location: {x: 0, y: 0, z: 3}, direction: {x: 0, y: 0, z: -1}}
)";

const char* const kRoom = R"(namespace: /ambf/env/
bodies: [BODY floor]
BODY floor: {name: floor, mass: 0, shape: BOX, geometry: {x: 4, y: 4, z: 0.1}}
)";

const char* const kArm = R"(# An arm of mine
namespace: /ambf/env/
bodies: [BODY base, BODY link, BODY tip]
joints: [JOINT swing, JOINT slide]
cameras: [CAMERA hand]
BODY base: {name: base, mass: 0, location: {position: {x: 0, y: 0, z: 1}, orientation: {r: 0, p: 0, y: 0.3}}}
BODY link:
  name: link
  mass: 1  # kg
  inertia: {ix: 0.01, iy: 0.01, iz: 0.01}
  location: {position: {x: 0.3, y: 0, z: 1}, orientation: {r: 0, p: 0, y: 0}}
BODY tip: {name: tip, mass: 0.5, inertia: {ix: 0.01, iy: 0.01, iz: 0.01}, location: {position: {x: 0.6, y: 0, z: 1}}}
JOINT swing: {name: swing, type: revolute, parent: BODY base, child: BODY link, parent axis: {x: 0, y: 1, z: 0},
  child axis: {x: 0, y: 1, z: 0}, parent pivot: {x: 0, y: 0, z: 0}, child pivot: {x: -0.3, y: 0, z: 0}}
JOINT slide: {name: slide, type: prismatic, parent: BODY link, child: BODY tip, parent axis: {x: 1, y: 0, z: 0},
  child axis: {x: 1, y: 0, z: 0}, parent pivot: {x: 0.3, y: 0, z: 0}, child pivot: {x: 0, y: 0, z: 0},
  joint limits: {low: -0.2, high: 0.2}}
CAMERA hand: {name: hand, parent: BODY tip, location: {x: 0, y: 0, z: 0.1}, look at: {x: 1, y: 0, z: 0}}
)";

// Files, a scene that is started from a launch file as the program does it, and what a test does to it.
class SceneSaving : public testing::Test {
 protected:
  void SetUp() override {
    home_ = fs::path(testing::TempDir()) / ("ambf_scene_saving_" + std::to_string(getpid()));
    write("world.yaml", kWorld);
    write("room.yaml", kRoom);
    write("arm.yaml", kArm);
    write("launch.yaml", "world config: ./world.yaml\nmultibody configs: [arm.yaml]\n");
  }
  void TearDown() override { fs::remove_all(home_); }

  void write(const std::string& file, const std::string& text) {
    fs::create_directories((home_ / file).parent_path());
    std::ofstream(home_ / file) << text;
  }
  std::string read(const std::string& file) const {
    std::ifstream stream(home_ / file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  std::set<std::string> files_in(const std::string& folder) const {
    std::set<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(home_ / folder))
      if (entry.is_regular_file()) files.insert(entry.path().lexically_relative(home_ / folder).string());
    return files;
  }

  // As ambf_simulator --launch_file FILE -l 0,1,..
  std::unique_ptr<LocalSimulation> start(const std::string& file) {
    const adf::LaunchResult launch = adf::load_launch((home_ / file).string());
    EXPECT_TRUE(launch.launch.has_value());
    adf::WorldResult world = adf::load_world(launch.launch->world_file);
    EXPECT_TRUE(world.world.has_value());
    EXPECT_FALSE(base::has_errors(world.diagnostics));
    SimulationOptions options = test::free_running();
    options.files.world_text = world.text;
    auto simulation = std::make_unique<LocalSimulation>(options, *world.world, scene::ColorTable{}, log_);
    for (std::size_t i = 0; i < launch.launch->model_files.size(); ++i) {
      state::LoadRequest request;
      request.path = launch.launch->model_files[i];
      if (!launch.placements.empty()) {
        request.name_prefix = launch.placements[i].name_prefix;
        request.T_world_model = launch.placements[i].T_world_model;
      }
      const state::Outcome loaded = simulation->load(request);
      EXPECT_TRUE(loaded.success && !base::has_errors(loaded.diagnostics)) << loaded.message;
    }
    return simulation;
  }
  state::Outcome load(LocalSimulation& simulation, const std::string& file, const std::string& prefix = {},
                      const math::Pose& pose = {}) {
    state::LoadRequest request;
    request.path = (home_ / file).string();
    request.name_prefix = prefix;
    request.T_world_model = pose;
    return simulation.load(request);
  }
  state::Outcome save(LocalSimulation& simulation, const std::string& folder, bool now, bool overwrite = false) {
    return simulation.save({"", (home_ / folder).string() + (folder.ends_with('/') ? "/" : ""), now, overwrite});
  }

  static std::vector<std::string> names_of(const LocalSimulation& simulation) {
    std::vector<std::string> names;
    for (const state::ObjectInfo& object : simulation.structure()->objects)
      names.push_back(object.name + " = " + object.identifier);
    std::sort(names.begin(), names.end());
    return names;
  }
  static std::set<std::string> models_of(const LocalSimulation& simulation) {
    std::set<std::string> names;
    for (const state::ModelInfo& model : simulation.structure()->models) names.insert(model.name);
    return names;
  }

  static void expect_same(const LocalSimulation& a, const LocalSimulation& b) {
    EXPECT_EQ(names_of(a), names_of(b));
    EXPECT_EQ(models_of(a), models_of(b));
    EXPECT_EQ(a.structure()->world_name, b.structure()->world_name);
    const state::Frame &was = a.frame(), &is = b.frame();
    const auto near = [](const math::Pose& p, const math::Pose& q, const std::string& name) {
      EXPECT_LT(math::norm(p.position - q.position), kSame) << name;
      EXPECT_LT(math::norm(math::log(math::inverse(p.orientation) * q.orientation)), kSame) << name;
    };
    for (const state::ObjectInfo& object : a.structure()->objects) {
      const std::uint32_t other = state::find(*b.structure(), object.identifier, object.kind);
      ASSERT_NE(other, state::kNone) << object.identifier;
      const std::uint32_t i = object.slot, k = b.structure()->objects[other].slot;
      if (object.kind == ObjectKind::rigid_body) {
        near(was.bodies[i].T_world_body, is.bodies[k].T_world_body, object.name);
        EXPECT_TRUE(was.body_parameters[i] == is.body_parameters[k]) << object.name;
      } else if (object.kind == ObjectKind::joint) {
        EXPECT_NEAR(was.joints[i].position, is.joints[k].position, kSame) << object.name;
        EXPECT_TRUE(was.joint_parameters[i] == is.joint_parameters[k]) << object.name;
      } else if (object.kind == ObjectKind::camera) {
        near(was.cameras[i].T_world_camera, is.cameras[k].T_world_camera, object.name);
      } else if (object.kind == ObjectKind::light) {
        // A beam may have turned about itself: no key says so, and nothing shows it.
        const math::Pose &p = was.lights[i].T_world_light, &q = is.lights[k].T_world_light;
        const math::Vec3 along{1, 0, 0};
        EXPECT_LT(math::norm(p.position - q.position), kSame) << object.name;
        EXPECT_LT(math::norm(math::rotate(p.orientation, along) - math::rotate(q.orientation, along)), kSame);
      }
    }
  }
  static state::ObjectId id(const LocalSimulation& simulation, const std::string& name, ObjectKind kind) {
    const std::uint32_t object = state::find(*simulation.structure(), name, kind);
    EXPECT_NE(object, state::kNone) << name;
    return simulation.structure()->objects.at(object).id;
  }

  fs::path home_;
  JudgedLog log_;
};

const math::Pose kAside{{0.5, 1.5, 0.25}, math::from_rpy(0.1, -0.2, 0.7)};

TEST_F(SceneSaving, AsBuiltAllFilesAreTheSameAndTheSceneStartsUnderTheSameNames) {
  const auto was = start("launch.yaml");
  ASSERT_TRUE(load(*was, "arm.yaml", "/left", kAside).success);
  const state::Outcome saved = save(*was, "scene", false);
  ASSERT_TRUE(saved.success) << saved.message;
  EXPECT_EQ(saved.model, (home_ / "scene/launch.yaml").string());
  EXPECT_NE(saved.message.find("ambf_simulator --launch_file " + saved.model + " -l 0,1"), std::string::npos)
      << saved.message;
  EXPECT_EQ(files_in("scene"), (std::set<std::string>{"launch.yaml", "world.yaml", "models/room.yaml",
                                                      "models/arm.yaml", "models/2/arm.yaml"}));
  for (const char* file : {"models/arm.yaml", "models/2/arm.yaml"})
    EXPECT_EQ(read("scene/" + std::string(file)), kArm) << file;
  EXPECT_EQ(read("scene/models/room.yaml"), kRoom);
  EXPECT_NE(read("scene/world.yaml").find("down\nenvironment: ./models/room.yaml\n"), std::string::npos);
  expect_same(*was, *start("scene/launch.yaml"));
}

TEST_F(SceneSaving, ModelsWhoseNamesOthersHadBeforeComeBackUnderTheirNames) {
  const auto was = start("launch.yaml");
  ASSERT_TRUE(load(*was, "arm.yaml").success);
  ASSERT_TRUE(load(*was, "arm.yaml").success);
  ASSERT_TRUE(was->unload("arm.yaml1").success);
  ASSERT_TRUE(was->remove("/ambf/env/hand2").success);
  const std::vector<std::string> names = names_of(*was);
  ASSERT_TRUE(std::find(names.begin(), names.end(), "/ambf/env/tip2 = /ambf/env/BODY tip2") != names.end());
  ASSERT_TRUE(save(*was, "scene", false).success);
  const auto is = start("scene/launch.yaml");
  expect_same(*was, *is);
  // Once more, from what was saved: the numbers are neither lost nor doubled.
  ASSERT_TRUE(was->unload("arm.yaml").success);
  ASSERT_TRUE(is->unload("arm.yaml").success);
  ASSERT_TRUE(save(*is, "again", false).success);
  expect_same(*was, *start("again/launch.yaml"));
}

TEST_F(SceneSaving, AtTheCurrentPoseEverythingIsWhereItWas) {
  const auto was = start("launch.yaml");
  ASSERT_TRUE(load(*was, "arm.yaml", "/left", kAside).success);
  // A joints-only file that ties both arms.
  write(
      "tie.yaml",
      "namespace: /ambf/env/\njoints: [JOINT tie]\nJOINT tie: {name: tie, type: p2p, parent: /left/ambf/env/BODY tip, "
      "child: /ambf/env/BODY tip, parent pivot: {x: 0, y: 0, z: 0}, child pivot: {x: 0, y: 0, z: 0}, max motor "
      "impulse: 0}\n");
  ASSERT_TRUE(load(*was, "tie.yaml").success);
  ASSERT_TRUE(was->remove("/ambf/env/JOINT tie").success);
  ASSERT_TRUE(was->step(137));
  const auto tune = [&](const char* name, ObjectKind kind, Parameter parameter, const math::Vec3& value) {
    EXPECT_TRUE(was->set_parameter(id(*was, name, kind), parameter, value).success) << name;
  };
  tune("/ambf/env/BODY link", ObjectKind::rigid_body, Parameter::friction, {0.75, 0, 0});
  tune("/ambf/env/BODY link", ObjectKind::rigid_body, Parameter::angular_damping, {0.3, 0, 0});
  tune("/ambf/env/BODY tip", ObjectKind::rigid_body, Parameter::linear_p, {3, 4, 5});
  tune("/ambf/env/JOINT swing", ObjectKind::joint, Parameter::joint_damping, {0.125, 0, 0});
  tune("/ambf/env/JOINT slide", ObjectKind::joint, Parameter::joint_p, {25, 0, 0});
  was->set_gravity({0, 0, -1.6});
  // The world's camera and light are put elsewhere.
  for (const auto& [name, kind] :
       {std::pair("/ambf/env/eye", ObjectKind::camera), {"/ambf/env/lamp", ObjectKind::light}}) {
    const auto port = was->bind(id(*was, name, kind), state::Source::panel);
    state::PoseCommand pose;
    pose.enabled = true;
    pose.T_parent_object = {{1, 2, 2}, math::from_rpy(0.2, 0.1, 0.4)};
    port->post(state::Command(pose));
  }
  ASSERT_TRUE(was->step(1));
  const state::Outcome saved = save(*was, "scene", true);
  ASSERT_TRUE(saved.success) << saved.message;
  const auto is = start("scene/launch.yaml");
  expect_same(*was, *is);
  EXPECT_EQ(is->frame().gravity_world.z, -1.6);
  EXPECT_NE(read("scene/world.yaml").find("z: -1.6}  # down"), std::string::npos) << read("scene/world.yaml");
  EXPECT_NE(read("scene/models/arm.yaml").find("mass: 1  # kg"), std::string::npos) << "comments stay";
  const auto told = [&](const char* what) {
    return std::any_of(saved.diagnostics.begin(), saved.diagnostics.end(),
                       [&](const base::Diagnostic& d) { return d.message.find(what) != std::string::npos; });
  };
  EXPECT_TRUE(told("velocities"));
  // Saved over itself, twice: the file is what was written, nobody else has changed it.
  ASSERT_TRUE(is->step(20));
  EXPECT_FALSE(save(*is, "scene", true).success);
  for (int i = 0; i < 2; ++i) {
    const state::Outcome over = save(*is, "scene", true, true);
    EXPECT_TRUE(over.success) << over.message;
    ASSERT_TRUE(is->step(20));
  }
}

TEST_F(SceneSaving, NothingIsReplacedUnaskedNorHalfWritten) {
  const auto was = start("launch.yaml");
  write("scene/world.yaml", "precious");
  const state::Outcome refused = save(*was, "scene", false);
  EXPECT_FALSE(refused.success);
  EXPECT_NE(refused.message.find("it exists"), std::string::npos) << refused.message;
  EXPECT_EQ(files_in("scene"), std::set<std::string>{"world.yaml"}) << "nothing half written is left";
  EXPECT_EQ(read("scene/world.yaml"), "precious");
  EXPECT_FALSE(save(*was, "/sys/scene", false).success);
  EXPECT_FALSE(was->save({"", "", false, false}).success) << "no folder";
  EXPECT_TRUE(save(*was, "scene", false, true).success);
  // A model that somebody else has changed meanwhile is not lost.
  const auto is = start("scene/launch.yaml");
  write("scene/models/arm.yaml", "theirs");
  const state::Outcome theirs = save(*is, "scene", false, true);
  EXPECT_FALSE(theirs.success);
  EXPECT_NE(theirs.message.find("has changed since"), std::string::npos) << theirs.message;
  EXPECT_EQ(read("scene/models/arm.yaml"), "theirs");
}

}  // namespace
}  // namespace ambf::runtime
