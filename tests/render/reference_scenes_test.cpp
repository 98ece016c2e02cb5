// Scenes whose pictures are compared with committed ones (tests/render/reference). Look at each when it changes.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "offscreen_fixture.h"
#include "reference_picture.h"

namespace ambf::render {
namespace {

using testing::kHeight;
using testing::kWidth;
using testing::matches_reference;
using testing::matte;
using testing::SceneMaker;
using testing::shining;

class ReferenceScenes : public testing::OffscreenFixture {
 protected:
  void TearDown() override {
    EXPECT_TRUE(diagnostics_.empty());
    OffscreenFixture::TearDown();
  }
};

mesh::SurfaceMaterial polished(float r, float g, float b) {
  mesh::SurfaceMaterial material = matte(r, g, b);
  for (float& c : material.specular) c = 1.0F;
  return material;
}

// Tall and flat things on a table, so that shadows fall near and far from what throws them.
SceneMaker table() {
  SceneMaker scene;
  const mesh::SurfaceMaterial white = matte(0.85F, 0.85F, 0.82F), red = polished(0.8F, 0.15F, 0.1F),
                              blue = polished(0.1F, 0.3F, 0.7F), green = matte(0.2F, 0.6F, 0.3F);
  scene.body(mesh::make_box(2.0, 2.0, 0.1), {{0, 0, -0.05}, {}}, &white);
  scene.body(mesh::make_cylinder(0.06, 0.7, mesh::Axis::z), {{-0.3, -0.35, 0.35}, {}}, &red);
  scene.body(mesh::make_sphere(0.18), {{0.25, 0.05, 0.18}, {}}, &blue);
  scene.body(mesh::make_box(0.25, 0.25, 0.25), {{-0.2, 0.45, 0.125}, math::from_axis_angle({0, 0, 1}, 0.5)}, &green);
  return scene;
}

mesh::SurfaceMaterial metal(float r, float g, float b, float shininess) {
  mesh::SurfaceMaterial material = polished(r, g, b);
  material.metallic = 1.0F;
  material.shininess = shininess;
  return material;
}

TEST_F(ReferenceScenes, MetalsMirrorARoomInTheirOwnColour) {
  const mesh::SurfaceMaterial white = matte(0.85F, 0.85F, 0.82F), steel = metal(0.72F, 0.73F, 0.74F, 200.0F),
                              brass = metal(0.82F, 0.68F, 0.42F, 90.0F), dull = metal(0.8F, 0.81F, 0.82F, 8.0F),
                              plastic = polished(0.72F, 0.73F, 0.74F);
  const auto scene = [&](const mesh::SurfaceMaterial& post) {
    SceneMaker out;
    out.body(mesh::make_box(2.0, 2.0, 0.1), {{0, 0, -0.05}, {}}, &white);
    out.body(mesh::make_cylinder(0.12, 0.7, mesh::Axis::z), {{0, -0.6, 0.35}, {}}, &post);
    out.body(mesh::make_sphere(0.2), {{0, -0.15, 0.2}, {}}, &brass);
    out.body(mesh::make_sphere(0.2), {{0, 0.3, 0.2}, {}}, &dull);
    out.body(mesh::make_box(0.02, 0.3, 0.4), {{-0.1, 0.7, 0.2}, {}}, &steel);
    out.light(shining({1.0, -1.6, 2.2}, {0, 0, 0}));
    return out;
  };
  const Image metals = take(scene(steel), {2.4, 0.1, 1.0}, {0, 0.05, 0.25});
  EXPECT_TRUE(matches_reference(metals, "metals"));
  // Across a post of plastic the light falls off once; steel shows bright and dark stripes: it turns several times.
  const auto turns = [](const Image& image) {
    int count = 0, last = testing::pixel(image, 56, 110).sum(), way = 0;
    for (int x = 57; x < 84; ++x) {
      const int now = testing::pixel(image, x, 110).sum(), change = now - last > 15 ? 1 : last - now > 15 ? -1 : 0;
      if (change == 0) continue;
      if (way != 0 && change != way) ++count;
      way = change;
      last = now;
    }
    return count;
  };
  EXPECT_GE(turns(metals), 2);
  EXPECT_LE(turns(take(scene(plastic), {2.4, 0.1, 1.0}, {0, 0.05, 0.25})), 1);
  const testing::Rgb of_brass = testing::pixel(metals, 130, 130);
  EXPECT_GT(of_brass.r, of_brass.b + 30);
}

TEST_F(ReferenceScenes, ShadowsAtEachQuality) {
  for (int quality = 0; quality <= 5; ++quality) {
    SceneMaker scene = table();
    scene.light(shining({1.0, -1.6, 2.2}, {0, 0, 0})).beam.shadow_quality = quality;
    EXPECT_TRUE(matches_reference(take(scene, {2.4, 0.8, 1.5}, {0, 0, 0.15}), "shadows_" + std::to_string(quality)));
  }
}

TEST_F(ReferenceScenes, EveryLightThatAsksThrowsShadows) {
  SceneMaker scene = table();
  scene.light(shining({1.0, -1.6, 2.2}, {0, 0, 0})).beam.shadow_quality = 4;
  scene.light(shining({1.0, 1.8, 2.0}, {0, 0, 0})).beam.shadow_quality = 4;
  EXPECT_TRUE(matches_reference(take(scene, {2.4, 0.2, 1.7}, {0, 0, 0.15}), "shadows_of_two_lights"));
}

TEST_F(ReferenceScenes, PointLightsShineAllAround) {
  SceneMaker scene = table();
  state::Beam& beam = scene.light({{0.0, 0.1, 0.6}, {}}).beam;
  beam.type = state::LightType::point;
  beam.shadow_quality = 5;
  EXPECT_TRUE(matches_reference(take(scene, {2.0, 0.2, 2.2}, {0, 0, 0.1}), "point_light"));
}

TEST_F(ReferenceScenes, DirectionalLightsThrowParallelShadows) {
  SceneMaker scene = table();
  state::Beam& beam = scene.light(shining({0, -1, 1.2}, {0, 0, 0})).beam;
  beam.type = state::LightType::directional;
  beam.shadow_quality = 5;
  EXPECT_TRUE(matches_reference(take(scene, {2.0, 0.2, 2.2}, {0, 0, 0.1}), "directional_light"));
}

TEST_F(ReferenceScenes, TransparentThingsInFrontOfEachOther) {
  SceneMaker scene = table();
  scene.light(shining({1.0, -1.6, 2.2}, {0, 0, 0})).beam.shadow_quality = 4;
  mesh::SurfaceMaterial glass = polished(0.3F, 0.7F, 0.9F), amber = polished(0.9F, 0.6F, 0.1F);
  glass.alpha = amber.alpha = 0.45F;
  scene.body(mesh::make_sphere(0.3), {{0.25, 0.05, 0.31}, {}}, &glass);
  scene.body(mesh::make_box(0.04, 0.9, 0.5), {{0.65, 0.3, 0.26}, {}}, &amber);
  EXPECT_TRUE(matches_reference(take(scene, {2.4, 0.8, 1.0}, {0, 0, 0.2}), "transparency"));
}

// A ball that a sheet cuts through and that holds another: no order of whole things is right.
SceneMaker crossing() {
  SceneMaker scene = table();
  scene.light(shining({1.0, -1.6, 2.2}, {0, 0, 0})).beam.shadow_quality = 4;
  mesh::SurfaceMaterial glass = polished(0.2F, 0.6F, 0.9F), amber = polished(0.95F, 0.55F, 0.05F),
                        rose = polished(0.9F, 0.1F, 0.4F);
  glass.alpha = amber.alpha = rose.alpha = 0.5F;
  scene.body(mesh::make_sphere(0.35), {{0.35, 0.0, 0.4}, {}}, &glass);
  scene.body(mesh::make_sphere(0.12), {{0.35, 0.0, 0.4}, {}}, &rose);
  scene.body(mesh::make_box(0.02, 1.1, 0.5), {{0.45, 0.0, 0.4}, math::from_axis_angle({0, 0, 1}, 0.5)}, &amber);
  return scene;
}

TEST_F(ReferenceScenes, MultipassCamerasSeeTransparentThingsThatCrossEachOtherRight) {
  Camera camera;
  camera.T_world_camera = looking_at({2.4, 0.8, 1.0}, {0, 0, 0.25});
  std::vector<Shot> shots(1);
  shots[0].camera = camera;
  shots[0].width = kWidth;
  shots[0].height = kHeight;
  shots[0].color = shots[0].multipass = true;
  const SceneMaker scene = crossing();
  offscreen_->shoot(*scene.frame(), shots, diagnostics_);
  ASSERT_EQ(shots[0].failure, "");
  const Image image = image_of(shots[0].rgb, kWidth, kHeight);
  EXPECT_TRUE(matches_reference(image, "multipass"));
  // The sheet's right part (in the picture) lies before the ball, its left part inside: there the ball's near side
  // comes first.
  const Image plain = take(scene, {2.4, 0.8, 1.0}, {0, 0, 0.25});
  EXPECT_GT(testing::difference_of(image, plain, 20).share, 0.01);
}

TEST_F(ReferenceScenes, ShadowsAreDrawnOnceForAllCamerasAndOnlyWhenSomethingMoves) {
  SceneMaker scene = table();
  scene.light(shining({1.0, -1.6, 2.2}, {0, 0, 0})).beam.shadow_quality = 3;
  std::vector<Shot> shots(3);
  for (std::size_t i = 0; i < shots.size(); ++i) {
    shots[i].camera.T_world_camera = looking_at({2.0, 0.5 * static_cast<double>(i), 1.0}, {0, 0, 0});
    shots[i].width = shots[i].height = 32;
    shots[i].color = true;
  }
  offscreen_->shoot(*scene.frame(), shots, diagnostics_);
  EXPECT_EQ(offscreen_->counts().shadow_maps, 1U);
  offscreen_->shoot(*scene.frame(), shots, diagnostics_);
  EXPECT_EQ(offscreen_->counts().shadow_maps, 1U);
  scene.bodies[2].position.y += 0.01;
  offscreen_->shoot(*scene.frame(), shots, diagnostics_);
  EXPECT_EQ(offscreen_->counts().shadow_maps, 2U);
  scene.lights[0].position.z += 0.1;
  offscreen_->shoot(*scene.frame(), shots, diagnostics_);
  EXPECT_EQ(offscreen_->counts().shadow_maps, 3U);
}

// A print of black and white stripes of 8 mm along x. A pixel in its middle is 5 to 6 mm.
class Prints : public ReferenceScenes {
 protected:
  Prints() { std::filesystem::create_directories(folder_); }
  ~Prints() override { std::filesystem::remove_all(folder_); }
  Image seen(const Quality& quality, const math::Vec3& from, double aside_m = 0.0) {
    constexpr int kSide = 256, kStripe = 2;
    Image stripes{kSide, kSide, {}};
    for (int i = 0; i < kSide * kSide; ++i) {
      const bool white = i / kSide / kStripe % 2 == 0;
      for (int c = 0; c < 3; ++c) stripes.rgba.push_back(white ? 255 : 0);
      stripes.rgba.push_back(255);
    }
    std::string why;
    EXPECT_TRUE(write_png((folder_ / "stripes.png").string(), stripes, why)) << why;
    mesh::Mesh print = testing::square(1.0F);
    print.materials[0].texture_file = (folder_ / "stripes.png").string();
    print.materials[0].diffuse = {1, 1, 1, 1};
    SceneMaker scene;
    scene.body(std::move(print), {}, nullptr);
    Camera camera;
    camera.T_world_camera = looking_at({from.x, from.y + aside_m, from.z}, {0, aside_m, 0});
    Image image;
    EXPECT_TRUE(offscreen_->picture(*scene.frame(), camera, kWidth, kHeight, image, diagnostics_, why, quality)) << why;
    return image;
  }
  static double level(const Image& image, int x, int y) { return testing::pixel(image, x, y).g; }
  // How much the print's pixels change when the view moves by a third of one, of 255.
  double shimmer(const Quality& quality) {
    const math::Vec3 above{0.01, 0, 1.8};
    const Image here = seen(quality, above), there = seen(quality, above, 0.0018);
    double sum = 0.0;
    for (int y = 100; y < 140; ++y) {
      for (int x = 110; x < 210; ++x) sum += std::abs(level(here, x, y) - level(there, x, y));
    }
    return sum / (40 * 100);
  }
  // How much neighbours along a row differ where the print is seen at a slant: what is left to be read.
  double contrast(const Quality& quality) {
    const Image image = seen(quality, {0.87, 0, 0.15});
    double sum = 0.0;
    for (int y = 112; y < 136; ++y) {
      for (int x = 110; x < 210; ++x) sum += std::abs(level(image, x, y) - level(image, x + 1, y));
    }
    return sum / (24 * 100);
  }
  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("ambf prints " + std::to_string(getpid()));
};

TEST_F(Prints, DoNotShimmerWhenTheViewMovesAndTheBestPicturesKeepMoreOfThem) {
  const Quality window{1, 1024, 1, ShadowFilter::hard, false, false}, best;
  EXPECT_LT(shimmer(window), 25.0);
  EXPECT_GT(contrast(best), 2.0 * contrast(window));
}

mesh::Mesh bumpy_square(const std::string& normal_map) {
  mesh::Mesh mesh = testing::square(8.0F);
  mesh.materials[0].diffuse = {0.7F, 0.5F, 0.35F, 1.0F};
  mesh.materials[0].normal_map_file = normal_map;
  return mesh;
}

// A dome on each tile.
std::string dome_normals(const std::filesystem::path& folder) {
  constexpr int kSide = 64;
  Image image{kSide, kSide, {}};
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const double u = (x + 0.5) / kSide * 2.0 - 1.0, v = 1.0 - (y + 0.5) / kSide * 2.0;
      const bool dome = u * u + v * v < 0.7;
      const double n[3] = {dome ? u : 0.0, dome ? v : 0.0, dome ? std::sqrt(1.0 - u * u - v * v) : 1.0};
      for (const double part : n) image.rgba.push_back(static_cast<std::uint8_t>(127.5 + 127.5 * part));
      image.rgba.push_back(255);
    }
  }
  const std::string path = (folder / "domes.png").string();
  std::string why;
  EXPECT_TRUE(write_png(path, image, why)) << why;
  return path;
}

TEST_F(ReferenceScenes, NormalMapsLookLitFromWhereTheLightIs) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("ambf domes " + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  SceneMaker scene;
  scene.body(bumpy_square(dome_normals(folder)), {}, nullptr);
  scene.light(shining({-1.5, 0.6, 0.8}, {0, 0, 0}));
  EXPECT_TRUE(matches_reference(take(scene, {0.9, 0.0, 0.9}), "normal_map"));
  // A light on the right (+y): of a dome the right side is the brighter one.
  SceneMaker aside;
  aside.body(bumpy_square((folder / "domes.png").string()), {}, nullptr);
  aside.light(shining({0.0, 2.0, 0.5}, {0, 0, 0}));
  const Image image = take(aside, {0.01, 0.0, 1.2});
  const auto brightness = [&](double y_m) {
    // One dome is an eighth of a metre; the camera sees 2 * 1.2 * tan(0.35) = 0.876 m on 240 pixels, y to the right.
    const auto x = static_cast<std::size_t>(kWidth / 2 + y_m / 0.876 * kHeight), y = std::size_t{kHeight / 2 - 16};
    return image.rgba.at(4 * (y * kWidth + x)) + image.rgba.at(4 * (y * kWidth + x) + 1);
  };
  EXPECT_GT(brightness(0.0625 + 0.035), brightness(0.0625 - 0.035) + 60);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace ambf::render
