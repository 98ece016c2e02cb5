// Our own scenes as our own readers see them. What the files themselves must hold is in test_models.py and
// test_model_files.py.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "adf/adf.h"
#include "mesh/hull.h"
#include "mesh/loader.h"

namespace ambf {
namespace {

const std::string kDescriptions = std::string(AMBF_MODELS_DIR) + "/descriptions/";

std::string listed(const base::Diagnostics& diagnostics) {
  std::string text;
  for (const base::Diagnostic& diagnostic : diagnostics) {
    text += base::to_string(diagnostic) + "\n";
  }
  return text;
}

std::vector<std::string> model_files() {
  const adf::LaunchResult launch = adf::load_launch(kDescriptions + "launch.yaml");
  return launch.launch ? launch.launch->model_files : std::vector<std::string>{};
}

TEST(OwnModels, LaunchFilesAndWhatTheyNameLoadWithoutAFinding) {
  for (const char* name :
       {"launch.yaml", "launch_two_views.yaml", "launch_cameras.yaml", "launch_stereo.yaml", "launch_two_users.yaml"}) {
    const adf::LaunchResult launch = adf::load_launch(kDescriptions + name);
    ASSERT_TRUE(launch.launch) << listed(launch.diagnostics);
    EXPECT_EQ(listed(launch.diagnostics), "");
    const adf::ColorsResult colors = adf::load_colors(launch.launch->color_file);
    EXPECT_EQ(listed(colors.diagnostics), "");
    ASSERT_TRUE(colors.colors);
    EXPECT_TRUE(colors.colors->contains("teal"));
    const base::Diagnostics devices = adf::load_input_devices(launch.launch->input_devices_file).diagnostics;
    EXPECT_FALSE(base::has_errors(devices) || base::has_warnings(devices)) << listed(devices);
  }
}

TEST(OwnModels, InputDevicesAreReadWithoutAFinding) {
  std::size_t devices = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kDescriptions + "input_devices")) {
    const adf::InputDevicesResult result = adf::load_input_devices(entry.path().string());
    ASSERT_TRUE(result.devices) << entry.path();
    EXPECT_FALSE(base::has_errors(result.diagnostics) || base::has_warnings(result.diagnostics))
        << listed(result.diagnostics);
    EXPECT_EQ(result.devices->devices.size(), result.devices->listed.size()) << entry.path();
    devices += result.devices->devices.size();
  }
  EXPECT_GE(devices, 18u);
}

TEST(OwnModels, WorldsLoadWithoutAFinding) {
  std::size_t worlds = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kDescriptions + "world")) {
    if (!entry.path().filename().string().ends_with("world.yaml")) continue;
    ++worlds;
    const adf::WorldResult world = adf::load_world(entry.path().string());
    ASSERT_TRUE(world.world) << listed(world.diagnostics);
    EXPECT_FALSE(base::has_errors(world.diagnostics) || base::has_warnings(world.diagnostics))
        << listed(world.diagnostics);
    EXPECT_FALSE(world.world->cameras.empty());
    EXPECT_FALSE(world.world->lights.empty());
    const adf::ModelResult environment = adf::load_model(world.world->environment_file);
    ASSERT_TRUE(environment.model) << listed(environment.diagnostics);
    EXPECT_EQ(listed(environment.diagnostics), "");
  }
  EXPECT_GE(worlds, 10U);
}

TEST(OwnModels, ModelsLoadWithoutAFindingAndComplete) {
  const std::map<std::string, std::pair<std::size_t, std::size_t>> bodies_and_joints = {
      {"four_bar.yaml", {4, 4}},
      {"peg_transfer.yaml", {15, 4}},
      {"arm7.yaml", {8, 7}},
      {"stewart_platform.yaml", {20, 24}},
      {"two_finger.yaml", {3, 2}},
      {"cubes_300.yaml", {300, 0}},
      {"toy_car.yaml", {7, 6}},
      {"grasps.yaml", {9, 6}},
      {"magnet.yaml", {6, 2}},
      {"door.yaml", {2, 1}},
      {"ghost.yaml", {5, 0}},
      {"slope.yaml", {3, 0}},
      {"stick_slip.yaml", {2, 0}},
      {"screwdriver.yaml", {9, 7}},
      {"rover.yaml", {5, 0}},
      {"psm.yaml", {15, 14}},
      {"ecm.yaml", {12, 11}},
      {"mtmr.yaml", {15, 12}},
      {"mtml.yaml", {15, 12}},
      {"kuka_lwr.yaml", {9, 7}},
      {"kuka_lbr_med.yaml", {9, 7}},
      {"suj.yaml", {25, 24}},
      {"cloth.yaml", {2, 0}},
      {"neuro_robot.yaml", {19, 22}},
      {"raven2.yaml", {16, 14}},
      {"pr2.yaml", {39, 38}},
      {"thread.yaml", {59, 57}},
      {"pr2_gripper.yaml", {5, 4}},
      {"pr2_gripper_small_red.yaml", {5, 4}},
      {"cloth_two_hands.yaml", {7, 6}},
      {"tissue.yaml", {3, 0}},
      {"incision.yaml", {6, 0}},
      {"thread_over_pegs.yaml", {8, 6}},
      {"suture_pad.yaml", {3, 0}},
      {"peritoneum.yaml", {6, 0}},
      {"gallbladder.yaml", {3, 0}},
      {"cloth_two_hands_tissue.yaml", {7, 6}},
      {"swab.yaml", {4, 0}}};
  const std::vector<std::string> files = model_files();
  EXPECT_EQ(files.size(), bodies_and_joints.size());
  for (const std::string& file : files) {
    const adf::ModelResult result = adf::load_model(file);
    ASSERT_TRUE(result.model) << listed(result.diagnostics);
    EXPECT_EQ(listed(result.diagnostics), "");
    const auto expected = bodies_and_joints.find(std::filesystem::path(file).filename().string());
    ASSERT_NE(expected, bodies_and_joints.end()) << file;
    EXPECT_EQ(result.model->bodies.size(), expected->second.first) << file;
    EXPECT_EQ(result.model->joints.size(), expected->second.second) << file;
  }
}

TEST(OwnModels, MeshesLoadWithoutAFinding) {
  std::size_t meshes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(std::string(AMBF_MODELS_DIR) + "/meshes")) {
    if (entry.path().extension() != ".obj") {
      continue;
    }
    const mesh::LoadResult result = mesh::load(entry.path().string());
    EXPECT_TRUE(result.ok && result.mesh.triangle_count() > 0) << entry.path();
    EXPECT_EQ(listed(result.diagnostics), "");
    ++meshes;
  }
  EXPECT_GE(meshes, 35U);
}

// Colliding shapes are primitives wherever they can be; a hull must be small, since a query is linear in its points.
TEST(OwnModels, NoBodyCollidesAsATriangleMesh) {
  std::size_t hulls = 0;
  for (const std::string& file : model_files()) {
    const adf::ModelResult result = adf::load_model(file);
    ASSERT_TRUE(result.model);
    for (const scene::Body& body : result.model->bodies) {
      if (!body.collision.shapes.empty()) {
        continue;
      }
      EXPECT_EQ(body.collision.mesh_type, scene::CollisionMeshType::convex_hull) << body.identity.identifier;
      const mesh::LoadResult loaded = mesh::load(body.collision.mesh_file);
      ASSERT_TRUE(loaded.ok) << body.collision.mesh_file;
      std::vector<math::Vec3> points;
      for (const mesh::Submesh& part : loaded.mesh.submeshes) {
        for (std::size_t i = 0; i < part.vertex_count(); ++i) {
          points.push_back(part.vertex(i));
        }
      }
      const mesh::ReducedHull hull = mesh::reduce_hull(points);
      EXPECT_LE(hull.points.size(), 64U) << body.identity.identifier;
      EXPECT_LT(hull.max_deviation, 1e-3) << body.identity.identifier;
      ++hulls;
    }
  }
  EXPECT_GE(hulls, 1U);
}

}  // namespace
}  // namespace ambf
