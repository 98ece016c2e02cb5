// Whether models move as the rows of known arms say: those that are shipped do; wrong signs, offsets and joints are
// found.
#include <gtest/gtest.h>

#include <fstream>

#include "adf/adf.h"
#include "adf/arms.h"
#include "adf/check.h"
#include "adf/crtk/motion.h"
#include "kinematics/agreement.h"
#include "scene/chain.h"
#include "scene/lookup.h"

namespace ambf::kinematics {
namespace {

using Verdict = Agreement::Verdict;

const std::string kModels = AMBF_SOURCE_DIR "/ambf_models/descriptions/";

const scene::Model& model_of(const std::string& file) {
  static std::map<std::string, scene::Model> read;
  const auto found = read.find(file);
  if (found != read.end()) return found->second;
  adf::Options options;
  options.look_for_files = false;
  return read[file] = *adf::load_model(kModels + "multi-bodies/" + file, options).model;
}

Agreement compared(const Arm& arm, const std::string& file, const std::string& base) {
  const scene::Model& model = model_of(file);
  std::vector<std::string> bodies;
  for (const scene::Body& body : model.bodies) bodies.push_back(body.identity.name_space + body.identity.identifier);
  const auto found = scene::find_identifier(bodies, base).index;
  EXPECT_TRUE(found) << base;
  return compare(arm, scene::mechanism_joints(model), found.value_or(0));
}

Agreement psm(const Arm& arm) { return compared(arm, "robots/psm.yaml", "/ambf/env/psm/BODY base link"); }
Arm known_psm() { return *adf::known_arms().find("PSM"); }

struct Shipped {
  const char *arm, *file, *base;
};
class ShippedArms : public testing::TestWithParam<Shipped> {};

TEST_P(ShippedArms, MoveAsTheirRowsSay) {
  const Agreement found = compared(*adf::known_arms().find(GetParam().arm), GetParam().file, GetParam().base);
  EXPECT_EQ(found.verdict, Verdict::agrees) << found.joint;
  EXPECT_LT(found.distance, 1e-5);
  EXPECT_LT(found.angle, 1e-4);
}
INSTANTIATE_TEST_SUITE_P(All, ShippedArms,
                         testing::Values(Shipped{"PSM", "robots/psm.yaml", "/ambf/env/psm/BODY base link"},
                                         Shipped{"ECM", "robots/ecm.yaml", "/ambf/env/ecm/BODY base link"},
                                         Shipped{"MTMR", "robots/mtmr.yaml", "/ambf/env/mtm/BODY Top Panel"},
                                         Shipped{"MTML", "robots/mtml.yaml", "/ambf/env/mtml/BODY Top Panel"},
                                         Shipped{"SUJ_PSM1", "robots/suj.yaml", "/ambf/env/BODY base link"},
                                         Shipped{"SUJ_PSM3", "robots/suj.yaml", "/ambf/env/BODY base link"},
                                         Shipped{"SUJ_ECM", "robots/suj.yaml", "/ambf/env/BODY base link"},
                                         Shipped{"RAVEN_LEFT", "robots/raven2.yaml", "BODY left_base"},
                                         Shipped{"RAVEN_RIGHT", "robots/raven2.yaml", "BODY right_base"},
                                         Shipped{"LBR_MED_14", "robots/kuka_lbr_med.yaml", "BODY base"},
                                         Shipped{"LWR_4", "robots/kuka_lwr.yaml", "BODY base"}),
                         [](const auto& parameter) { return std::string(parameter.param.arm); });

TEST(Agreement, WrongSignsAreFoundOfEveryJoint) {
  for (std::size_t i = 0; i < known_psm().adf_joints.size(); ++i) {
    Arm arm = known_psm();
    arm.adf_joints[i].sign = -1.0;
    const Agreement found = psm(arm);
    EXPECT_EQ(found.verdict, Verdict::differs) << arm.adf_joints[i].name;
  }
  Arm arm = known_psm();
  std::swap(arm.adf_jaw[0].wrist, arm.adf_jaw[1].wrist);
  EXPECT_EQ(psm(arm).verdict, Verdict::differs);
  Arm one = known_psm();
  one.adf_jaw[1].wrist = 1.0;  // the other half only
  EXPECT_EQ(psm(one).verdict, Verdict::differs);
}

TEST(Agreement, WrongOffsetsAndLengthsAreFound) {
  for (const std::size_t i : {1, 2, 3, 4}) {
    Arm arm = known_psm();
    arm.adf_joints[i].offset = arm.prismatic[i] ? 0.01 : 0.1;
    EXPECT_EQ(psm(arm).verdict, Verdict::differs) << arm.adf_joints[i].name;
  }
  // The first joint's is where the rows start: 0.1 rad aside.
  Arm arm = known_psm();
  arm.adf_joints[0].offset = 0.1;
  const Agreement found = psm(arm);
  EXPECT_EQ(found.verdict, Verdict::agrees);
  EXPECT_NEAR(found.base_angle, 0.1, 1e-4);
  Arm other = known_psm();
  other.steps[2].before.position.z += 0.005;  // of the shaft's way
  EXPECT_EQ(psm(other).verdict, Verdict::differs);
}

TEST(Agreement, WrongJointsAreFound) {
  Arm swapped = known_psm();
  std::swap(swapped.adf_joints[0].name, swapped.adf_joints[1].name);
  EXPECT_EQ(psm(swapped).verdict, Verdict::differs);
  Arm absent = known_psm();
  absent.adf_joints[3].name = "a joint";
  const Agreement missing = psm(absent);
  EXPECT_EQ(missing.verdict, Verdict::not_the_way);
  EXPECT_EQ(missing.joint, "a joint");
  // Its tip is the gripper's half instead of what comes after the pitch link.
  Arm loose = known_psm();
  loose.adf_joints[4].name = "base link-yaw link";
  EXPECT_EQ(psm(loose).verdict, Verdict::unknown);
}

TEST(Agreement, AnotherJointOfALoopMayDriveIt) {
  Arm arm = known_psm();
  arm.adf_joints[1].name = "yaw link-pitch front link";
  EXPECT_EQ(psm(arm).verdict, Verdict::agrees);
}

TEST(Agreement, IsToldWithPlaceAndHintWhereFilesAreChecked) {
  const std::string own = testing::TempDir() + "ambf_agreement_arms.yaml", file = testing::TempDir() + "ambf_crtk.yaml";
  std::ifstream known(AMBF_SOURCE_DIR "/ambf_client_py/ambf_client/kinematics/arms.yaml");
  std::string text{std::istreambuf_iterator<char>(known), {}};
  const std::string right = "{joint: yaw link-pitch back link}";
  text.replace(text.find(right), right.size(), "{joint: yaw link-pitch back link, sign: -1}");
  std::ofstream(own) << text;
  const auto description = [&](const std::string& kinematics, const std::string& more) {
    std::ofstream(file) << "crtk arms:\n  PSM1:\n    kinematics: " + kinematics +
                               "\n    base: /ambf/env/psm/BODY base link\n" + more;
    return adf::check_file(file, {}, {model_of("robots/psm.yaml")});
  };
  EXPECT_TRUE(description("PSM", "").empty());
  EXPECT_TRUE(description("PSM", "    view: ECM\n").empty());
  const base::Diagnostics found = description("PSM", "    kinematics file: " + own + "\n");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].severity, base::Severity::error);
  const std::string said = base::to_string(found[0]);
  EXPECT_NE(said.find("ambf_crtk.yaml:3:17: error: [PSM1: kinematics]"), std::string::npos) << said;
  EXPECT_NE(said.find("'yaw link-pitch back link'"), std::string::npos) << said;
  // Another tool than the model's: 1.6 mm longer.
  EXPECT_TRUE(base::has_errors(description("PSM", "    tool: NEEDLE_DRIVER_5MM:400117\n")));
  // In a view, rows start in the body's frame.
  const std::string first = "{joint: base link-yaw link}";
  text.replace(text.find(first), first.size(), "{joint: base link-yaw link, offset: 0.1}");
  text.replace(text.find(", sign: -1"), 10, "");
  std::ofstream(own) << text;
  EXPECT_TRUE(description("PSM", "    kinematics file: " + own + "\n").empty());
  const base::Diagnostics aside = description("PSM", "    view: ECM\n    kinematics file: " + own + "\n");
  ASSERT_EQ(aside.size(), 1u);
  EXPECT_NE(aside[0].message.find("do not start in the frame"), std::string::npos) << aside[0].message;
}

}  // namespace
}  // namespace ambf::kinematics
