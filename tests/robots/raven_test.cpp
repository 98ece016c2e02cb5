// Our Raven II: both arms' tips are where the published kinematics say, for any joints.
#include <cmath>
#include <map>
#include <random>

#include "adf/arms.h"
#include "tests/robots/original.h"

namespace ambf::runtime {
namespace {

using namespace test;

class Raven : public testing::TestWithParam<const char*> {};

TEST_P(Raven, HasItsTipsWhereTheKinematicsSay) {
  ModelRig rig(nothing_else());
  const state::Outcome loaded = rig.load(own_model(GetParam()));
  ASSERT_TRUE(loaded.success) << loaded.message;
  ASSERT_TRUE(loaded.diagnostics.empty()) << base::to_string(loaded.diagnostics.front());
  std::mt19937 random(16);
  for (int k = 0; k < 4; ++k) {
    std::map<std::string, kinematics::ArmPosition> wanted;
    std::vector<state::AddressedCommand> commands;
    for (const std::string side : {"left", "right"}) {
      const kinematics::Arm& arm = *adf::known_arms().find(side == "left" ? "RAVEN_LEFT" : "RAVEN_RIGHT");
      kinematics::ArmPosition& target = wanted[side];
      for (std::size_t i = 0; i < arm.size(); ++i)
        target.joints.push_back(std::uniform_real_distribution<double>(
            0.95 * arm.lower[i] + 0.05 * arm.upper[i], 0.05 * arm.lower[i] + 0.95 * arm.upper[i])(random));
      target.opening = std::uniform_real_distribution<double>(0.0, 1.0)(random);
      std::vector<std::pair<std::string, double>> targets;
      for (const auto& [name, value] : to_adf(arm, target)) targets.emplace_back(name, value);
      commands.push_back(rig.joint_command("BODY " + side + "_base", JointCommandType::position, targets));
    }
    ASSERT_TRUE(rig.step(1, commands).success);
    ASSERT_TRUE(rig.run(2.0).success);
    EXPECT_LT(rig.largest_gap(), 0.02e-3);
    for (const std::string side : {"left", "right"}) {
      const kinematics::Arm& arm = *adf::known_arms().find(side == "left" ? "RAVEN_LEFT" : "RAVEN_RIGHT");
      std::map<std::string, double> measured;
      for (const auto& [name, value] : to_adf(arm, wanted[side]))
        measured[name] = rig.frame().joints[rig.joint_slot(name)].position;
      const auto reached = from_adf(arm, measured);
      ASSERT_TRUE(reached);
      for (std::size_t i = 0; i < arm.size(); ++i)
        EXPECT_NEAR(reached->joints[i], wanted[side].joints[i], 1e-3) << side << i;
      EXPECT_NEAR(reached->opening, wanted[side].opening, 1e-3);
      // The second half of the jaw stands half an opening from the tip's frame, about its z.
      const double half = -0.5 * reached->opening;
      const math::Pose closed{{}, {0, 0, std::sin(0.5 * half), std::cos(0.5 * half)}};
      const math::Pose tip = math::inverse(rig.body("BODY " + side + "_base").T_world_body) *
                             rig.body("BODY " + side + "_grasper2").T_world_body * closed;
      const kinematics::PoseDifference off = kinematics::difference(tip, forward(arm, reached->joints));
      EXPECT_LT(off.distance, 0.1e-3) << side;
      EXPECT_LT(off.angle, 0.1 * kPi / 180.0) << side;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Gravity, Raven, testing::Values("robots/raven2.yaml", "robots/raven2_gravity.yaml"),
                         [](const auto& parameter) {
                           return std::string(parameter.param).find("gravity") == std::string::npos ? "Without"
                                                                                                    : "With";
                         });

}  // namespace
}  // namespace ambf::runtime
