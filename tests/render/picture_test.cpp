// Draws small scenes without a display and looks at the pixels.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "math/rotation.h"
#include "render/pictures/offscreen.h"
#include "render/scene/lights.h"
#include "scenes.h"

namespace ambf::render {
namespace {

using testing::matte;
using testing::SceneMaker;

constexpr int kWidth = 320, kHeight = 240;

struct Rgb {
  int r = 0, g = 0, b = 0;
  int sum() const { return r + g + b; }
};

class Pictures : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string why;
    offscreen_ = Offscreen::open(why);
    ASSERT_NE(offscreen_, nullptr) << why;
  }
  void TearDown() override {
    if (offscreen_ != nullptr) {
      EXPECT_EQ(offscreen_->counts().gl_errors, 0U);
    }
  }
  // From (3, 0, 0) along -x with z up: y is to the right.
  static Camera camera() {
    Camera camera;
    camera.T_world_camera = {{3.0, 0.0, 0.0}, {}};
    return camera;
  }
  Image take(const SceneMaker& scene, const Camera& from) {
    Image image;
    std::string why;
    EXPECT_TRUE(offscreen_->picture(*scene.frame(), from, kWidth, kHeight, image, diagnostics_, why)) << why;
    return image;
  }
  // The colour where `point_world` is seen.
  static Rgb at(const Image& image, const Camera& from, const math::Vec3& point_world) {
    const Mat4 m = projection_matrix(from, static_cast<double>(kWidth) / kHeight) * view_matrix(from.T_world_camera);
    const auto clip = transform(m, point_world);
    return at(image, (clip[0] / clip[3] + 1.0) / 2.0 * kWidth, (1.0 - clip[1] / clip[3]) / 2.0 * kHeight);
  }
  static Rgb at(const Image& image, double x_px, double y_px) {
    const auto i = static_cast<std::size_t>(4 * (static_cast<int>(y_px) * image.width + static_cast<int>(x_px)));
    return {image.rgba.at(i), image.rgba.at(i + 1), image.rgba.at(i + 2)};
  }

  std::unique_ptr<Offscreen> offscreen_;
  base::Diagnostics diagnostics_;
};

bool reddish(const Rgb& c) { return c.r > 2 * c.g && c.r > 2 * c.b && c.r > 80; }
bool greenish(const Rgb& c) { return c.g > 2 * c.r && c.g > 2 * c.b && c.g > 80; }
bool bluish(const Rgb& c) { return c.b > 2 * c.r && c.b > 2 * c.g && c.b > 80; }

const mesh::SurfaceMaterial kRed = matte(0.9F, 0.05F, 0.05F), kGreen = matte(0.05F, 0.8F, 0.05F),
                            kBlue = matte(0.05F, 0.05F, 0.9F), kWhite = matte(0.8F, 0.8F, 0.8F);

TEST_F(Pictures, RightIsRightAndUpIsUp) {
  SceneMaker scene;
  scene.body(mesh::make_box(0.2, 0.2, 0.2), {{0, 0.6, 0}, {}}, &kRed);
  scene.body(mesh::make_box(0.2, 0.2, 0.2), {{0, 0, 0.6}, {}}, &kGreen);
  const Image image = take(scene, camera());
  EXPECT_TRUE(reddish(at(image, camera(), {0, 0.6, 0})));
  EXPECT_TRUE(greenish(at(image, camera(), {0, 0, 0.6})));
  // Independently of our own projection: +y lies right of the middle, +z above it.
  int red_right = 0, red_left = 0, green_above = 0, green_below = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const Rgb c = at(image, x, y);
      if (reddish(c)) ++(x > kWidth / 2 ? red_right : red_left);
      if (greenish(c)) ++(y < kHeight / 2 ? green_above : green_below);
    }
  }
  EXPECT_GT(red_right, 200);
  EXPECT_GT(green_above, 200);
  EXPECT_EQ(red_left, 0);
  EXPECT_EQ(green_below, 0);
}

TEST_F(Pictures, SizeOnThePictureIsThatOfAPinholeCamera) {
  SceneMaker scene;
  scene.body(mesh::make_sphere(0.3), {{0, 0, 0}, {}}, &kRed);
  const Image image = take(scene, camera());
  int wide = 0, high = 0;
  for (int x = 0; x < kWidth; ++x) wide += reddish(at(image, x, kHeight / 2)) ? 1 : 0;
  for (int y = 0; y < kHeight; ++y) high += reddish(at(image, kWidth / 2, y)) ? 1 : 0;
  // The sphere's outline is seen at asin(r / d); 0.7 rad fill the height.
  const double expected = kHeight * std::tan(std::asin(0.1)) / std::tan(0.35);
  EXPECT_NEAR(wide, expected, 2.0);
  EXPECT_NEAR(high, expected, 2.0);
}

TEST_F(Pictures, OrthographicCamerasKeepSizes) {
  SceneMaker scene;
  scene.body(mesh::make_box(0.1, 0.5, 0.5), {{0, 0, 0}, {}}, &kRed);
  Camera from = camera();
  from.orthographic_width_m = 2.0;
  for (const double distance : {2.0, 6.0}) {
    from.T_world_camera.position.x = distance;
    const Image image = take(scene, from);
    int wide = 0;
    for (int x = 0; x < kWidth; ++x) wide += reddish(at(image, x, kHeight / 2)) ? 1 : 0;
    EXPECT_NEAR(wide, kWidth * 0.25, 2.0) << distance;
  }
}

TEST_F(Pictures, NearThingsHideFarOnes) {
  SceneMaker scene;
  scene.body(mesh::make_box(0.1, 1.0, 1.0), {{-1.0, 0, 0}, {}}, &kBlue);
  scene.body(mesh::make_box(0.1, 0.2, 0.2), {{1.0, 0, 0}, {}}, &kRed);
  const Image image = take(scene, camera());
  EXPECT_TRUE(reddish(at(image, camera(), {1.05, 0, 0})));
  EXPECT_TRUE(bluish(at(image, camera(), {-0.95, 0.4, 0.0})));
}

TEST_F(Pictures, ClosedBodiesAreSeenFromOutsideAndFromInside) {
  const Camera from = camera();
  mesh::Mesh box = mesh::make_box(1.0, 1.0, 1.0);
  for (const bool wound_inwards : {false, true}) {
    if (wound_inwards) std::reverse(box.submeshes[0].triangles.begin(), box.submeshes[0].triangles.end());
    for (const double x : {0.0, 3.0}) {  // before the camera; around it
      SceneMaker scene;
      scene.body(box, {{x, 0, 0}, {}}, &kRed);
      if (x == 0.0) scene.body(mesh::make_box(0.5, 0.5, 0.5), {}, &kBlue);  // hidden in it
      const Rgb seen = at(take(scene, from), from, {0, 0, 0});
      EXPECT_GT(seen.r, 2 * seen.b) << (wound_inwards ? "inwards" : "outwards") << ", x " << x;
    }
  }
}

TEST_F(Pictures, TransparentThingsShowWhatIsBehindWhateverTheirOrder) {
  mesh::SurfaceMaterial glass = kRed;
  glass.alpha = 0.4F;
  for (const bool glass_first : {true, false}) {
    SceneMaker scene;
    if (glass_first) scene.body(mesh::make_box(0.05, 1, 1), {{1.0, 0, 0}, {}}, &glass);
    scene.body(mesh::make_box(0.1, 1.0, 1.0), {{-1.0, 0, 0}, {}}, &kBlue);
    if (!glass_first) scene.body(mesh::make_box(0.05, 1, 1), {{1.0, 0, 0}, {}}, &glass);
    const Rgb seen = at(take(scene, camera()), camera(), {1.0, 0, 0});
    EXPECT_GT(seen.r, 60) << glass_first;
    EXPECT_GT(seen.b, 60) << glass_first;
  }
}

TEST_F(Pictures, LightsLightTheSideTheyShineOnAndOnlyWithinTheirCone) {
  SceneMaker scene;
  scene.body(mesh::make_box(0.1, 4.0, 4.0), {{0, 0, 0}, {}}, &kWhite);
  // From the viewer's side straight at the wall, cone of 0.2 rad: 0.6 m at 3 m.
  scene.light({{3.0, 0.0, 0.0}, math::from_axis_angle({0, 0, 1}, std::numbers::pi)}, 0.2);
  const Image image = take(scene, camera());
  const Rgb middle = at(image, camera(), {0.05, 0, 0}), inside = at(image, camera(), {0.05, 0.3, 0}),
            outside = at(image, camera(), {0.05, 0.8, 0});
  EXPECT_GT(middle.sum(), outside.sum() + 150);
  EXPECT_GT(inside.sum(), outside.sum() + 40);

  SceneMaker behind;
  behind.body(mesh::make_box(0.1, 4.0, 4.0), {{0, 0, 0}, {}}, &kWhite);
  behind.light({{-3.0, 0.0, 0.0}, {}}, 0.2);
  EXPECT_LT(at(take(behind, camera()), camera(), {0.05, 0, 0}).sum(), middle.sum() - 150);
}

TEST_F(Pictures, AttenuationDimsWithDistance) {
  const auto brightness = [&](double quadratic) {
    SceneMaker scene;
    scene.body(mesh::make_box(0.1, 4.0, 4.0), {{0, 0, 0}, {}}, &kWhite);
    scene.light({{2.0, 0, 0}, math::from_axis_angle({0, 0, 1}, std::numbers::pi)}).beam.attenuation_quadratic =
        quadratic;
    return at(take(scene, camera()), camera(), {0.05, 0, 0}).sum();
  };
  EXPECT_GT(brightness(0.0), brightness(0.3) + 60);
  EXPECT_GT(brightness(0.3), brightness(3.0) + 60);
}

TEST_F(Pictures, ShadowsFallAwayFromTheLightThatAsksForThem) {
  for (const int quality : {0, 1, 5}) {
    SceneMaker scene;
    scene.body(mesh::make_box(4.0, 4.0, 0.1), {{0, 0, -0.55}, {}}, &kWhite);
    scene.body(mesh::make_box(0.4, 0.4, 0.4), {{0, 0, 0.2}, {}}, &kRed);
    // Above on the left (-y): the shadow falls to the right.
    const math::Vec3 from{0.0, -2.0, 3.0}, direction = math::normalized(math::Vec3{0.0, 2.0, -3.0});
    scene.light({from, math::rotation_between({1, 0, 0}, direction)}).beam.shadow_quality = quality;
    Camera above;
    above.T_world_camera = looking_at({0.01, 0, 6.0}, {0, 0, 0});
    const Image image = take(scene, above);
    const int right = at(image, above, {0, 0.5, -0.5}).sum(), left = at(image, above, {0, -0.5, -0.5}).sum();
    if (quality == 0) {
      EXPECT_NEAR(right, left, 60);
    } else {
      EXPECT_LT(right, left - 120) << quality;
    }
  }
}

// Upper left red, upper right green, lower left blue, lower right white.
std::string make_texture() {
  Image image{2, 2, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255}};
  const std::string path = (std::filesystem::temp_directory_path() / "ambf render tëxture.png").string();
  std::string why;
  EXPECT_TRUE(write_png(path, image, why)) << why;
  return path;
}

// A square that faces the viewer, u to the right and v up.
mesh::Mesh textured_square(const std::string& file) {
  mesh::Mesh mesh;
  mesh::Submesh part;
  part.positions = {0, -0.5F, -0.5F, 0, 0.5F, -0.5F, 0, 0.5F, 0.5F, 0, -0.5F, 0.5F};
  part.normals = {1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0};
  part.texcoords = {0, 0, 1, 0, 1, 1, 0, 1};
  part.triangles = {0, 1, 2, 0, 2, 3};
  part.material = 0;
  mesh.submeshes.push_back(part);
  mesh::Material material;
  material.diffuse = {1.0F, 1.0F, 1.0F, 1.0F};
  material.specular = {0.0F, 0.0F, 0.0F, 1.0F};
  material.texture_file = file;
  mesh.materials.push_back(material);
  mesh.bounds = mesh::bounds_of(mesh.submeshes);
  return mesh;
}

TEST_F(Pictures, TexturesAreTheRightWayRound) {
  const std::string path = make_texture();
  SceneMaker scene;
  scene.body(textured_square(path), {}, nullptr);
  const Image image = take(scene, camera());
  EXPECT_TRUE(reddish(at(image, camera(), {0, -0.25, 0.25})));
  EXPECT_TRUE(greenish(at(image, camera(), {0, 0.25, 0.25})));
  EXPECT_TRUE(bluish(at(image, camera(), {0, -0.25, -0.25})));
  EXPECT_GT(at(image, camera(), {0, 0.25, -0.25}).sum(), 400);
  EXPECT_TRUE(diagnostics_.empty());
  std::filesystem::remove(path);
}

// glTF and FBX hold pictures within.
TEST_F(Pictures, TexturesWithinAMeshAreDrawnAsThoseOfFilesAre) {
  const std::string path = make_texture();
  SceneMaker of_file, within;
  of_file.body(textured_square(path), {}, nullptr);
  mesh::Mesh square = textured_square("model.glb*0-5eed");
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  square.pictures["model.glb*0-5eed"] = std::make_shared<const std::string>(bytes.str());
  within.body(std::move(square), {}, nullptr);
  EXPECT_EQ(take(within, camera()).rgba, take(of_file, camera()).rgba);
  EXPECT_TRUE(diagnostics_.empty()) << diagnostics_[0].file << ": " << diagnostics_[0].message;
  std::filesystem::remove(path);
}

TEST_F(Pictures, ATextureThatCannotBeReadIsReportedOnceAndThePlainColourDrawn) {
  SceneMaker scene;
  mesh::Mesh square = textured_square("/no/such/texture.png");
  square.materials[0].diffuse = {0.9F, 0.05F, 0.05F, 1.0F};
  scene.body(std::move(square), {}, nullptr);
  take(scene, camera());
  const Image image = take(scene, camera());
  EXPECT_TRUE(reddish(at(image, camera(), {0, 0, 0})));
  ASSERT_EQ(diagnostics_.size(), 1U);
  EXPECT_EQ(diagnostics_[0].file, "/no/such/texture.png");
}

TEST_F(Pictures, EqualThingsAreOneDrawAndWhatIsOutOfSightNone) {
  SceneMaker scene;
  for (int i = 0; i < 300; ++i) {
    // Half of them behind the camera. Each has a mesh of its own with the same content.
    scene.body(mesh::make_box(0.05, 0.05, 0.05), {{i % 2 == 0 ? 0.0 : 6.0, -0.5 + i / 300.0, 0.0}, {}}, &kRed);
  }
  take(scene, camera());
  const Offscreen::Counts counts = offscreen_->counts();
  EXPECT_EQ(counts.meshes, 1U);
  EXPECT_EQ(counts.batches, 1U);
  EXPECT_EQ(counts.instances_drawn, 150U);
}

TEST_F(Pictures, WhatIsUnloadedLeavesTheCard) {
  const std::string path = make_texture();
  SceneMaker both;
  both.body(textured_square(path), {}, nullptr);
  both.body(mesh::make_sphere(0.1), {{0, 1, 0}, {}}, &kRed);
  take(both, camera());
  EXPECT_EQ(offscreen_->counts().meshes, 2U);
  EXPECT_EQ(offscreen_->counts().textures, 1U);
  SceneMaker one;
  one.body(mesh::make_sphere(0.1), {{0, 0, 0}, {}}, &kRed);
  const Image image = take(one, camera());
  EXPECT_EQ(offscreen_->counts().meshes, 1U);
  EXPECT_EQ(offscreen_->counts().textures, 0U);
  EXPECT_TRUE(reddish(at(image, camera(), {0, 0, 0})));
  std::filesystem::remove(path);
}

TEST_F(Pictures, TheBackgroundIsCalmAndNeverWhite) {
  const Image image = take(SceneMaker(), camera());
  Rgb last = at(image, 10, 0);
  for (int y = 0; y < kHeight; ++y) {
    const Rgb c = at(image, 10, y);
    EXPECT_LT(c.sum(), 690);
    EXPECT_GT(c.sum(), 240);
    EXPECT_LE(std::abs(c.sum() - last.sum()), 24);
    last = c;
  }
}

TEST_F(Pictures, PicturesOfEverySizeWork) {
  SceneMaker scene;
  scene.body(mesh::make_box(0.1, 3.0, 3.0), {}, &kRed);
  for (const auto& [width, height] : {std::pair{1, 1}, std::pair{640, 3}, std::pair{3, 640}, std::pair{1920, 1080}}) {
    Image image;
    std::string why;
    ASSERT_TRUE(offscreen_->picture(*scene.frame(), camera(), width, height, image, diagnostics_, why)) << why;
    EXPECT_EQ(image.rgba.size(), static_cast<std::size_t>(4 * width * height));
    EXPECT_TRUE(reddish(at(image, width / 2, height / 2)));
  }
}

}  // namespace
}  // namespace ambf::render
