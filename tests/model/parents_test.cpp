// What cameras hang on: bodies and cameras of any file, that come and go, or are chosen while the world lives.
#include <gtest/gtest.h>

#include "rig.h"
#include "tests/support/views.h"

namespace ambf::model::test {
namespace {

using state::ObjectKind;

TEST(DeferredParent, IsFoundAtALaterLoadLostOnRemovalAndFoundAgain) {
  Rig rig;
  scene::Model view = model("view.yaml", {});
  view.cameras.push_back(test_camera({1, 0, 0}, "BODY arm"));
  const Prepared prepared = rig.load(view);
  ASSERT_EQ(prepared.diagnostics.size(), 1u);
  EXPECT_EQ(prepared.diagnostics[0].severity, base::Severity::information);
  EXPECT_EQ(rig.live->structure()->cameras[0].parent_object, state::kNone);
  EXPECT_NEAR(rig.frame->cameras[0].T_world_camera.position.x, 1.0, 1e-12);

  rig.load(model("arm.yaml", {box("arm", 0.0, {0.5, 2, 0})}));
  EXPECT_EQ(rig.live->structure()->cameras[0].parent_object, rig.object("arm"));
  EXPECT_NEAR(rig.frame->cameras[0].T_world_camera.position.x, 1.5, 1e-12);

  ASSERT_TRUE(rig.apply(rig.catalogue.prepare_remove("/test/arm")).success);
  EXPECT_EQ(rig.live->structure()->cameras[0].parent_object, state::kNone);
  EXPECT_NEAR(rig.frame->cameras[0].T_world_camera.position.x, 1.5, 1e-12);  // stays where it was
  EXPECT_NEAR(rig.frame->cameras[0].T_world_camera.position.y, 2.0, 1e-12);
  rig.live->reset();
  rig.live->fill(*rig.frame);
  EXPECT_NEAR(rig.frame->cameras[0].T_world_camera.position.y, 2.0, 1e-12);

  rig.load(model("arm.yaml", {box("arm", 0.0, {0, -3, 0})}));
  EXPECT_NEAR(rig.frame->cameras[0].T_world_camera.position.x, 1.0, 1e-12);
  EXPECT_NEAR(rig.frame->cameras[0].T_world_camera.position.y, -3.0, 1e-12);
}

TEST(SetParent, LeavesACameraWhereItIsAndCarriesItAlongFromThenOn) {
  Rig rig;
  scene::Model view = model("view.yaml", {box("arm", 1.0, {0.5, 2, 0})});
  view.cameras.push_back(test_camera({1, 0, 0}));
  rig.load(view);
  const state::ObjectId eye = rig.id("eye", state::ObjectKind::camera);
  ASSERT_TRUE(rig.apply(rig.catalogue.prepare_set_parent(eye, "BODY arm")).success);
  EXPECT_EQ(rig.live->structure()->cameras[0].parent_object, rig.object("arm"));
  EXPECT_EQ(rig.live->structure()->cameras[0].parent_name, "BODY arm");
  EXPECT_NEAR(rig.frame->cameras[0].T_world_camera.position.x, 1.0, 1e-12);
  EXPECT_NEAR(rig.frame->cameras[0].T_parent_camera.position.y, -2.0, 1e-12);
  rig.live->set_gravity({0.0, 0.0, -9.81});
  rig.step(100);  // the arm falls
  const double fallen = rig.frame->bodies[0].T_world_body.position.z;
  EXPECT_LT(fallen, -0.01);
  EXPECT_NEAR(rig.frame->cameras[0].T_world_camera.position.z, fallen, 1e-12);
  ASSERT_TRUE(rig.apply(rig.catalogue.prepare_set_parent(eye, "")).success);
  EXPECT_EQ(rig.live->structure()->cameras[0].parent_object, state::kNone);
  EXPECT_NEAR(rig.frame->cameras[0].T_world_camera.position.z, fallen, 1e-12);
  rig.step(100);
  EXPECT_NEAR(rig.frame->cameras[0].T_world_camera.position.z, fallen, 1e-12);
}

TEST(SetParent, RefusesWhatIsNotThereCirclesAndBodies) {
  Rig rig;
  scene::Model view = model("view.yaml", {box("arm", 0.0, {0.5, 2, 0})});
  view.cameras.push_back(test_camera({1, 0, 0}, "BODY arm"));
  view.cameras.push_back(test_camera({1, 0, 0}, "eye"));
  view.cameras[1].identity.identifier = view.cameras[1].identity.name = "second";
  rig.load(view);
  const state::ObjectId eye = rig.id("eye", state::ObjectKind::camera);
  const auto refused = [&](state::ObjectId object, const std::string& parent) {
    return !rig.catalogue.prepare_set_parent(object, parent).success;
  };
  EXPECT_TRUE(refused(eye, "nothing"));
  EXPECT_TRUE(refused(eye, "eye"));
  EXPECT_TRUE(refused(eye, "second"));  // which hangs on it
  EXPECT_TRUE(refused(rig.id("arm"), "eye"));
  EXPECT_EQ(rig.catalogue.structure()->cameras[0].parent_name, "BODY arm");
  EXPECT_FALSE(refused(eye, "/test/arm"));  // by its full name
}

TEST(DeferredParent, MayBeAnotherCameraButNeverItself) {
  Rig rig;
  scene::Model view = model("view.yaml", {});
  view.cameras.push_back(test_camera({1, 0, 0}, "second"));
  view.cameras.push_back(test_camera({1, 0, 0}, "eye"));
  view.cameras[1].identity.identifier = view.cameras[1].identity.name = "second";
  rig.load(view);
  const auto& cameras = rig.live->structure()->cameras;
  // eye hangs on second; second may not hang on eye then.
  EXPECT_EQ(cameras[0].parent_object, rig.object("second", ObjectKind::camera));
  EXPECT_EQ(cameras[1].parent_object, state::kNone);
  EXPECT_NEAR(rig.frame->cameras[0].T_world_camera.position.x, 2.0, 1e-12);
}

TEST(DeferredParent, ThatCannotBeIsToldAsSuch) {
  Rig rig;
  scene::Model view = model("view.yaml", {box("arm", 0.0, {0, 0, 0}), box("armour", 0.0, {0, 1, 0})});
  const auto add = [&](const std::string& name, const std::string& parent) {
    scene::Camera camera = test_camera({1, 0, 0}, parent);
    camera.identity.identifier = camera.identity.name = name;
    view.cameras.push_back(camera);
  };
  add("first", "second");
  add("second", "first");
  add("lone", "lone");
  add("torn", "BODY a");
  add("early", "later");
  const Prepared prepared = rig.load(view);
  std::string text;
  for (const base::Diagnostic& found : prepared.diagnostics) text += base::to_string(found) + "\n";
  for (const char* told :
       {"[second: parent] \"first\" hangs on this one", "[lone: parent] it cannot hang on itself",
        "[torn: parent] \"BODY a\" may mean several objects: ", "[early: parent] there is no object \"later\" yet"})
    EXPECT_NE(text.find(told), std::string::npos) << told << " in\n" << text;
  EXPECT_EQ(prepared.diagnostics.size(), 4u) << text;
  // Of several that a file may mean, the first counts.
  EXPECT_EQ(rig.live->structure()->cameras[3].parent_object, rig.object("arm"));
}

}  // namespace
}  // namespace ambf::model::test
