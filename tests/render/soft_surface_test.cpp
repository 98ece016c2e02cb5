// Soft bodies as all pictures show them: in the light of the scene, with shadows and textures, measured and masked.
#include "render/scene/soft_surface.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "offscreen_fixture.h"
#include "render/images/image_file.h"
#include "state/kind_rows.h"
#include "state/soft_bodies.h"

namespace ambf::render {
namespace {

using testing::matte;
using testing::pixel;
using testing::Rgb;
using testing::SceneMaker;

// A soft body whose nodes are the vertices of the square metre of scenes.h.
struct SoftScene : SceneMaker {
  std::vector<math::Vec3> nodes;

  SoftScene() { state::make_tables(*structure); }

  std::uint32_t sheet(mesh::Mesh mesh, const math::Vec3& at, const mesh::SurfaceMaterial* material) {
    auto look = std::make_shared<mesh::Appearance>();
    auto shape = std::make_shared<state::SoftShape>();
    state::SoftBodyInfo body;
    body.first_node = static_cast<std::uint32_t>(nodes.size());
    for (const mesh::Submesh& part : mesh.submeshes)
      for (std::uint32_t i = 0; i < part.vertex_count(); ++i) {
        shape->skin.push_back({{i, i, i}, {1.0F, 0.0F, 0.0F}, 0.0F});
        nodes.push_back(part.vertex(i) + at);
      }
    look->parts.push_back({std::make_shared<mesh::Mesh>(std::move(mesh)), {}, 1.0});
    look->has_material = material != nullptr;
    if (material != nullptr) look->material = *material;
    auto& rows = state::table<state::SoftBodyInfo>(*structure, state::soft_body_kind().kind);
    body.object = object(state::soft_body_kind().kind, "sheet", static_cast<std::uint32_t>(rows.size()));
    body.appearance = look;
    body.shape = shape;
    body.nodes = static_cast<std::uint32_t>(nodes.size()) - body.first_node;
    rows.push_back(body);
    return body.object;
  }
  std::unique_ptr<state::Frame> soft_frame() const {
    auto made = frame();
    for (const math::Vec3& node : nodes) state::soft_nodes(*made).push_back({node});
    return made;
  }
};

// A square of two triangles whose nodes have moved by 1 m along x and hang down at one corner.
TEST(SoftSurface, VerticesAreWhereTheirNodesAre) {
  mesh::Mesh square = testing::square(1.0F);
  square.submeshes[0].positions.insert(square.submeshes[0].positions.end(), {0.0F, -0.5F, 0.1F});
  square.submeshes[0].normals.insert(square.submeshes[0].normals.end(), {0, 0, 1});
  auto shape = std::make_shared<state::SoftShape>();
  for (std::uint32_t node = 0; node < 4; ++node) shape->skin.push_back({{node, node, node}, {1.0F, 0.0F, 0.0F}, 0.0F});
  shape->skin.push_back({{0, 1, 2}, {0.5F, 0.5F, 0.0F}, 0.1F});
  state::SoftBodyInfo body;
  body.shape = shape;
  body.nodes = 4;
  SoftSurface surface(body, {std::make_shared<mesh::Mesh>(square), {}, 1.0}, 0);
  EXPECT_LT(surface.bounds_world().radius, 0.0);
  EXPECT_FALSE(surface.pose({{0, 0, 0}}));
  ASSERT_TRUE(surface.pose({{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, -0.5}}));
  const mesh::Submesh& now = surface.submeshes()[0];
  EXPECT_EQ(now.vertex(3), (math::Vec3{1, 1, -0.5}));
  EXPECT_LT(math::norm(now.vertex(4) - math::Vec3{1.5, 0.0, 0.1}), 1e-6) << "above the middle of an edge";
  EXPECT_GT(now.normals[2], 0.8F) << "between both triangles";
  EXPECT_LT(now.normals[2], 0.99F);
  EXPECT_FLOAT_EQ(now.normals[5], 1.0F) << "of the level one alone";
  EXPECT_GT(surface.bounds_world().radius, 0.7);
}

class SoftPictures : public testing::OffscreenFixture {
 protected:
  // From straight above: 1 m is some 100 pixels, x down the picture.
  Image take_from_above(const SoftScene& scene) {
    Image image;
    std::string why;
    EXPECT_TRUE(
        offscreen_->picture(*scene.soft_frame(), above(), testing::kWidth, testing::kHeight, image, diagnostics_, why))
        << why;
    return image;
  }
  static Camera above() {
    Camera camera;
    camera.T_world_camera = looking_at({0.001, 0, 4}, {});
    camera.orthographic_width_m = 3.2;
    return camera;
  }
  static Rgb at(const Image& image, double x, double y) {
    return pixel(image, static_cast<int>(160 + 100 * y), static_cast<int>(120 + 100 * x));
  }
};

TEST_F(SoftPictures, TheyThrowShadowsWhereTheyAre) {
  SoftScene scene;
  const mesh::SurfaceMaterial white = matte(0.8F, 0.8F, 0.8F), red = matte(0.8F, 0.1F, 0.1F);
  scene.body(mesh::make_box(4, 4, 0.1), {{0, 0, -0.05}, {}}, &white);
  mesh::Mesh small = testing::square(1.0F);
  for (float& p : small.submeshes[0].positions) p *= 0.4F;
  scene.sheet(small, {-0.3, -0.5, 0.8}, &red);
  // From the left and from above: shadows fall 0.8 m to the right.
  scene.light(testing::shining({-0.3, -4.5, 4.0}, {-0.3, 0.0, 0.0}), 1.5).beam.shadow_quality = 3;
  const Image image = take_from_above(scene);
  const Rgb shadow = at(image, -0.3, 0.35), beside = at(image, -0.3, 0.95), sheet = at(image, -0.3, -0.5);
  EXPECT_LT(shadow.sum(), 0.75 * beside.sum());
  EXPECT_GT(sheet.r, 2 * sheet.g) << "its own colour";
  for (math::Vec3& node : scene.nodes) node.x += 0.7;
  const Image moved = take_from_above(scene);
  EXPECT_GT(at(moved, -0.3, 0.35).sum(), shadow.sum() / 0.75);
  EXPECT_LT(at(moved, 0.4, 0.35).sum(), 0.75 * at(moved, -0.3, 0.35).sum());
}

TEST_F(SoftPictures, ShadowsFallOnThem) {
  SoftScene scene;
  const mesh::SurfaceMaterial white = matte(0.8F, 0.8F, 0.8F);
  scene.sheet(testing::square(1.0F), {}, &white);
  scene.body(mesh::make_box(0.2, 0.2, 0.02), {{0.0, -0.5, 0.8}, {}}, &white);
  scene.light(testing::shining({0.0, -4.5, 4.0}, {}), 1.5).beam.shadow_quality = 3;
  const Image image = take_from_above(scene);
  EXPECT_LT(at(image, 0.0, 0.45).sum(), 0.75 * at(image, 0.3, 0.45).sum());
}

TEST_F(SoftPictures, TheirTexturesGoWithThem) {
  const std::string path =
      (std::filesystem::temp_directory_path() / "ambf_soft_surface_test.png").string();  // half green, half blue
  Image picture{8, 8, std::vector<std::uint8_t>(std::size_t{4} * 64, 255)};
  for (std::size_t i = 0; i < 64; ++i) {
    picture.rgba[4 * i] = 0;
    picture.rgba[4 * i + (i % 8 < 4 ? 2 : 1)] = 0;
  }
  std::string why;
  ASSERT_TRUE(write_png(path, picture, why)) << why;
  mesh::Mesh square = testing::square(1.0F);
  square.materials[0].diffuse = {1.0F, 1.0F, 1.0F, 1.0F};
  square.materials[0].texture_file = path;
  SoftScene scene;
  scene.sheet(square, {}, nullptr);
  for (math::Vec3& node : scene.nodes) node = {node.y, node.x + 0.4, node.z};  // turned over, and moved
  const Image image = take_from_above(scene);
  const Rgb left = at(image, 0.0, 0.15), right = at(image, 0.0, 0.65);
  EXPECT_GT(left.g, 1.3 * left.b);
  EXPECT_GT(right.b, 1.3 * right.g);
  std::filesystem::remove(path);
}

TEST_F(SoftPictures, TheyAreMeasuredAndMasked) {
  SoftScene scene;
  const mesh::SurfaceMaterial white = matte(0.8F, 0.8F, 0.8F);
  const std::uint32_t floor = scene.body(mesh::make_box(4, 4, 0.1), {{0, 0, -0.05}, {}}, &white);
  scene.sheet(testing::square(1.0F), {0, 0, 0.5}, &white);
  std::vector<Shot> shots(1);
  shots[0].camera = above();
  shots[0].width = testing::kWidth;
  shots[0].height = testing::kHeight;
  shots[0].measured = true;
  offscreen_->shoot(*scene.soft_frame(), shots, diagnostics_);
  ASSERT_EQ(shots[0].failure, "");
  const std::size_t middle = 120 * testing::kWidth + 160, edge = 120 * testing::kWidth + 300;
  EXPECT_NEAR(shots[0].depth_m[middle], 3.5, 1e-3);
  EXPECT_NEAR(shots[0].depth_m[edge], 4.0, 2e-3);
  EXPECT_EQ(shots[0].bodies[middle], scene.structure->bodies.size()) << "soft bodies are counted after bodies";
  EXPECT_EQ(shots[0].bodies[edge], floor);
}

}  // namespace
}  // namespace ambf::render
