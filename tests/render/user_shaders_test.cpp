// Old-style shaders of users (tests/render/shaders), drawn: for bodies, worlds and skies.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "offscreen_fixture.h"
#include "reference_picture.h"
#include "render/camera/intrinsics.h"

namespace ambf::render {
namespace {

using testing::matches_reference;
using testing::matte;
using testing::pixel;
using testing::Rgb;
using testing::SceneMaker;
using testing::shining;

std::string shader(const std::string& name) { return std::string(AMBF_SOURCE_DIR) + "/tests/render/shaders/" + name; }
state::ShaderFiles pair(const std::string& name) { return {shader(name + ".vs"), shader(name + ".fs")}; }

const mesh::SurfaceMaterial kRed = matte(0.9F, 0.1F, 0.1F), kBlue = matte(0.1F, 0.2F, 0.8F);

class UserShaders : public testing::OffscreenFixture {
 protected:
  UserShaders() { std::filesystem::create_directories(folder_); }
  ~UserShaders() override { std::filesystem::remove_all(folder_); }
  std::string write(const std::string& name, const Image& image) const {
    std::string why;
    EXPECT_TRUE(write_png((folder_ / name).string(), image, why)) << why;
    return (folder_ / name).string();
  }
  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("ambf user shaders " + std::to_string(getpid()));
};

mesh::Mesh square(const std::string& texture, const std::string& normal_map) {
  mesh::Mesh mesh = testing::square(4.0F);
  mesh.materials[0].diffuse = {0.4F, 0.6F, 0.5F, 1.0F};
  mesh.materials[0].texture_file = texture;
  mesh.materials[0].normal_map_file = normal_map;
  return mesh;
}

TEST_F(UserShaders, ThreeOldOnesDrawTheirBodies) {
  Image domes{64, 64, {}}, leaf{2, 2, {40, 160, 60, 255, 200, 220, 60, 255, 200, 220, 60, 255, 40, 160, 60, 255}};
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const double u = (x + 0.5) / 32.0 - 1.0, v = 1.0 - (y + 0.5) / 32.0;
      const bool dome = u * u + v * v < 0.7;
      const double n[3] = {dome ? u : 0.0, dome ? v : 0.0, dome ? std::sqrt(1.0 - u * u - v * v) : 1.0};
      for (const double part : n) domes.rgba.push_back(static_cast<std::uint8_t>(127.5 + 127.5 * part));
      domes.rgba.push_back(255);
    }
  }
  SceneMaker scene;
  scene.light(shining({1.0, -1.6, 2.2}, {0, 0, 0}));
  scene.shaders = pair("toon");
  scene.body(mesh::make_sphere(0.3), {{0, -0.7, 0.3}, {}}, &kRed);
  scene.shaders = pair("bumps");
  scene.body(square("", write("domes.png", domes)), {{0, 0.1, 0}, {}}, nullptr);
  scene.shaders = pair("checked");
  scene.body(square(write("leaf.png", leaf), ""), {{-0.6, 0.2, 0.5}, math::from_axis_angle({0, 1, 0}, 1.5)}, nullptr);
  scene.shaders = {};
  scene.body(mesh::make_sphere(0.15), {{0.2, 0.85, 0.15}, {}}, &kBlue);  // ours beside theirs
  EXPECT_TRUE(matches_reference(take(scene, {2.6, 0.3, 1.4}, {0, 0.05, 0.2}), "user_shaders"));
  for (const base::Diagnostic& finding : diagnostics_) ADD_FAILURE() << finding.file << ": " << finding.message;
}

TEST_F(UserShaders, OneThatDoesNotCompileIsReportedOnceWithItsLineAndTheBodyStaysVisible) {
  SceneMaker scene;
  scene.shaders = {shader("toon.vs"), shader("broken.fs")};
  for (int i = 0; i < 3; ++i) scene.body(mesh::make_sphere(0.2), {{0, 0.5 * i - 0.5, 0}, {}}, &kRed);
  take(scene, {3, 0, 0});
  const Image image = take(scene, {3, 0, 0});
  const Rgb middle = pixel(image, 160, 120);
  EXPECT_GT(middle.r, 2 * middle.b);
  ASSERT_EQ(diagnostics_.size(), 1U);
  EXPECT_EQ(diagnostics_[0].severity, base::Severity::error);
  EXPECT_EQ(diagnostics_[0].file, shader("broken.fs"));
  EXPECT_EQ(diagnostics_[0].line, 4);
  EXPECT_NE(diagnostics_[0].message.find("colour"), std::string::npos) << diagnostics_[0].message;
}

TEST_F(UserShaders, AMissingFileIsNamed) {
  SceneMaker scene;
  scene.shaders = {shader("toon.vs"), "/no/such/shader.fs"};
  scene.body(mesh::make_sphere(0.2), {}, &kRed);
  const Rgb middle = pixel(take(scene, {3, 0, 0}), 160, 120);
  EXPECT_GT(middle.r, 2 * middle.b);
  ASSERT_EQ(diagnostics_.size(), 1U);
  EXPECT_EQ(diagnostics_[0].file, "/no/such/shader.fs");
}

TEST_F(UserShaders, TheWorldsDrawBodiesWithoutTheirOwn) {
  SceneMaker scene;
  auto look = std::make_shared<state::WorldLook>();
  look->shaders = pair("mask");
  scene.structure->look = look;
  scene.body(mesh::make_sphere(0.2), {{0, -0.4, 0}, {}}, &kRed);
  scene.shaders = pair("toon");
  scene.body(mesh::make_sphere(0.2), {{0, 0.4, 0}, {}}, &kBlue);
  const Image image = take(scene, {3, 0, 0});
  // The mask shows the file's colour everywhere on the body, the other one shades it.
  EXPECT_EQ(pixel(image, 160 - 44, 120).r, 230);
  EXPECT_EQ(pixel(image, 160 - 44 - 16, 120).r, 230);
  EXPECT_NE(pixel(image, 160 + 44, 120).b, pixel(image, 160 + 44 + 21, 120).b);
}

TEST_F(UserShaders, ACamerasDrawEveryBodyBeforeBlack) {
  SceneMaker scene;
  scene.body(mesh::make_sphere(0.2), {{0, -0.4, 0}, {}}, &kRed);
  scene.shaders = pair("toon");
  scene.body(mesh::make_sphere(0.2), {{0, 0.4, 0}, {}}, &kBlue);
  std::vector<Shot> shots(1);
  shots[0].camera.T_world_camera = {{3, 0, 0}, {}};
  shots[0].width = testing::kWidth;
  shots[0].height = testing::kHeight;
  shots[0].color = true;
  shots[0].shaders = pair("mask");
  offscreen_->shoot(*scene.frame(), shots, diagnostics_);
  const Image image = image_of(shots[0].rgb, testing::kWidth, testing::kHeight);
  EXPECT_EQ(pixel(image, 160 - 44, 120).r, 230);
  EXPECT_EQ(pixel(image, 160 + 44, 120).b, 204);
  EXPECT_EQ(pixel(image, 10, 10).sum(), 0);
}

TEST_F(UserShaders, MultipassCamerasPeelTransparentThingsThatTheyDraw) {
  SceneMaker scene;
  scene.shaders = {shader("mask.vs"), shader("veil.fs")};
  mesh::SurfaceMaterial red = matte(1.0F, 0.0F, 0.0F), blue = matte(0.0F, 0.0F, 1.0F);
  red.alpha = blue.alpha = 0.5F;
  scene.body(mesh::make_box(1.0, 1.0, 1.0), {}, &red);
  scene.body(mesh::make_box(0.5, 0.5, 0.5), {}, &blue);  // within
  std::vector<Shot> shots(1);
  shots[0].camera.T_world_camera = looking_at({3, 0, 0}, {0, 0, 0});
  shots[0].width = testing::kWidth;
  shots[0].height = testing::kHeight;
  shots[0].color = shots[0].multipass = true;
  offscreen_->shoot(*scene.frame(), shots, diagnostics_);
  ASSERT_EQ(shots[0].failure, "");
  EXPECT_TRUE(diagnostics_.empty());
  const Image image = image_of(shots[0].rgb, testing::kWidth, testing::kHeight);
  // Red, blue, blue, red, each half of what is left; then 1/16 of the sky, about 210.
  const Rgb through_all = pixel(image, 160, 120);
  EXPECT_NEAR(through_all.r, 255 * (0.5 + 0.0625) + 13, 6);
  EXPECT_NEAR(through_all.b, 255 * (0.25 + 0.125) + 13, 6);
  const Rgb through_red = pixel(image, 160 - 45, 120);  // two walls, then a quarter of the sky
  EXPECT_NEAR(through_red.r, 255 * 0.75 + 52, 10);
  // Solid things before and behind are respected.
  const mesh::SurfaceMaterial green = matte(0.0F, 1.0F, 0.0F);
  scene.shaders = pair("mask");
  scene.body(mesh::make_box(0.02, 0.3, 0.3), {{1.0, 0, 0}, {}}, &green);
  scene.structure->version += 1'000'000;
  offscreen_->shoot(*scene.frame(), shots, diagnostics_);
  EXPECT_EQ(pixel(image_of(shots[0].rgb, testing::kWidth, testing::kHeight), 160, 120).g, 255);
}

class DepthShaders : public UserShaders {
 protected:
  Shot take_depth(const SceneMaker& scene, const state::ShaderFiles& shaders, double orthographic_width_m = 0.0,
                  const state::Optics& optics = {}) {
    std::vector<Shot> shots(1);
    shots[0].camera.T_world_camera = looking_at({2, 0.3, 0.4}, {0, 0, 0});
    shots[0].camera.orthographic_width_m = orthographic_width_m;
    shots[0].camera.optics = optics;
    shots[0].width = testing::kWidth;
    shots[0].height = testing::kHeight;
    shots[0].measured = true;
    shots[0].depth_shaders = shaders;
    offscreen_->shoot(*scene.frame(), shots, diagnostics_);
    EXPECT_EQ(shots[0].failure, "");
    return shots[0];
  }
  static SceneMaker two_balls() {
    SceneMaker scene;
    scene.body(mesh::make_sphere(0.3), {{0, -0.3, 0}, {}}, &kRed);
    scene.body(mesh::make_sphere(0.3), {{-0.5, 0.4, 0}, {}}, &kBlue);
    return scene;
  }
};

TEST_F(DepthShaders, OneThatInvertsTheProjectionFindsWhatIsMeasured) {
  const state::Optics aside{.focal_ratio = 1.25, .axis_right = 0.15, .axis_down = -0.1, .skew = 0.05};
  for (const auto& [width_m, optics] :
       {std::pair{0.0, state::Optics{}}, std::pair{2.0, state::Optics{}}, std::pair{0.0, aside}}) {
    const Shot shot = take_depth(two_balls(), pair("points"), width_m, optics);
    ASSERT_EQ(shot.points_m.size(), 3 * shot.depth_m.size());
    int seen = 0;
    for (std::size_t i = 0; i < shot.depth_m.size(); ++i) {
      const float z = shot.points_m[3 * i + 2];
      ASSERT_EQ(shot.depth_m[i] == 0.0F, std::isnan(z)) << i;
      if (std::isnan(z)) continue;
      ++seen;
      ASSERT_NEAR(z, shot.depth_m[i], 1e-3) << i;
      const auto column = static_cast<double>(i % testing::kWidth), row = static_cast<double>(i / testing::kWidth);
      const state::Intrinsics in = intrinsics_of(shot.camera, shot.width, shot.height);
      const double along = width_m > 0.0 ? 1.0 : static_cast<double>(z);
      const double down = (row - in.cy) / in.fy;
      ASSERT_NEAR(shot.points_m[3 * i], (column - in.cx - in.skew * down) / in.fx * along, 1e-3);
      ASSERT_NEAR(shot.points_m[3 * i + 1], down * along, 1e-3);
    }
    EXPECT_GT(seen, 1000);
  }
  EXPECT_TRUE(diagnostics_.empty());
}

// Pictures, depths and points agree with what CameraInfo says of an off-centre camera with unequal focal lengths.
TEST_F(DepthShaders, OfAnOffCentreCameraAreWhereItsIntrinsicsSay) {
  const math::Vec3 at[] = {{0, 0.3, 0.25}, {0.4, -0.3, -0.2}, {-0.3, 0.05, 0}};
  SceneMaker scene;
  for (const math::Vec3& point : at) scene.body(mesh::make_sphere(0.06), {point, {}}, &kRed);
  std::vector<Shot> shots(1);
  Shot& shot = shots[0];
  shot.camera.T_world_camera = {{2, 0, 0}, {}};
  shot.camera.optics = {.focal_ratio = 1.25, .axis_right = 0.15, .axis_down = -0.1, .skew = 0.05};
  shot.width = testing::kWidth;
  shot.height = testing::kHeight;
  shot.color = shot.measured = true;
  offscreen_->shoot(*scene.frame(), shots, diagnostics_);
  ASSERT_EQ(shot.failure, "");
  const state::Intrinsics in = intrinsics_of(shot.camera, shot.width, shot.height);
  for (std::uint32_t body = 0; body < std::size(at); ++body) {
    double column = 0.0, row = 0.0, pixels = 0.0, nearest = 1e9, red = 0.0;
    for (std::size_t i = 0; i < shot.bodies.size(); ++i) {
      if (shot.bodies[i] != body) continue;
      pixels += 1.0;
      column += static_cast<double>(i % testing::kWidth);
      row += static_cast<double>(i / testing::kWidth);
      nearest = std::min(nearest, static_cast<double>(shot.depth_m[i]));
      red += shot.rgb[3 * i] > shot.rgb[3 * i + 2] + 40 ? 1.0 : 0.0;
    }
    const double x = at[body].y, y = -at[body].z, z = 2.0 - at[body].x;
    EXPECT_NEAR(column / pixels, (in.fx * x + in.skew * y) / z + in.cx, 0.5) << body;
    EXPECT_NEAR(row / pixels, in.fy * y / z + in.cy, 0.5) << body;
    EXPECT_GT(red, 0.8 * pixels) << "the picture shows it there";
    EXPECT_NEAR(nearest, z - 0.06, 5e-3);
  }
}

TEST_F(DepthShaders, AnotherOneChangesThePointsAndWhereThereAreAny) {
  const Shot shot = take_depth(two_balls(), {shader("points.vs"), shader("half_range.fs")});
  ASSERT_EQ(shot.points_m.size(), 3 * shot.depth_m.size());
  int seen = 0, hidden = 0;
  for (std::size_t i = 0; i < shot.depth_m.size(); ++i) {
    const bool left = i % testing::kWidth<testing::kWidth / 2, any = shot.depth_m[i]> 0.0F;
    ASSERT_EQ(std::isnan(shot.points_m[3 * i + 2]), left || !any) << i;
    hidden += left && any ? 1 : 0;
    if (left || !any) continue;
    ++seen;
    ASSERT_NEAR(shot.points_m[3 * i + 2], 0.5F * shot.depth_m[i], 1e-3) << i;
  }
  EXPECT_GT(seen, 500);
  EXPECT_GT(hidden, 500);
  EXPECT_TRUE(diagnostics_.empty());
}

TEST_F(DepthShaders, OneThatDoesNotCompileIsReportedOnceAndDepthIsMeasured) {
  const state::ShaderFiles broken{shader("points.vs"), shader("broken.fs")};
  take_depth(two_balls(), broken);
  const Shot shot = take_depth(two_balls(), broken);
  EXPECT_TRUE(shot.points_m.empty());
  EXPECT_GT(*std::max_element(shot.depth_m.begin(), shot.depth_m.end()), 1.0F);
  ASSERT_EQ(diagnostics_.size(), 1U);
  EXPECT_EQ(diagnostics_[0].severity, base::Severity::error);
  EXPECT_EQ(diagnostics_[0].file, shader("broken.fs"));
  EXPECT_EQ(diagnostics_[0].line, 4);
  EXPECT_EQ(diagnostics_[0].hint, "depth is measured as without it meanwhile");
}

// Each face of one colour with a white upper left quarter.
Image face(int r, int g, int b) {
  Image image{16, 16, {}};
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      const bool mark = x < 8 && y < 8;
      for (const int value : {mark ? 255 : r, mark ? 255 : g, mark ? 255 : b, 255}) {
        image.rgba.push_back(static_cast<std::uint8_t>(value));
      }
    }
  }
  return image;
}

class Skies : public UserShaders {
 protected:
  // In front (-x) red, right (+y) green, back cyan, left magenta, top yellow, bottom blue.
  state::Skybox skybox() const {
    state::Skybox sky;
    sky.front = write("front.png", face(200, 0, 0));
    sky.right = write("right.png", face(0, 160, 0));
    sky.back = write("back.png", face(0, 160, 160));
    sky.left = write("left.png", face(160, 0, 160));
    sky.top = write("top.png", face(180, 180, 0));
    sky.bottom = write("bottom.png", face(0, 0, 180));
    return sky;
  }
  static SceneMaker under(const state::Skybox& sky) {
    SceneMaker scene;
    auto look = std::make_shared<state::WorldLook>();
    look->skybox = sky;
    scene.structure->look = look;
    return scene;
  }
  // The four quarters around the middle of what is seen in a direction: upper left, upper right, lower left.
  std::array<Rgb, 3> quarters(const SceneMaker& scene, const math::Vec3& direction) {
    const Image image = take(scene, {0, 0, 0}, direction);
    return {pixel(image, 100, 60), pixel(image, 220, 60), pixel(image, 100, 180)};
  }
  void expect_faces(const SceneMaker& scene) {
    struct Side {
      math::Vec3 direction;
      Rgb color;
    };
    for (const Side& side : {Side{{-1, 0, 0}, {200, 0, 0}}, Side{{0, 1, 0}, {0, 160, 0}},
                             Side{{1, 0, 0}, {0, 160, 160}}, Side{{0, -1, 0}, {160, 0, 160}}}) {
      const auto [upper_left, upper_right, lower_left] = quarters(scene, side.direction);
      EXPECT_GT(upper_left.sum(), 720) << side.direction.x << ' ' << side.direction.y;
      for (const Rgb& seen : {upper_right, lower_left}) {
        EXPECT_NEAR(seen.r, side.color.r, 6) << side.direction.x << ' ' << side.direction.y;
        EXPECT_NEAR(seen.g, side.color.g, 6) << side.direction.x << ' ' << side.direction.y;
        EXPECT_NEAR(seen.b, side.color.b, 6) << side.direction.x << ' ' << side.direction.y;
      }
    }
    EXPECT_NEAR(pixel(take(scene, {0, 0, 0}, {0.2, 0.3, 1}), 170, 130).b, 0, 6);  // yellow above
    EXPECT_NEAR(pixel(take(scene, {0, 0, 0}, {0.2, 0.3, -1}), 170, 130).b, 180, 6);
  }
};

TEST_F(Skies, FrontIsAheadAlongMinusXAndPicturesStandUpright) {
  expect_faces(under(skybox()));
  EXPECT_TRUE(diagnostics_.empty());
}

TEST_F(Skies, UsersShadersDrawThemToo) {
  state::Skybox sky = skybox();
  sky.shaders = pair("sky");
  expect_faces(under(sky));
  for (const base::Diagnostic& finding : diagnostics_) ADD_FAILURE() << finding.file << ": " << finding.message;
}

TEST_F(Skies, AreMirroredByPolishedThings) {
  SceneMaker scene = under(skybox());
  mesh::SurfaceMaterial polished = matte(0.1F, 0.1F, 0.1F);
  for (float& c : polished.specular) c = 1.0F;
  polished.shininess = 250.0F;
  scene.body(mesh::make_sphere(0.5), {}, &polished);
  scene.light(shining({1.0, -1.6, 2.2}, {0, 0, 0}));
  EXPECT_TRUE(matches_reference(take(scene, {2.5, 0.8, 0.6}), "skybox"));
}

TEST_F(Skies, WithAPictureThatCannotBeReadThereIsNone) {
  state::Skybox sky = skybox();
  sky.top = "/no/such/top.png";
  const Image image = take(under(sky), {0, 0, 0}, {-1, 0, 0});
  EXPECT_GT(pixel(image, 170, 130).g, 100);  // the plain gradient
  ASSERT_EQ(diagnostics_.size(), 1U);
  EXPECT_EQ(diagnostics_[0].file, "/no/such/top.png");
}

}  // namespace
}  // namespace ambf::render
