// Our robot for needles under MRI: the original's names and home frames, a scissor of six bars and a linkage of eight
// that stay closed while they move, a needle that turns about the remote centre.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "tests/robots/original.h"

namespace ambf::runtime {
namespace {

using namespace test;

constexpr const char *kBase = "BODY base_link", *kPlatform = "BODY vertical_translation_fol";
constexpr const char* kLevelBar = "BODY vertical_translation_par";  // ours

class Neuro : public testing::TestWithParam<const char*> {
 protected:
  Neuro() : rig(nothing_else()) {}
  void SetUp() override {
    const state::Outcome loaded = rig.load(own_model(GetParam()));
    ASSERT_TRUE(loaded.success) << loaded.message;
    ASSERT_TRUE(loaded.diagnostics.empty()) << base::to_string(loaded.diagnostics.front());
    platform_home = rig.body(kPlatform).T_world_body.orientation;
    center_in_platform = math::inverse(rig.body(kPlatform).T_world_body) * math::Vec3{0.260, -0.065, 0.153};
  }
  // rad, from level.
  double tilt() { return norm(math::log(rig.body(kPlatform).T_world_body.orientation * math::inverse(platform_home))); }
  // m, of the needle's line from the remote centre on the yaw's axis.
  double off_center() {
    const math::Pose needle = rig.body("BODY needle_link").T_world_body;
    const math::Vec3 center = rig.body(kPlatform).T_world_body * center_in_platform;
    return norm(cross(math::rotate(needle.orientation, {0, 0, 1}), center - needle.position));
  }
  ModelRig rig;
  math::Quat platform_home;
  math::Vec3 center_in_platform;
};

TEST_P(Neuro, HasTheNamesOrderTypesAndHomeFramesOfTheOriginal) {
  AMBF_NEEDS_COMPAT();
  const adf::ModelResult own = adf::load_model(own_model(GetParam()));
  const adf::ModelResult original = adf::load_model(compat::model("robots/blender-neuro-robot.yaml"));
  ASSERT_TRUE(own.model && original.model);
  expect_same_interface(*own.model, *original.model);
}

TEST_P(Neuro, StaysClosedOverTheWholeRange) {
  struct Range {
    double low = 1e9, high = -1e9;
  };
  std::map<std::string, Range> reached;
  double gap = 0.0, off = 0.0, tilted = 0.0;
  std::string whose;
  for (unsigned k = 1; k <= 5000; ++k) {
    const double t = k * 1e-3, blend = std::min(t, 0.5) * 2.0;
    const auto wave = [&](double hertz) { return std::sin(2.0 * kPi * hertz * t); };
    // Both slides towards each other, by up to 0.1 m together, raise the platform.
    const double closer = 0.05 * (1.0 - std::cos(2.0 * kPi * 0.33 * t));
    const double left = std::clamp(0.5 * closer + 0.035 * wave(0.21), 0.0, 0.1);
    const std::vector<std::pair<std::string, double>> targets = {
        {"base_link-lateral_translation_link", blend * 0.025 * (1.0 + wave(0.4))},
        {"lateral_translation_link-axial_translation_link", blend * left},
        {"lateral_translation_link-axial_translation_mirror", blend * (closer - left)},
        {"vertical_translation_fol-yaw_link", blend * 1.12 * wave(0.35)},
        {"yaw_link-pitch_link", blend * 0.69 * wave(0.45)},
        {"needle_driver_base_link-needle_driver_link", blend * 0.02 * (1.0 + wave(0.5))},
        {"needle_driver_link-needle_link", blend * 1.03 * wave(0.5)}};
    ASSERT_TRUE(rig.step(1, {rig.joint_command(kBase, JointCommandType::position, targets)}).success);
    if (k % 5 != 0) continue;
    gap = std::max(gap, rig.largest_gap(&whose));
    off = std::max(off, off_center());
    tilted = std::max(tilted, tilt());
    for (const auto& [joint, target] : targets) {
      const double q = rig.frame().joints[rig.joint_slot(joint)].position;
      reached[joint].low = std::min(reached[joint].low, q);
      reached[joint].high = std::max(reached[joint].high, q);
    }
  }
  std::printf("pivots %.5f mm apart (%s), needle %.5f mm off the centre, platform %.4f mrad off level\n", gap * 1e3,
              whose.c_str(), off * 1e3, tilted * 1e3);
  EXPECT_LT(gap, 0.02e-3);
  EXPECT_LT(off, 0.05e-3);
  EXPECT_LT(tilted, 0.1e-3);
  EXPECT_LT(reached["vertical_translation_fol-yaw_link"].low, -1.05);
  EXPECT_GT(reached["vertical_translation_fol-yaw_link"].high, 1.05);
  EXPECT_LT(reached["yaw_link-pitch_link"].low, -0.65);
  EXPECT_GT(reached["yaw_link-pitch_link"].high, 0.65);
  EXPECT_GT(reached["base_link-lateral_translation_link"].high, 0.047);
  EXPECT_GT(reached["lateral_translation_link-axial_translation_link"].high, 0.07);
  EXPECT_GT(reached["needle_driver_base_link-needle_driver_link"].high, 0.038);
}

// Nothing hidden keeps the platform level: without the second bar it tilts at a push.
TEST_P(Neuro, PlatformIsKeptLevelByTheSecondBarAlone) {
  const auto push_aside = [&] {
    state::Push push;
    push.point_body = {};
    push.force_world = {0, 2.0, -2.0};
    push.seconds = 0.3;
    ASSERT_TRUE(rig.wait_for([&](auto done) { rig.simulation.push(rig.id(kPlatform), push, done); }).success);
    ASSERT_TRUE(rig.run(0.3).success);
  };
  const auto raised = rig.joint_command(kBase, JointCommandType::position,
                                        {{"lateral_translation_link-axial_translation_link", 0.03},
                                         {"lateral_translation_link-axial_translation_mirror", 0.03}});
  for (int k = 0; k < 10; ++k) ASSERT_TRUE(rig.step(100, {raised}).success);
  push_aside();
  EXPECT_LT(tilt(), 1e-3);
  ASSERT_TRUE(rig.remove(kLevelBar).success);
  push_aside();
  EXPECT_GT(tilt(), 0.05);
}

INSTANTIATE_TEST_SUITE_P(Gravity, Neuro, testing::Values("robots/neuro_robot.yaml", "robots/neuro_robot_gravity.yaml"),
                         [](const auto& parameter) {
                           return std::string(parameter.param).find("gravity") == std::string::npos ? "Without"
                                                                                                    : "With";
                         });

}  // namespace
}  // namespace ambf::runtime
