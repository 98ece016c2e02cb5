// A small canvas without a display for tests that look at pictures: drawn by Mesa, so that everybody's pictures agree.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>

#include "math/rotation.h"
#include "render/pictures/offscreen.h"
#include "scenes.h"

namespace ambf::render::testing {

inline constexpr int kWidth = 320, kHeight = 240;

struct Rgb {
  int r = 0, g = 0, b = 0;
  int sum() const { return r + g + b; }
};

inline Rgb pixel(const Image& image, int x, int y) {
  const auto i = static_cast<std::size_t>(4 * (y * image.width + x));
  return {image.rgba.at(i), image.rgba.at(i + 1), image.rgba.at(i + 2)};
}

inline math::Pose shining(const math::Vec3& from, const math::Vec3& to) {
  return {from, math::rotation_between({1, 0, 0}, math::normalized(to - from))};
}

class OffscreenFixture : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string why;
    offscreen_ = Offscreen::open(why, OffscreenBackend::osmesa);
    ASSERT_NE(offscreen_, nullptr) << why;
  }
  void TearDown() override {
    if (offscreen_ != nullptr) {
      EXPECT_EQ(offscreen_->counts().gl_errors, 0U);
    }
  }
  Image take(const SceneMaker& scene, const math::Vec3& from, const math::Vec3& target = {}) {
    Camera camera;
    camera.T_world_camera = looking_at(from, target);
    Image image;
    std::string why;
    EXPECT_TRUE(offscreen_->picture(*scene.frame(), camera, kWidth, kHeight, image, diagnostics_, why)) << why;
    return image;
  }

  std::unique_ptr<Offscreen> offscreen_;
  base::Diagnostics diagnostics_;
};

}  // namespace ambf::render::testing
