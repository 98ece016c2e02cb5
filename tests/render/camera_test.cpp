#include "render/camera/camera.h"
#include "render/camera/stereo.h"
#include "render/navigation/framing.h"
#include "render/panel/view_actions.h"

#include <gtest/gtest.h>

#include "math/rotation.h"

namespace ambf::render {
namespace {

TEST(Camera, LooksAlongMinusXWithYToTheRightAndZUp) {
  const Mat4 view = view_matrix({});
  const auto ahead = transform(view, {-1, 0, 0}), aside = transform(view, {0, 1, 0}),
             above = transform(view, {0, 0, 1});
  EXPECT_NEAR(ahead[2], -1.0, 1e-6);  // OpenGL looks along -z
  EXPECT_NEAR(aside[0], 1.0, 1e-6);
  EXPECT_NEAR(above[1], 1.0, 1e-6);
}

TEST(Camera, RaysPassThroughThePointsTheirPixelShows) {
  Camera camera;
  camera.T_world_camera = looking_at({1.0, -2.0, 0.7}, {0.2, 0.1, 0.3});
  for (const double width_m : {0.0, 3.0}) {
    camera.orthographic_width_m = width_m;
    const Mat4 m = projection_matrix(camera, 2.0) * view_matrix(camera.T_world_camera);
    const math::Vec3 point{0.3, 0.2, 0.1};
    const auto clip = transform(m, point);
    const double x = (clip[0] / clip[3] + 1.0) / 2.0 * 800, y = (1.0 - clip[1] / clip[3]) / 2.0 * 400;
    const Ray ray = ray_through(camera, 800, 400, x, y);
    const math::Vec3 along = math::normalized(ray.to - ray.from);
    EXPECT_LT(math::norm(math::cross(point - ray.from, along)), 1e-5) << width_m;
    EXPECT_NEAR(transform(m, ray.from)[2] / transform(m, ray.from)[3], -1.0, 1e-4);  // begins on the near plane
    EXPECT_NEAR(transform(m, ray.to)[2] / transform(m, ray.to)[3], 1.0, 1e-4);       // ends on the far one
  }
}

TEST(Camera, RaysPassThroughThePointsOfAnOffCentrePicture) {
  Camera camera;
  camera.T_world_camera = looking_at({1.0, -2.0, 0.7}, {0.2, 0.1, 0.3});
  camera.optics = {.focal_ratio = 1.3, .axis_right = 0.2, .axis_down = -0.1, .skew = 0.15};
  camera.shift = 0.04;
  const Mat4 m = projection_matrix(camera, 2.0) * view_matrix(camera.T_world_camera);
  for (const math::Vec3& point : {math::Vec3{0.3, 0.2, 0.1}, math::Vec3{-0.4, 0.1, 0.7}}) {
    const auto clip = transform(m, point);
    const double x = (clip[0] / clip[3] + 1.0) / 2.0 * 800, y = (1.0 - clip[1] / clip[3]) / 2.0 * 400;
    const Ray ray = ray_through(camera, 800, 400, x, y);
    EXPECT_LT(math::norm(math::cross(point - ray.from, math::normalized(ray.to - ray.from))), 1e-5);
  }
  // Straight ahead is where the axis is said to be, in heights from the middle.
  const auto ahead = transform(m, camera.T_world_camera * math::Vec3{-1.0, -0.04, 0.0});
  EXPECT_NEAR(0.5 * ahead[0] / ahead[3] * 2.0, 0.2, 1e-6);
  EXPECT_NEAR(-0.5 * ahead[1] / ahead[3], -0.1, 1e-6);
}

TEST(Camera, AWiderPictureShowsMoreAtBothSidesAndNothingElse) {
  Camera camera;
  camera.optics = {.focal_ratio = 0.8, .axis_right = 0.2, .axis_down = 0.1, .skew = 0.0};
  const math::Vec3 point{-2.0, 0.1, 0.2};
  const auto narrow = transform(projection_matrix(camera, 1.0) * view_matrix({}), point),
             wide = transform(projection_matrix(camera, 2.0) * view_matrix({}), point);
  EXPECT_NEAR(narrow[0], 2.0 * wide[0], 1e-6) << "in heights from the middle";
  EXPECT_NEAR(narrow[1], wide[1], 1e-6);
}

TEST(Camera, AnOffCentreOneIsCopiedWithItsIntrinsics) {
  Camera camera;
  camera.field_of_view_rad = 2.0 * std::atan(0.48);
  EXPECT_EQ(as_adf("eye", {}, camera, "").find("intrinsics"), std::string::npos);
  camera.optics = {.focal_ratio = 1.2, .axis_right = 0.1, .axis_down = -0.05, .skew = -0.04};
  const std::string block = as_adf("eye", {}, camera, "");
  EXPECT_NE(block.find("window resolution: {width: 640, height: 480}\n"
                       "camera intrinsics: {fx: 600, fy: 500, cx: 368, cy: 216, s: 20}\n"),
            std::string::npos)
      << block;
}

TEST(Camera, FrustumKeepsWhatTouchesItAndDropsTheRest) {
  Camera camera;
  camera.T_world_camera = {{3, 0, 0}, {}};
  const Frustum frustum(projection_matrix(camera, 1.0) * view_matrix(camera.T_world_camera));
  EXPECT_TRUE(frustum.may_see({{0, 0, 0}, 0.1}));
  EXPECT_TRUE(frustum.may_see({{0, 1.3, 0}, 0.3}));   // crosses the right border (at 1.095 m)
  EXPECT_FALSE(frustum.may_see({{0, 1.6, 0}, 0.3}));  // right of it
  EXPECT_FALSE(frustum.may_see({{0, 0, -2.0}, 0.3}));
  EXPECT_FALSE(frustum.may_see({{4, 0, 0}, 0.5}));   // behind
  EXPECT_FALSE(frustum.may_see({{-9, 0, 0}, 0.5}));  // beyond the far plane
}

// How much of the picture's width and height things take at most, 1: all of it.
double filled(const std::vector<Sphere>& things, const Camera& camera, double aspect) {
  const Mat4 m = projection_matrix(camera, aspect) * view_matrix(camera.T_world_camera);
  double most = 0.0;
  for (const Sphere& thing : things) {
    for (int i = 0; i < 400; ++i) {  // points on the sphere, evenly
      const double z = 1.0 - 2.0 * (i + 0.5) / 400, turn = 2.399963 * i, flat = std::sqrt(1.0 - z * z);
      const math::Vec3 point =
          thing.centre + thing.radius * math::Vec3{flat * std::cos(turn), flat * std::sin(turn), z};
      const auto clip = transform(m, point);
      EXPECT_GT(clip[3], 0.0);
      EXPECT_LT(std::abs(clip[2]), clip[3]) << "between the clipping planes";
      most = std::max({most, std::abs(clip[0] / clip[3]), std::abs(clip[1] / clip[3])});
    }
  }
  return most;
}

TEST(Framing, ShowsEverythingAndNoMoreThanThat) {
  const std::vector<std::vector<Sphere>> scenes = {
      {{{1.0, 2.0, 3.0}, 0.02}},
      {{{1.0, 2.0, 3.0}, 50.0}},
      {{{0.0, 0.0, 0.0}, 0.1}, {{0.0, 0.0, 1.0}, 0.1}},                            // tall
      {{{-2.0, 0.0, 0.0}, 0.1}, {{0.0, 3.0, 0.0}, 0.1}, {{2.0, 0.0, 0.3}, 0.4}}};  // wide
  for (const double aspect : {0.5, 1.0, 3.0}) {
    for (const auto& things : scenes) {
      const double share = filled(things, framing(things, aspect).camera, aspect);
      EXPECT_LT(share, 1.0) << aspect;
      EXPECT_GT(share, 0.85) << aspect;
    }
  }
}

TEST(Framing, OfAnOffCentrePictureShowsEverythingInItsMiddle) {
  const std::vector<Sphere> things = {{{0.0, 0.0, 0.0}, 0.1}, {{0.2, 0.5, 0.7}, 0.3}};
  for (const double aside : {-0.9, 0.3}) {
    Camera like;
    like.optics = {.focal_ratio = 1.4, .axis_right = aside, .axis_down = 0.5 * aside, .skew = 0.1};
    const double share = filled(things, framing(things, 1.5, like).camera, 1.5);
    EXPECT_LT(share, 1.0) << aside;
    EXPECT_GT(share, 0.8) << aside;
  }
}

TEST(Framing, LooksAtTheMiddleOfThings) {
  const std::vector<Sphere> things = {{{5.0, 0.0, 0.0}, 0.5}};
  const Framing all = framing(things, 2.0);
  EXPECT_LT(math::norm(target_of(all.view) - things[0].centre), 0.05);
  EXPECT_GT(up(all.camera.T_world_camera).z, 0.8);  // level
}

TEST(Framing, KeepsTheSideAndTheAngleOfAView) {
  const std::vector<Sphere> things = {{{0.3, -2.0, 0.4}, 0.2}, {{0.1, -2.5, 1.0}, 0.3}};
  Camera from_above;
  from_above.T_world_camera = looking_at({0.1, 0.0, 5.0}, {});
  from_above.field_of_view_rad = 1.1;
  const Camera found = framing(things, 1.6, from_above).camera;
  EXPECT_EQ(found.field_of_view_rad, 1.1);
  EXPECT_NEAR(math::norm(backward(found.T_world_camera) - backward(from_above.T_world_camera)), 0.0, 1e-12);
  EXPECT_LT(filled(things, found, 1.6), 1.0) << "all of them are in the picture";
  EXPECT_GT(filled(things, found, 1.6), 0.8);
}

TEST(Stereo, WhatIsAtTheFocalLengthIsInTheSamePlaceOfBothPicturesAndNearerThingsStandOut) {
  state::Lens lens;
  lens.stereo = true;
  lens.eye_separation_m = 0.06;
  lens.focal_length_m = 0.5;
  const auto eyes = eyes_of({}, lens, 801.0);
  ASSERT_EQ(eyes.size(), 2U);
  EXPECT_EQ(eyes[0].width, 400.0);
  EXPECT_EQ(eyes[1].left, 401.0);
  const auto across = [&](const EyeView& eye, const math::Vec3& point) {  // -1 .. 1
    const auto clip = transform(projection_matrix(eye.camera, 1.0) * view_matrix(eye.camera.T_world_camera), point);
    return clip[0] / clip[3];
  };
  EXPECT_NEAR(across(eyes[0], {-0.5, 0.1, 0.0}), across(eyes[1], {-0.5, 0.1, 0.0}), 1e-6);
  EXPECT_GT(across(eyes[0], {-0.3, 0.0, 0.0}), across(eyes[1], {-0.3, 0.0, 0.0}) + 0.05);
  EXPECT_LT(across(eyes[0], {-2.0, 0.0, 0.0}), across(eyes[1], {-2.0, 0.0, 0.0}) - 0.05);
  // A ray through where a point is seen meets the point.
  const math::Vec3 point{-0.4, 0.05, 0.02};
  for (const EyeView& eye : eyes) {
    const double aspect = eye.width / 300.0;
    const auto clip = transform(projection_matrix(eye.camera, aspect) * view_matrix(eye.camera.T_world_camera), point);
    const Ray ray = ray_through(eye.camera, eye.width, 300.0, (clip[0] / clip[3] + 1.0) / 2.0 * eye.width,
                                (1.0 - clip[1] / clip[3]) / 2.0 * 300.0);
    const math::Vec3 along = math::normalized(ray.to - ray.from);
    EXPECT_LT(math::norm(math::cross(along, point - ray.from)), 1e-6);
  }
  EXPECT_EQ(&eye_at(eyes, 399.0), &eyes[0]);
  EXPECT_EQ(&eye_at(eyes, 401.0), &eyes[1]);
  lens.stereo = false;
  EXPECT_EQ(eyes_of({}, lens, 800.0).size(), 1U);
}

TEST(Camera, SpheresAroundSpheresHoldBoth) {
  const Sphere a{{0, 0, 0}, 1.0}, b{{4, 0, 0}, 0.5};
  const Sphere both = around(a, b);
  EXPECT_NEAR(both.radius, 2.75, 1e-12);
  EXPECT_NEAR(both.centre.x, 1.75, 1e-12);
  EXPECT_EQ(around(a, {{0.2, 0, 0}, 0.1}).radius, 1.0);
  EXPECT_EQ(around({{}, -1.0}, b).centre.x, 4.0);
}

}  // namespace
}  // namespace ambf::render
