// Meshes of URDF robots: several a link, beside primitives, of any scale; and where their files are.
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "adf/urdf_import.h"
#include "tests/adf/support.h"

namespace ambf::adf {
namespace {

namespace fs = std::filesystem;

std::string mesh(const std::string& tag, const std::string& file, const std::string& scale, const std::string& xyz) {
  return "<" + tag + "><origin xyz=\"" + xyz + "\"/><geometry><mesh filename=\"" + file + "\" scale=\"" + scale +
         "\"/></geometry></" + tag + ">\n";
}

std::string robot(const std::string& parts) {
  return "<robot name=\"r\"><link name=\"a\">\n<inertial><origin xyz=\"0 0 0.5\"/><mass value=\"1\"/>"
         "<inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"/></inertial>\n" +
         parts + "</link></robot>";
}

scene::Body link_of(const std::string& parts) {
  const ModelResult result = parse(robot(parts));
  EXPECT_TRUE(result.model) << all_of(result.diagnostics);
  EXPECT_TRUE(no_worse_than_information(result.diagnostics));
  return result.model ? result.model->bodies.at(0) : scene::Body{};
}

const std::string kSphere = "<geometry><sphere radius=\"0.05\"/></geometry>";

TEST(UrdfMeshes, SeveralOfALinkAreAllThereAtTheirPlacesAndScales) {
  const scene::Body body =
      link_of(mesh("visual", "a.stl", "0.5 0.5 0.5", "1 0 0") + mesh("visual", "b.stl", "1 -2 3", "0 1 0") +
              "<visual>" + kSphere + "</visual>" + mesh("collision", "a.stl", "-1 1 1", "2 0 0") + "<collision>" +
              kSphere + "</collision>" + mesh("collision", "b.stl", "1 1 1", "0 0 1"));
  EXPECT_EQ(body.scale, 1.0);
  EXPECT_EQ(body.visual.mesh_file, "");
  EXPECT_EQ(body.visual.shapes.size(), 1U);
  ASSERT_EQ(body.visual.meshes.size(), 2U);
  EXPECT_EQ(body.visual.meshes[0].scale, (math::Vec3{0.5, 0.5, 0.5}));
  EXPECT_EQ(body.visual.meshes[0].offset.position, (math::Vec3{1, 0, 0}));
  EXPECT_EQ(body.visual.meshes[1].scale, (math::Vec3{1, -2, 3}));
  EXPECT_EQ(body.collision.shapes.size(), 1U);
  ASSERT_EQ(body.collision.meshes.size(), 2U);
  EXPECT_EQ(body.collision.meshes[0].scale, (math::Vec3{-1, 1, 1}));
  EXPECT_EQ(body.collision.meshes[1].offset.position, (math::Vec3{0, 0, 1}));
}

// A body's `scale` acts on the primitives that it collides by, but not on their offsets.
TEST(UrdfMeshes, OfAnotherScaleLeavePrimitivesAsTheyAre) {
  const scene::Body body = link_of(mesh("visual", "a.stl", "0.001 0.001 0.001", "0 0 0") +
                                   "<collision><origin xyz=\"0 0 0.2\"/>" + kSphere + "</collision>");
  ASSERT_EQ(body.collision.shapes.size(), 1U);
  EXPECT_EQ(body.collision.shapes[0].geometry.radius * body.scale, 0.05);
  EXPECT_EQ(body.collision.shapes[0].offset.position, (math::Vec3{0, 0, 0.2}));
}

TEST(UrdfMeshes, OnePrimitiveAtTheOriginStaysThereWhateverTheCentreOfMass) {
  const scene::Body body = link_of("<collision>" + kSphere + "</collision>");
  ASSERT_TRUE(body.collision.offset && body.inertial_offset);
  EXPECT_EQ(body.collision.offset->position, (math::Vec3{0, 0, 0}));
  EXPECT_EQ(body.inertial_offset->position.z, 0.5);
}

TEST(UrdfMeshes, WithoutExtentAreLeftOutWithTheirLine) {
  const ModelResult result =
      parse(robot(mesh("visual", "a.stl", "1 0 1", "0 0 0") + "<visual>" + kSphere + "</visual>"));
  ASSERT_TRUE(result.model);
  EXPECT_TRUE(says(result.diagnostics, "yaml:3: warning.*visual mesh with a scale of 0 is left out"));
  EXPECT_TRUE(result.model->bodies.at(0).visual.meshes.empty());
}

// By a path from the working folder: its meshes are beside it, not in a folder of that name beneath it.
TEST(UrdfMeshes, OfAFileLoadedByARelativePathAreFoundAndSavedFromThere) {
  const fs::path home = fs::path(testing::TempDir()) / ("ambf_urdf_relative_" + std::to_string(getpid()));
  fs::create_directories(home / "robot");
  std::ofstream(home / "robot/a.stl") << "solid a\nendsolid a\n";
  std::ofstream(home / "robot/r.urdf") << robot(mesh("visual", "a.stl", "1 1 1", "0 0 0"));
  const fs::path before = fs::current_path();
  fs::current_path(home);
  const ModelResult result = load_model("robot/r.urdf");
  fs::current_path(before);
  ASSERT_TRUE(result.model) << all_of(result.diagnostics);
  EXPECT_TRUE(no_worse_than_information(result.diagnostics));
  EXPECT_EQ(result.model->bodies.at(0).visual.mesh_file, (fs::canonical(home) / "robot/a.stl").string());
  ASSERT_TRUE(result.text);
  EXPECT_NE(result.text->find(home.filename().string() + "/robot/a.stl\""), std::string::npos) << *result.text;
  fs::remove_all(home);
}

}  // namespace
}  // namespace ambf::adf
