#include "render/window/detail/picker.h"

#include <gtest/gtest.h>

#include "fake_abilities.h"
#include "scenes.h"

namespace ambf::render {
namespace {

class PickerTest : public ::testing::Test {
 protected:
  PickerTest() {
    scene_.body(mesh::make_box(0.2, 0.2, 0.2), {{0, 0, 0}, {}}, nullptr);
    camera_.T_world_camera = {{3, 0, 0}, {}};
  }
  bool update() {
    frame_ = scene_.frame();
    frame_->picks = picks_;
    poses_.bodies = scene_.bodies;
    return picker_.update(*frame_, poses_, camera_);
  }
  void grasp() {
    picker_.press(camera_, 400, 400, 200, 200);
    abilities_.answer(true, {{0, 1}, {0.1, 0, 0}, 2.9});
    ASSERT_TRUE(update());
  }
  testing::FakeAbilities abilities_;
  testing::SceneMaker scene_;
  Camera camera_;
  Picker picker_{abilities_};
  ScenePoses poses_;
  std::unique_ptr<state::Frame> frame_;
  std::vector<state::PickState> picks_;
};

TEST_F(PickerTest, CastsTheRayThroughThePointer) {
  picker_.press(camera_, 400, 400, 200, 200);
  EXPECT_EQ(abilities_.picks, 1);
  EXPECT_NEAR(abilities_.from.x, 2.9, 1e-9);
  EXPECT_NEAR(abilities_.to.x, -7.0, 1e-9);
  EXPECT_NEAR(abilities_.to.y, 0.0, 1e-9);
}

TEST_F(PickerTest, DragsTheGraspedPointAtItsDepth) {
  grasp();
  EXPECT_TRUE(picker_.holds());
  EXPECT_EQ(picker_.body(), 0U);
  picker_.drag(camera_, 400, 400, 300, 100);
  ASSERT_FALSE(abilities_.dragged.empty());
  const math::Vec3 target = abilities_.dragged.back();
  EXPECT_NEAR(target.x, 0.1, 1e-9);  // as far away as what was grasped
  EXPECT_NEAR(target.y, 0.5 * 2.9 * std::tan(0.35), 1e-9);
  EXPECT_NEAR(target.z, 0.5 * 2.9 * std::tan(0.35), 1e-9);
}

TEST_F(PickerTest, TellsTheForceOfItsOwnPointer) {
  grasp();
  picks_ = {{7, 0, {}, {}, {0, 0, 9}}, {0, 0, {0.1, 0, 0}, {}, {0, 0, 2.5}}};
  update();
  EXPECT_EQ(picker_.force(), (math::Vec3{0, 0, 2.5}));
}

TEST_F(PickerTest, ABodyThatTheSimulationLetGoOfIsLetGoHere) {
  grasp();
  update();
  EXPECT_TRUE(picker_.holds()) << "the frame at hand may be older than the answer";
  picks_ = {{0, 0, {0.1, 0, 0}, {}, {}}};
  update();
  EXPECT_TRUE(picker_.holds());
  picks_.clear();  // a reset
  update();
  EXPECT_FALSE(picker_.holds());
}

TEST_F(PickerTest, ThePartsOfARoomArePickedAndNotDragged) {
  state::Structure room = *scene_.structure;
  room.models = {{room.objects[0].model, "room", "room.yaml", true}};
  room.bodies[0].mass = 0.0;
  scene_.structure = std::make_shared<state::Structure>(room);
  picker_.press(camera_, 400, 400, 200, 200);
  abilities_.answer(true, {{0, 1}, {0.1, 0, 0}, 2.9});
  EXPECT_TRUE(update());
  EXPECT_EQ(picker_.last().index, 0U);
  EXPECT_FALSE(picker_.holds());
  picker_.drag(camera_, 400, 400, 300, 100);
  EXPECT_TRUE(abilities_.dragged.empty());
  EXPECT_EQ(abilities_.ended, 1);
}

TEST_F(PickerTest, WithoutAPointerThereIsNothingToHoldWith) {
  abilities_.no_pointers = true;
  Picker none(abilities_);
  EXPECT_FALSE(none.press(camera_, 400, 400, 200, 200));
  EXPECT_FALSE(none.pressed());
}

TEST_F(PickerTest, ReleaseEndsItAndRemembersTheBody) {
  grasp();
  picker_.release();
  EXPECT_EQ(abilities_.ended, 1);
  EXPECT_FALSE(picker_.holds());
  EXPECT_EQ(picker_.last().index, 0U);
}

TEST_F(PickerTest, AnAnswerAfterTheReleaseIsIgnored) {
  picker_.press(camera_, 400, 400, 200, 200);
  picker_.release();
  abilities_.answer(true, {{0, 1}, {0.1, 0, 0}, 2.9});
  EXPECT_FALSE(update());
  EXPECT_FALSE(picker_.holds());
}

TEST_F(PickerTest, MissesHoldNothing) {
  picker_.press(camera_, 400, 400, 10, 10);
  abilities_.answer(false, {});
  EXPECT_FALSE(update());
  picker_.drag(camera_, 400, 400, 300, 100);
  EXPECT_TRUE(abilities_.dragged.empty());
}

TEST_F(PickerTest, ABodyThatIsUnloadedIsLetGo) {
  grasp();
  scene_ = testing::SceneMaker();
  update();
  EXPECT_FALSE(picker_.holds());
  EXPECT_EQ(abilities_.ended, 1);
}

}  // namespace
}  // namespace ambf::render
