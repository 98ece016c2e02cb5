#include "scene/soft_body.h"
#include "tests/adf/support.h"

namespace ambf::adf {
namespace {

TEST(Model, BlocksComeInTheOrderOfTheirListAndUnlistedOnesDoNot) {
  const ModelResult result =
      parse("bodies: [B, A]\nnamespace: /t/\nA: {name: A, mass: 1}\nB: {name: B, mass: 1}\nC: {name: C, mass: 1}\n");
  ASSERT_EQ(result.model->bodies.size(), 2u);
  EXPECT_EQ(result.model->bodies[0].identity.name, "B");
  EXPECT_EQ(result.model->bodies[1].identity.name, "A");
  EXPECT_TRUE(no_worse_than_information(result.diagnostics));
}

TEST(Model, HeaderArrives) {
  const ModelResult result = parse(
      "bodies: []\nnamespace: /a//b/\nignore inter-collision: 'True'\ngravity: {x: 0, y: 0, z: -1.6}\njoint erp: "
      "0.1\njoint cfm: 0.2\n"
      "shaders: {path: s, vertex: v, fragment: f}\n");
  EXPECT_TRUE(result.model->ignore_inter_collision);
  EXPECT_EQ(result.model->gravity->z, -1.6);
  EXPECT_EQ(result.model->joint_erp, 0.1);
  EXPECT_EQ(result.model->joint_cfm, 0.2);
  EXPECT_EQ(result.model->shaders.path, "s");
  EXPECT_EQ(result.model->name, "model.yaml");
  EXPECT_TRUE(no_worse_than_information(result.diagnostics));
}

TEST(Model, ListedButUndefinedBlockIsAnErrorAndTheRestLoads) {
  const ModelResult result = parse("bodies: [BODY A, BODY Lnk]\nBODY A: {name: A}\nBODY Link: {name: L}\n");
  EXPECT_EQ(result.model->bodies.size(), 1u);
  EXPECT_TRUE(says(
      result.diagnostics,
      "^model.yaml:1:18: error: \\[BODY Lnk\\] listed in `bodies`, but not defined \\(did you mean 'BODY Link'\\?\\)"));
}

TEST(Model, HeaderOfAWrongTypeRefusesTheFile) {
  EXPECT_FALSE(parse("bodies: BODY A\nBODY A: {name: A}\n").model);
  EXPECT_FALSE(parse("bodies: []\ngravity: down\n").model);
  EXPECT_TRUE(says(parse("bodies: BODY A\n").diagnostics,
                   "model.yaml:1:9: error: \\[bodies\\] expected a list of names, found the text 'BODY A'"));
}

TEST(Model, EmptyListsAndMissingValuesAreFine) {
  EXPECT_TRUE(parse("bodies:\njoints: []\nnamespace: /t/\n").model);
  EXPECT_TRUE(says(parse("bodies: [A]\nA: {name: A, mass: }\n").diagnostics,
                   "info: \\[A: mass\\] has no value; the default counts \\(default: 1\\)"));
}

TEST(Model, TextThatIsNoMapIsRefused) {
  for (const char* text : {"", "just words", "[1, 2]", "# only a comment\n"}) {
    const ModelResult result = parse(text);
    EXPECT_FALSE(result.model) << text;
    EXPECT_TRUE(base::has_errors(result.diagnostics)) << text;
  }
}

TEST(Model, NamesLoseTheirSpacesAndIdentifiersKeepThem) {
  const ModelResult result =
      parse("bodies: [BODY Box 1]\nnamespace: /ambf/env/\nBODY Box 1: {name: Box 1, namespace: arm/, mass: 1}\n");
  const scene::Identity& identity = result.model->bodies.at(0).identity;
  EXPECT_EQ(identity.identifier, "BODY Box 1");
  EXPECT_EQ(identity.name, "Box1");
  EXPECT_EQ(identity.name_space, "/ambf/env/arm/");
  EXPECT_EQ(identity.where.line, 3);
}

TEST(Model, MissingNameAndNamespaceAreSaidAsInformation) {
  const ModelResult result = parse("bodies: [BODY Box 1]\nBODY Box 1: {mass: 1}\n");
  EXPECT_EQ(result.model->bodies.at(0).identity.name, "Box1");
  EXPECT_TRUE(says(result.diagnostics, "info: \\[BODY Box 1: name\\] missing; the object is called 'Box1'"));
  EXPECT_TRUE(says(result.diagnostics, "info: \\[namespace\\] missing"));
  EXPECT_TRUE(no_worse_than_information(result.diagnostics));
}

TEST(Model, SecondObjectOfANameIsRenamed) {
  const ModelResult result =
      parse("bodies: [A, B, C]\nA: {name: Box}\nB: {name: Box}\nC: {name: Box, namespace: /other/}\n");
  ASSERT_EQ(result.model->bodies.size(), 3u);
  EXPECT_EQ(result.model->bodies[1].identity.name, "Box1");
  EXPECT_EQ(result.model->bodies[1].identity.identifier, "B");
  EXPECT_EQ(result.model->bodies[2].identity.name, "Box");
  EXPECT_TRUE(
      says(result.diagnostics,
           "warning: \\[B: name\\] another object is called 'Box' already \\(this one is renamed to 'Box1'\\)"));
}

TEST(Model, BodyAndJointMayShareAName) {
  const ModelResult result = parse_joint_keys("namespace: /t/");
  ASSERT_EQ(result.model->joints.size(), 1u);
  EXPECT_TRUE(no_worse_than_information(result.diagnostics));
}

TEST(Model, ValuesAtTheTopAreFineWithAnAnchorAndWarnedOfWithout) {
  EXPECT_TRUE(no_worse_than_information(
      parse("friction: &f {static: 1}\nradius: &r 0.5\nbodies: [A]\nA: {name: A, friction: *f, mass: *r}\n")
          .diagnostics));
  EXPECT_TRUE(says(parse("namespac: /t/\nbodies: []\n").diagnostics,
                   "^model.yaml:1:1: warning: \\[namespac\\] unknown key.*did you mean `namespace`"));
  EXPECT_TRUE(says(parse("shader: {path: a}\nbodies: []\n").diagnostics,
                   "warning: \\[shader\\] unknown key.*did you mean `shaders`"));
}

TEST(Model, VersionIsOneOrNone) {
  EXPECT_TRUE(parse("adf version: 1.0\nbodies: []\n").model);
  EXPECT_TRUE(parse("ADF Version: \"1.0\"\nbodies: []\n").model);
  const ModelResult result = parse("adf version: 2.0\nbodies: []\n");
  EXPECT_FALSE(result.model);
  EXPECT_TRUE(says(result.diagnostics, "model.yaml:1:14: error: \\[adf version\\] expected 1.0, found the number 2.0"));
}

TEST(Model, KindsThatComeLaterAreCheckedAndSaidOncePerBlock) {
  const ModelResult result = parse(
      "volumes: [O]\npoint clouds: [P]\nnamespace: /t/\n"
      "O: {dimensions: {x: 1, y: 1, z: far}, color lut: a.png}\n"
      "P: {parent: BODY A, points size: 0.01, color: red}\n");
  ASSERT_TRUE(result.model);
  for (const char* kind : {"volume", "point cloud"}) {
    EXPECT_TRUE(says(result.diagnostics, std::string("info: .*this ") + kind + " is not simulated yet"));
  }
  EXPECT_TRUE(says(result.diagnostics, "warning: \\[O: dimensions/z\\] expected a vector .*, found the text 'far'"));
  EXPECT_FALSE(base::has_errors(result.diagnostics));
  EXPECT_EQ(count(result.diagnostics, base::Severity::information), 2u);
}

// They are used as they are, as AMBF 2.0 did, but not in silence.
TEST(Model, SharesOfASoftBodyBeyondTheirRangeAreWarnedOf) {
  const auto of = [](const std::string& config) {
    return parse(
        "soft bodies: [S]\nnamespace: /t/\n"
        "S: {name: S, shape: SPHERE, geometry: {radius: 1}, config: {" +
        config + "}}\n");
  };
  for (const std::string key : {"kLST", "kDP", "kMT", "kCHR", "kKHR", "kSHR"})
    for (const std::string value : {"-0.5", "1.5"})
      EXPECT_TRUE(says(of(key + ": " + value).diagnostics,
                       "warning: \\[S: config/" + key + "\\] expected 0 to 1, found " + value))
          << key;
  EXPECT_TRUE(says(of("kDF: -1").diagnostics, "warning: \\[S: config/kDF\\] expected at least 0, found -1"));
  EXPECT_TRUE(says(of("piterations: 0").diagnostics, "warning: \\[S: config/piterations\\] 0 sweeps"));
  const ModelResult good = of("kLST: 1, kDP: 0, kMT: 1, kDF: 2, kCHR: 0, kKHR: 1, kSHR: 0.5");
  EXPECT_FALSE(says(good.diagnostics, "warning"));
  const ModelResult bad = of("kLST: 1.5");
  ASSERT_TRUE(bad.model);
  EXPECT_EQ(bad.model->blocks.at(0).as<scene::SoftBody>().config.kLST, 1.5);
}

TEST(Model, SettingsOfASoftBodyAreReadAndChecked) {
  const ModelResult result = parse(
      "soft bodies: [S, T]\nnamespace: /t/\n"
      "S: {name: S, shape: SPHERE, geometry: {radius: 1}, config: {kXYZ: 2, flags: 5, fixed nodes: [0, 7]}}\n"
      "T: {name: T, shape: SPHERE, geometry: {radius: 1}, mass: 2, config: {kLST: 0.5, flags: 34, piterations: "
      "5000}}\n");
  ASSERT_TRUE(result.model);
  ASSERT_EQ(result.model->blocks.size(), 2u);
  EXPECT_TRUE(says(result.diagnostics, "warning: \\[S: config/kXYZ\\] unknown key"));
  EXPECT_TRUE(says(result.diagnostics, "warning: \\[S: config/flags\\] the bits 4 are of Bullet's deformable bodies"));
  EXPECT_TRUE(says(result.diagnostics, "warning: \\[T: config/flags\\] clusters are to meet something"));
  EXPECT_TRUE(says(result.diagnostics, "warning: \\[T: config/piterations\\]"));
  const auto& first = result.model->blocks[0].as<scene::SoftBody>();
  EXPECT_EQ(first.config.fixed_nodes, (std::vector<int>{0, 7}));
  EXPECT_EQ(first.config.kLST, 1.0);
  const auto& second = result.model->blocks[1].as<scene::SoftBody>();
  EXPECT_EQ(second.mass, 2.0);
  EXPECT_EQ(second.config.kLST, 0.5);
  EXPECT_EQ(second.config.piterations, 1000);
}

TEST(Model, FileThatCannotBeReadIsRefusedWithItsName) {
  const ModelResult result = load_model("/no/such/file.yaml");
  EXPECT_FALSE(result.model);
  EXPECT_TRUE(says(result.diagnostics, "^/no/such/file.yaml: error: cannot be read: no such file"));
  EXPECT_TRUE(says(load_model("/dev/zero").diagnostics, "error: cannot be read: not a file"));
  EXPECT_TRUE(says(load_model("/tmp").diagnostics, "error: cannot be read: not a file"));
}

}  // namespace
}  // namespace ambf::adf
