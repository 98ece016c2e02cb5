// Chains of a model's joints.
#include <gtest/gtest.h>

#include <algorithm>

#include "adf/adf.h"
#include "math/rotation.h"
#include "scene/chain.h"

namespace ambf::scene {
namespace {

Model arm7() {
  auto read = adf::load_model(AMBF_SOURCE_DIR "/ambf_models/descriptions/multi-bodies/robots/arm7.yaml");
  return read.model ? *read.model : Model{};
}

TEST(ModelChain, OfEachJointReachesWhereTheFilePutsItsChild) {
  const Model model = arm7();
  ASSERT_EQ(model.bodies.size(), 8u);
  for (std::size_t i = 0; i + 1 < model.bodies.size(); ++i) {
    const Body &parent = model.bodies[i], &child = model.bodies[i + 1];
    const ChainResult result = chain_between(model, parent.identity.identifier, child.identity.identifier);
    ASSERT_TRUE(result.chain) << result.problem;
    ASSERT_EQ(result.chain->names, (std::vector<std::string>{"joint" + std::to_string(i + 1)}));
    const math::Pose wanted = math::inverse(parent.T_world_body) * child.T_world_body;
    const kinematics::Answer answer = inverse(*result.chain, wanted, result.chain->home);
    EXPECT_LT(answer.distance, 1e-5);  // the file's digits
    EXPECT_LT(answer.angle, 1e-5);
  }
}

TEST(ModelChain, IsSolvedNumericallyFromFarAway) {
  const auto chain = chain_between(arm7(), "base", "link7").chain;
  ASSERT_TRUE(chain);
  const math::Pose pose = forward(*chain, {0.5, -0.4, 0.3, 0.6, -0.5, 0.4, 1.0});
  const kinematics::Answer answer = inverse(*chain, pose, chain->home);
  ASSERT_EQ(answer.status, kinematics::Status::solved);
  const auto missing = kinematics::difference(forward(*chain, answer.joints), pose);
  EXPECT_LT(std::max(missing.distance, missing.angle), 1e-9);
  math::Pose far = pose;
  far.position.x += 5.0;
  const kinematics::Answer nearest = inverse(*chain, far, chain->home);
  EXPECT_EQ(nearest.status, kinematics::Status::unreachable);
  EXPECT_GT(nearest.distance, 3.0);
}

TEST(ModelChain, LeadsThroughFixedJointsAndReportsOthers) {
  Model model;
  for (const char* name : {"BODY a", "BODY b", "BODY c"}) {
    Body body;
    body.identity.identifier = name;
    model.bodies.push_back(body);
  }
  const auto add = [&](const char* parent, const char* child, state::JointType type) {
    Joint joint;
    joint.identity.name = std::string(parent) + child;
    joint.parent = std::string("BODY ") + parent;
    joint.child = std::string("BODY ") + child;
    joint.type = type;
    joint.parent_pivot = {1.0, 0.0, 0.0};
    model.joints.push_back(joint);
  };
  add("a", "b", state::JointType::fixed);
  add("b", "c", state::JointType::revolute);
  model.bodies[1].scale = 2.0;
  const auto chain = chain_between(model, "BODY a", "BODY c").chain;
  ASSERT_TRUE(chain);
  EXPECT_EQ(chain->size(), 1u);
  EXPECT_LT(norm(forward(*chain, {0.7}).position - math::Vec3{3.0, 0.0, 0.0}), 1e-12);
  EXPECT_NE(chain_between(model, "BODY c", "BODY a").problem.find("no joints lead"), std::string::npos);
  EXPECT_NE(chain_between(model, "BODY a", "BODY z").problem.find("'BODY z'"), std::string::npos);
  model.joints[1].type = state::JointType::cone_twist;
  EXPECT_NE(chain_between(model, "BODY a", "BODY c").problem.find("'bc'"), std::string::npos);
}

// R_parent_child(q) and p_parent_child(q) of physics/joint.h.
TEST(ModelChain, HasTheOffsetsOfSimulatedJoints) {
  const double q = 0.3;
  for (const bool prismatic : {false, true}) {
    kinematics::AdfGeometry joint;
    joint.parent_pivot = {0.1, 0.2, 0.3};
    joint.child_pivot = {0.0, 0.1, -0.2};
    joint.parent_axis = {0.6, 0.0, 0.8};
    joint.child_axis = {0.0, 1.0, 0.0};
    joint.child_offset = 0.2;
    joint.joint_offset = 0.5;
    kinematics::Chain chain;
    append(chain, joint, prismatic, -1.0, 1.0, "joint");
    const double angle = joint.child_offset - joint.joint_offset + (prismatic ? 0.0 : q);
    const math::Quat turn =
        math::from_axis_angle(joint.parent_axis, angle) * math::rotation_between(joint.child_axis, joint.parent_axis);
    const math::Vec3 shift = prismatic ? q * joint.parent_axis : math::Vec3{};
    const math::Pose wanted{joint.parent_pivot + shift - rotate(turn, joint.child_pivot), turn};
    const auto missing = kinematics::difference(forward(chain, {q}), wanted);
    EXPECT_LT(std::max(missing.distance, missing.angle), 1e-12) << prismatic;
  }
}

}  // namespace
}  // namespace ambf::scene
