// What cameras measure: distances and whose they are, the same whoever draws.
#include "render/pictures/offscreen.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "scenes.h"

namespace ambf::render::testing {
namespace {

constexpr int kWidth = 160, kHeight = 120;

// Looks along -x from x = 2: a box in the middle, a smaller one to the right and further up, nothing else.
struct Scene {
  Scene() {
    const auto red = matte(0.8F, 0.1F, 0.1F), blue = matte(0.1F, 0.1F, 0.8F);
    box = scene.body(mesh::make_box(0.4, 0.4, 0.4), {}, &red);
    small = scene.body(mesh::make_box(0.1, 0.1, 0.1), {{0.0, 0.4, 0.3}, {}}, &blue);
    camera.T_world_camera = {{2.0, 0.0, 0.0}, {}};
    camera.near_m = 0.01;
    camera.far_m = 50.0;
  }
  Shot shot(bool color, bool measured, int width = kWidth, int height = kHeight) const {
    Shot shot;
    shot.camera = camera;
    shot.width = width;
    shot.height = height;
    shot.color = color;
    shot.measured = measured;
    return shot;
  }
  SceneMaker scene;
  Camera camera;
  std::uint32_t box = 0, small = 0;
};

class OffscreenTest : public ::testing::Test {
 protected:
  static std::unique_ptr<Offscreen> open(OffscreenBackend backend, bool overlap = false) {
    std::string why;
    auto offscreen = Offscreen::open(why, backend, overlap);
    EXPECT_NE(offscreen, nullptr) << why;
    return offscreen;
  }
  static Shot take(Offscreen& offscreen, const Scene& scene, Shot shot) {
    std::vector<Shot> shots{std::move(shot)};
    base::Diagnostics diagnostics;
    offscreen.shoot(*scene.scene.frame(), shots, diagnostics);
    EXPECT_EQ(shots[0].failure, "");
    EXPECT_TRUE(diagnostics.empty());
    return shots[0];
  }
  // Where a point of the world is in a picture, in pixels from the upper left corner.
  static std::size_t pixel_of(const Scene& scene, const math::Vec3& point, int width = kWidth, int height = kHeight) {
    const Mat4 m =
        projection_matrix(scene.camera, static_cast<double>(width) / height) * view_matrix(scene.camera.T_world_camera);
    const auto row = [&](std::size_t r) {
      return static_cast<double>(m.m[r]) * point.x + static_cast<double>(m.m[4 + r]) * point.y +
             static_cast<double>(m.m[8 + r]) * point.z + static_cast<double>(m.m[12 + r]);
    };
    const double u = (row(0) / row(3) + 1.0) / 2.0 * width, v = (1.0 - row(1) / row(3)) / 2.0 * height;
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u);
  }
};

TEST_F(OffscreenTest, MeasuresDepthAlongTheViewWithinAMillimetreFarBeyondTheNearPlane) {
  const auto offscreen = open(OffscreenBackend::osmesa);
  for (const double away : {0.5, 2.0, 20.0}) {
    Scene scene;
    scene.camera.T_world_camera.position = {0.2 + away, 0.0, 0.0};
    const Shot shot = take(*offscreen, scene, scene.shot(false, true));
    ASSERT_EQ(shot.depth_m.size(), static_cast<std::size_t>(kWidth * kHeight));
    // Along the view axis: the same in the middle and at the edge of the face.
    EXPECT_NEAR(shot.depth_m[pixel_of(scene, {0.2, 0.0, 0.0})], away, 1e-4);
    EXPECT_NEAR(shot.depth_m[pixel_of(scene, {0.2, 0.15, -0.15})], away, 1e-4);
  }
}

TEST_F(OffscreenTest, TellsWhoseASurfaceIsAndWhereNothingIs) {
  const auto offscreen = open(OffscreenBackend::osmesa);
  const Scene scene;
  const Shot shot = take(*offscreen, scene, scene.shot(false, true));
  EXPECT_EQ(shot.bodies[pixel_of(scene, {0.2, 0.0, 0.0})], scene.box);
  // Right and up in the world is right and up in the picture: the camera looks along -x, so +y is on its right.
  const std::size_t at = pixel_of(scene, {0.05, 0.4, 0.3});
  EXPECT_EQ(shot.bodies[at], scene.small);
  EXPECT_GT(at % kWidth, kWidth / 2);
  EXPECT_LT(at / kWidth, kHeight / 2);
  EXPECT_NEAR(shot.depth_m[at], 1.95, 1e-4);
  EXPECT_EQ(shot.bodies[0], state::kNone);
  EXPECT_EQ(shot.depth_m[0], 0.0F);
}

TEST_F(OffscreenTest, ParallelRaysMeasureTheSameWayRound) {
  const auto offscreen = open(OffscreenBackend::osmesa);
  Scene scene;
  scene.camera.orthographic_width_m = 1.6;
  const Shot shot = take(*offscreen, scene, scene.shot(false, true));
  // 0.01 m a pixel.
  EXPECT_EQ(shot.bodies[60 * kWidth + 80], scene.box);
  EXPECT_EQ(shot.bodies[(60 - 30) * kWidth + 80 + 40], scene.small);
  EXPECT_NEAR(shot.depth_m[(60 - 30) * kWidth + 80 + 40], 1.95, 1e-4);
  EXPECT_EQ(shot.bodies[60 * kWidth + 80 + 19], scene.box);
  EXPECT_EQ(shot.bodies[60 * kWidth + 80 + 21], state::kNone);
}

TEST_F(OffscreenTest, ColourAndMeasuresOfSeveralCamerasComeAtOnceAndUnmixed) {
  const auto offscreen = open(OffscreenBackend::osmesa);
  const Scene scene;
  std::vector<Shot> shots{scene.shot(true, true), scene.shot(true, false, 64, 48), scene.shot(false, true, 64, 48)};
  shots[1].camera.T_world_camera = looking_at({0.0, 0.4, 3.0}, {0.0, 0.4, 0.3});  // the small one from above
  base::Diagnostics diagnostics;
  offscreen->shoot(*scene.scene.frame(), shots, diagnostics);
  const auto rgb = [](const Shot& shot, std::size_t pixel) { return &shot.rgb[3 * pixel]; };
  const std::uint8_t* box = rgb(shots[0], pixel_of(scene, {0.2, 0.0, 0.0}));
  EXPECT_GT(box[0], 2 * box[2]);
  const std::uint8_t* small = rgb(shots[1], 24 * 64 + 32);
  EXPECT_GT(small[2], 2 * small[0]);
  EXPECT_TRUE(shots[1].depth_m.empty());
  EXPECT_TRUE(shots[2].rgb.empty());
  EXPECT_EQ(shots[2].bodies[24 * 64 + 32], scene.box);
  EXPECT_EQ(offscreen->counts().gl_errors, 0U);
}

TEST_F(OffscreenTest, ReadingWhileTheNextIsDrawnGivesTheSamePixels) {
  const Scene scene;
  const Shot at_once = take(*open(OffscreenBackend::osmesa), scene, scene.shot(true, true));
  const auto overlapping = open(OffscreenBackend::osmesa, true);
  for (int i = 0; i < 3; ++i) {
    const Shot later = take(*overlapping, scene, scene.shot(true, true));
    EXPECT_EQ(later.rgb, at_once.rgb);
    EXPECT_EQ(later.depth_m, at_once.depth_m);
    EXPECT_EQ(later.bodies, at_once.bodies);
  }
  EXPECT_EQ(overlapping->counts().gl_errors, 0U);
}

TEST_F(OffscreenTest, EglWithoutADisplayDrawsTheSamePicture) {
  const Scene scene;
  const auto egl = open(OffscreenBackend::egl), osmesa = open(OffscreenBackend::osmesa);
  ASSERT_NE(egl, nullptr);
  const Shot a = take(*egl, scene, scene.shot(true, true)), b = take(*osmesa, scene, scene.shot(true, true));
  std::size_t differing = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) differing += std::abs(a.rgb[i] - b.rgb[i]) > 8 ? 1 : 0;
  EXPECT_LT(differing, a.rgb.size() / 200);
  for (std::size_t i = 0; i < a.depth_m.size(); ++i) {
    if (a.bodies[i] == b.bodies[i]) {
      ASSERT_NEAR(a.depth_m[i], b.depth_m[i], 1e-3);
    }
  }
}

// Run alone, in a process of its own: drivers are looked up once.
TEST_F(OffscreenTest, WhereEglIsBrokenOsmesaDrawsAndThatIsSaidOnce) {
  const auto attempt = [] {
    setenv("__EGL_VENDOR_LIBRARY_DIRS", "/nowhere", 1);  // the dispatching library finds no driver
    std::string why;
    const auto offscreen = Offscreen::open(why, OffscreenBackend::egl);
    if (offscreen == nullptr || !offscreen->in_software()) std::_Exit(1);
    const Scene scene;
    const Shot shot = take(*offscreen, scene, scene.shot(true, true));
    if (shot.rgb != take(*open(OffscreenBackend::osmesa), scene, scene.shot(true, true)).rgb) std::_Exit(2);
    std::fprintf(stderr, "said: %s\n", why.c_str());
    why = "left over";
    if (Offscreen::open(why) == nullptr || !why.empty()) std::_Exit(3);  // nobody asked for a card: all is well
    std::_Exit(0);
  };
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(attempt(), ::testing::ExitedWithCode(0),
              "said: EGL finds no graphics card, nor a renderer of Mesa's; the processor draws by OSMesa instead");
}

TEST_F(OffscreenTest, ACamerasOwnShadersReplaceThoseOfAllBodiesBeforeBlack) {
  const auto folder = std::filesystem::path(::testing::TempDir());
  std::ofstream(folder / "plain.vs") << "#version 120\nvoid main() { gl_Position = ftransform(); }\n";
  std::ofstream(folder / "plain.fs") << "#version 120\nvoid main() { gl_FragColor = vec4(0.0, 1.0, 0.0, 1.0); }\n";
  const auto offscreen = open(OffscreenBackend::osmesa);
  const Scene scene;
  Shot wish = scene.shot(true, true);
  wish.shaders = {(folder / "plain.vs").string(), (folder / "plain.fs").string()};
  const Shot shot = take(*offscreen, scene, wish);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < shot.bodies.size(); ++i) {
    const int green = shot.bodies[i] == state::kNone ? 0 : 255;
    if (shot.rgb[3 * i] > 4 || std::abs(shot.rgb[3 * i + 1] - green) > 4 || shot.rgb[3 * i + 2] > 4) ++wrong;
  }
  EXPECT_LT(wrong, shot.bodies.size() / 50);  // edges are blended
}

TEST_F(OffscreenTest, MemoryForPicturesOfASizeGoesWhenNobodyAsksAnyMore) {
  const auto offscreen = open(OffscreenBackend::osmesa);
  const Scene scene;
  for (int i = 0; i < 5; ++i) take(*offscreen, scene, scene.shot(true, false, 32 + i, 32));
  EXPECT_EQ(offscreen->counts().sizes, 5U);
  for (int i = 0; i < 110; ++i) take(*offscreen, scene, scene.shot(false, true, 16, 16));
  EXPECT_EQ(offscreen->counts().sizes, 1U);
}

TEST_F(OffscreenTest, AnUnknownBackendIsNone) {
  EXPECT_EQ(offscreen_backend("egl"), OffscreenBackend::egl);
  EXPECT_EQ(offscreen_backend("osmesa"), OffscreenBackend::osmesa);
  EXPECT_EQ(offscreen_backend("auto"), OffscreenBackend::automatic);
  EXPECT_FALSE(offscreen_backend("EGL2").has_value());
}

}  // namespace
}  // namespace ambf::render::testing
