// Our arms of KUKA: the original's names and home frames, motors that follow, tips where the published kinematics say.
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "adf/arms.h"
#include "tests/robots/original.h"

namespace ambf::runtime {
namespace {

using namespace test;

struct KukaCase {
  const char *name, *file, *original;
  const char* flange;  // body
  double foot;         // m: below the base body's frame
  double tip;          // m: from the flange body's frame
  bool base_moved;     // the original's base lies a metre away from its first joint
};
void PrintTo(const KukaCase& arm, std::ostream* out) { *out << arm.name; }

class Kuka : public testing::TestWithParam<KukaCase> {
 protected:
  Kuka() : rig(nothing_else()) {}
  void SetUp() override {
    const state::Outcome loaded = rig.load(own_model(GetParam().file));
    ASSERT_TRUE(loaded.success) << loaded.message;
    ASSERT_TRUE(loaded.diagnostics.empty()) << base::to_string(loaded.diagnostics.front());
  }
  ModelRig rig;
};

TEST_P(Kuka, HasTheNamesOrderTypesAndHomeFramesOfTheOriginal) {
  AMBF_NEEDS_COMPAT();
  const adf::ModelResult own = adf::load_model(own_model(GetParam().file));
  const adf::ModelResult original = adf::load_model(compat::model(GetParam().original));
  ASSERT_TRUE(own.model && original.model);
  expect_same_interface(*own.model, *original.model, GetParam().base_moved ? "base" : "");
}

TEST_P(Kuka, HasItsFlangeWhereTheKinematicsSay) {
  const kinematics::Arm& arm = *adf::known_arms().find(GetParam().name);
  std::mt19937 random(16);
  for (int k = 0; k < 4; ++k) {
    kinematics::ArmPosition wanted;
    for (std::size_t i = 0; i < arm.size(); ++i)
      wanted.joints.push_back(std::uniform_real_distribution<double>(0.5 * arm.lower[i], 0.5 * arm.upper[i])(random));
    std::vector<std::pair<std::string, double>> targets;
    for (const auto& [name, target] : to_adf(arm, wanted)) targets.emplace_back(spaceless(name), target);
    ASSERT_TRUE(rig.step(1, {rig.joint_command("BODY base", JointCommandType::position, targets)}).success);
    ASSERT_TRUE(rig.run(2.5).success);
    std::map<std::string, double> measured;
    for (const auto& [name, target] : targets) measured[name] = rig.frame().joints[rig.joint_slot(name)].position;
    const auto reached = from_adf(arm, measured);
    ASSERT_TRUE(reached);
    for (std::size_t i = 0; i < arm.size(); ++i) EXPECT_NEAR(reached->joints[i], wanted.joints[i], 1e-3) << i;
    const math::Pose T_world_foot = rig.body("BODY base").T_world_body * math::Pose{{0, 0, -GetParam().foot}, {}};
    const math::Pose tip =
        math::inverse(T_world_foot) * rig.body(GetParam().flange).T_world_body * math::Pose{{0, 0, GetParam().tip}, {}};
    const kinematics::PoseDifference off = kinematics::difference(tip, forward(arm, reached->joints));
    EXPECT_LT(off.distance, 0.1e-3);
    EXPECT_LT(off.angle, 0.1 * kPi / 180.0);
  }
}

constexpr KukaCase kLwr{"LWR_4", "robots/kuka_lwr.yaml", "robots/blender-kuka.yaml", "BODY link7", 0.0, 0.0145, false};
constexpr KukaCase kMed{"LBR_MED_14", "robots/kuka_lbr_med.yaml", "robots/blender-kuka-lbr-med.yaml",
                        "BODY Link7", -0.29008 + 0.037 + 0.3595,  0.036,
                        true};

KukaCase heavy(KukaCase arm, const char* file) {
  arm.file = file;
  return arm;
}

INSTANTIATE_TEST_SUITE_P(Arms, Kuka, testing::Values(kLwr, kMed),
                         [](const auto& parameter) { return std::string(parameter.param.name); });
INSTANTIATE_TEST_SUITE_P(WithGravity, Kuka,
                         testing::Values(heavy(kLwr, "robots/kuka_lwr_gravity.yaml"),
                                         heavy(kMed, "robots/kuka_lbr_med_gravity.yaml")),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

}  // namespace
}  // namespace ambf::runtime
