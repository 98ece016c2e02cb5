// Our arms of the da Vinci Research Kit: the original's names and tips, parallel linkages that keep the remote centre
// by themselves, and poses that are those of the published kinematics.
#include <random>

#include "adf/arms.h"
#include "tests/robots/dvrk_arms.h"

namespace ambf::runtime {
namespace {

using namespace test;

class DvrkLinkage : public DvrkArms {};

TEST_P(DvrkLinkage, HaveTheNamesOrderTypesAndHomeFramesOfTheOriginal) {
  AMBF_NEEDS_COMPAT();
  const adf::ModelResult own = adf::load_model(own_model(GetParam().file));
  const adf::ModelResult original = adf::load_model(compat::model(GetParam().original));
  ASSERT_TRUE(own.model && original.model);
  ASSERT_GE(own.model->bodies.size(), original.model->bodies.size());
  for (std::size_t i = 0; i < original.model->bodies.size(); ++i) {
    const scene::Body &ours = own.model->bodies[i], &theirs = original.model->bodies[i];
    EXPECT_EQ(ours.identity.identifier, theirs.identity.identifier);
    EXPECT_EQ(ours.identity.name, theirs.identity.name);
    EXPECT_EQ(ours.identity.name_space, theirs.identity.name_space) << theirs.identity.name;
    EXPECT_EQ(ours.identity.passive, theirs.identity.passive) << theirs.identity.name;
    EXPECT_LT(norm(ours.T_world_body.position - theirs.T_world_body.position), 10e-3) << theirs.identity.name;
    EXPECT_LT(norm(math::log(math::inverse(ours.T_world_body.orientation) * theirs.T_world_body.orientation)),
              kPi / 180.0)
        << theirs.identity.name;
  }
  ASSERT_GE(own.model->joints.size(), original.model->joints.size());
  for (std::size_t i = 0; i < original.model->joints.size(); ++i) {
    const scene::Joint &ours = own.model->joints[i], &theirs = original.model->joints[i];
    EXPECT_EQ(ours.identity.name, theirs.identity.name);
    EXPECT_EQ(ours.identity.passive, theirs.identity.passive) << theirs.identity.name;
    EXPECT_EQ(ours.type, theirs.type) << theirs.identity.name;
    EXPECT_EQ(ours.parent, theirs.parent) << theirs.identity.name;
    EXPECT_EQ(ours.child, theirs.child) << theirs.identity.name;
  }
}

// Scripts command joints by their index in the base's list, and mean the same tip with the same positions. How far the
// original's pitch gets depends on how its rounded loops jam, so ours is sent to where that is.
TEST_P(DvrkLinkage, ObeyScriptsForTheOriginal) {
  AMBF_NEEDS_COMPAT();
  ModelRig original(nothing_else());
  ASSERT_TRUE(original.load(compat::model(GetParam().original)).success);
  const auto listed = [](ModelRig& of) {
    const auto all = of.simulation.structure();
    std::vector<std::string> names;
    for (const std::uint32_t joint : all->bodies[of.slot("BODY base link")].joints)
      names.push_back(all->joints[joint].name);
    return names;
  };
  const std::vector<std::string> names = listed(rig);
  ASSERT_EQ(names, listed(original));
  const auto tip_after = [&](ModelRig& of, const state::RigidBodyCommand& command) {
    for (int k = 0; k < 10; ++k) EXPECT_TRUE(of.step(200, {{of.id("BODY base link"), command}}).success);
    return math::inverse(of.body("BODY base link").T_world_body) *
           (of.body(GetParam().tip_body).T_world_body * GetParam().tip);
  };
  for (const double share : {0.3, -0.25}) {
    state::RigidBodyCommand command;
    command.joints.resize(names.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (std::find(moved.begin(), moved.end(), names[i]) == moved.end()) continue;
      const double low = info(names[i]).lower, high = info(names[i]).upper;
      command.joints[i] = {JointCommandType::position, 0.5 * (low + high) + share * (high - low)};
    }
    const math::Vec3 theirs = tip_after(original, command);
    for (std::size_t i = 0; i < names.size(); ++i)
      command.joints[i].value = original.frame().joints[original.joint_slot(names[i])].position;
    const math::Vec3 ours = tip_after(rig, command);
    std::printf("%s: tip %.2f mm from the original's\n", GetParam().name, norm(ours - theirs) * 1e3);
    EXPECT_LT(norm(ours - theirs), 10e-3);
  }
}

TEST_P(DvrkLinkage, KeepTheRemoteCentreByTheirLinkageAlone) {
  expect_true_linkage(sweep());
  ASSERT_TRUE(rig.remove(GetParam().remote_center).success);
  expect_true_linkage(sweep());
  push_end_link();
  ASSERT_TRUE(rig.run(0.5).success);
  EXPECT_LT(off_center(), 0.05e-3);
  // Nothing else holds it: without the second parallelogram the end link turns freely.
  ASSERT_TRUE(rig.remove(GetParam().top_link).success);
  push_end_link();
  ASSERT_TRUE(rig.run(0.5).success);
  EXPECT_GT(off_center(), 5e-3);
}

// Measured joints, put into the published kinematics, give the tip where the bodies are.
TEST_P(DvrkLinkage, HaveTheirTipWhereTheKinematicsSay) {
  const kinematics::Arm& arm = *adf::known_arms().find(GetParam().name);
  const math::Pose T_body_tip{GetParam().tip, math::from_matrix(GetParam().tip_axes.data())};
  std::mt19937 random(16);
  for (int k = 0; k < 4; ++k) {
    kinematics::ArmPosition wanted;
    for (std::size_t i = 0; i < arm.size(); ++i)
      wanted.joints.push_back(std::uniform_real_distribution<double>(0.8 * arm.lower[i], 0.8 * arm.upper[i])(random));
    std::vector<std::pair<std::string, double>> targets;
    const auto positions = to_adf(arm, wanted);
    for (const auto& [name, target] : positions) targets.emplace_back(spaceless(name), target);
    ASSERT_TRUE(rig.step(1, {rig.joint_command("BODY base link", JointCommandType::position, targets)}).success);
    ASSERT_TRUE(rig.run(2.5).success);
    std::map<std::string, double> measured;
    for (const auto& [name, target] : positions)
      measured[name] = rig.frame().joints[rig.joint_slot(spaceless(name))].position;
    const auto reached = from_adf(arm, measured);
    ASSERT_TRUE(reached);
    for (std::size_t i = 0; i < arm.size(); ++i) EXPECT_NEAR(reached->joints[i], wanted.joints[i], 1e-3) << i;
    const math::Pose tip = math::inverse(rig.body("BODY base link").T_world_body) *
                           rig.body(GetParam().tip_body).T_world_body * T_body_tip;
    const kinematics::PoseDifference off = kinematics::difference(tip, forward(arm, reached->joints));
    EXPECT_LT(off.distance, 0.1e-3);
    EXPECT_LT(off.angle, 0.1 * kPi / 180.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Arms, DvrkLinkage, testing::Values(kPsm, kEcm),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

}  // namespace
}  // namespace ambf::runtime
