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

}  // namespace
}  // namespace ambf::runtime
