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

TEST(CheckParents, BodyOfNoOtherFileIsAWarningWithTheNearestName) {
  const scene::Model model = model_of(
      "bodies: [BODY Base]\njoints: [J]\nBODY Base: {name: B}\nJ: {name: J, type: fixed, parent: BODY Bse, child: BODY "
      "Base, " +
      kJoint + "}\n");
  const base::Diagnostics diagnostics = check_parents(model);
  EXPECT_TRUE(says(diagnostics,
                   "model.yaml:4:4: warning: \\[J: parent\\] no body of this file is called 'BODY Bse' \\(did you mean "
                   "'BODY Base'\\?"));
  EXPECT_EQ(diagnostics.size(), 1u);
}

TEST(CheckParents, AmbiguousNameIsAnErrorThatListsWhatItMayMean) {
  const scene::Model model = model_of(
      "bodies: [BODY L1, BODY L2]\njoints: [J]\nBODY L1: {name: A}\nBODY L2: {name: B}\nJ: {name: J, type: fixed, "
      "parent: L, child: L2, " +
      kJoint + "}\n");
  EXPECT_TRUE(says(check_parents(model), "error: \\[J: parent\\] 'L' may mean several bodies: 'BODY L1', 'BODY L2'"));
}

TEST(CheckGains, DampingThatTurnsVelocitiesRoundIsAWarning) {
  EXPECT_TRUE(
      says(check_gains(model_of("bodies: [A]\nA: {name: A, mass: 0.01, controller: {linear: {P: 100, D: 50}}}\n")),
           "warning: \\[A: controller/linear/D\\] cannot be stable: D of 50 times the step of 0.001 s is more than "
           "0.01 kg"));
  EXPECT_TRUE(
      check_gains(model_of("bodies: [A]\nA: {name: A, mass: 1, controller: {linear: {P: 100, D: 50}}}\n")).empty());
}

TEST(CheckGains, OfTheLastJointOfAChainOnlyAndWithTheLeverOfItsBody) {
  const std::string bodies =
      "bodies: [A, B, C]\njoints: [J, K]\nA: {name: A, mass: 1}\nB: {name: B, mass: 1, inertia: {ix: 0.001, iy: 0.001, "
      "iz: 0.001}}\n";
  const std::string joints = "J: {name: J, type: revolute, parent: A, child: B, controller: {P: 1, D: 5}, " + kJoint +
                             "}\nK: {name: K, type: revolute, parent: B, child: C, controller: {P: 1, D: 5}, " +
                             kJoint + "}\n";
  const auto at_pivot =
      check_gains(model_of(bodies + "C: {name: C, mass: 1, inertia: {ix: 0.001, iy: 0.001, iz: 0.001}}\n" + joints));
  EXPECT_TRUE(says(at_pivot, "warning: \\[K: controller/D\\] cannot be stable"));
  EXPECT_EQ(at_pivot.size(), 1u);
  const auto with_lever = check_gains(model_of(bodies +
                                               "C: {name: C, mass: 1, inertia: {ix: 0.001, iy: 0.001, iz: 0.001}, "
                                               "inertial offset: {position: {x: 0.1, y: 0, z: 0}}}\n" +
                                               joints));
  EXPECT_TRUE(with_lever.empty()) << all_of(with_lever);
}

TEST(CheckFile, AsksTheProbeAboutEachMeshOnce) {
  const auto folder = std::filesystem::temp_directory_path() / ("ambf_check_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "a.STL") << "x";
  std::ofstream(folder / "m.yaml")
      << "bodies: [A, B]\nnamespace: /t/\nA: {name: A, mass: 1, mesh: a.STL}\nB: {name: B, mass: 1, mesh: a.STL}\n";
  int asked = 0;
  const base::Diagnostics diagnostics = check_file((folder / "m.yaml").string(), [&](const std::string&) {
    ++asked;
    return std::string("no triangles");
  });
  std::filesystem::remove_all(folder);
  EXPECT_EQ(asked, 1);
  EXPECT_TRUE(says(diagnostics, "error: \\[A: mesh\\] .*a.STL: no triangles"));
}

TEST(CheckFile, ThatDoesNotExistIsAnError) { EXPECT_TRUE(base::has_errors(check_file("/no/such.yaml"))); }

}  // namespace
}  // namespace ambf::adf
