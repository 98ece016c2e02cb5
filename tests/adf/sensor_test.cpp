// Sensor blocks: forms of rays, and what is wrong with them.
#include <gtest/gtest.h>

#include "scene/sensor.h"
#include "tests/adf/support.h"

namespace ambf::adf {
namespace {

ModelResult sensor(const std::string& keys) {
  return parse_model("namespace: /t/\nsensors: [S]\nS: {name: S, " + keys + "}\n", "model.yaml");
}

TEST(SensorBlock, GivesItsRays) {
  const ModelResult result = sensor(
      "type: PROXIMITY, parent: BODY a, range: 0.1, array: [{offset: {x: 1, y: 2, z: 3}, direction: {x: 0, y: 0, z: "
      "1}}]");
  EXPECT_TRUE(no_worse_than_information(result.diagnostics));
  ASSERT_EQ(result.model->blocks.size(), 1U);
  const auto& read = result.model->blocks[0].as<scene::Sensor>();
  EXPECT_EQ(read.type, state::SensorType::proximity);
  EXPECT_EQ(read.parent, "BODY a");
  ASSERT_EQ(read.array.size(), 1U);
  EXPECT_EQ(read.array[0].offset, (math::Vec3{1, 2, 3}));
}

TEST(SensorBlock, OfTheOlderSyntaxIsASingleRayInTheParentsFrame) {
  const ModelResult result =
      sensor("parent: BODY a, range: 0.8, location: {x: 1, y: 0, z: 0}, direction: {x: 0, y: 1, z: 0}");
  EXPECT_TRUE(no_worse_than_information(result.diagnostics));
  const auto& read = result.model->blocks.at(0).as<scene::Sensor>();
  EXPECT_EQ(read.T_parent_sensor.position, math::Vec3{});
  EXPECT_EQ(read.array.at(0).offset, (math::Vec3{1, 0, 0}));
  EXPECT_DOUBLE_EQ(read.visible_size_m, 0.1);
}

TEST(SensorBlock, WithoutRaysIsLeftOut) {
  const struct {
    const char *keys, *message;
  } kCases[] = {
      {"range: 1", "error: \\[S: array\\] missing; the sensor has no rays"},
      {"array: []", "error: \\[S: array\\] expected a list of rays, found none"},
      {"array: [{offset: {x: 0, y: 0, z: 0}, direction: {x: 0, y: 0, z: 0}}]",
       "error: \\[S: array\\[0\\]/direction\\] expected a direction, found the zero vector"},
      {"location: {x: 0, y: 0, z: 0}, direction: {x: 0, y: 0, z: 0}", "error: \\[S: direction\\] expected a direction"},
      {"range: 0, array: [{offset: {x: 0, y: 0, z: 0}, direction: {x: 0, y: 0, z: 1}}]",
       "error: \\[S: range\\] expected a number above 0"},
      {"parametric: {resolution: 1}", "error: \\[S: parametric/resolution\\] expected 2 or more, found 1"},
      {"mesh: absent.stl", "error: \\[S: mesh\\] mesh of rays not found"},
      {"type: Sonar, parametric: {resolution: 2}", "error: \\[S: type\\]"},
      {"range: .nan, parametric: {resolution: 2}", "error: \\[S: range\\]"},
  };
  for (const auto& each : kCases) {
    const ModelResult result = sensor(each.keys);
    EXPECT_TRUE(says(result.diagnostics, each.message)) << each.keys;
    EXPECT_TRUE(result.model->blocks.empty()) << each.keys;
  }
}

TEST(SensorBlock, PlacesRaysOfAMesh) {
  const auto placed = [](const std::string& keys) {
    const ModelResult result = parse("namespace: /t/\nsensors: [S]\nS: {name: S, mesh: a.obj" + keys + "}\n");
    return std::pair(result.model->blocks.at(0).as<scene::Sensor>().placement, all_of(result.diagnostics));
  };
  EXPECT_TRUE(placed("").first.faces);
  EXPECT_FALSE(placed("").first.edges);
  const scene::RayPlacement both = placed(", placement: [edges, vertices]").first;
  EXPECT_TRUE(!both.faces && both.edges && both.vertices);
  EXPECT_TRUE(placed(", placement: [corners]").first.faces);
  EXPECT_NE(placed(", placement: [corners]").second.find("expected faces, edges or vertices"), std::string::npos);
}

TEST(SensorBlock, OfTypeResistanceHasItsFriction) {
  const std::string ray = ", array: [{offset: {x: 0, y: 0, z: 0}, direction: {x: 1, y: 0, z: 0}}]";
  const struct {
    const char* word;
    scene::FrictionScale scale;
  } kCases[] = {{"true", scene::FrictionScale::normal_force},
                {"yes", scene::FrictionScale::normal_force},
                {"1", scene::FrictionScale::normal_force},
                {"false", scene::FrictionScale::none},
                {"depth", scene::FrictionScale::depth}};
  for (const auto& each : kCases) {
    const ModelResult result =
        sensor(std::string("type: Resistance, contact area: 0.002, contact stiffness: 3, friction: "
                           "{static: 1000, dynamic: 0.5, variable: ") +
               each.word + "}" + ray);
    EXPECT_TRUE(no_worse_than_information(result.diagnostics)) << each.word;
    const auto& read = result.model->blocks.at(0).as<scene::Sensor>();
    EXPECT_EQ(read.friction.scale, each.scale) << each.word;
    EXPECT_EQ(read.friction.stick, 1000.0);
    EXPECT_EQ(read.friction.damping, 0.1);
    EXPECT_EQ(read.friction.slide, 0.5);
    EXPECT_EQ(read.contact_area_m, 0.002);
    EXPECT_EQ(read.contact_stiffness, 3.0);
  }
  EXPECT_TRUE(says(sensor("type: Resistance, contact stiffness: -1" + ray).diagnostics,
                   "error: \\[S: contact stiffness\\] expected a number of at least 0"));
  EXPECT_TRUE(says(sensor("type: Resistance, mesh: a.stl, range: 0.1, depth: 0.1").diagnostics,
                   "warning: \\[S: depth\\] expected less than `range`"));
}

TEST(ResistiveSurface, IsASensorOnItsBodyWithDefaultsOfItsOwn) {
  Options options;
  options.look_for_files = false;
  const ModelResult result = parse_model(
      "namespace: /t/\nhigh resolution path: high/\nbodies: [BODY a, BODY b, BODY c]\n"
      "BODY a: {name: a, mass: 1, scale: 0.5, mesh: a.stl, resistive surface: {range: 0.05}}\n"
      "BODY b: {name: b, mass: 1, mesh: b.stl, high resolution path: own/, resistive surface: {mesh: tip.stl, depth: "
      "0.01, "
      "friction: {static: 7, variable: true}}}\n"
      "BODY c: {name: c, mass: 1, shape: BOX, geometry: {x: 1, y: 1, z: 1}, resistive surface: {range: 1}}\n",
      "/folder/model.yaml", options);
  ASSERT_EQ(result.model->bodies.size(), 3U);
  ASSERT_EQ(result.model->blocks.size(), 2U);
  const auto& a = result.model->blocks[0].as<scene::Sensor>();
  EXPECT_EQ(result.model->blocks[0].identity.name, "a_resistive_surface");
  EXPECT_EQ(a.type, state::SensorType::resistance);
  EXPECT_EQ(a.parent, "BODY a");
  EXPECT_EQ(a.mesh_files, std::vector<std::string>{"/folder/high/a.stl"}) << "the visual mesh";
  EXPECT_EQ(a.mesh_scale, 0.5);
  EXPECT_EQ(a.range_m, 0.05);
  EXPECT_DOUBLE_EQ(a.visible_size_m, 0.01);
  EXPECT_EQ(a.contact_area_m, 0.001);
  EXPECT_EQ(a.friction.stick, 1.0);
  EXPECT_EQ(a.friction.damping, 1.0);
  EXPECT_EQ(a.friction.slide, 0.1);
  const auto& b = result.model->blocks[1].as<scene::Sensor>();
  EXPECT_EQ(b.mesh_files.at(0), "/folder/own/tip.stl");
  EXPECT_EQ(b.mesh_files.at(1), "/folder/high/own/tip.stl");
  EXPECT_EQ(b.depth_m, 0.01);
  EXPECT_EQ(b.friction.stick, 7.0);
  EXPECT_EQ(b.friction.scale, scene::FrictionScale::normal_force);
  EXPECT_TRUE(says(result.diagnostics, "error: \\[BODY c: resistive surface\\] expected a mesh"));
}

TEST(SensorBlock, WithRaysInTwoFormsTakesTheFirst) {
  const ModelResult result =
      sensor("parametric: {resolution: 2}, array: [{offset: {x: 0, y: 0, z: 0}, direction: {x: 1, y: 0, z: 0}}]");
  EXPECT_TRUE(says(result.diagnostics, "warning: \\[S: parametric\\] not used: `array` counts"));
  EXPECT_EQ(result.model->blocks.at(0).as<scene::Sensor>().array.size(), 1U);
}

}  // namespace
}  // namespace ambf::adf
