// Whether a model moves as an arm's kinematics say is judged beside the thread that reads frames.
#include "crtk/motion_judge.h"

#include <gtest/gtest.h>

#include "tests/runtime/simulation_rig.h"

namespace ambf::crtk {
namespace {

using Verdict = MotionJudge::Verdict;
using runtime::test::Rig;

const std::string kBase = "/ambf/env/psm/BODY base link";

adf::CrtkArm arm(const std::string& joints = {}) {
  const auto read =
      adf::parse_crtk_arms("crtk arms: {PSM1: {kinematics: PSM, base: '" + kBase + "'" + joints + "}}", "arms.yaml");
  EXPECT_TRUE(read.diagnostics.empty());
  return read.arms.at(0);
}

class JudgedPsm : public testing::Test {
 protected:
  JudgedPsm() : rig(runtime::test::free_running(), "") {
    state::LoadRequest request;
    request.path = AMBF_SOURCE_DIR "/ambf_models/descriptions/multi-bodies/robots/psm.yaml";
    EXPECT_TRUE(rig.simulation.load_and_wait(request).success);
    rig.wait_until([](const state::Frame& newest) {
      return state::find(*newest.structure, kBase, state::ObjectKind::rigid_body) != state::kNone;
    });
    frame = rig.frame();
    base = state::find(*frame.structure, kBase, state::ObjectKind::rigid_body);
  }

  Rig rig;
  state::Frame frame;
  std::uint32_t base = state::kNone;
  MotionJudge judge;
};

TEST_F(JudgedPsm, IsJudgedByAnotherThreadAndOnce) {
  const adf::CrtkArm right = arm();
  EXPECT_FALSE(judge.judge(rig.log));
  EXPECT_EQ(judge.of(right, frame, base), Verdict::pending);
  EXPECT_EQ(judge.of(right, frame, base), Verdict::pending);
  EXPECT_TRUE(judge.judge(rig.log));
  EXPECT_EQ(judge.of(right, frame, base), Verdict::fits);
  EXPECT_FALSE(judge.judge(rig.log));
}

TEST_F(JudgedPsm, OfADivergedWorldIsJudgedOnceItIsReset) {
  adf::CrtkArm wrong = arm();
  std::swap(wrong.kinematics.adf_joints[0], wrong.kinematics.adf_joints[1]);
  frame.run.diverged = true;
  EXPECT_EQ(judge.of(wrong, frame, base), Verdict::unknowable);
  EXPECT_FALSE(judge.judge(rig.log));
  frame.run.diverged = false;
  EXPECT_EQ(judge.of(wrong, frame, base), Verdict::pending);
  base::Log quiet;
  EXPECT_TRUE(judge.judge(quiet));
  EXPECT_EQ(judge.of(wrong, frame, base), Verdict::differs);
}

TEST_F(JudgedPsm, JointsThatAreNotFiniteAreNotJudged) {
  frame.joints[0].position = std::nan("");
  EXPECT_EQ(judge.of(arm(), frame, base), Verdict::unknowable);
  EXPECT_EQ(judge.of(arm(), rig.frame(), base), Verdict::pending);
}

}  // namespace
}  // namespace ambf::crtk
