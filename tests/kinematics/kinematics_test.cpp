// Known arms: published poses, inverse of forward, refusals, Jacobians; chains of ADF joints; files of arms.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <random>
#include <set>
#include <sstream>

#include "adf/arms.h"
#include "adf/document.h"
#include "math/rotation.h"

namespace ambf::kinematics {
namespace {

Joints random_joints(const Arm& arm, std::mt19937& rng) {
  std::uniform_real_distribution<double> uniform;
  Joints q;
  for (std::size_t i = 0; i < arm.size(); ++i) {
    const double place = uniform(rng), corner = uniform(rng);  // one in five is at a limit
    q.push_back(corner < 0.1   ? arm.lower[i]
                : corner < 0.2 ? arm.upper[i]
                               : arm.lower[i] + place * (arm.upper[i] - arm.lower[i]));
  }
  return q;
}

std::vector<double> numbers(const adf::Value& list) {
  std::vector<double> made;
  for (std::size_t i = 0; i < list.size(); ++i) made.push_back(std::stod(list.item(i).text()));
  return made;
}

const Arm& arm_of(const std::string& name, const std::string& tool = {}) {
  const Arm* arm = adf::known_arms().find(name, tool);
  if (arm == nullptr) throw std::invalid_argument(name + tool);
  return *arm;
}

bool redundant(const Arm& arm) { return arm.size() == 7; }

TEST(KnownArms, ReachThePublishedPoses) {
  std::ostringstream text;
  text << std::ifstream(AMBF_SOURCE_DIR "/tests/kinematics/check_poses.yaml").rdbuf();
  const adf::Document document(text.str());
  ASSERT_EQ(document.root().size(), 48u);
  for (std::size_t i = 0; i < document.root().size(); ++i) {
    const adf::Value given = document.root().item(i);
    const auto tool = given.find("tool");
    const Arm& arm = arm_of(given.find("arm")->text(), tool ? tool->text() : "");
    const auto p = numbers(*given.find("position")), q = numbers(*given.find("quaternion"));
    math::Pose wanted{{p[0], p[1], p[2]}, {q[0], q[1], q[2], q[3]}};
    const PoseDifference found = difference(forward(arm, numbers(*given.find("joints"))), wanted);
    EXPECT_LT(found.distance, 1e-6) << arm.name << i;
    EXPECT_LT(found.angle, 2e-6) << arm.name << i;
  }
}

TEST(KnownArms, InverseLeadsBackOverTheWholeRange) {
  std::mt19937 rng(1);
  std::set<std::string> seen;
  for (const Arm& arm : adf::known_arms().arms) {
    if (arm.solver == Solver::numeric) continue;
    seen.insert(arm.name);
    for (int i = 0; i < 100; ++i) {
      const Joints q = random_joints(arm, rng);
      const math::Pose pose = forward(arm, q);
      const Answer answer = inverse(arm, pose, redundant(arm) ? q : arm.home);
      ASSERT_EQ(answer.status, Status::solved) << arm.name << arm.tool << i;
      const PoseDifference missing = difference(forward(arm, answer.joints), pose);
      ASSERT_LT(std::max(missing.distance, missing.angle), 1e-9);
    }
  }
  EXPECT_EQ(seen.size(), 9u);
}

TEST(KnownArms, SnakeToolIsSolvedNumerically) {
  const Arm& arm = arm_of("PSM", "NEEDLE_DRIVER_5MM:400117");
  const Joints q{0.2, -0.1, 0.15, 0.4, 0.3, -0.5};
  const Answer answer = inverse(arm, forward(arm, q), arm.home);
  ASSERT_EQ(answer.status, Status::solved);
  for (std::size_t i = 0; i < q.size(); ++i) EXPECT_NEAR(answer.joints[i], q[i], 1e-8);
  const Answer beyond = inverse(arm, forward(arm, {0.2, -0.1, 0.26, 0.4, 0.3, -0.5}), arm.home);
  EXPECT_EQ(beyond.status, Status::out_of_limits);
  EXPECT_EQ(beyond.joint, 2);
  EXPECT_NEAR(beyond.excess, 0.02, 1e-8);
}

TEST(KnownArms, JacobiansAreDifferences) {
  std::mt19937 rng(2);
  constexpr double kStep = 1e-6;
  for (const Arm& arm : adf::known_arms().arms) {
    const Joints q = random_joints(arm, rng);
    const auto spatial = jacobian(arm, q, JacobianFrame::spatial), body = jacobian(arm, q, JacobianFrame::body);
    const math::Quat to_tip = inverse(forward(arm, q).orientation);
    for (std::size_t j = 0; j < arm.size(); ++j) {
      Joints before = q, after = q;
      before[j] -= kStep;
      after[j] += kStep;
      const math::Pose a = forward(arm, before), b = forward(arm, after);
      const math::Vec3 linear = (b.position - a.position) / (2.0 * kStep);
      const math::Quat turned = b.orientation * inverse(a.orientation);
      const double sign = turned.w < 0.0 ? -1.0 : 1.0;
      const math::Vec3 angular = math::Vec3{turned.x, turned.y, turned.z} * (sign / kStep);
      const auto column = [&](const std::vector<double>& rows, std::size_t first) {
        const std::size_t n = arm.size();
        return math::Vec3{rows[first * n + j], rows[(first + 1) * n + j], rows[(first + 2) * n + j]};
      };
      EXPECT_LT(norm(column(spatial, 0) - linear), 1e-6) << arm.name << j;
      EXPECT_LT(norm(column(spatial, 3) - angular), 1e-6) << arm.name << j;
      EXPECT_LT(norm(column(body, 0) - rotate(to_tip, linear)), 1e-6) << arm.name << j;
      EXPECT_LT(norm(column(body, 3) - rotate(to_tip, angular)), 1e-6) << arm.name << j;
    }
  }
}

TEST(KnownArms, JointBeyondItsLimitIsNamed) {
  const Arm& arm = arm_of("PSM");
  for (std::size_t joint : {0u, 1u, 2u, 4u, 5u}) {
    Joints q{0.2, -0.3, 0.2, 0.5, 0.3, -0.2};
    q[joint] = arm.upper[joint] + 0.03;
    const Answer answer = inverse(arm, forward(arm, q), arm.home);
    EXPECT_EQ(answer.status, Status::out_of_limits);
    EXPECT_EQ(answer.joint, static_cast<int>(joint));
    EXPECT_NEAR(answer.excess, 0.03, 1e-9);
    EXPECT_NEAR(answer.joints[joint], arm.upper[joint], 1e-12);
    EXPECT_GT(answer.distance + answer.angle, 1e-3);
  }
}

TEST(KnownArms, TipOnTheRemoteCentreIsSingular) {
  const Arm& arm = arm_of("PSM");
  math::Pose pose = forward(arm, arm.home);
  pose.position = {};
  const Answer answer = inverse(arm, pose, {0.1, 0.1, 0.1, 0.2, 0.3, 0.4});
  EXPECT_EQ(answer.status, Status::singular);
  EXPECT_EQ(answer.free, (std::vector<bool>{false, false, false, false, false, true}));
  EXPECT_NEAR(answer.joints[5], 0.4, 1e-12);
  EXPECT_LT(norm(forward(arm, answer.joints).position), 1e-9);
}

TEST(KnownArms, AnswerTheNearestToWhatNothingReaches) {
  const Arm& arm = arm_of("LBR_MED_14");
  const Joints q{0.3, 0.8, 0.2, 0.0, 0.4, 0.7, -0.5};
  math::Pose pose = forward(arm, q);
  const math::Vec3 wrist = pose * math::Vec3{0.0, 0.0, -0.126} - math::Vec3{0.0, 0.0, 0.3595};
  pose.position += wrist * (0.1 / norm(wrist));
  const Answer answer = inverse(arm, pose, q);
  EXPECT_EQ(answer.status, Status::unreachable);
  EXPECT_FALSE(answer.reached());
  EXPECT_NEAR(answer.distance, 0.1, 1e-9);
  EXPECT_LT(answer.angle, 1e-9);
}

TEST(KnownArms, AnswerBadInputWithFiniteValues) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const Arm& arm : adf::known_arms().arms) {
    math::Pose pose = forward(arm, arm.home);
    EXPECT_TRUE(inverse(arm, pose, arm.home).reached()) << arm.name;
    EXPECT_EQ(inverse(arm, pose, Joints(arm.size(), kNan)).status, Status::invalid);
    EXPECT_EQ(inverse(arm, pose, {0.0}).status, Status::invalid);
    pose.position = {};
    Answer answer = inverse(arm, pose, arm.home);
    for (double q : answer.joints) EXPECT_TRUE(std::isfinite(q)) << arm.name;
    pose.position.x = kNan;
    answer = inverse(arm, pose, arm.home);
    EXPECT_EQ(answer.status, Status::invalid);
    EXPECT_EQ(answer.joints, arm.home);
  }
}

TEST(KnownArms, RavenHasEightSolutions) {
  const Arm& arm = arm_of("RAVEN_RIGHT");
  const math::Pose pose = forward(arm, {0.8, 1.6, 0.45, -0.6, -0.5, 0.3});
  const auto found = solutions(arm, pose, arm.home);
  EXPECT_EQ(found.size(), 8u);
  for (const Solution& solution : found) {
    const PoseDifference missing = difference(forward(arm, solution.joints), pose);
    EXPECT_LT(std::max(missing.distance, missing.angle), 1e-9);
  }
}

TEST(KnownArms, ConvertJointsOfAdfModels) {
  const Arm& arm = arm_of("PSM");
  const Joints q{0.2, -0.1, 0.15, 0.4, 0.3, -0.5};
  const auto positions = to_adf(arm, {q, 0.6});
  EXPECT_NEAR(positions.at("tool pitch link-tool gripper1 link"), -0.5 + 0.3, 1e-12);
  EXPECT_NEAR(positions.at("tool pitch link-tool gripper2 link"), 0.5 + 0.3, 1e-12);
  const auto back = from_adf(arm, positions);
  ASSERT_TRUE(back);
  EXPECT_NEAR(back->opening, 0.6, 1e-12);
  for (std::size_t i = 0; i < q.size(); ++i) EXPECT_NEAR(back->joints[i], q[i], 1e-12);
  EXPECT_FALSE(from_adf(arm, {}));
}

TEST(Chain, OfAdfJointsMovesAsTheyDo) {
  Chain chain;
  append(chain, {.parent_pivot = {0, 0, 1}, .parent_axis = {0, 1, 0}, .child_axis = {1, 0, 0}, .child_offset = 0.3},
         false, -3.0, 3.0, "turn");
  append(chain, {.child_pivot = {0, 0.5, 0}, .parent_axis = {1, 0, 0}, .child_axis = {-1, 0, 0}}, true, -1.0, 1.0,
         "slide");
  // T_P_C(q) of an ADF joint: R = AxisAngle(parent axis, offset + q) rot(child axis, parent axis).
  const math::Quat first = math::from_axis_angle({0, 1, 0}, 0.3 + 0.4) * math::rotation_between({1, 0, 0}, {0, 1, 0});
  const math::Quat second = math::rotation_between({-1, 0, 0}, {1, 0, 0});
  const math::Pose wanted =
      math::Pose{{0, 0, 1}, first} * math::Pose{math::Vec3{0.2, 0, 0} - rotate(second, math::Vec3{0, 0.5, 0}), second};
  const PoseDifference found = difference(forward(chain, {0.4, 0.2}), wanted);
  EXPECT_LT(std::max(found.distance, found.angle), 1e-12);
  const Answer answer = inverse(chain, wanted, chain.home);
  ASSERT_EQ(answer.status, Status::solved);
  EXPECT_NEAR(answer.joints[0], 0.4, 1e-9);
  EXPECT_NEAR(answer.joints[1], 0.2, 1e-9);
}

// A joint that moves its axes by half: whole turns of the joint are no whole turns of the axes.
TEST(Chain, AnswersReachThePoseWhateverTheRatios) {
  for (double ratio : {0.5, 1.5, 2.0, 1.0 / 3.0, 0.618}) {
    Chain chain;
    append(chain, {.parent_axis = {0, 0, 1}}, false, -25.0, 25.0, "first");
    append(chain, {.parent_pivot = {0.3, 0, 0}, .parent_axis = {0, 1, 0}, .child_axis = {0, 1, 0}}, false, -25.0, 25.0,
           "second");
    append(chain, {.parent_pivot = {0, 0, 0.2}, .parent_axis = {1, 0, 0}, .child_axis = {1, 0, 0}}, false, -25.0, 25.0,
           "third");
    for (Step& step : chain.steps) step.ratio = ratio;
    chain.tip = math::Pose{{0.1, 0.05, 0.0}, {}};
    const Joints q{0.4, -0.5, 0.3};
    for (const double away : {0.0, 6.0, -12.0, 18.0}) {
      const Answer answer = inverse(chain, forward(chain, q), {q[0] + away, q[1], q[2] - away});
      ASSERT_TRUE(answer.reached()) << ratio;
      const PoseDifference missing = difference(forward(chain, answer.joints), forward(chain, q));
      EXPECT_LT(std::max(missing.distance, missing.angle), 1e-9) << ratio << " " << away;
    }
  }
}

TEST(ArmFile, ReportsMistakesWithTheirPlaceAndKeepsTheRest) {
  const std::string good =
      "GOOD:\n  dh: modified\n  solver: numeric\n  joints:\n"
      "    - {name: a, type: revolute, limits_deg: [-90, 90]}\n  rows:\n"
      "    - {joint: 0, alpha_deg: 0, a: 0.1, d: 0, theta_deg: 0}\n";
  const std::pair<const char*, const char*> cases[] = {
      {"BAD: {same_as: NOBODY}\n", "another arm"},
      {"BAD: {same_as: BAD}\n", "another arm"},
      {"BAD: {same_as: GOOD, colour: red}\n", "unknown key"},
      {"BAD: {same_as: GOOD, rows: {0: {a: long}}}\n", "a number"},
      {"BAD: {same_as: GOOD, rows: {7: {a: 1}}}\n", "index"},
      {"BAD: {same_as: GOOD, limits_deg: {0: [90, -90]}}\n", "the lower one first"},
      {"BAD: {same_as: GOOD, solver: gimbal}\n", "does not fit"},
      {"BAD: {same_as: GOOD, foot: {xyz: [1]}}\n", "3 numbers"},
      {"BAD: 5\n", "map"},
  };
  for (const auto& [text, message] : cases) {
    const auto result = adf::parse_arms(good + text, "arms.yaml");
    ASSERT_EQ(result.diagnostics.size(), 1u) << text;
    EXPECT_NE(result.diagnostics[0].message.find(message), std::string::npos) << result.diagnostics[0].message;
    EXPECT_GT(result.diagnostics[0].line, 0);
    EXPECT_NE(result.table.find("GOOD"), nullptr);
    EXPECT_EQ(result.table.find("BAD"), nullptr);
  }
  EXPECT_EQ(adf::parse_arms("- 1\n", "x").diagnostics.size(), 1u);
  EXPECT_EQ(adf::known_arms().names.size(), 13u);
}

}  // namespace
}  // namespace ambf::kinematics
