// Our arms of the da Vinci Research Kit in a running simulation: what tests of their linkages and motors share. One
// thread.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tests/robots/original.h"

namespace ambf::runtime::test {

// A link of a linkage: how far it turns in the yaw link's frame when the pitch, and the third joint, turn by one.
struct LinkRule {
  const char* link;
  double of_pitch, of_third;
};
struct ArmCase {
  const char *name, *file, *original;
  const char* name_space;
  const char *base, *yaw_link;           // bodies
  const char *yaw, *pitch, *third;       // joints; the third is insertion or elbow
  const char* shaft;                     // body; its z is along the shaft. Null: there is no remote centre
  math::Vec3 pitch_axis;                 // in the yaw link's frame
  const char *remote_center, *top_link;  // the redundant joint; without the link the centre is free
  std::vector<LinkRule> rules;
  const char* tip_body;
  math::Vec3 tip;                  // in the frame of that body
  std::array<double, 9> tip_axes;  // rows; of the published kinematics' tip frame in that body's
};
inline void PrintTo(const ArmCase& arm, std::ostream* out) { *out << arm.name; }

inline const ArmCase kPsm{"PSM",
                          "robots/psm.yaml",
                          "robots/blender-psm.yaml",
                          "/ambf/env/psm/",
                          "BODY base link",
                          "BODY yaw link",
                          "baselink-yawlink",
                          "yawlink-pitchbacklink",
                          "pitchendlink-maininsertionlink",
                          "BODY tool roll link",
                          {0, 1, 0},
                          "yawlink-pitchendlink",
                          "BODY pitch top link",
                          {{"BODY pitch back link", 1.0, 0.0},
                           {"BODY pitch front link", 1.0, 0.0},
                           {"BODY pitch end link", 1.0, 0.0},
                           {"BODY pitch bottom link", 0.0, 0.0},
                           {"BODY pitch top link", 0.0, 0.0}},
                          "BODY tool gripper1 link",
                          {},
                          {0, -1, 0, 0, 0, 1, -1, 0, 0}};  // the jaw's y is along the tool

inline const ArmCase kEcm{"ECM",
                          "robots/ecm.yaml",
                          "robots/blender-ecm.yaml",
                          "/ambf/env/ecm/",
                          "BODY base link",
                          "BODY yaw link",
                          "baselink-yawlink",
                          "yawlink-pitchbacklink",
                          "pitchendlink-maininsertionlink",
                          "BODY tool link",
                          {1, 0, 0},
                          "baselink-pitchendlink",
                          "BODY pitch top link",
                          {{"BODY pitch back link", 1.0, 0.0},
                           {"BODY pitch front link", 1.0, 0.0},
                           {"BODY pitch end link", 1.0, 0.0},
                           {"BODY pitch bottom link", 0.0, 0.0},
                           {"BODY pitch top link", 0.0, 0.0}},
                          "BODY tool link",
                          {0, 0, -0.371},
                          {1, 0, 0, 0, -1, 0, 0, 0, -1}};

inline const ArmCase kMtmr{"MTMR",
                           "robots/mtmr.yaml",
                           "robots/blender-mtm.yaml",
                           "/ambf/env/mtm/",
                           "BODY Top Panel",
                           "BODY OutPitch Shoulder",
                           "TopPanel-OutPitchShoulder",
                           "OutPitchShoulder-ArmParallel",
                           "ArmParallel-BottomArm",
                           nullptr,
                           {0, 1, 0},
                           nullptr,
                           nullptr,
                           {{"BODY ArmParallel", 1.0, 0.0},
                            {"BODY ArmFront", 1.0, 0.0},
                            {"BODY ArmParallel1", 1.0, 1.0},
                            {"BODY BottomArm", 1.0, 1.0}},
                           "BODY WristRoll",
                           {0, 0, -0.039},
                           {-1, 0, 0, 0, -1, 0, 0, 0, 1}};

// Its linkage is the right one's mirrored; the original has no left one.
inline ArmCase mtml() {
  ArmCase left = kMtmr;
  left.name = "MTML";
  left.file = "robots/mtml.yaml";
  left.name_space = "/ambf/env/mtml/";
  return left;
}
inline const ArmCase kMtml = mtml();

class DvrkArms : public testing::TestWithParam<ArmCase> {
 protected:
  DvrkArms() : rig(nothing_else()) {}
  void SetUp() override {
    const state::Outcome loaded = rig.load(own_model(GetParam().file));
    ASSERT_TRUE(loaded.success) << loaded.message;
    ASSERT_TRUE(loaded.diagnostics.empty()) << base::to_string(loaded.diagnostics.front());
    for (const LinkRule& rule : GetParam().rules) home[rule.link] = in_yaw_link(rule.link);
    for (const char* joint : {GetParam().yaw, GetParam().pitch, GetParam().third}) moved.push_back(joint);
  }

  math::Quat in_yaw_link(const char* link) {
    return math::inverse(rig.body(GetParam().yaw_link).T_world_body.orientation) *
           rig.body(GetParam().name_space + std::string(link)).T_world_body.orientation;
  }
  const state::JointInfo& info(const std::string& joint) {
    structure = rig.simulation.structure();
    return structure->joints[rig.joint_slot(joint)];
  }
  double position(const std::string& joint) { return rig.frame().joints[rig.joint_slot(joint)].position; }
  // Distance of the remote centre, the base link's origin, from the axis of the shaft.
  double off_center() {
    if (GetParam().shaft == nullptr) return 0.0;
    const math::Pose shaft = rig.body(GetParam().shaft).T_world_body;
    const math::Vec3 axis = math::rotate(shaft.orientation, {0, 0, 1});
    return norm(cross(axis, rig.body(GetParam().base).T_world_body.position - shaft.position));
  }
  bool step_to(const std::vector<std::pair<std::string, double>>& targets, unsigned steps = 1) {
    return rig.step(steps, {rig.joint_command(GetParam().base, JointCommandType::position, targets)}).success;
  }

  struct Worst {
    double gap = 0.0, off_center = 0.0, mimic = 0.0;
    std::string whose;
    std::vector<double> low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
  };
  // Yaw, pitch and the third joint through their whole ranges, all at once and with different periods.
  Worst sweep() {
    constexpr double kFrequency[] = {0.24, 0.31, 0.19}, kSeconds = 6.0;  // Hz: within the motors' efforts
    std::vector<double> middle, half, from;
    for (const std::string& joint : moved) {
      middle.push_back(0.5 * (info(joint).lower + info(joint).upper));
      half.push_back(0.5 * (info(joint).upper - info(joint).lower));
      from.push_back(position(joint));
    }
    Worst worst;
    for (unsigned k = 1; k <= kSeconds * 1e3; ++k) {
      const double t = k * 1e-3, u = std::min(t, 1.0), blend = u * u * (3.0 - 2.0 * u);
      std::vector<std::pair<std::string, double>> targets;
      for (std::size_t i = 0; i < moved.size(); ++i) {
        const double wave = middle[i] + half[i] * std::sin(2.0 * kPi * kFrequency[i] * t);
        targets.emplace_back(moved[i], from[i] + blend * (wave - from[i]));
      }
      EXPECT_TRUE(step_to(targets));
      if (k % 4 != 0) continue;
      worst.gap = std::max(worst.gap, rig.largest_gap(&worst.whose));
      worst.off_center = std::max(worst.off_center, off_center());
      const double pitch = position(GetParam().pitch), third = position(GetParam().third);
      for (const LinkRule& rule : GetParam().rules) {
        const math::Vec3 turned = math::log(in_yaw_link(rule.link) * math::inverse(home[rule.link]));
        worst.mimic = std::max(worst.mimic,
                               norm(turned - GetParam().pitch_axis * (rule.of_pitch * pitch + rule.of_third * third)));
      }
      for (std::size_t i = 0; i < moved.size(); ++i) {
        worst.low[i] = std::min(worst.low[i], position(moved[i]));
        worst.high[i] = std::max(worst.high[i], position(moved[i]));
      }
    }
    std::printf("%s: pivots %.5f mm apart (%s), shaft %.5f mm off the centre, links %.6f mrad off their rules\n",
                GetParam().name, worst.gap * 1e3, worst.whose.c_str(), worst.off_center * 1e3, worst.mimic * 1e3);
    return worst;
  }
  void expect_true_linkage(const Worst& worst) {
    EXPECT_LT(worst.gap, 0.02e-3);
    EXPECT_LT(worst.off_center, 0.05e-3);
    EXPECT_LT(worst.mimic, 0.1e-3);
    for (std::size_t i = 0; i < moved.size(); ++i) {
      const double slack = 0.05 * (info(moved[i]).upper - info(moved[i]).lower);
      EXPECT_LT(worst.low[i], info(moved[i]).lower + slack) << moved[i];
      EXPECT_GT(worst.high[i], info(moved[i]).upper - slack) << moved[i];
    }
  }
  // 1 N at the remote centre.
  void push_end_link() {
    state::Push push;
    push.point_body =
        math::inverse(rig.body("BODY pitch end link").T_world_body) * rig.body(GetParam().base).T_world_body.position;
    push.force_world = {0, 1.0, 0};
    push.seconds = 0.5;
    const state::Outcome pushed =
        rig.wait_for([&](auto done) { rig.simulation.push(rig.id("BODY pitch end link"), push, done); });
    ASSERT_TRUE(pushed.success) << pushed.message;
  }

  ModelRig rig;
  std::shared_ptr<const state::Structure> structure;
  std::map<std::string, math::Quat> home;
  std::vector<std::string> moved;
};

}  // namespace ambf::runtime::test
