// Our arms of the da Vinci Research Kit: the original's names and tips, parallel linkages that keep the remote centre
// by themselves, and poses that are those of the published kinematics.
#include <random>

#include "adf/arms.h"
#include "tests/robots/dvrk_arms.h"

namespace ambf::runtime {
namespace {

using namespace test;

class DvrkOriginal : public DvrkArms {};

TEST_P(DvrkOriginal, HasTheNamesOrderTypesAndHomeFramesOfTheOriginal) {
  AMBF_NEEDS_COMPAT();
  const adf::ModelResult own = adf::load_model(own_model(GetParam().file));
  const adf::ModelResult original = adf::load_model(compat::model(GetParam().original));
  ASSERT_TRUE(own.model && original.model);
  expect_same_interface(*own.model, *original.model);
}

// Scripts command joints by their index in the base's list, and mean the same tip with the same positions. How far the
// original's pitch gets depends on how its rounded loops jam, so ours is sent to where that is.
TEST_P(DvrkOriginal, ObeysItsScripts) {
  AMBF_NEEDS_COMPAT();
  ModelRig original(nothing_else());
  ASSERT_TRUE(original.load(compat::model(GetParam().original)).success);
  const auto listed = [](ModelRig& of) {
    const auto all = of.simulation.structure();
    std::vector<std::string> names;
    for (const std::uint32_t joint : all->bodies[of.slot(GetParam().base)].joints)
      names.push_back(all->joints[joint].name);
    return names;
  };
  std::vector<std::string> names = listed(rig);
  const std::vector<std::string> known = listed(original);
  ASSERT_GE(names.size(), known.size());
  ASSERT_TRUE(std::equal(known.begin(), known.end(), names.begin())) << "joints that are ours come last";
  names = known;
  const auto tip_after = [&](ModelRig& of, const state::RigidBodyCommand& command) {
    for (int k = 0; k < 10; ++k) EXPECT_TRUE(of.step(200, {{of.id(GetParam().base), command}}).success);
    return math::inverse(of.body(GetParam().base).T_world_body) *
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

class DvrkLinkage : public DvrkArms {};

TEST_P(DvrkLinkage, IsTrueOverTheWholeRange) { expect_true_linkage(sweep()); }

class DvrkRemoteCentre : public DvrkArms {};

TEST_P(DvrkRemoteCentre, IsKeptByTheLinkageAlone) {
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
TEST_P(DvrkLinkage, HasItsTipWhereTheKinematicsSay) {
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
    ASSERT_TRUE(rig.step(1, {rig.joint_command(GetParam().base, JointCommandType::position, targets)}).success);
    ASSERT_TRUE(rig.run(2.5).success);
    std::map<std::string, double> measured;
    for (const auto& [name, target] : positions)
      measured[name] = rig.frame().joints[rig.joint_slot(spaceless(name))].position;
    const auto reached = from_adf(arm, measured);
    ASSERT_TRUE(reached);
    for (std::size_t i = 0; i < arm.size(); ++i) EXPECT_NEAR(reached->joints[i], wanted.joints[i], 1e-3) << i;
    const math::Pose tip =
        math::inverse(rig.body(GetParam().base).T_world_body) * rig.body(GetParam().tip_body).T_world_body * T_body_tip;
    const kinematics::PoseDifference off = kinematics::difference(tip, forward(arm, reached->joints));
    EXPECT_LT(off.distance, 0.1e-3);
    EXPECT_LT(off.angle, 0.1 * kPi / 180.0);
  }
}

// The short link is turned by the forearm through the front arm: without that it turns freely.
TEST(DvrkMaster, ShortLinkIsTurnedByTheParallelogramAlone) {
  ModelRig rig(nothing_else());
  ASSERT_TRUE(rig.load(own_model(kMtmr.file)).success);
  const auto joint = [&](const char* name) { return rig.frame().joints[rig.joint_slot(name)].position; };
  const auto turn_elbow = [&](double to) {
    const auto command = rig.joint_command(kMtmr.base, JointCommandType::position, {{kMtmr.third, to}});
    for (int k = 0; k < 10; ++k) ASSERT_TRUE(rig.step(100, {command}).success);
  };
  turn_elbow(0.4);
  EXPECT_NEAR(joint("ArmParallel-ArmParallel1"), 0.4, 1e-4);
  ASSERT_TRUE(rig.remove("BODY ArmFront").success);
  turn_elbow(-0.4);
  EXPECT_GT(joint("ArmParallel-ArmParallel1"), 0.2);
}

// Springs open the gripper; squeezed it closes, up to both levers' stops.
TEST(DvrkMaster, GripperIsSprung) {
  for (const ArmCase& arm : {kMtmr, kMtml}) {
    ModelRig rig(nothing_else());
    ASSERT_TRUE(rig.load(own_model(arm.file)).success);
    const auto opening = [&] {
      return rig.frame().joints[rig.joint_slot("WristRoll-Gripper1")].position +
             rig.frame().joints[rig.joint_slot("WristRoll-Gripper2")].position;
    };
    ASSERT_TRUE(rig.run(0.2).success);
    EXPECT_NEAR(opening(), kPi / 3.0, 1e-3);
    for (const char* lever : {"BODY Gripper1", "BODY Gripper2"}) {
      state::Push push;
      push.point_body = {0.05, 0, 0};
      push.force_world = math::rotate(rig.body(lever).T_world_body.orientation, {0, -3.0, 0});
      push.seconds = 0.5;
      ASSERT_TRUE(rig.wait_for([&](auto done) { rig.simulation.push(rig.id(lever), push, done); }).success);
    }
    ASSERT_TRUE(rig.run(0.3).success);
    EXPECT_NEAR(opening(), 0.0, 5e-3) << arm.name;
    ASSERT_TRUE(rig.run(0.7).success);
    EXPECT_NEAR(opening(), kPi / 3.0, 1e-3) << arm.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Arms, DvrkOriginal, testing::Values(kPsm, kEcm, kMtmr),
                         [](const auto& parameter) { return std::string(parameter.param.name); });
INSTANTIATE_TEST_SUITE_P(Arms, DvrkLinkage, testing::Values(kPsm, kEcm, kMtmr, kMtml),
                         [](const auto& parameter) { return std::string(parameter.param.name); });
INSTANTIATE_TEST_SUITE_P(Arms, DvrkRemoteCentre, testing::Values(kPsm, kEcm),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

}  // namespace
}  // namespace ambf::runtime
