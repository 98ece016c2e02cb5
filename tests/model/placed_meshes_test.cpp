// Several meshes of one body, each at its place and scale, drawn and colliding beside primitives.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "mesh/appearance.h"
#include "mesh/facing.h"
#include "mesh/mesh.h"
#include "rig.h"

namespace ambf::model {
namespace {

using namespace test;

constexpr double kMargin = 0.005;  // a margin of 1 mm around faces that the rays meet at an angle

// A corner of a cube, its three edges 0.1 m along the axes.
std::string write_corner() {
  const std::string path = (std::filesystem::path(testing::TempDir()) / "model_placed_corner.stl").string();
  std::ofstream out(path);
  const char* const points[4] = {"0 0 0", "0.1 0 0", "0 0.1 0", "0 0 0.1"};
  const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  out << "solid t\n";
  for (const auto& face : faces) {
    out << "facet normal 0 0 0\nouter loop\n";
    for (const int corner : face) out << "vertex " << points[corner] << '\n';
    out << "endloop\nendfacet\n";
  }
  out << "endsolid t\n";
  return path;
}

TEST(PlacedMeshes, OfOneBodyAreDrawnAndCollideAtTheirPlacesAndScales) {
  Rig rig;
  const std::string file = write_corner();
  scene::Body body = box("a", 1.0, {0, 0, 0});
  body.collision.shapes.front().offset.position = {0, 0, 3};
  body.collision.meshes = {
      {file, {}, {1, 1, 1}, {}}, {file, {}, {2, 2, 2}, {{0, 0, 1}, {}}}, {file, {}, {-2, 1, 1}, {{0, 0, 2}, {}}}};
  body.visual.shapes = body.collision.shapes;
  body.visual.meshes = body.collision.meshes;
  rig.load(model("a", {body}));
  rig.step();
  std::uint64_t press = 0;
  const auto meets = [&](double height, double from) {
    state::PickHit hit;
    const math::Vec3 start{from, 0.02, height}, end{-from, 0.02, height};
    return rig.live->pick(0, ++press, start, end, hit) ? hit.point_world.x : 99.0;
  };
  EXPECT_NEAR(meets(0.02, 1), 0.06, kMargin);
  EXPECT_NEAR(meets(1.02, 1), 0.16, kMargin);
  EXPECT_NEAR(meets(2.02, -1), -0.12, kMargin) << "mirrored and twice as long";
  EXPECT_NEAR(meets(2.02, 1), 0.0, kMargin);
  EXPECT_NEAR(meets(3.0, 1), 0.05, kMargin) << "the box beside them";
  EXPECT_EQ(meets(0.5, 1), 99.0);
  for (const auto& drawn : {rig.info("a").appearance, rig.info("a").collision_appearance}) {
    ASSERT_NE(drawn, nullptr);
    ASSERT_EQ(drawn->parts.size(), 4U);
    EXPECT_EQ(drawn->parts[1].mesh, drawn->parts[2].mesh) << "one scale for all axes needs no other mesh";
    EXPECT_EQ(drawn->parts[2].scale, 2.0);
    for (const mesh::AppearancePart& part : drawn->parts)
      EXPECT_EQ(mesh::facing_of(part.mesh->submeshes.at(0)), mesh::Facing::outwards);
    EXPECT_NEAR(drawn->parts[3].mesh->bounds.min.x, -0.2, 1e-6);
  }
  EXPECT_EQ(rig.info("a").appearance->parts[3].mesh, rig.info("a").collision_appearance->parts[3].mesh) << "shared";
}

TEST(PlacedMeshes, AndShapesHaveColoursOfTheirOwn) {
  Rig rig;
  scene::Body body = box("a", 1.0, {0, 0, 0});
  scene::Material red;
  red.diffuse = {1, 0, 0};
  body.visual.shapes = {body.collision.shapes.front(), body.collision.shapes.front()};
  body.visual.shapes[1].material = red;
  body.visual.meshes = {{write_corner(), {}, {1, 1, 1}, {}, red}};
  rig.load(model("a", {body}));
  const auto& parts = rig.info("a").appearance->parts;
  ASSERT_EQ(parts.size(), 3U);
  EXPECT_FALSE(parts[0].material);
  for (const std::size_t i : {1U, 2U}) {
    ASSERT_TRUE(parts[i].material);
    EXPECT_EQ(parts[i].material->diffuse[0], 1.0F);
    EXPECT_EQ(parts[i].material->diffuse[1], 0.0F);
  }
}

TEST(PlacedMeshes, ThatCannotBeReadAreLeftOutWithAnError) {
  Rig rig;
  scene::Body body = box("a", 1.0, {0, 0, 0});
  body.visual.meshes = {{"/nowhere/at_all.stl", {}, {1, 1, 1}, {}}, {write_corner(), {}, {1, 1, 1}, {}}};
  const Prepared prepared = rig.load(model("a", {body}));
  EXPECT_TRUE(base::has_errors(prepared.diagnostics));
  EXPECT_EQ(rig.info("a").appearance->parts.size(), 2U);
}

}  // namespace
}  // namespace ambf::model
