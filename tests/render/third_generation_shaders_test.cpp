// Shaders of the compatibility profile, as suites built on the original bring them: those under tests/render/shaders,
// and those of the suite in AMBF_THIRD_GENERATION_DIR. Judged by what they draw.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "offscreen_fixture.h"
#include "tests/support/compat_models.h"

namespace ambf::render {
namespace {

using testing::matte;
using testing::pixel;
using testing::Rgb;
using testing::SceneMaker;
using testing::shining;

const mesh::SurfaceMaterial kGrey = matte(0.6F, 0.6F, 0.6F), kRed = matte(0.9F, 0.1F, 0.1F);

state::ShaderFiles pair(const std::string& vertex, const std::string& fragment) {
  const std::string folder = std::string(AMBF_SOURCE_DIR) + "/tests/render/shaders/";
  return {folder + vertex + ".vs", folder + fragment + ".fs"};
}

class CompatibilityShaders : public testing::OffscreenFixture {
 protected:
  // A ground that the shaders draw, with a ball of ours above it, lit from straight above; seen from the side.
  static SceneMaker ball_over_ground(const state::ShaderFiles& ground, int shadow_quality) {
    SceneMaker scene;
    scene.shaders = ground;
    scene.body(mesh::make_box(2.0, 2.0, 0.02), {}, &kGrey);
    scene.shaders = {};
    scene.body(mesh::make_sphere(0.15), {{0, 0, 0.4}, {}}, &kRed);
    scene.light(shining({0.0, 0.0, 2.0}, {0, 0, 0})).beam.shadow_quality = shadow_quality;
    return scene;
  }
  struct Ground {
    Rgb under, beside;  // the ball
  };
  Ground ground(const SceneMaker& scene) {
    const Image image = take(scene, {2.0, 0.0, 1.2});
    for (const base::Diagnostic& finding : diagnostics_) ADD_FAILURE() << base::to_string(finding);
    // The middle of the picture is the origin; the ball hangs above it in the picture.
    return {pixel(image, 160, 122), pixel(image, 160 - 70, 122)};
  }
};

TEST_F(CompatibilityShaders, EyePlanesLeadIntoTheShadowMap) {
  const Ground seen = ground(ball_over_ground(pair("eye_planes", "shadow_in_color"), 2));
  EXPECT_EQ(seen.under.sum(), 0);
  EXPECT_EQ(seen.beside.sum(), 3 * 255);
}

TEST_F(CompatibilityShaders, WithoutAShadowMapTheyFindLightEverywhere) {
  const Ground seen = ground(ball_over_ground(pair("eye_planes", "shadow_in_color"), 0));
  EXPECT_EQ(seen.under.sum(), 3 * 255);
  EXPECT_EQ(seen.beside.sum(), 3 * 255);
}

TEST_F(CompatibilityShaders, ShadowsInAlphaDimTheLights) {
  const Ground seen = ground(ball_over_ground(pair("eye_planes", "shadow_in_alpha"), 2));
  EXPECT_NEAR(seen.beside.r, 0.6 * 255, 2);
  EXPECT_NEAR(seen.under.r, 0.5 * seen.beside.r, 2);
}

TEST_F(CompatibilityShaders, BuiltInNamesHaveTheirValues) {
  SceneMaker scene;
  scene.shaders = pair("built_ins", "built_ins");
  scene.body(mesh::make_sphere(0.3), {}, &kRed);
  scene.light(shining({1.0, -1.6, 2.2}, {0, 0, 0}));
  const Rgb middle = pixel(take(scene, {3, 0, 0}), 160, 120);
  for (const base::Diagnostic& finding : diagnostics_) ADD_FAILURE() << base::to_string(finding);
  EXPECT_EQ(middle.r, 0);
  EXPECT_EQ(middle.g, 255);
}

TEST_F(CompatibilityShaders, AnErrorIsOneLineEvenAfterItsBodyCameBack) {
  for (int i = 0; i < 3; ++i) {
    SceneMaker scene;
    if (i != 1) scene.shaders = pair("toon", "broken");
    scene.body(mesh::make_sphere(0.2), {}, &kRed);
    take(scene, {3, 0, 0});
  }
  ASSERT_EQ(diagnostics_.size(), 1U);
  EXPECT_EQ(diagnostics_[0].message.find('\n'), std::string::npos) << diagnostics_[0].message;
  EXPECT_NE(diagnostics_[0].message.find("error"), std::string::npos) << diagnostics_[0].message;
}

class ThirdGenerationShaders : public CompatibilityShaders {
 protected:
  void SetUp() override {
    AMBF_NEEDS_THIRD_GENERATION();
    folder_ = compat::third_generation() / "ambf_shaders";
    CompatibilityShaders::SetUp();
  }
  struct Statistics {
    int colors = 0;     // different ones
    double mean = 0.0;  // of 255, over all channels
  };
  // Of a red ball that the shaders draw, within its outline.
  Statistics ball(const std::string& vertex, const std::string& fragment, Image* whole = nullptr) {
    SceneMaker scene;
    scene.shaders = {(folder_ / vertex).string(), (folder_ / fragment).string()};
    scene.body(mesh::make_sphere(0.3), {}, &kRed);
    // Shaders of pbr/ ignore the lights' strengths and take the square of the distance for granted: near.
    scene.light(shining({1.0, -0.5, 0.8}, {0, 0, 0})).beam.shadow_quality = 2;
    const Image image = take(scene, {2, 0, 0});
    for (const base::Diagnostic& finding : diagnostics_) ADD_FAILURE() << base::to_string(finding);
    if (whole != nullptr) *whole = image;
    std::set<int> colors;
    double sum = 0.0;
    int pixels = 0;
    for (int y = 120 - 40; y <= 120 + 40; ++y) {
      for (int x = 160 - 40; x <= 160 + 40; ++x) {
        if ((x - 160) * (x - 160) + (y - 120) * (y - 120) > 40 * 40) continue;  // the ball's radius is 49
        ++pixels;
        const Rgb seen = pixel(image, x, y);
        colors.insert(65536 * seen.r + 256 * seen.g + seen.b);
        sum += seen.sum() / 3.0;
      }
    }
    return {static_cast<int>(colors.size()), sum / pixels};
  }
  std::filesystem::path folder_;
};

TEST_F(ThirdGenerationShaders, ShadeABall) {
  for (const auto& [vertex, fragment] :
       {std::pair{"shader.vs", "shader.fs"}, std::pair{"normal_map/shader.vs", "normal_map/shader.fs"},
        std::pair{"normal_map/shader0.vs", "normal_map/shader0.fs"}, std::pair{"pbr/shader.vs", "pbr/shader.fs"},
        std::pair{"pbr_textured/shader.vs", "pbr_textured/shader.fs"}}) {
    Image image;
    const Statistics seen = ball(vertex, fragment, &image);
    EXPECT_GT(seen.colors, 50) << fragment;  // shaded, neither black nor burnt out
    EXPECT_GT(seen.mean, 10.0) << fragment;
    EXPECT_LT(seen.mean, 230.0) << fragment;
    EXPECT_GT(pixel(image, 185, 100).sum(), pixel(image, 135, 145).sum())
        << fragment << ": the lit side is the bright one";
  }
}

TEST_F(ThirdGenerationShaders, MaskABallInItsColor) {
  const Statistics seen = ball("preprocessing/shader.vs", "preprocessing/shader.fs");
  EXPECT_EQ(seen.colors, 1);
  EXPECT_NEAR(seen.mean, (230 + 26 + 26) / 3.0, 1.0);
}

}  // namespace
}  // namespace ambf::render
