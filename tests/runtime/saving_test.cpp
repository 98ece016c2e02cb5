// Saved models on the disk: bundles that can be moved anywhere, and disks that are full or closed.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "adf/adf.h"
#include "mesh/appearance.h"
#include "mesh/mesh.h"
#include "runtime/local_simulation.h"
#include "simulation_rig.h"
#include "state/frame.h"

namespace ambf::runtime {
namespace {

namespace fs = std::filesystem;

class Saving : public testing::Test {
 protected:
  void SetUp() override {
    home_ = fs::path(testing::TempDir()) / ("ambf_saving_" + std::to_string(getpid()));
    fs::create_directories(home_);
  }
  void TearDown() override { fs::remove_all(home_); }

  void write(const std::string& file, const std::string& text) {
    fs::create_directories((home_ / file).parent_path());
    std::ofstream(home_ / file) << text;
  }
  std::string read(const std::string& file) {
    std::ifstream stream(home_ / file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  std::set<std::string> files_in(const std::string& folder) {
    std::set<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(home_ / folder))
      if (entry.is_regular_file()) files.insert(entry.path().lexically_relative(home_ / folder).string());
    return files;
  }
  // A corner whose material has a texture; `size` tells files of one name apart.
  void write_mesh(const std::string& file, const std::string& material, const std::string& size) {
    write(file, "mtllib " + material + "\nv 0 0 0\nv " + size + " 0 0\nv 0 " + size + " 0\nv 0 0 " + size +
                    "\nusemtl m\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  }
  state::Outcome load(LocalSimulation& simulation, const std::string& file) {
    state::LoadRequest request;
    request.path = (home_ / file).string();
    return simulation.load(request);
  }
  state::Outcome save(const std::string& path, bool overwrite = false) {
    return simulation_.save({simulation_.frame().structure->models.back().name, path, false, overwrite});
  }

  fs::path home_;
  JudgedLog log_;
  LocalSimulation simulation_{test::free_running(), test::empty_world(), {}, log_};
};

const std::string kHead = "namespace: /t/\n";

TEST_F(Saving, ABundleHoldsMeshesMaterialsAndTexturesAndLoadsAnywhere) {
  write_mesh("mine/high/a.obj", "a.mtl", "0.1");
  write_mesh("mine/low/a.obj", "a.mtl", "0.2");
  write_mesh("mine/other/a.obj", "../shared/b.mtl", "0.3");
  write("mine/high/a.mtl", "newmtl m\nmap_Kd pictures/a.png\n");
  write("mine/low/a.mtl", "newmtl m\nKd 1 0 0\n");
  write("mine/shared/b.mtl", "newmtl m\nmap_Kd b.png\n");
  write("mine/high/pictures/a.png", "a picture");
  write("mine/other/b.png", "another picture");
  const std::string blocks =
      "# Mine\nA: {name: A, mass: 1, mesh: a.obj}\n"
      "B: {name: B, mass: 1, high resolution path: other, compound shape: [{shape: MESH, geometry: {mesh: a.obj, "
      "scale: {x: 1, y: -1, z: 1}}}], compound collision shape: [{shape: MESH, geometry: {mesh: a.obj}}]}\n";
  write("mine/m.yaml", kHead + "bodies: [A, B]\nhigh resolution path: ./high/\nlow resolution path: ./low/\n" + blocks);
  ASSERT_TRUE(load(simulation_, "mine/m.yaml").success);
  const state::Outcome saved = save((home_ / "new/bundle/").string());
  ASSERT_TRUE(saved.success) << saved.message;
  EXPECT_EQ(saved.model, (home_ / "new/bundle/m.yaml").string());
  EXPECT_EQ(files_in("new/bundle"),
            (std::set<std::string>{"m.yaml", "m_meshes/a.obj", "m_meshes/a.mtl", "m_meshes/pictures/a.png",
                                   "m_meshes/low/a.obj", "m_meshes/low/a.mtl", "m_meshes/2/a.obj", "m_meshes/2/b.mtl",
                                   "m_meshes/2/b.png", "m_meshes/3/a.obj", "m_meshes/3/b.mtl", "m_meshes/3/b.png"}));
  EXPECT_NE(read("new/bundle/m.yaml").find("# Mine\nA: {name: A, mass: 1, mesh: a.obj}\n"), std::string::npos)
      << read("new/bundle/m.yaml");

  fs::rename(home_ / "new/bundle", home_ / "moved");
  fs::rename(home_ / "mine", home_ / "away");
  JudgedLog log;
  LocalSimulation again{test::free_running(), test::empty_world(), {}, log};
  const state::Outcome loaded = load(again, "moved/m.yaml");
  ASSERT_TRUE(loaded.success) << loaded.message;
  EXPECT_FALSE(base::has_errors(loaded.diagnostics) || base::has_warnings(loaded.diagnostics));
  const auto size_of = [](const std::shared_ptr<const mesh::Appearance>& appearance) {
    return appearance->parts.at(0).mesh->bounds.max.x;
  };
  for (const state::ObjectInfo& object : again.frame().structure->objects) {
    if (object.name != "/t/A" && object.name != "/t/B") continue;
    const state::BodyInfo& body = again.frame().structure->bodies.at(object.slot);
    EXPECT_NEAR(size_of(body.appearance), object.name == "/t/A" ? 0.1 : 0.3, 1e-6);
    EXPECT_NEAR(size_of(body.collision_appearance), object.name == "/t/A" ? 0.2 : 0.3, 1e-6);
    EXPECT_TRUE(fs::exists(body.appearance->parts.at(0).mesh->materials.at(0).texture_file));
  }
}

TEST_F(Saving, ASceneThatIsABundleHasItsDevicesAndWhatPartsOfTheProgramLoadIsNotInIt) {
  write_mesh("mine/meshes/a.obj", "a.mtl", "0.1");
  write("mine/meshes/a.mtl", "newmtl m\nKd 1 0 0\n");
  const std::string model =
      kHead + "bodies: [A]\nhigh resolution path: ../meshes/\nA: {name: A, mass: 1, mesh: a.obj}\n";
  write("mine/left/hand.yaml", model);
  write("mine/right/hand.yaml", model);
  write("mine/devices.yaml",
        "# Ours\ninput devices: [L, R]\nL: {hardware name: a, simulated multibody: left/hand.yaml}\n"
        "R: {hardware name: b, simulated multibody: ./right/hand.yaml, root link: A}\n");
  SimulationOptions options = test::free_running();
  options.files.input_devices = (home_ / "mine/devices.yaml").string();
  LocalSimulation simulation{options, test::empty_world(), {}, log_};
  state::LoadRequest request;
  request.text = kHead + "bodies: [B]\nB: {name: B, mass: 1}\n";
  request.not_saved = true;
  ASSERT_TRUE(simulation.load(request).success);
  write("mine/crate.yaml", kHead + "bodies: [C]\nC: {name: C, mass: 1}\n");
  ASSERT_TRUE(load(simulation, "mine/crate.yaml").success);

  const state::Outcome saved = simulation.save({"", (home_ / "scene/").string(), false, false});
  ASSERT_TRUE(saved.success) << saved.message;
  EXPECT_EQ(
      files_in("scene"),
      (std::set<std::string>{"launch.yaml", "world.yaml", "input_devices.yaml", "models/crate.yaml",
                             "devices/hand.yaml", "devices/hand_meshes/a.obj", "devices/hand_meshes/a.mtl",
                             "devices/2/hand.yaml", "devices/2/hand_meshes/a.obj", "devices/2/hand_meshes/a.mtl"}));
  EXPECT_NE(read("scene/launch.yaml").find("input devices config: ./input_devices.yaml\n"), std::string::npos);
  EXPECT_NE(saved.message.find("-l 0"), std::string::npos) << "the crate alone: " << saved.message;
  fs::rename(home_ / "scene", home_ / "moved");
  fs::rename(home_ / "mine", home_ / "away");
  const adf::InputDevicesResult devices = adf::load_input_devices((home_ / "moved/input_devices.yaml").string());
  ASSERT_TRUE(devices.devices && devices.devices->devices.size() == 2);
  EXPECT_EQ(devices.devices->devices[1].root_link, "A");
  for (const scene::InputDevice& device : devices.devices->devices) {
    LocalSimulation again{test::free_running(), test::empty_world(), {}, log_};
    request = {};
    request.path = device.multibody_file;
    const state::Outcome loaded = again.load(request);
    EXPECT_TRUE(loaded.success && loaded.diagnostics.empty()) << loaded.message;
  }
}

TEST_F(Saving, ABundleReplacesNothingUnasked) {
  write_mesh("mine/a.obj", "a.mtl", "0.1");
  write("mine/a.mtl", "newmtl m\nKd 1 0 0\n");
  write("mine/m.yaml", kHead + "bodies: [A]\nA: {name: A, mass: 1, mesh: a.obj}\n");
  write("bundle/m_meshes/a.obj", "precious");
  ASSERT_TRUE(load(simulation_, "mine/m.yaml").success);
  const std::string folder = (home_ / "bundle/").string();
  const state::Outcome refused = save(folder);
  EXPECT_FALSE(refused.success);
  EXPECT_NE(refused.message.find("it exists"), std::string::npos) << refused.message;
  EXPECT_EQ(files_in("bundle"), std::set<std::string>{"m_meshes/a.obj"});
  EXPECT_EQ(read("bundle/m_meshes/a.obj"), "precious");
  EXPECT_TRUE(save(folder, true).success);
  EXPECT_EQ(read("bundle/m_meshes/a.obj"), read("mine/a.obj"));
  // A second time, what lies there already is what is wanted; the file itself is replaced only if asked.
  EXPECT_NE(save(folder).message.find("it exists"), std::string::npos);
  EXPECT_TRUE(save(folder, true).success);
}

TEST_F(Saving, AFullDiskOrAClosedFolderLeavesTheOldFile) {
  write("m.yaml", kHead + "bodies: [A]\nA: {name: A, mass: 1}\n" + std::string(5000, '#') + "\n");
  write("old.yaml", "precious");
  ASSERT_TRUE(load(simulation_, "m.yaml").success);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto ignore_before = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = before;
  small.rlim_cur = 1000;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const state::Outcome full = save((home_ / "old.yaml").string(), true);
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, ignore_before);
  EXPECT_FALSE(full.success);
  EXPECT_NE(full.message.find("cannot write"), std::string::npos) << full.message;
  EXPECT_EQ(read("old.yaml"), "precious");
  EXPECT_EQ(files_in("."), (std::set<std::string>{"m.yaml", "old.yaml"})) << "nothing half written is left";
  const state::Outcome closed = save("/sys/saved.yaml");  // not even root may
  EXPECT_FALSE(closed.success);
  EXPECT_NE(closed.message.find("cannot write '/sys/saved.yaml'"), std::string::npos) << closed.message;
  EXPECT_FALSE(save("/sys/bundle/").success);
}

}  // namespace
}  // namespace ambf::runtime
