// Files of other people, as they are: what is expected of the odd ones, and no error from all others.
#include <filesystem>
#include <map>

#include "adf/check.h"
#include "scene/actuator.h"
#include "scene/sensor.h"
#include "tests/adf/support.h"
#include "tests/support/compat_models.h"

namespace ambf::adf {
namespace {

namespace fs = std::filesystem;

class Compat : public ::testing::Test {
 protected:
  void SetUp() override { AMBF_NEEDS_COMPAT(); }
  std::string descriptions(const std::string& file) const { return (compat::descriptions() / file).string(); }
  ModelResult model(const std::string& file) const { return load_model(descriptions("multi-bodies/" + file)); }
};

const char* const kWithErrors[] = {"compound_example.yaml", "sophie.yaml", "rover_parts.yaml", "urdf-kuka.yaml"};

TEST_F(Compat, AllButTheKnownOddOnesLoadWithoutError) {
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(compat::folder())) {
    if (entry.path().extension() != ".yaml") continue;
    const std::string name = entry.path().filename().string();
    if (std::find(std::begin(kWithErrors), std::end(kWithErrors), name) != std::end(kWithErrors)) continue;
    ++files;
    const base::Diagnostics diagnostics = check_file(entry.path().string());
    EXPECT_FALSE(base::has_errors(diagnostics)) << entry.path() << "\n" << all_of(diagnostics);
  }
  EXPECT_GE(files, 30u);
}

TEST_F(Compat, RobotsHaveAllTheirPartsAndGiveNoWarning) {
  const std::map<std::string, std::pair<std::size_t, std::size_t>> expected = {
      {"robots/blender-psm.yaml", {14, 14}},
      {"robots/blender-ecm.yaml", {11, 11}},
      {"robots/blender-mtm.yaml", {12, 10}},
      {"robots/blender-pr2.yaml", {39, 38}},
      {"robots/blender-suj.yaml", {20, 19}},
      {"robots/blender-kuka.yaml", {8, 7}},
      {"robots/blender-neuro-robot.yaml", {17, 20}},
      {"robots/blender-toy-car.yaml", {5, 4}},
      {"puzzles/puzzle1.yaml", {10, 2}},
      {"puzzles/parallel_structure.yaml", {5, 5}},
      {"environments/KnotEnv/env.yaml", {71, 72}}};
  for (const auto& [file, parts] : expected) {
    const ModelResult result = model(file);
    ASSERT_TRUE(result.model) << file;
    EXPECT_EQ(result.model->bodies.size(), parts.first) << file;
    EXPECT_EQ(result.model->joints.size(), parts.second) << file;
    EXPECT_TRUE(no_worse_than_information(result.diagnostics)) << file;
  }
}

TEST_F(Compat, BrokenYamlIsRefusedWithLineAndColumn) {
  const ModelResult result = model("puzzles/compound_example.yaml");
  EXPECT_FALSE(result.model);
  EXPECT_TRUE(says(result.diagnostics, "compound_example.yaml:84:[0-9]+: error: YAML syntax error"));
}

TEST_F(Compat, MissingMeshesAreErrorsAndEverythingElseLoads) {
  for (const auto& [file, bodies, joints] : {std::tuple{"robots/sophie.yaml", 17u, 20u},
                                             {"robots/rover_car/rover_parts.yaml", 9u, 2u},
                                             {"robots/urdf-kuka.yaml", 8u, 7u}}) {
    const ModelResult result = model(file);
    ASSERT_TRUE(result.model) << file;
    EXPECT_EQ(result.model->bodies.size(), bodies) << file;
    EXPECT_EQ(result.model->joints.size(), joints) << file;
    EXPECT_TRUE(base::has_errors(result.diagnostics)) << file;
    for (const base::Diagnostic& diagnostic : result.diagnostics) {
      if (diagnostic.severity != base::Severity::error) continue;
      EXPECT_NE(diagnostic.message.find("mesh not found; looked at: "), std::string::npos)
          << base::to_string(diagnostic);
      EXPECT_GT(diagnostic.line, 0);
    }
  }
}

TEST_F(Compat, ReversedLimitsAreAWarningAndAFreeJoint) {
  const ModelResult result = model("grippers/multi joint1.yaml");
  EXPECT_TRUE(says(result.diagnostics,
                   "multi joint1.yaml:69:[0-9]+: warning: \\[JOINT gripperBase-gripperR1: joint limits\\] reversed"));
  EXPECT_TRUE(result.model->joints.at(0).limits);
  EXPECT_FALSE(result.model->joints.at(1).limits);
}

TEST_F(Compat, DuplicateKeysAreAWarningEach) {
  const ModelResult result = model("sb/cloth.yaml");
  EXPECT_EQ(count(result.diagnostics, base::Severity::warning), 2u) << all_of(result.diagnostics);
  EXPECT_TRUE(
      says(result.diagnostics, "warning: \\[BODY Cloth: collision margin\\] given twice; the first value counts"));
  EXPECT_TRUE(says(result.diagnostics, "info: \\[BODY Cloth: config/flags\\] of value 16 they let it meet no bodies"));
}

TEST_F(Compat, FlowMapAtTheFirstColumnIsValid) {
  const ModelResult result = model("robots/rover_car/rover_info.yaml");
  EXPECT_TRUE(result.model);
  EXPECT_TRUE(no_worse_than_information(result.diagnostics));
  ASSERT_EQ(result.model->blocks.size(), 1u) << "the vehicle";
}

TEST_F(Compat, OlderSensorSyntaxGivesNoWarning) {
  EXPECT_TRUE(no_worse_than_information(model("tools/cylinder.yaml").diagnostics));
}

TEST_F(Compat, SensorsAndActuatorsOfGrippersAreReadAsTheyAreWritten) {
  const auto sensor = [](const ModelResult& result, std::size_t i) -> const scene::Sensor& {
    return result.model->blocks.at(i).as<scene::Sensor>();
  };
  const ModelResult cylinder = model("tools/cylinder.yaml");
  const scene::Sensor& single = sensor(cylinder, 0);
  EXPECT_EQ(single.array.at(0).offset, (math::Vec3{-0.4, 0, 0})) << "older syntax: both in the parent's frame";
  EXPECT_EQ(single.array.at(0).direction, (math::Vec3{-1, 0, 0}));
  EXPECT_EQ(single.range_m, 0.3);
  EXPECT_EQ(single.parent, "/ambf/env/cylinder");

  const ModelResult red = model("grippers/pr2 gripper small red.yaml");
  ASSERT_EQ(red.model->blocks.size(), 2U);
  EXPECT_EQ(sensor(red, 0).T_parent_sensor.position, (math::Vec3{-0.14, 0, 0}));
  EXPECT_EQ(sensor(red, 0).array.at(0).offset, (math::Vec3{0, 0, -0.01}));
  EXPECT_TRUE(sensor(red, 0).visible);
  EXPECT_EQ(red.model->blocks[1].kind, &scene::kind::kActuator);

  const ModelResult plates = model("grippers/resistive/gripper1/gripperB.yaml");
  ASSERT_EQ(plates.model->blocks.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const scene::Sensor& plate = sensor(plates, i);
    EXPECT_EQ(plate.type, state::SensorType::resistance);
    EXPECT_TRUE(plate.mesh_files.at(0).ends_with("resistive_plate.STL"));
    EXPECT_EQ(plate.range_m, 0.03);
    EXPECT_EQ(plate.friction.stick, 10000.0);
    EXPECT_EQ(plate.friction.damping, 0.0);
    EXPECT_EQ(plate.friction.slide, 5.0);
    EXPECT_EQ(plate.friction.scale, scene::FrictionScale::normal_force);
    EXPECT_EQ(plate.contact_area_m, 0.001);
    EXPECT_EQ(plate.contact_stiffness, 3.0);
    EXPECT_EQ(plate.parent, i == 0 ? "/ambf/env/gripper/BODY LeftL2" : "/ambf/env/gripper/BODY RightL2");
  }

  const ModelResult box = model("grippers/resistive/sensorized_box/gripper.yaml");
  const scene::Sensor& rays = sensor(box, 0);
  EXPECT_EQ(rays.array.at(0).offset.x, -0.15) << "by YAML anchors";
  EXPECT_EQ(rays.friction.stick, 10000.0);
  EXPECT_EQ(rays.friction.damping, 50.0);
  EXPECT_EQ(rays.contact_area_m, 0.001);
  EXPECT_EQ(rays.contact_stiffness, 0.0) << "an anchor that no block uses";
  EXPECT_EQ(rays.contact_damping, 0.0);
  EXPECT_EQ(rays.range_m, 0.3);
}

TEST_F(Compat, LaunchFileKeepsThePlacesOfAbsentModels) {
  const LaunchResult result = load_launch(descriptions("launch.yaml"));
  ASSERT_TRUE(result.launch);
  EXPECT_EQ(result.launch->model_files.size(), 23u);
  EXPECT_TRUE(result.diagnostics.empty()) << all_of(result.diagnostics);
  EXPECT_TRUE(says(check_file(descriptions("launch.yaml")),
                   "launch.yaml:10:5: warning: \\[multibody configs\\[3\\]\\] no such file: .*blender-raven2.yaml"));
  EXPECT_TRUE(base::has_errors(load_model(result.launch->model_files[3]).diagnostics));
}

TEST_F(Compat, ColoursOfTheColourFileAreThere) {
  const ColorsResult result = load_colors(descriptions("color/colors.yaml"));
  ASSERT_TRUE(result.colors);
  EXPECT_EQ(result.colors->size(), 143u);
  EXPECT_EQ(result.colors->at("red").r, 1.0);
  EXPECT_TRUE(result.diagnostics.empty());
}

TEST_F(Compat, WorldHasItsLightsAndCameras) {
  const WorldResult result = load_world(descriptions("world/world.yaml"));
  ASSERT_TRUE(result.world);
  EXPECT_EQ(result.world->lights.size(), 2u);
  EXPECT_EQ(result.world->cameras.size(), 1u);
  EXPECT_EQ(result.world->lights[1].identity.name_space, "/ambf/env/lights/");
  EXPECT_EQ(result.world->max_iterations, 50u);
  EXPECT_TRUE(no_worse_than_information(result.diagnostics));
}

TEST_F(Compat, InputDevicesKeepTheMeaningOfTheirGains) {
  const InputDevicesResult second = load_input_devices(descriptions("input_devices/input_devices.yaml"));
  ASSERT_TRUE(second.devices);
  EXPECT_EQ(second.devices->devices.size(), 7u);
  EXPECT_FALSE(base::has_errors(second.diagnostics)) << all_of(second.diagnostics);
  for (const scene::InputDevice& device : second.devices->devices) {
    EXPECT_EQ(device.haptic_gain_kind, scene::HapticGainKind::stiffness) << device.name;
  }
  const InputDevicesResult first = load_input_devices(descriptions("input_devices/input_devices_shadow.yaml"));
  ASSERT_TRUE(first.devices);
  EXPECT_EQ(first.devices->devices.size(), 7u);
  EXPECT_FALSE(base::has_errors(first.diagnostics)) << all_of(first.diagnostics);
  for (const scene::InputDevice& device : first.devices->devices) {
    const bool hydra = device.hardware_name == "Razer Hydra";
    EXPECT_EQ(device.haptic_gain_kind, hydra ? scene::HapticGainKind::stiffness : scene::HapticGainKind::ratio)
        << device.name;
  }
}

}  // namespace
}  // namespace ambf::adf
