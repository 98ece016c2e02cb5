#include "adf/check.h"

#include <filesystem>
#include <fstream>

#include "tests/adf/support.h"

namespace ambf::adf {
namespace {

TEST(Kind, FilesAreToldApartByTheirKeys) {
  EXPECT_EQ(kind_of("world config: a\nmultibody configs: []\n"), FileKind::launch);
  EXPECT_EQ(kind_of("input devices: [A]\n"), FileKind::input_devices);
  EXPECT_EQ(kind_of("bodies: []\nlights: [l]\ncameras: [c]\n"), FileKind::model);
  EXPECT_EQ(kind_of("sensors: [S]\n"), FileKind::model);
  EXPECT_EQ(kind_of("enclosure size: {length: 1}\nlights: [l]\n"), FileKind::world);
  EXPECT_EQ(kind_of("lights: [l]\ncameras: [c]\nl: {name: l}\n"), FileKind::world);
  EXPECT_EQ(kind_of("red: {r: 1, g: 0, b: 0}\n"), FileKind::colors);
  EXPECT_EQ(kind_of("nonsense"), FileKind::model);
}

scene::Model model_of(const std::string& text) {
  ModelResult result = parse(text);
  EXPECT_TRUE(result.model) << all_of(result.diagnostics);
  return result.model.value_or(scene::Model());
}

const std::string kJoint =
    "parent pivot: {x: 0, y: 0, z: 0}, child pivot: {x: 0, y: 0, z: 0}, parent axis: {x: 0, y: 0, z: 1}, child axis: "
    "{x: 0, y: 0, z: 1}";

TEST(Orphans, BodyOfNoOtherFileIsAWarningWithTheNearestName) {
  scene::Model model = model_of(
      "bodies: [BODY Base]\njoints: [J]\nBODY Base: {name: B}\nJ: {name: J, type: fixed, parent: BODY Bse, child: BODY "
      "Base, " +
      kJoint + "}\n");
  const base::Diagnostics diagnostics = take_out_orphans(model);
  EXPECT_TRUE(says(diagnostics,
                   "model.yaml:4:4: warning: \\[J: parent\\] no body of this file is called 'BODY Bse' \\(did you mean "
                   "'BODY Base'\\?"));
  EXPECT_EQ(diagnostics.size(), 1u);
}

TEST(Orphans, AmbiguousNameIsAnErrorThatListsWhatItMayMean) {
  scene::Model model = model_of(
      "bodies: [BODY L1, BODY L2]\njoints: [J]\nBODY L1: {name: A}\nBODY L2: {name: B}\nJ: {name: J, type: fixed, "
      "parent: L, child: L2, " +
      kJoint + "}\n");
  EXPECT_TRUE(
      says(take_out_orphans(model), "error: \\[J: parent\\] 'L' may mean several bodies: 'BODY L1', 'BODY L2'"));
}

TEST(Orphans, LeaveTheModelAndTheOthersStay) {
  scene::Model model = model_of(
      "bodies: [A, B]\njoints: [J, K]\nA: {name: A}\nB: {name: B}\nJ: {name: J, type: fixed, parent: Elsewhere, "
      "child: B, " +
      kJoint + "}\nK: {name: K, type: fixed, parent: A, child: B, " + kJoint + "}\n");
  EXPECT_TRUE(says(take_out_orphans(model), "warning: \\[J: parent\\] no body of this file is called 'Elsewhere'"));
  ASSERT_EQ(model.joints.size(), 1u);
  EXPECT_EQ(model.joints[0].identity.identifier, "K");
}

TEST(Orphans, CamerasAndLightsHangOnOneAnotherToo) {
  scene::Model model = model_of(
      "namespace: /t/\nbodies: [A]\ncameras: [C1, C2, C3]\nlights: [L]\nA: {name: A}\n"
      "C1: {name: C1, parent: C2, location: {x: 1, y: 0, z: 0}}\nC2: {name: C2, parent: L, location: {x: 1, y: 0, z: "
      "0}}\n"
      "C3: {name: C3, parent: Lamp9, location: {x: 1, y: 0, z: 0}}\nL: {name: L, parent: A, location: {x: 1, y: 0, z: "
      "0}}\n");
  const base::Diagnostics found = take_out_orphans(model);
  EXPECT_EQ(found.size(), 1u) << all_of(found);
  EXPECT_TRUE(says(found, "info: \\[C3: parent\\] no object of this file is called 'Lamp9'"));
  EXPECT_EQ(model.cameras[0].parent, "C2");
  EXPECT_EQ(model.cameras[2].parent, "");
}

TEST(CheckFile, TellsWhatLoadingWouldSayOfWhatTheFileHolds) {
  const auto folder = std::filesystem::temp_directory_path() / ("ambf_check_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "m.yaml") << "bodies: [A]\njoints: [J]\nnamespace: /t/\nA: {name: A, mass: 1}\nJ: {name: J, "
                                      "type: fixed, parent: A, child: Gone, "
                                   << kJoint << "}\n";
  const base::Diagnostics diagnostics =
      check_file((folder / "m.yaml").string(), [&](const scene::Model& model) -> base::Diagnostics {
        EXPECT_EQ(model.bodies.size(), 1u);
        EXPECT_TRUE(model.joints.empty());
        return {{base::Severity::warning, model.file, 4, 4, "A", "mesh", "dull", ""}};
      });
  std::filesystem::remove_all(folder);
  EXPECT_TRUE(says(diagnostics, "m.yaml:4:4: warning: \\[A: mesh\\] dull"));
  EXPECT_TRUE(says(diagnostics, "warning: \\[J: child\\] no body of this file is called 'Gone'"));
}

TEST(Model, FilesOfOtherKindsAreRefusedWithWhatToDoWithThem) {
  const auto refused = [](const std::string& text, const std::string& pattern) {
    const ModelResult result = parse(text);
    EXPECT_FALSE(result.model) << text;
    EXPECT_EQ(result.diagnostics.size(), 1u) << all_of(result.diagnostics);
    EXPECT_TRUE(says(result.diagnostics, pattern)) << all_of(result.diagnostics);
  };
  refused("color config: c.yaml\nmultibody configs: [m.yaml]\n",
          "model.yaml:2:1: error: this is a launch file, no model \\(start with --launch_file model.yaml\\)");
  refused("world config: w.yaml\n", "this is a launch file");
  refused("lights: [l]\nenvironment: e.yaml\nl: {name: l}\n",
          "model.yaml:2:1: error: this is a world file, no model \\(name it as `world config` of a launch file\\)");
  refused("red: {r: 1, g: 0, b: 0}\n", "this is a colour file");
  refused("input devices: [A]\nA: {}\n", "this is an input devices file");
}

TEST(Model, OfCamerasAndLightsOnlyIsOne) {
  const scene::Model model = model_of("namespace: /t/\nlights: [L]\nL: {name: L, location: {x: 1, y: 0, z: 0}}\n");
  EXPECT_EQ(model.lights.size(), 1u);
}

TEST(Keys, BareVectorsAsPosesAreToldHowToWriteThem) {
  const ModelResult result = parse("bodies: [A]\nA: {name: A, mass: 1, location: {x: 1, y: 0, z: 0}}\n");
  EXPECT_TRUE(
      says(result.diagnostics, "warning: \\[A: location/x\\] unknown key; .*\\(write `position: \\{x, y, z\\}`\\)"))
      << all_of(result.diagnostics);
}

TEST(Keys, BlocksThatBeginLikeAKeyAreBlocks) {
  const base::Diagnostics found =
      parse("namespace: /t/\nbodies: [shaders box]\nshaders box: {name: A, mass: 1}\nshadesr: {}\n").diagnostics;
  EXPECT_FALSE(says(found, "shaders box\\] unknown key")) << all_of(found);
  EXPECT_TRUE(says(found, "shadesr\\] unknown key.*did you mean `shaders`")) << all_of(found);
}

TEST(CheckFile, ThatDoesNotExistIsAnError) { EXPECT_TRUE(base::has_errors(check_file("/no/such.yaml"))); }

}  // namespace
}  // namespace ambf::adf
