// Motors of our arms of the da Vinci Research Kit follow, settle and hold within the real ones' efforts.
#include "adf/arms.h"
#include "tests/robots/dvrk_arms.h"

namespace ambf::runtime {
namespace {

using namespace test;

class DvrkMotors : public DvrkArms {};

TEST_P(DvrkMotors, FollowSinusoidsWithinThreePercent) {
  std::vector<std::string> names;
  for (const kinematics::AdfJoint& joint : adf::known_arms().find(GetParam().name)->adf_joints)
    names.push_back(spaceless(joint.name));
  std::vector<double> middle, amplitude, squares(names.size(), 0.0);
  for (const std::string& name : names) {
    amplitude.push_back(0.2 * (info(name).upper - info(name).lower));
    middle.push_back(std::clamp(position(name), info(name).lower + amplitude.back(), info(name).upper));
  }
  constexpr unsigned kBlend = 2000, kMeasured = 2000;  // steps; one period is measured
  for (unsigned k = 1; k <= kBlend + kMeasured; ++k) {
    const double t = k * 1e-3, u = std::min(k / static_cast<double>(kBlend), 1.0), blend = u * u * (3.0 - 2.0 * u);
    std::vector<std::pair<std::string, double>> targets;
    for (std::size_t i = 0; i < names.size(); ++i)
      targets.emplace_back(names[i], blend * (middle[i] + amplitude[i] * std::sin(kPi * t)));
    ASSERT_TRUE(step_to(targets));
    for (std::size_t i = 0; k > kBlend && i < names.size(); ++i)
      squares[i] += std::pow(position(names[i]) - targets[i].second, 2);
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double rms = std::sqrt(squares[i] / kMeasured) / amplitude[i];
    std::printf("%s, %s: rms error %.2f %% of the amplitude\n", GetParam().name, names[i].c_str(), rms * 100.0);
    EXPECT_LT(rms, 0.03) << names[i];
  }
}

TEST_P(DvrkMotors, SettleAfterAStepWithoutHunting) {
  const double step = 10.0 * kPi / 180.0;
  double overshoot = 0.0, late = 0.0;
  int turns = 0;
  double before = 0.0;
  for (int k = 0; k < 2000; ++k) {
    ASSERT_TRUE(step_to({{GetParam().yaw, step}, {GetParam().pitch, step}}));
    const double q = position(GetParam().pitch), speed = rig.frame().joints[rig.joint_slot(GetParam().pitch)].velocity;
    overshoot = std::max({overshoot, q - step, position(GetParam().yaw) - step});
    if (std::abs(speed) > 0.01 && speed * before < 0.0) ++turns;
    if (std::abs(speed) > 0.01) before = speed;
    if (k >= 1500) late = std::max({late, std::abs(q - step), std::abs(position(GetParam().yaw) - step)});
  }
  std::printf("%s: overshoot %.2f %%, reverses %d times, %.4f mrad off after 1.5 s\n", GetParam().name,
              100.0 * overshoot / step, turns, late * 1e3);
  EXPECT_LT(overshoot, 0.1 * step);
  EXPECT_LE(turns, 2);
  EXPECT_LT(late, 0.1e-3);
}

// The original's file lists a joint inside the loop as active, so scripts may command it.
TEST(DvrkPsm, PitchIsFreeOfTheActiveJointInItsLoop) {
  ModelRig rig(nothing_else());
  ASSERT_TRUE(rig.load(own_model(kPsm.file)).success);
  for (const double pitch : {0.5, -0.4}) {
    const state::AddressedCommand command = rig.joint_command(
        kPsm.base, JointCommandType::position, {{kPsm.pitch, pitch}, {"pitchfrontlink-pitchbottomlink", pitch}});
    for (int k = 0; k < 8; ++k) ASSERT_TRUE(rig.step(200, {command}).success);
    EXPECT_NEAR(rig.frame().joints[rig.joint_slot(kPsm.pitch)].position, pitch, 1e-4);
    EXPECT_NEAR(rig.frame().joints[rig.joint_slot("pitchfrontlink-pitchbottomlink")].position, -pitch, 1e-4);
    EXPECT_LT(rig.largest_gap(), 0.02e-3);
  }
}

// Motors keep the arm where the last command left it.
TEST(DvrkPsm, StaysWhenItsCommandsEnd) {
  ModelRig rig(nothing_else());
  ASSERT_TRUE(rig.load(own_model(kPsm.file)).success);
  const state::AddressedCommand command =
      rig.joint_command(kPsm.base, JointCommandType::position, {{kPsm.pitch, 0.5}, {kPsm.yaw, 0.3}});
  for (int k = 0; k < 8; ++k) ASSERT_TRUE(rig.step(200, {command}).success);
  state::Push push;
  push.force_world = {0, 2.0, 2.0};
  push.seconds = 1.0;
  ASSERT_TRUE(rig.wait_for([&](auto done) { rig.simulation.push(rig.id(kPsm.shaft), push, done); }).success);
  ASSERT_TRUE(rig.run(3.0).success);
  EXPECT_NEAR(rig.frame().joints[rig.joint_slot(kPsm.pitch)].position, 0.5, 1e-3);
  EXPECT_NEAR(rig.frame().joints[rig.joint_slot(kPsm.yaw)].position, 0.3, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Arms, DvrkMotors, testing::Values(kPsm, kEcm, kMtmr),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

// The same motors carry the links where gravity acts.
ArmCase heavy(ArmCase arm, const char* file) {
  arm.file = file;
  return arm;
}
INSTANTIATE_TEST_SUITE_P(WithGravity, DvrkMotors,
                         testing::Values(heavy(kPsm, "robots/psm_gravity.yaml"),
                                         heavy(kEcm, "robots/ecm_gravity.yaml")),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

TEST(DvrkPsm, FallsWithGravityWhereItsCounterweightIsGone) {
  for (const bool balanced : {true, false}) {
    ModelRig rig(nothing_else());
    ASSERT_TRUE(rig.load(own_model("robots/psm_gravity.yaml")).success);
    const state::AddressedCommand command =
        rig.joint_command(kPsm.base, JointCommandType::position, {{kPsm.pitch, 0.8}});
    for (int k = 0; k < 8; ++k) ASSERT_TRUE(rig.step(200, {command}).success);
    if (!balanced) {
      ASSERT_TRUE(rig.remove("/ambf/env/psm/counterweight").success);
    }
    ASSERT_TRUE(rig.run(1.0).success);
    const double pitch = rig.frame().joints[rig.joint_slot(kPsm.pitch)].position;
    if (balanced)
      EXPECT_NEAR(pitch, 0.8, 1e-3);
    else
      EXPECT_GT(pitch, 0.85);
  }
}

}  // namespace
}  // namespace ambf::runtime
