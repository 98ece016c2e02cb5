#include "render/navigation/mouse.h"

#include <gtest/gtest.h>

#include "math/rotation.h"
#include "render/camera/camera.h"

namespace ambf::render {
namespace {

View tilted_view() {
  View view;
  view.T_parent_camera = looking_at({2.0, 1.0, 1.5}, {0.0, 0.2, 0.1});
  view.target_distance_m = math::norm(view.T_parent_camera.position - math::Vec3{0.0, 0.2, 0.1});
  return view;
}

// No roll: the camera's right axis stays level.
double roll_of(const View& view) { return right(view.T_parent_camera).z; }

TEST(Mouse, PanMovesTheSceneWithThePointer) {
  const View before = tilted_view();
  const View after = pan(before, 10.0, 5.0, 0.01);
  const math::Vec3 moved = after.T_parent_camera.position - before.T_parent_camera.position;
  EXPECT_NEAR(math::dot(moved, right(before.T_parent_camera)), -0.10, 1e-12);  // pointer right: camera left
  EXPECT_NEAR(math::dot(moved, up(before.T_parent_camera)), 0.05, 1e-12);      // pointer down: camera up
  EXPECT_NEAR(math::dot(moved, backward(before.T_parent_camera)), 0.0, 1e-12);
  EXPECT_EQ(after.T_parent_camera.orientation, before.T_parent_camera.orientation);
}

TEST(Mouse, PanKeepsTheTargetUnderThePointer) {
  View view = tilted_view();
  const double scale = pan_scale(view, 1.0, 0.7, 500.0);
  Camera camera;
  const auto pixel = [&](const math::Vec3& p) {
    camera.T_world_camera = view.T_parent_camera;
    const auto clip = transform(projection_matrix(camera, 2.0) * view_matrix(camera.T_world_camera), p);
    return std::pair{(clip[0] / clip[3] + 1) * 500.0, (1 - clip[1] / clip[3]) * 250.0};
  };
  const math::Vec3 target = target_of(view);
  const auto before = pixel(target);
  view = pan(view, 40.0, -25.0, scale);
  const auto after = pixel(target);
  EXPECT_NEAR(after.first - before.first, 40.0, 0.1);
  EXPECT_NEAR(after.second - before.second, -25.0, 0.1);
}

TEST(Mouse, PanIsNeverFasterThanTheReference) {
  View far = tilted_view();
  far.target_distance_m = 100.0;
  EXPECT_DOUBLE_EQ(pan_scale(far, 1.0, 0.7, 500.0), 0.01);
  EXPECT_DOUBLE_EQ(pan_scale(far, 0.1, 0.7, 500.0), 0.001);
  View close = tilted_view();
  close.target_distance_m = 0.1;
  EXPECT_LT(pan_scale(close, 1.0, 0.7, 500.0), 0.001);
}

TEST(Mouse, LookingTurnsTowardsThePointerWithoutRoll) {
  const View before = tilted_view();
  const View after = look(before, 100.0, -50.0, kLookPerPixel);
  EXPECT_EQ(after.T_parent_camera.position, before.T_parent_camera.position);
  const math::Vec3 ahead = -backward(after.T_parent_camera);
  EXPECT_GT(math::dot(ahead, right(before.T_parent_camera)), 0.3);  // pointer right: look right
  EXPECT_GT(ahead.z, -backward(before.T_parent_camera).z);          // pointer up: look up
  EXPECT_NEAR(roll_of(after), 0.0, 1e-9);
}

TEST(Mouse, LookingIsThreeTenthsOfADegreeAPixel) {
  const View level{{{0, 0, 0}, {}}, 1.0};
  const View after = look(level, 100.0, 0.0, kLookPerPixel);
  EXPECT_NEAR(math::norm(math::log(after.T_parent_camera.orientation)), 30.0 / 57.29578, 1e-6);
}

TEST(Mouse, OrbitKeepsTargetDistanceAndHorizon) {
  View view = tilted_view();
  const math::Vec3 target = target_of(view);
  for (int i = 0; i < 200; ++i) view = orbit(view, 13.0, i % 2 == 0 ? 4.0 : -3.0, kOrbitPerPixel);
  EXPECT_LT(math::norm(target_of(view) - target), 1e-9);
  EXPECT_NEAR(roll_of(view), 0.0, 1e-9);
  EXPECT_NEAR(math::norm(view.T_parent_camera.position - target), view.target_distance_m, 1e-9);
}

TEST(Mouse, OrbitTurnsTheSceneWithThePointer) {
  // Camera on +x: with the pointer going right it moves to -y, so that the scene's front turns to the right.
  const View view = orbit({{{1, 0, 0}, {}}, 1.0}, 50.0, 0.0, kOrbitPerPixel);
  EXPECT_LT(view.T_parent_camera.position.y, -0.1);
  // Pointer down: the camera rises, so that more of the top is seen.
  EXPECT_GT(orbit({{{1, 0, 0}, {}}, 1.0}, 0.0, 50.0, kOrbitPerPixel).T_parent_camera.position.z, 0.1);
}

TEST(Mouse, NothingTurnsOverThePoles) {
  for (const double way : {-1.0, 1.0}) {
    View view{{{1, 0, 0}, {}}, 1.0};
    for (int i = 0; i < 1000; ++i) view = orbit(view, 0.0, 20.0 * way, kOrbitPerPixel);
    EXPECT_NEAR(std::asin(-backward(view.T_parent_camera).z), -way * kPitchLimit_rad, 1e-6);
    EXPECT_GT(up(view.T_parent_camera).z, 0.0);
  }
}

TEST(Mouse, AViewFromStraightAboveCanBeTurnedBack) {
  View view{looking_at({0, 0, 2}, {0, 0, 0}), 2.0};
  const View turned = orbit(view, 0.0, -20.0, kOrbitPerPixel);
  EXPECT_GT(-backward(turned.T_parent_camera).z, -backward(view.T_parent_camera).z + 0.005);
}

TEST(Mouse, WheelGoesForwardsAndNeverThroughTheTarget) {
  View view = tilted_view();
  const math::Vec3 ahead = -backward(view.T_parent_camera);
  const View after = dolly(view, 1.0, 1.0, kMinTargetDistance_m);
  EXPECT_NEAR(math::dot(after.T_parent_camera.position - view.T_parent_camera.position, ahead), 0.1, 1e-12);
  EXPECT_NEAR(after.target_distance_m, view.target_distance_m - 0.1, 1e-12);
  for (int i = 0; i < 500; ++i) view = dolly(view, 1.0, 1.0, kMinTargetDistance_m);
  EXPECT_NEAR(view.target_distance_m, kMinTargetDistance_m, 1e-9);  // it goes on ahead of us
}

}  // namespace
}  // namespace ambf::render
