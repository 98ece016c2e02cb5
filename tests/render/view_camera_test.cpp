#include "render/view_camera.h"

#include <gtest/gtest.h>

#include "fake_control.h"
#include "render/motion.h"
#include "scenes.h"

namespace ambf::render {
namespace {

using testing::FakeControl;
using testing::SceneMaker;

constexpr std::int64_t kSecond = 1'000'000'000;

class ViewCameraTest : public ::testing::Test {
 protected:
  void follow(const SceneMaker& scene, std::int64_t now_ns) {
    frame_ = scene.frame();
    Motion motion;
    motion.take(*frame_);
    view_.follow(*frame_, motion.at(now_ns), {{0, 0, 0}, 1.0}, 2.0, now_ns);
  }
  FakeControl control_;
  ViewCamera view_{control_};
  std::unique_ptr<state::Frame> frame_;
};

TEST_F(ViewCameraTest, LooksThroughTheFirstVisibleCamera) {
  SceneMaker scene;
  scene.camera({{1, 0, 0}, {}});
  scene.camera({{2, 0, 0}, {}});
  scene.structure->cameras[0].visible = false;
  scene.structure->cameras[1].field_of_view_rad = 0.5;
  follow(scene, kSecond);
  EXPECT_EQ(view_.name(), "camera1");
  EXPECT_EQ(view_.camera().T_world_camera.position.x, 2.0);
  EXPECT_EQ(view_.camera().field_of_view_rad, 0.5);
  EXPECT_NEAR(view_.view().target_distance_m, 2.0, 1e-12);  // to its look-at, the origin
}

TEST_F(ViewCameraTest, WithoutAnyItFramesTheScene) {
  follow(SceneMaker(), kSecond);
  const Camera& camera = view_.camera();
  EXPECT_GT(math::norm(camera.T_world_camera.position), 1.0);
  EXPECT_GT(math::dot(camera.T_world_camera.position / math::norm(camera.T_world_camera.position),
                      backward(camera.T_world_camera)),
            0.999);
}

TEST_F(ViewCameraTest, TheMouseMovesTheCameraOfTheSimulation) {
  SceneMaker scene;
  scene.camera({{1, 0, 0}, {}});
  follow(scene, kSecond);
  view_.move(pan(view_.view(), 0.0, 100.0, 0.01), kSecond);
  ASSERT_EQ(control_.posted.size(), 1U);
  EXPECT_TRUE(control_.posted[0].command.enabled);
  EXPECT_NEAR(control_.posted[0].command.T_parent_object.position.z, 1.0, 1e-12);
  // Seen at once, though the simulation has not answered yet.
  follow(scene, kSecond + 10'000'000);
  EXPECT_NEAR(view_.camera().T_world_camera.position.z, 1.0, 1e-12);
}

TEST_F(ViewCameraTest, FollowsWhenOthersMoveIt) {
  SceneMaker scene;
  scene.camera({{1, 0, 0}, {}});
  follow(scene, kSecond);
  view_.move(pan(view_.view(), 0.0, 100.0, 0.01), kSecond);
  scene.cameras[0].position = {5, 6, 7};
  follow(scene, 2 * kSecond);
  EXPECT_EQ(view_.camera().T_world_camera.position.y, 6.0);
  // And the next gesture goes on from there.
  view_.move(pan(view_.view(), 0.0, 100.0, 0.01), 2 * kSecond);
  EXPECT_NEAR(control_.posted.back().command.T_parent_object.position.z, 8.0, 1e-12);
}

TEST_F(ViewCameraTest, ACameraOnAMovingBodyIsMovedInItsParentsFrame) {
  SceneMaker scene;
  scene.camera({{1, 0, 0}, {}});
  follow(scene, kSecond);
  frame_ = scene.frame();
  frame_->cameras[0].T_world_camera = {{11, 0, 0}, {}};  // the parent is at x = 10
  Motion motion;
  motion.take(*frame_);
  view_.follow(*frame_, motion.at(0), {{}, 1.0}, 2.0, kSecond);
  EXPECT_EQ(view_.camera().T_world_camera.position.x, 11.0);
  view_.move(dolly(view_.view(), -1.0, 1.0, 0.1), kSecond);
  EXPECT_NEAR(control_.posted[0].command.T_parent_object.position.x, 1.1, 1e-9);
}

TEST_F(ViewCameraTest, ResetBringsAllCamerasBack) {
  SceneMaker scene;
  scene.camera({{1, 0, 0}, {}});
  scene.camera({{2, 0, 0}, {}});
  follow(scene, kSecond);
  scene.cameras[0].position.x = scene.cameras[1].position.x = 9.0;
  follow(scene, 2 * kSecond);
  view_.reset_all(*frame_, 2 * kSecond);
  ASSERT_EQ(control_.posted.size(), 2U);
  EXPECT_EQ(control_.posted[0].command.T_parent_object.position.x, 1.0);
  EXPECT_EQ(control_.posted[1].command.T_parent_object.position.x, 2.0);
}

TEST_F(ViewCameraTest, WhenItsCameraIsUnloadedAnotherOneServes) {
  SceneMaker two;
  two.camera({{1, 0, 0}, {}});
  follow(two, kSecond);
  SceneMaker other;
  other.body(mesh::make_box(1, 1, 1), {}, nullptr);  // so that the camera's id is another one
  other.camera({{3, 0, 0}, {}});
  follow(other, 2 * kSecond);
  EXPECT_EQ(view_.camera().T_world_camera.position.x, 3.0);
  follow(SceneMaker(), 3 * kSecond);
  EXPECT_EQ(view_.name(), "view");
}

}  // namespace
}  // namespace ambf::render
