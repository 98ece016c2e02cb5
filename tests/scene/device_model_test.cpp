// The model that an input device brings: what is left with topics, and which body is its root link.
#include "scene/device_model.h"

#include <gtest/gtest.h>

namespace ambf::scene {
namespace {

Body body(const std::string& name) {
  Body out;
  out.identity.identifier = "BODY " + name;
  out.identity.name = name;
  out.identity.name_space = "/ambf/env/";
  return out;
}

Joint joint(const std::string& parent, const std::string& child) {
  Joint out;
  out.parent = "BODY " + parent;
  out.child = "BODY " + child;
  return out;
}

Model gripper() {
  Model model;
  model.bodies = {body("finger"), body("palm"), body("tip")};
  model.bodies[1].T_world_body.position = {0.0, 0.0, 0.3};
  model.joints = {joint("palm", "finger"), joint("finger", "tip")};
  return model;
}

TEST(DeviceModel, OnlyTheRootLinkKeepsTopicsBelowSimulatedDevice) {
  Model model = gripper();
  const auto T_world_root = make_device_model(model, "Falcon", "");
  ASSERT_TRUE(T_world_root);
  EXPECT_EQ(T_world_root->position.z, 0.3);
  EXPECT_EQ(model.bodies[1].identity.name, "simulated_device/Falcon");
  EXPECT_EQ(model.bodies[1].identity.identifier, "BODY palm") << "joints find it";
  EXPECT_FALSE(model.bodies[1].identity.passive);
  EXPECT_TRUE(model.bodies[0].identity.passive);
  EXPECT_TRUE(model.bodies[2].identity.passive);
}

TEST(DeviceModel, TheRootLinkIsNamedByNameOrIdentifier) {
  for (const std::string name : {"tip", "BODY tip"}) {
    Model model = gripper();
    ASSERT_TRUE(make_device_model(model, "A", name));
    EXPECT_EQ(model.bodies[2].identity.name, "simulated_device/A") << name;
  }
  Model model = gripper();
  EXPECT_FALSE(make_device_model(model, "A", "wrist"));
  EXPECT_FALSE(model.bodies[0].identity.passive) << "it stays as it is";
}

}  // namespace
}  // namespace ambf::scene
