#include "render/navigation/view_camera.h"

#include <gtest/gtest.h>

#include <optional>

#include "fake_abilities.h"
#include "render/navigation/camera_homes.h"
#include "render/scene/motion.h"
#include "scenes.h"

namespace ambf::render {
namespace {

using testing::FakeAbilities;
using testing::SceneMaker;

constexpr std::int64_t kSecond = 1'000'000'000;

class ViewCameraTest : public ::testing::Test {
 protected:
  void follow(const SceneMaker& scene, std::int64_t now_ns) {
    frame_ = scene.frame();
    Motion motion;
    motion.take(*frame_);
    view_->follow(*frame_, motion.at(now_ns), {{{0, 0, 0}, 1.0}}, 2.0, now_ns);
  }
  // Looks through the camera in `slot` of the scene.
  void look_through(const SceneMaker& scene, std::size_t slot) {
    view_.emplace(abilities_, abilities_, scene.structure->objects[scene.structure->cameras[slot].object].id);
  }
  FakeAbilities abilities_;
  std::optional<ViewCamera> view_{std::in_place, abilities_, abilities_, state::ObjectId{}};
  std::unique_ptr<state::Frame> frame_;
};

TEST_F(ViewCameraTest, LooksThroughItsCamera) {
  SceneMaker scene;
  scene.camera({{1, 0, 0}, {}});
  scene.camera({{2, 0, 0}, {}});
  scene.structure->cameras[1].lens.field_of_view_rad = 0.5;
  look_through(scene, 1);
  follow(scene, kSecond);
  EXPECT_EQ(view_->camera().T_world_camera.position.x, 2.0);
  EXPECT_EQ(view_->camera().field_of_view_rad, 0.5);
  EXPECT_NEAR(view_->view().target_distance_m, 2.0, 1e-12);  // to its look-at, the origin
}

TEST_F(ViewCameraTest, WithoutAnyItFramesTheScene) {
  follow(SceneMaker(), kSecond);
  const Camera& camera = view_->camera();
  EXPECT_GT(math::norm(camera.T_world_camera.position), 1.0);
  EXPECT_GT(math::dot(camera.T_world_camera.position / math::norm(camera.T_world_camera.position),
                      backward(camera.T_world_camera)),
            0.999);
}

TEST_F(ViewCameraTest, TheMouseMovesTheCameraOfTheSimulation) {
  SceneMaker scene;
  scene.camera({{1, 0, 0}, {}});
  look_through(scene, 0);
  follow(scene, kSecond);
  view_->move(pan(view_->view(), 0.0, 100.0, 0.01), kSecond);
  ASSERT_EQ(abilities_.posted.size(), 1U);
  EXPECT_TRUE(abilities_.posted[0].command.enabled);
  EXPECT_NEAR(abilities_.posted[0].command.T_parent_object.position.z, 1.0, 1e-12);
  // Seen at once, though the simulation has not answered yet.
  follow(scene, kSecond + 10'000'000);
  EXPECT_NEAR(view_->camera().T_world_camera.position.z, 1.0, 1e-12);
}

TEST_F(ViewCameraTest, FollowsWhenOthersMoveIt) {
  SceneMaker scene;
  scene.camera({{1, 0, 0}, {}});
  look_through(scene, 0);
  follow(scene, kSecond);
  view_->move(pan(view_->view(), 0.0, 100.0, 0.01), kSecond);
  scene.cameras[0].position = {5, 6, 7};
  follow(scene, 2 * kSecond);
  EXPECT_EQ(view_->camera().T_world_camera.position.y, 6.0);
  // And the next gesture goes on from there.
  view_->move(pan(view_->view(), 0.0, 100.0, 0.01), 2 * kSecond);
  EXPECT_NEAR(abilities_.posted.back().command.T_parent_object.position.z, 8.0, 1e-12);
}

TEST_F(ViewCameraTest, ACameraOnAMovingBodyIsMovedInItsParentsFrame) {
  SceneMaker scene;
  scene.camera({{1, 0, 0}, {}});
  look_through(scene, 0);
  follow(scene, kSecond);
  frame_ = scene.frame();
  frame_->cameras[0].T_world_camera = {{11, 0, 0}, {}};  // the parent is at x = 10
  Motion motion;
  motion.take(*frame_);
  view_->follow(*frame_, motion.at(0), {}, 2.0, kSecond);
  EXPECT_EQ(view_->camera().T_world_camera.position.x, 11.0);
  view_->move(dolly(view_->view(), -1.0, 1.0, 0.1), kSecond);
  EXPECT_NEAR(abilities_.posted[0].command.T_parent_object.position.x, 1.1, 1e-9);
}

TEST_F(ViewCameraTest, AnotherControllerIsFollowedAsSoonAsTheMouseHasArrived) {
  SceneMaker scene;
  scene.camera({{1, 0, 0}, {}});
  look_through(scene, 0);
  follow(scene, kSecond);
  view_->move(pan(view_->view(), 0.0, 100.0, 0.01), kSecond);
  scene.cameras[0].position = {1, 0, 1};  // the simulation shows what the mouse did
  follow(scene, kSecond + 1'000'000);
  scene.cameras[0].position = {5, 6, 7};  // and then what another one does, at once
  follow(scene, kSecond + 2'000'000);
  EXPECT_EQ(view_->camera().T_world_camera.position.x, 5.0);
  view_->move(pan(view_->view(), 0.0, 100.0, 0.01), kSecond + 3'000'000);
  EXPECT_NEAR(abilities_.posted.back().command.T_parent_object.position.z, 8.0, 1e-12);
}

TEST_F(ViewCameraTest, ResetBringsItBack) {
  SceneMaker scene;
  scene.camera({{1, 0, 0}, {}});
  look_through(scene, 0);
  CameraHomes homes;
  follow(scene, kSecond);
  homes.take(*frame_);
  scene.cameras[0].position.x = 9.0;
  follow(scene, 2 * kSecond);
  homes.take(*frame_);
  view_->reset(homes.home(view_->object()), 2 * kSecond);
  ASSERT_EQ(abilities_.posted.size(), 1U);
  EXPECT_EQ(abilities_.posted[0].command.T_parent_object.position.x, 1.0);
}

TEST_F(ViewCameraTest, TheCameraThatNobodyDescribedIsPutOnceWhereItSeesEverything) {
  SceneMaker scene;
  scene.camera({{40, 0, 20}, {}});
  scene.structure->cameras[0].frames_scene = true;
  look_through(scene, 0);
  follow(scene, kSecond);
  ASSERT_EQ(abilities_.posted.size(), 1U);
  const math::Pose T = abilities_.posted[0].command.T_parent_object;
  EXPECT_GT(math::norm(T.position), 1.0);
  EXPECT_LT(math::norm(T.position), 6.0);
  EXPECT_EQ(abilities_.released, 0) << "that would end the command before the simulation has seen it";
  follow(scene, 2 * kSecond);
  EXPECT_EQ(abilities_.posted.size(), 1U);
  view_->reset({}, 3 * kSecond);  // the key that brings cameras back frames anew
  follow(scene, 3 * kSecond);
  EXPECT_EQ(abilities_.posted.size(), 2U);
}

TEST_F(ViewCameraTest, WhenItsCameraIsUnloadedItStaysWhereItWas) {
  SceneMaker scene;
  scene.camera({{1, 0, 0}, {}});
  look_through(scene, 0);
  follow(scene, kSecond);
  SceneMaker empty;
  empty.structure->version = 77;
  follow(empty, 2 * kSecond);
  EXPECT_EQ(view_->camera().T_world_camera.position.x, 1.0);
}

}  // namespace
}  // namespace ambf::render
