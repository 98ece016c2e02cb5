// Fig. 3.7 of the dissertation, every branch: which body and which cameras a device moves.
#include "devices/binding.h"

#include <gtest/gtest.h>

#include <utility>

namespace ambf::devices {
namespace {

using state::ObjectKind;

// A scene: model 1 "arm" with a chain base - wrist - tip and a finger below the tip, model 2 "gripper" with palm and
// finger, model 3 "gripper1" with the same names, two cameras, a static floor.
class BindingScene : public ::testing::Test {
 protected:
  void SetUp() override {
    structure_.models = {{1, "arm", "arm.yaml"}, {2, "gripper", "g.yaml"}, {3, "gripper1", "g.yaml"}};
    add_body(1, "base", 2.0);
    const auto wrist = add_body(1, "wrist", 1.0), tip = add_body(1, "tip", 0.5), jaw = add_body(1, "jaw", 0.1);
    structure_.bodies[0].children = list({wrist, tip, jaw});
    structure_.bodies[1].children = list({tip, jaw});
    structure_.bodies[2].children = list({jaw});
    structure_.bodies[2].joints = list({add_joint(tip, jaw)});
    for (const state::ModelId model : {2u, 3u}) {
      const auto finger = add_body(model, "finger", 0.1), palm = add_body(model, "palm", 0.2);
      structure_.bodies[structure_.objects[palm].slot].children = list({finger});
    }
    for (std::size_t i = structure_.objects.size() - 2; i < structure_.objects.size(); ++i) {
      structure_.objects[i].identifier += "1";  // renamed: the names were taken
      structure_.objects[i].name += "1";
    }
    add_body(0, "floor", 0.0);
    for (const char* name : {"camera1", "camera2"}) {
      state::CameraInfo camera;
      camera.object = add_object(0, ObjectKind::camera, name, static_cast<std::uint32_t>(structure_.cameras.size()));
      structure_.cameras.push_back(camera);
    }
  }

  std::uint32_t add_object(state::ModelId model, ObjectKind kind, const std::string& name, std::uint32_t slot) {
    state::ObjectInfo object;
    object.id = {static_cast<std::uint32_t>(structure_.objects.size()), 1};
    object.kind = kind;
    object.model = model;
    object.local_name = name;
    object.name = "/ambf/env/" + name;
    object.identifier = "/ambf/env/BODY " + name;
    object.slot = slot;
    structure_.objects.push_back(object);
    return object.id.index;
  }
  std::uint32_t add_body(state::ModelId model, const std::string& name, double mass) {
    state::BodyInfo body;
    body.object = add_object(model, ObjectKind::rigid_body, name, static_cast<std::uint32_t>(structure_.bodies.size()));
    body.mass = mass;
    body.inertia = {mass, mass, mass};
    structure_.bodies.push_back(body);
    return body.object;
  }
  std::uint32_t add_joint(std::uint32_t parent, std::uint32_t child) {
    state::JointInfo joint;
    joint.type = state::JointType::revolute;
    joint.has_limits = true;
    joint.parent_body = structure_.objects[parent].slot;
    joint.child_body = structure_.objects[child].slot;
    const auto slot = static_cast<std::uint32_t>(structure_.joints.size());
    joint.object = add_object(1, ObjectKind::joint, "tip-jaw", slot);
    structure_.joints.push_back(joint);
    return slot;
  }
  static state::IndexList list(std::vector<std::uint32_t> indices) { return state::IndexList(std::move(indices)); }

  std::string body_of(const std::string& root_link, const std::string& file = {}, const std::string& model = {}) {
    scene::InputDevice device;
    device.root_link = root_link;
    device.multibody_file = file;
    places_ = find_places(structure_, device, model);
    return places_.body_name;
  }

  state::Structure structure_;
  Places places_;
};

TEST_F(BindingScene, AMultibodyAndARootLinkIsThatBodyOfTheDevicesOwnModel) {
  EXPECT_EQ(body_of("palm", "g.yaml", "gripper"), "/ambf/env/palm");
  EXPECT_EQ(body_of("palm", "g.yaml", "gripper1"), "/ambf/env/palm1") << "renamed, since the name was taken";
  EXPECT_EQ(body_of("tip", "g.yaml", "gripper"), "") << "of another model";
  EXPECT_NE(places_.problem.find("has no body 'tip'"), std::string::npos);
}

TEST_F(BindingScene, AMultibodyAloneIsItsBodyWithTheFewestParents) {
  EXPECT_EQ(body_of("", "g.yaml", "gripper"), "/ambf/env/palm");
  EXPECT_EQ(body_of("", "arm.yaml", "arm"), "/ambf/env/base");
}

TEST_F(BindingScene, AMultibodyThatIsNotLoadedYetIsWaitedFor) {
  EXPECT_EQ(body_of("palm", "g.yaml", ""), "");
  EXPECT_FALSE(places_.body.valid());
  EXPECT_FALSE(places_.problem.empty());
}

TEST_F(BindingScene, ARootLinkOfTheSceneMayHaveParentsAndSeveralOfOneChainMayBeMoved) {
  EXPECT_EQ(body_of("tip"), "/ambf/env/tip");
  EXPECT_EQ(places_.jaw_joints.size(), 1u);
  EXPECT_EQ(body_of("/ambf/env/wrist"), "/ambf/env/wrist");
  EXPECT_EQ(body_of("/ambf/env/BODY palm1"), "/ambf/env/palm1") << "another device's gripper, renamed";
}

TEST_F(BindingScene, WhatIsAbsentIsWaitedForAndWhatIsStaticIsRefused) {
  EXPECT_EQ(body_of("nothing"), "");
  EXPECT_NE(places_.problem.find("waited for"), std::string::npos);
  EXPECT_EQ(body_of("floor"), "");
  EXPECT_NE(places_.problem.find("is static"), std::string::npos);
}

TEST_F(BindingScene, CamerasAreThoseNamedInTheirOrderElseAll) {
  scene::InputDevice device;
  device.root_link = "tip";
  device.cameras = {"camera2", "nowhere", "camera1"};
  EXPECT_EQ(find_places(structure_, device, "").camera_names,
            (std::vector<std::string>{"/ambf/env/camera2", "/ambf/env/camera1"}));
  device.cameras.clear();
  EXPECT_EQ(find_places(structure_, device, "").camera_names.front(), "/ambf/env/camera1");
}

TEST_F(BindingScene, GainsAreTheBodysOwnForcesElseThoseThatCarryItsMass) {
  EXPECT_NEAR(own_gains(structure_, 2).linear_stiffness.x, 0.6 * kOwnFrequency * kOwnFrequency, 1e-9);
  EXPECT_NEAR(own_gains(structure_, 2).linear_damping.x, 2.0 * 0.6 * kOwnFrequency, 1e-9);
  structure_.bodies[2].linear_output = state::ControllerOutput::force;
  structure_.bodies[2].parameters.linear.p = {1.0, 2.0, 3.0};
  EXPECT_EQ(own_gains(structure_, 2).linear_stiffness, (math::Vec3{1.0, 2.0, 3.0}));
}

}  // namespace
}  // namespace ambf::devices
