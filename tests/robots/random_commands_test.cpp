// Any legal commands leave every robot whole: values stay finite, joints inside their limits, pivots together. Seconds
// here, or as many as AMBF_RANDOM_COMMANDS_S says.
#include <cmath>
#include <cstdlib>
#include <random>

#include "tests/robots/original.h"

namespace ambf::runtime {
namespace {

using namespace test;

class RandomCommands : public testing::TestWithParam<std::string> {};

TEST_P(RandomCommands, LeaveARobotWhole) {
  ModelRig rig(nothing_else());
  const state::Outcome loaded = rig.load(own_model("robots/" + GetParam() + ".yaml"));
  ASSERT_TRUE(loaded.success) << loaded.message;
  const char* wanted = std::getenv("AMBF_RANDOM_COMMANDS_S");
  const double seconds = wanted != nullptr ? std::atof(wanted) : 1.5;
  // Every joint that may be commanded, through a body above it.
  const auto structure = rig.simulation.structure();
  std::mt19937 random(16);
  double gap = 0.0, beyond = 0.0;
  std::string whose, farthest;
  for (double t = 0.0; t < seconds; t += 0.15) {
    std::vector<state::AddressedCommand> commands;
    for (std::uint32_t slot = 0; slot < structure->bodies.size(); ++slot) {
      state::RigidBodyCommand command;
      command.joints.resize(structure->bodies[slot].joints.size());
      bool any = false;
      for (std::size_t i = 0; i < command.joints.size(); ++i) {
        const state::JointInfo& joint = structure->joints[structure->bodies[slot].joints[i]];
        // Once: by its parent.
        if (joint.parent_body != slot || joint.passive) continue;
        const bool limited = joint.has_limits;
        const double low = limited ? joint.lower : -3.0, high = limited ? joint.upper : 3.0;
        command.joints[i] = {JointCommandType::position, std::uniform_real_distribution<double>(low, high)(random)};
        any = true;
      }
      if (!any) continue;
      for (const state::ObjectInfo& object : structure->objects)
        if (object.kind == state::ObjectKind::rigid_body && object.slot == slot)
          commands.push_back({object.id, command});
    }
    ASSERT_TRUE(rig.step(1, commands).success);
    for (int k = 0; k < 15; ++k) {
      ASSERT_TRUE(rig.step(10).success);
      gap = std::max(gap, rig.largest_gap(&whose));
      const state::Frame& now = rig.frame();
      for (const state::BodyState& body : now.bodies)
        ASSERT_TRUE(std::isfinite(norm(body.T_world_body.position)) && std::isfinite(norm(body.twist_world.linear)));
      for (std::size_t i = 0; i < structure->joints.size(); ++i) {
        const state::JointInfo& joint = structure->joints[i];
        if (!joint.has_limits) continue;
        const double q = now.joints[i].position, out = std::max(joint.lower - q, q - joint.upper);
        if (out <= beyond) continue;
        beyond = out;
        farthest = joint.name;
      }
    }
  }
  std::printf("%s: pivots %.5f mm apart (%s), %.5f rad or m beyond a limit (%s)\n", GetParam().c_str(), gap * 1e3,
              whose.c_str(), beyond, farthest.c_str());
  // While whole arms are thrown from one end of their range to the other, and afterwards, with all at rest.
  EXPECT_LT(gap, 3e-3);
  EXPECT_LT(beyond, 1e-3);
  ASSERT_TRUE(rig.run(1.5).success);
  EXPECT_LT(rig.largest_gap(), 0.02e-3);
}

INSTANTIATE_TEST_SUITE_P(Robots, RandomCommands,
                         testing::Values("psm", "psm_gravity", "ecm", "mtmr", "mtml", "suj", "kuka_lwr", "kuka_lbr_med",
                                         "neuro_robot", "neuro_robot_gravity", "raven2", "raven2_gravity", "pr2"),
                         [](const auto& parameter) { return parameter.param; });

}  // namespace
}  // namespace ambf::runtime
