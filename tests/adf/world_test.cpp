#include "tests/adf/support.h"

namespace ambf::adf {
namespace {

WorldResult world(const std::string& text, bool look = false) {
  Options options;
  options.look_for_files = look;
  return parse_world(text, "/w/world.yaml", options);
}

TEST(World, DefaultsAreThoseOfTheReference) {
  const WorldResult result = world("namespace: /ambf/env/\n");
  ASSERT_TRUE(result.world);
  EXPECT_EQ(result.world->gravity, (math::Vec3{0, 0, -9.8}));
  EXPECT_EQ(result.world->enclosure, (math::Vec3{4, 4, 3}));
  EXPECT_EQ(result.world->max_iterations, 10u);
  EXPECT_FALSE(result.world->max_iterations_given);
  EXPECT_TRUE(result.world->environment_file.empty());
}

TEST(World, EveryKeyArrives) {
  const WorldResult result = world(
      "namespace: /ambf/env/\nenvironment: ./floor.yaml\nmax iterations: 50\ngravity: {x: 0, y: 0, z: -9.81}\nsolver: "
      "si\nsolver iterations: 20\n"
      "skybox: {path: sky, right: a, left: b, top: c, bottom: d, front: e, back: f}\nlights: [l]\ncameras: [c]\n"
      "l: {name: l, namespace: lights/}\nc: {name: c, location: {x: 1, y: 0, z: 0}}\n");
  ASSERT_TRUE(result.world);
  EXPECT_EQ(result.world->environment_file, "/w/floor.yaml");
  EXPECT_EQ(result.world->max_iterations, 50u);
  EXPECT_TRUE(result.world->max_iterations_given);
  EXPECT_EQ(result.world->solver, "si");
  EXPECT_EQ(result.world->solver_iterations, 20u);
  ASSERT_TRUE(result.world->skybox);
  EXPECT_EQ(result.world->skybox->path, "/w/sky");
  EXPECT_EQ(result.world->lights.at(0).identity.name_space, "/ambf/env/lights/");
  EXPECT_EQ(result.world->cameras.size(), 1u);
  EXPECT_TRUE(no_worse_than_information(result.diagnostics));
}

TEST(World, BothSpellingsOfTheEnclosureAreRead) {
  EXPECT_EQ(world("enclosure: {length: 10, width: 8, height: 2}\n").world->enclosure, (math::Vec3{10, 8, 2}));
  EXPECT_EQ(world("enclosure size: {length: 10, width: 8, height: 2}\n").world->enclosure, (math::Vec3{10, 8, 2}));
}

TEST(World, MissingEnvironmentIsAnErrorAndTheWorldStays) {
  const WorldResult result = world("environment: floor.yaml\n", true);
  ASSERT_TRUE(result.world);
  EXPECT_EQ(result.world->environment_file, "");
  EXPECT_TRUE(says(result.diagnostics, "^/w/world.yaml:1:14: error: \\[environment\\] no such file: /w/floor.yaml"));
}

TEST(World, SkyboxNeedsAllSixFaces) {
  EXPECT_TRUE(says(world("skybox: {path: sky, right: a}\n").diagnostics, "error: \\[skybox/left\\] missing"));
}

TEST(Launch, PathsStartAtItsFolderAndKeepTheirPlaces) {
  const LaunchResult result = parse_launch(
      "world config: ./world/w.yaml\ncolor config: c.yaml\ninput devices config: /abs/d.yaml\nmultibody configs:\n  - "
      "a.yaml\n  - ../b.yaml\n",
      "/l/launch.yaml");
  ASSERT_TRUE(result.launch);
  EXPECT_EQ(result.launch->world_file, "/l/world/w.yaml");
  EXPECT_EQ(result.launch->color_file, "/l/c.yaml");
  EXPECT_EQ(result.launch->input_devices_file, "/abs/d.yaml");
  EXPECT_EQ(result.launch->model_files, (std::vector<std::string>{"/l/a.yaml", "/b.yaml"}));
  EXPECT_TRUE(result.diagnostics.empty());
}

TEST(Launch, EveryModelMayHaveItsOwnWorldAndThenAllDo) {
  const std::string models = "multibody configs: [a.yaml, b.yaml]\n";
  const LaunchResult both = parse_launch(models + "world configs: [w/a.yaml, w/b.yaml]\n", "/l/launch.yaml");
  ASSERT_TRUE(both.launch);
  EXPECT_EQ(both.launch->world_files, (std::vector<std::string>{"/l/w/a.yaml", "/l/w/b.yaml"}));
  const LaunchResult one = parse_launch(models + "world configs: [w/a.yaml]\n", "/l/launch.yaml");
  EXPECT_FALSE(one.launch);
  EXPECT_TRUE(says(one.diagnostics, "error: \\[world configs\\] expected 2 entries.*found 1"));
}

TEST(Launch, WhatIsMissingIsSaid) {
  const LaunchResult result = parse_launch("multibody configs: []\n", "l.yaml");
  ASSERT_TRUE(result.launch);
  EXPECT_TRUE(says(result.diagnostics, "info: \\[world config\\] missing; a default world is used"));
}

TEST(Launch, WrongTypeRefusesIt) {
  EXPECT_FALSE(parse_launch("world config: [a]\n", "l.yaml").launch);
  EXPECT_TRUE(says(parse_launch("world confg: a\n", "l.yaml").diagnostics,
                   "warning: \\[world confg\\] unknown key.*did you mean `world config`"));
}

TEST(Colors, WrongOnesAreLeftOutAndTheRestStays) {
  const ColorsResult result =
      parse_colors("red: {r: 255, g: 0, b: 0}\nbad: {r: 300, g: 0, b: 0}\nworse: {r: 1, g: 1}\nword: 5\n", "c.yaml");
  ASSERT_TRUE(result.colors);
  EXPECT_EQ(result.colors->size(), 1u);
  EXPECT_EQ(result.colors->at("red").a, 1.0);
  EXPECT_TRUE(says(result.diagnostics, "c.yaml:2:6: error: \\[bad\\] expected 0 to 255"));
  EXPECT_TRUE(says(result.diagnostics, "error: \\[worse/b\\] missing"));
  EXPECT_TRUE(says(result.diagnostics, "warning: \\[word\\] expected a colour"));
}

TEST(Launch, PlacementsBelongToModelsByTheirOrder) {
  const std::string models = "multibody configs: [a.yaml, b.yaml]\n";
  EXPECT_TRUE(parse_launch(models, "l/launch.yaml").placements.empty());
  const LaunchResult placed = parse_launch(
      models + "multibody placements: [{}, {name prefix: /left, location: {position: {x: 1, y: 2, z: 3}}}]\n",
      "l/launch.yaml");
  ASSERT_TRUE(placed.launch);
  ASSERT_EQ(placed.placements.size(), 2u);
  EXPECT_EQ(placed.placements[0].T_world_model, math::Pose{});
  EXPECT_EQ(placed.placements[1].name_prefix, "/left");
  EXPECT_EQ(placed.placements[1].T_world_model.position, (math::Vec3{1, 2, 3}));
  const LaunchResult one = parse_launch(models + "multibody placements: [{}]\n", "l/launch.yaml");
  EXPECT_FALSE(one.launch) << "which model would it belong to?";
  EXPECT_TRUE(base::has_errors(one.diagnostics));
}

TEST(ModelFile, ConflictNumbersAreWholeAndFromZeroOn) {
  const auto read = [](const std::string& numbers) {
    return parse_model("bodies: [A]\nconflict numbers: " + numbers + "\nA: {name: A, mass: 1}\n", "m.yaml");
  };
  const ModelResult good = read("{A: 2, B: 0}");
  EXPECT_EQ(good.conflict_numbers, (std::map<std::string, std::string>{{"A", "2"}}));
  EXPECT_FALSE(base::has_warnings(good.diagnostics));
  for (const char* wrong : {"{A: -1}", "{A: 1.5}", "{A: [2]}", "{A: two}"}) {
    const ModelResult result = read(wrong);
    EXPECT_TRUE(result.model && result.conflict_numbers.empty()) << wrong;
    EXPECT_TRUE(base::has_warnings(result.diagnostics)) << wrong;
  }
}

}  // namespace
}  // namespace ambf::adf
