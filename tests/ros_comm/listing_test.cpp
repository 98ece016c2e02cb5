// What List, Load, Unload and Remove answer about a structure.
#include "ros_comm/services/listing.h"

#include <gtest/gtest.h>

#include "state/kind_rows.h"

namespace ambf::ros_comm {
namespace {

// Model "arm": two bodies, a joint between them and a camera on the second. Model "lamp": a light in the world.
state::Structure arm_and_lamp() {
  state::Structure made;
  made.version = 7;
  made.models = {{1, "arm", "arm.yaml"}, {2, "lamp", "lamp.yaml"}};
  const auto add = [&](const std::string& name, state::ObjectKind kind, state::ModelId model, std::uint32_t slot) {
    state::ObjectInfo object;
    object.name = name;
    object.kind = kind;
    object.model = model;
    object.slot = slot;
    made.objects.push_back(object);
    return static_cast<std::uint32_t>(made.objects.size() - 1);
  };
  made.bodies.resize(2);
  made.bodies[0].object = add("/env/base", state::ObjectKind::rigid_body, 1, 0);
  made.bodies[1].object = add("/env/link", state::ObjectKind::rigid_body, 1, 1);
  made.joints.resize(1);
  made.joints[0].object = add("/env/hinge", state::ObjectKind::joint, 1, 0);
  made.joints[0].type = state::JointType::cone_twist;
  made.joints[0].parent_body = 0;
  made.joints[0].child_body = 1;
  made.joints[0].has_limits = true;
  made.joints[0].upper = 2.0;
  made.cameras.resize(1);
  made.cameras[0].object = add("/env/eye", state::ObjectKind::camera, 1, 0);
  made.cameras[0].parent_object = made.bodies[1].object;
  made.lights.resize(1);
  made.lights[0].object = add("/env/bulb", state::ObjectKind::light, 2, 0);
  return made;
}

TEST(Listing, HoldsObjectsUnderTheNamesOfTheirKinds) {
  TopicNames topics;
  topics.reserve("/env/eye");
  ambf_msgs::List::Response list;
  fill_list(arm_and_lamp(), topics, "", list);
  EXPECT_EQ(list.structure_version, 7u);
  ASSERT_EQ(list.objects.size(), 4u);
  EXPECT_EQ(list.objects[0].kind, "rigid_body");
  EXPECT_EQ(list.objects[0].parent, "");
  EXPECT_EQ(list.objects[0].topic, "");
  EXPECT_EQ(list.objects[2].name, "/env/eye");
  EXPECT_EQ(list.objects[2].kind, "camera");
  EXPECT_EQ(list.objects[2].parent, "/env/link");
  EXPECT_EQ(list.objects[2].topic, "/env/eye");
  EXPECT_EQ(list.objects[3].kind, "light");
  EXPECT_EQ(list.objects[3].model, "lamp");
  EXPECT_EQ(list.objects[3].parent, "");
}

TEST(Listing, DescribesJointsInAListOfTheirOwn) {
  ambf_msgs::List::Response list;
  fill_list(arm_and_lamp(), TopicNames(), "", list);
  ASSERT_EQ(list.joints.size(), 1u);
  EXPECT_EQ(list.joints[0].name, "/env/hinge");
  EXPECT_EQ(list.joints[0].type, "cone twist");
  EXPECT_EQ(list.joints[0].parent, "/env/base");
  EXPECT_EQ(list.joints[0].child, "/env/link");
  EXPECT_TRUE(list.joints[0].limited != 0);
  EXPECT_EQ(list.joints[0].upper, 2.0);
  ASSERT_EQ(list.models.size(), 2u);
  EXPECT_EQ(list.models[0].objects, (std::vector<std::string>{"/env/base", "/env/link", "/env/eye"}));
  EXPECT_EQ(list.models[0].joints, std::vector<std::string>{"/env/hinge"});
}

TEST(Listing, IsOfOneModelWhereOneIsNamed) {
  ambf_msgs::List::Response list;
  fill_list(arm_and_lamp(), TopicNames(), "lamp", list);
  ASSERT_EQ(list.models.size(), 1u);
  EXPECT_EQ(list.models[0].path, "lamp.yaml");
  ASSERT_EQ(list.objects.size(), 1u);
  EXPECT_EQ(list.objects[0].name, "/env/bulb");
  EXPECT_TRUE(list.joints.empty());
  EXPECT_EQ(names_in(arm_and_lamp(), "lamp"), std::set<std::string>{"/env/bulb"});
  EXPECT_EQ(names_in(arm_and_lamp()).size(), 5u);
}

struct BeaconInfo : state::PlacedInfo {};
struct BeaconState : state::PlacedState {};

TEST(Listing, HoldsObjectsOfARegisteredKindWithTheirParents) {
  state::KindInfo info;
  info.name = "beacon";
  info.label = "beacon";
  info.plural = "beacons";
  const auto beacons = state::register_placed_kind<BeaconInfo, BeaconState>(info);
  state::Structure scene = arm_and_lamp();
  state::make_tables(scene);
  state::ObjectInfo object;
  object.name = "/env/beacon";
  object.kind = beacons.kind;
  object.model = 2;
  object.slot = 0;
  scene.objects.push_back(object);
  BeaconInfo beacon;
  beacon.object = static_cast<std::uint32_t>(scene.objects.size() - 1);
  beacon.parent_object = scene.bodies[0].object;
  state::table<BeaconInfo>(scene, beacons.kind).push_back(beacon);
  ambf_msgs::List::Response list;
  fill_list(scene, TopicNames(), "lamp", list);
  ASSERT_EQ(list.objects.size(), 2u);
  EXPECT_EQ(list.objects[1].kind, "beacon");
  EXPECT_EQ(list.objects[1].parent, "/env/base");
  EXPECT_EQ(list.models[0].objects, (std::vector<std::string>{"/env/bulb", "/env/beacon"}));
}

}  // namespace
}  // namespace ambf::ros_comm
