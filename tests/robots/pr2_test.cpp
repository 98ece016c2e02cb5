// Our PR2: the original's names and home frames; it stands on its wheels, and its arms carry themselves.
#include <algorithm>

#include "tests/robots/original.h"

namespace ambf::runtime {
namespace {

using namespace test;

TEST(Pr2, HasTheNamesOrderTypesAndHomeFramesOfTheOriginal) {
  AMBF_NEEDS_COMPAT();
  const adf::ModelResult own = adf::load_model(own_model("robots/pr2.yaml"));
  const adf::ModelResult original = adf::load_model(compat::model("robots/blender-pr2.yaml"));
  ASSERT_TRUE(own.model && original.model);
  expect_same_interface(*own.model, *original.model);
  for (std::size_t i = 0; i < original.model->bodies.size(); ++i)
    EXPECT_EQ(own.model->bodies[i].mass, original.model->bodies[i].mass) << own.model->bodies[i].identity.name;
}

TEST(Pr2, StandsOnItsWheelsAndMovesItsArms) {
  ModelRig rig(world_of(own_descriptions() + "world/pr2_world.yaml"));
  const state::Outcome environment = rig.load(own_descriptions() + "world/lab_sunk_room.yaml");
  ASSERT_TRUE(environment.success) << environment.message;
  const state::Outcome loaded = rig.load(own_model("robots/pr2.yaml"));
  ASSERT_TRUE(loaded.success) << loaded.message;
  ASSERT_TRUE(loaded.diagnostics.empty()) << base::to_string(loaded.diagnostics.front());
  const math::Pose home = rig.body("BODY base_link").T_world_body;
  const math::Vec3 hand = rig.body("BODY r_wrist_roll_link").T_world_body.position;
  ASSERT_TRUE(rig.run(1.0).success);
  EXPECT_LT(norm(rig.body("BODY base_link").T_world_body.position - home.position), 1e-3);
  EXPECT_LT(norm(rig.body("BODY r_wrist_roll_link").T_world_body.position - hand), 2e-3);
  const std::vector<std::pair<std::string, double>> targets = {{"base_link-torso_lift_link", 0.2},
                                                               {"torso_lift_link-l_shoulder_pan_link", 0.8},
                                                               {"torso_lift_link-r_shoulder_pan_link", 0.3},
                                                               {"l_shoulder_pan_link-l_shoulder_lift_link", 0.9},
                                                               {"r_upper_arm_roll_link-r_elbow_flex_link", -1.2},
                                                               {"head_pan_link-head_tilt_link", 0.6},
                                                               {"l_wrist_roll_link-l_gripper_l_finger_link", 0.5}};
  for (int k = 0; k < 20; ++k)
    ASSERT_TRUE(rig.step(100, {rig.joint_command("BODY base_link", JointCommandType::position, targets)}).success);
  for (const auto& [name, target] : targets)
    EXPECT_NEAR(rig.frame().joints[rig.joint_slot(name)].position, target, 3e-3) << name;
  EXPECT_LT(norm(rig.body("BODY base_link").T_world_body.position - home.position), 10e-3);
  EXPECT_LT(rig.largest_gap(), 0.02e-3);
}

class Pr2Gripper : public testing::TestWithParam<const char*> {
 protected:
  std::string own() const { return own_model(std::string("grippers/pr2_gripper") + GetParam() + ".yaml"); }
};

TEST_P(Pr2Gripper, HasTheNamesOrderTypesAndLimitsOfTheOriginal) {
  AMBF_NEEDS_COMPAT();
  const bool small = *GetParam() != 0;
  const adf::ModelResult ours = adf::load_model(own());
  const adf::ModelResult theirs =
      adf::load_model(compat::model(small ? "grippers/pr2 gripper small red.yaml" : "grippers/pr2 gripper.yaml"));
  ASSERT_TRUE(ours.model && theirs.model);
  // The small one's file lists the places of the large one's bodies, where its joints do not hold them.
  if (!small) expect_same_interface(*ours.model, *theirs.model);
  ASSERT_EQ(ours.model->bodies.size(), theirs.model->bodies.size());
  for (std::size_t i = 0; i < theirs.model->bodies.size(); ++i) {
    EXPECT_EQ(ours.model->bodies[i].identity.identifier, theirs.model->bodies[i].identity.identifier);
    EXPECT_EQ(ours.model->bodies[i].mass, theirs.model->bodies[i].mass);
  }
  ASSERT_EQ(ours.model->joints.size(), theirs.model->joints.size());
  for (std::size_t i = 0; i < theirs.model->joints.size(); ++i)
    EXPECT_EQ(ours.model->joints[i].identity.name, theirs.model->joints[i].identity.name);
}

TEST_P(Pr2Gripper, FloatsOpensAndCloses) {
  ModelRig rig(nothing_else());
  const state::Outcome loaded = rig.load(own());
  ASSERT_TRUE(loaded.success) << loaded.message;
  ASSERT_TRUE(loaded.diagnostics.empty()) << base::to_string(loaded.diagnostics.front());
  const math::Vec3 home = rig.body("BODY r_gripper_palm_link").T_world_body.position;
  for (const double opening : {0.4, -0.2}) {
    std::vector<std::pair<std::string, double>> targets;
    for (const char* joint :
         {"r_gripper_palm_link-r_gripper_l_finger_link", "r_gripper_l_finger_link-r_gripper_l_finger_tip_link",
          "r_gripper_palm_link-r_gripper_r_finger_link", "r_gripper_r_finger_link-r_gripper_r_finger_tip_link"})
      targets.emplace_back(joint, opening);
    const auto command = rig.joint_command("BODY r_gripper_palm_link", JointCommandType::position, targets);
    for (int k = 0; k < 10; ++k) ASSERT_TRUE(rig.step(100, {command}).success);
    for (const auto& [joint, target] : targets)
      EXPECT_NEAR(rig.frame().joints[rig.joint_slot(joint)].position, target, 5e-3) << joint;
    EXPECT_LT(rig.largest_gap(), 0.02e-3);
  }
  EXPECT_LT(norm(rig.body("BODY r_gripper_palm_link").T_world_body.position - home), 0.05);
}

INSTANTIATE_TEST_SUITE_P(Sizes, Pr2Gripper, testing::Values("", "_small_red"), [](const auto& parameter) {
  return *parameter.param == 0 ? std::string("Large") : std::string("SmallAndRed");
});

}  // namespace
}  // namespace ambf::runtime
