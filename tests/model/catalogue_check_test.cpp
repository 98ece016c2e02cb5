// What loading would say, asked of a world that runs: as loading says it, and nothing comes of it.
#include <gtest/gtest.h>

#include <string>

#include "rig.h"

namespace ambf::model {
namespace {

using test::box;
using test::joint;
using test::model;
using test::Rig;

std::string text_of(const base::Diagnostics& found) {
  std::string text;
  for (const base::Diagnostic& each : found) {
    const char* severity = each.severity == base::Severity::error     ? "error"
                           : each.severity == base::Severity::warning ? "warning"
                                                                      : "information";
    text += std::string(severity) + ": " + each.block + ": " + each.message + "\n";
  }
  return text;
}

// An arm for a base of another file, with a camera on that base.
scene::Model arm_without_base() {
  scene::Model made = model("arm.yaml", {box("arm", 1.0, {0.2, 0, 0})}, {joint("hinge", "base", "arm")});
  scene::Camera camera;
  camera.identity.identifier = "CAMERA eye";
  camera.identity.name = "eye";
  camera.identity.name_space = "/test/";
  camera.parent = "BODY base";
  made.cameras.push_back(camera);
  return made;
}

TEST(Checking, FindsTheBodiesOfTheRunningWorld) {
  Rig rig;
  EXPECT_EQ(text_of(rig.catalogue.check_load(arm_without_base())),
            "error: JOINT hinge: there is no body \"BODY base\"\n"
            "information: CAMERA eye: there is no object \"BODY base\" yet\n");
  rig.load(model("base.yaml", {box("base", 0.0, {0, 0, 0})}));
  EXPECT_EQ(text_of(rig.catalogue.check_load(arm_without_base())), "");
  rig.apply(rig.catalogue.prepare_unload("base.yaml"));
  EXPECT_NE(text_of(rig.catalogue.check_load(arm_without_base())), "");
}

TEST(Checking, SaysWhatLoadingSaysThen) {
  Rig rig;
  rig.load(model("base.yaml", {box("base", 0.0, {0, 0, 0}), box("arm", 1.0, {1, 0, 0})}));
  scene::Model next = arm_without_base();
  next.joints.push_back(joint("self", "arm", "arm"));
  next.joints.push_back(joint("lost", "arn", "arm"));
  const std::string told = text_of(rig.catalogue.check_load(next));
  EXPECT_NE(told.find("information: BODY arm: /test/arm is there already; this one is called /test/arm1"),
            std::string::npos)
      << told;
  EXPECT_NE(told.find("there is no body \"BODY arn\""), std::string::npos) << told;
  EXPECT_NE(told.find("the same body"), std::string::npos) << told;
  EXPECT_EQ(told, text_of(rig.load(next).diagnostics));
}

TEST(Checking, HeedsThePrefix) {
  Rig rig;
  rig.load(model("base.yaml", {box("base", 0.0, {0, 0, 0})}));
  const scene::Model again = model("base.yaml", {box("base", 0.0, {0, 0, 0})});
  EXPECT_NE(text_of(rig.catalogue.check_load(again)), "");
  LoadOptions options;
  options.name_prefix = "/second";
  EXPECT_EQ(text_of(rig.catalogue.check_load(again, options)), "");
}

TEST(Checking, ChangesNothing) {
  Rig checked, other;
  for (Rig* rig : {&checked, &other}) rig->load(model("base.yaml", {box("base", 0.0, {0, 0, 0})}));
  const auto before = checked.catalogue.structure();
  for (int i = 0; i < 3; ++i) (void)checked.catalogue.check_load(arm_without_base());
  EXPECT_EQ(checked.catalogue.structure(), before);
  for (Rig* rig : {&checked, &other}) rig->load(arm_without_base());
  const state::Structure &one = *checked.live->structure(), &two = *other.live->structure();
  ASSERT_EQ(one.objects.size(), two.objects.size());
  EXPECT_EQ(one.version, two.version);
  for (std::size_t i = 0; i < one.objects.size(); ++i) {
    EXPECT_EQ(one.objects[i].name, two.objects[i].name);
    EXPECT_EQ(one.objects[i].id, two.objects[i].id);
    EXPECT_EQ(one.objects[i].model, two.objects[i].model);
  }
  checked.step(10);
  EXPECT_EQ(checked.live->structure()->joints.size(), 1u);
}

}  // namespace
}  // namespace ambf::model
