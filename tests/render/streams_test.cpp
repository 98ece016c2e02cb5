// What cameras publish: where points are in pictures, which pictures are due, noise.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "render/camera/intrinsics.h"
#include "render/pictures/detail/depth_noise.h"
#include "render/pictures/detail/stream_schedule.h"
#include "scenes.h"

namespace ambf::render::testing {
namespace {

using state::Eye;

// ---- intrinsics ----------------------------------------------------------------------------------------------------

// By OpenGL: in pixels whose centres are at whole numbers.
std::array<double, 2> drawn_at(const Camera& camera, const math::Vec3& point, int width, int height) {
  const Mat4 m = projection_matrix(camera, static_cast<double>(width) / height) * view_matrix(camera.T_world_camera);
  const auto clip = transform(m, point);
  return {(clip[0] / clip[3] + 1.0) / 2.0 * width - 0.5, (1.0 - clip[1] / clip[3]) / 2.0 * height - 0.5};
}

std::array<double, 2> calculated_at(const state::Intrinsics& in, const math::Vec3& in_camera) {
  const double x = in_camera.y, y = -in_camera.z, z = in.orthographic ? 1.0 : -in_camera.x;
  return {(in.fx * x + in.skew * y) / z + in.cx, in.fy * y / z + in.cy};
}

TEST(Intrinsics, SayWherePointsAreDrawnForEveryKindOfCamera) {
  Camera middle;
  middle.T_world_camera = looking_at({1.0, -2.0, 0.7}, {0.2, 0.1, 0.3});
  state::Lens lens;
  lens.eye_separation_m = 0.06;
  lens.focal_length_m = 0.8;
  const state::Optics aside{.focal_ratio = 1.25, .axis_right = 0.15, .axis_down = -0.1, .skew = 0.05};
  for (const double width_m : {0.0, 2.5}) {
    middle.orthographic_width_m = width_m;
    for (const state::Optics& optics : {state::Optics{}, aside}) {
      middle.optics = optics;
      for (const Eye eye : {Eye::middle, Eye::left, Eye::right}) {
        const Camera camera = eye_of(middle, lens, eye);
        const state::Intrinsics in = intrinsics_of(camera, 640, 400);
        for (const math::Vec3& point :
             {math::Vec3{0.3, 0.2, 0.1}, math::Vec3{0.0, -0.4, 0.5}, math::Vec3{0.5, 0, 0.9}}) {
          const auto drawn = drawn_at(camera, point, 640, 400);
          const auto calculated = calculated_at(in, math::inverse(camera.T_world_camera) * point);
          EXPECT_NEAR(drawn[0], calculated[0], 0.01) << width_m;
          EXPECT_NEAR(drawn[1], calculated[1], 0.01) << width_m;
        }
      }
    }
  }
}

TEST(Intrinsics, OfAFilesResolutionAreTheFilesOnes) {
  Camera camera;
  camera.field_of_view_rad = 2.0 * std::atan(0.48);
  camera.optics = {.focal_ratio = 1.2, .axis_right = 0.1, .axis_down = -0.05, .skew = -0.04};
  const state::Intrinsics in = intrinsics_of(camera, 640, 480), half = intrinsics_of(camera, 320, 240);
  EXPECT_NEAR(in.fx, 600.0, 1e-9);
  EXPECT_NEAR(in.fy, 500.0, 1e-9);
  EXPECT_NEAR(in.cx, 368.0 - 0.5, 1e-9) << "from the first pixel's middle, not the picture's edge";
  EXPECT_NEAR(in.cy, 216.0 - 0.5, 1e-9);
  EXPECT_NEAR(in.skew, -20.0, 1e-9);
  EXPECT_NEAR(half.fx, 300.0, 1e-9);
  EXPECT_NEAR(half.cx, 184.0 - 0.5, 1e-9);
}

TEST(StereoEyes, SeeTheSamePlaceAtTheFocalLengthAndAreApartByTheirSeparation) {
  Camera middle;  // looks along -x
  state::Lens lens;
  lens.eye_separation_m = 0.1;
  lens.focal_length_m = 2.0;
  const Camera left = eye_of(middle, lens, Eye::left), right = eye_of(middle, lens, Eye::right);
  EXPECT_NEAR(right.T_world_camera.position.y - left.T_world_camera.position.y, 0.1, 1e-12);
  EXPECT_NEAR(drawn_at(left, {-2.0, 0.3, 0.2}, 640, 480)[0], drawn_at(right, {-2.0, 0.3, 0.2}, 640, 480)[0], 1e-3);
  // What is nearer is further right for the left eye.
  EXPECT_GT(drawn_at(left, {-1.0, 0, 0}, 640, 480)[0], drawn_at(right, {-1.0, 0, 0}, 640, 480)[0] + 5.0);
  EXPECT_LT(drawn_at(left, {-4.0, 0, 0}, 640, 480)[0], drawn_at(right, {-4.0, 0, 0}, 640, 480)[0] - 5.0);
}

// ---- schedule ------------------------------------------------------------------------------------------------------

struct FakeSink final : state::PictureSink {
  state::PictureWishes wishes(state::ObjectId) const override { return now; }
  void post(state::Picture) override {}
  state::PictureWishes now;
};

class ScheduleTest : public ::testing::Test {
 protected:
  ScheduleTest() {
    scene.camera({});
    info().image = {true, 1, 640, 480};
    info().depth = {true, 3, 320, 240};
  }
  state::CameraInfo& info() { return scene.structure->cameras[0]; }
  std::vector<StreamOrder> due(bool all = false) { return schedule.due(*scene.frame(), sink, all); }
  SceneMaker scene;
  FakeSink sink;
  StreamSchedule schedule;
};

TEST_F(ScheduleTest, NothingIsDrawnThatNobodyWants) {
  EXPECT_TRUE(due().empty());
  EXPECT_FALSE(anything_wanted(*scene.structure, sink));
  sink.now.color[0] = true;
  EXPECT_TRUE(anything_wanted(*scene.structure, sink));
  ASSERT_EQ(due().size(), 1U);
  info().image.on = info().depth.on = false;
  EXPECT_TRUE(due().empty());
  EXPECT_FALSE(anything_wanted(*scene.structure, sink));
}

TEST_F(ScheduleTest, EveryNthSceneUpdateAsTheFileSays) {
  sink.now.color[0] = sink.now.depth = true;
  info().image.interval = 2;
  int images = 0, depths = 0;
  for (int i = 0; i < 12; ++i) {
    for (const StreamOrder& order : due()) {
      images += order.color ? 1 : 0;
      depths += order.depth ? 1 : 0;
      EXPECT_EQ(order.width, order.color ? 640U : 320U);
    }
  }
  EXPECT_EQ(images, 6);
  EXPECT_EQ(depths, 4);
}

TEST_F(ScheduleTest, OfAWorldThatStandsStillEverythingIsShown) {
  info().image.interval = 1000;
  sink.now.color[0] = true;
  due();
  EXPECT_TRUE(due().empty());
  EXPECT_EQ(due(true).size(), 1U);
}

TEST_F(ScheduleTest, PictureMaskAndDepthOfOneSizeAreDrawnOnce) {
  info().depth = {true, 1, 640, 480};
  sink.now.color[0] = sink.now.mask = sink.now.depth = sink.now.depth_color = true;
  const std::vector<StreamOrder> orders = due();
  ASSERT_EQ(orders.size(), 1U);
  EXPECT_TRUE(orders[0].color && orders[0].mask && orders[0].depth && orders[0].depth_color);
}

TEST_F(ScheduleTest, WhereACameraIsCostsNoPicture) {
  sink.now.geometry[0] = true;
  const std::vector<StreamOrder> orders = due();
  ASSERT_EQ(orders.size(), 1U);
  EXPECT_TRUE(orders[0].color_geometry);
  EXPECT_FALSE(orders[0].draws());
}

TEST_F(ScheduleTest, OnlyStereoCamerasHaveEyes) {
  sink.now.color = {false, true, true};
  EXPECT_TRUE(due().empty());
  auto frame = scene.frame();
  frame->cameras[0].lens.stereo = true;
  const std::vector<StreamOrder> orders = schedule.due(*frame, sink, false);
  ASSERT_EQ(orders.size(), 2U);
  EXPECT_EQ(orders[0].eye, Eye::left);
  EXPECT_EQ(orders[1].eye, Eye::right);
}

// ---- noise ---------------------------------------------------------------------------------------------------------

TEST(DepthNoise, HasTheMeanDeviationAndBiasThatAreAskedForAndLeavesEmptyPixelsAlone) {
  std::vector<float> depth(100'001, 2.0F);
  depth[7] = std::numeric_limits<float>::quiet_NaN();
  add_noise(depth, {true, 0.1, 0.02, -0.03}, 42);
  EXPECT_TRUE(std::isnan(depth[7]));
  depth[7] = 2.07F;
  const double n = static_cast<double>(depth.size());
  const double mean = std::accumulate(depth.begin(), depth.end(), 0.0) / n;
  double square = 0.0, beyond = 0.0;
  for (const float z : depth) {
    square += (z - mean) * (z - mean);
    beyond += std::abs(z - mean) > 0.04 ? 1.0 : 0.0;
  }
  EXPECT_NEAR(mean, 2.07, 4 * 0.02 / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(square / n), 0.02, 2e-4);
  EXPECT_NEAR(beyond / n, 0.0455, 0.003);  // of a normal distribution beyond two deviations
}

TEST(DepthNoise, IsTheSameForTheSameStepAndCameraOnly) {
  SceneMaker scene;
  scene.camera({});
  scene.camera({});
  auto frame = scene.frame();
  const auto noisy = [&](std::uint32_t camera) {
    std::vector<float> depth(1000, 1.0F);
    add_noise(depth, {true, 0.0, 0.01, 0.0}, noise_seed(*frame, camera));
    return depth;
  };
  const std::vector<float> first = noisy(0);
  EXPECT_EQ(noisy(0), first);
  EXPECT_NE(noisy(1), first);
  frame->sim_step = 1;
  EXPECT_NE(noisy(0), first);
}

}  // namespace
}  // namespace ambf::render::testing
