// The original's example of sensors and actuators, its files as they are: an arm picks up a box with what its sensor
// sees, carries it and lets it fall. Skipped visibly where the compatibility models are absent.
#include <gtest/gtest.h>

#include "model_rig.h"
#include "state/actuators.h"
#include "state/sensors.h"

namespace ambf::runtime::test {
namespace {

using compat::model;

std::string example(const std::string& file) {
  return (compat::folder() / "ambf_models/examples/sensors_actuators_example" / file).string();
}

class CompatGrasp : public ::testing::TestWithParam<bool> {
 protected:
  void SetUp() override { AMBF_NEEDS_COMPAT(); }
};

TEST_P(CompatGrasp, AnArmPicksUpCarriesAndPutsDownWhatItsSensorSees) {
  // The arm reaches below the height of the ground that a world has by default.
  scene::World world = bare_world();
  world.environment_file = ::testing::TempDir() + "/no_environment.yaml";
  std::ofstream(world.environment_file) << "adf version: 1.0\nnamespace: /test/\nbodies: []\n";
  ModelRig rig(world);
  const bool arm_first = GetParam();
  const std::string arm = model("robots/blender-kuka-lbr-med.yaml"), tool = example("sensors_actuators.yaml");
  for (const std::string& file : {arm_first ? arm : tool, arm_first ? tool : arm, example("box.yaml")})
    ASSERT_TRUE(rig.load(file).success) << file;
  const auto structure = rig.simulation.structure();
  const state::ObjectKind actuators = state::actuator_kind().kind;
  const std::uint32_t grip = state::find(*structure, "ACTUATOR Constraint0", actuators);
  ASSERT_NE(grip, state::kNone);
  const auto actuated = [&] {
    const auto& rows = state::rows(rig.frame(), state::actuator_kind().column);
    return rows.at(structure->objects[grip].slot).actuated();
  };
  EXPECT_EQ(state::holder_of(*structure, grip), rig.slot("Link7"));
  state::ActuatorCommand by_sensor;
  by_sensor.actuate = by_sensor.use_sensor = true;
  const std::uint32_t sensor = state::find(*structure, "Proximity0", state::sensor_kind().kind);
  ASSERT_NE(sensor, state::kNone);
  by_sensor.sensor = structure->objects[sensor].id;
  const state::AddressedCommand hold{structure->objects[grip].id, state::KindCommand{by_sensor}};
  const state::AddressedCommand let_go{structure->objects[grip].id, state::KindCommand{state::ActuatorCommand{}}};

  const auto arm_to = [&](double first_joint) {
    state::RigidBodyCommand command;
    command.type = state::CartesianCommandType::force;
    for (const double value : {first_joint, 0.4, 0.0, -1.0, 0.0, 0.5, 0.0})
      command.joints.push_back({state::JointCommandType::position, value});
    return state::AddressedCommand{rig.id("BODY base"), command};
  };
  const auto box_to = [&](const math::Pose& T_world_box) {
    state::RigidBodyCommand command;
    command.type = state::CartesianCommandType::position;
    command.T_world_body = T_world_box;
    return state::AddressedCommand{rig.id("BODY Box"), command};
  };
  for (int i = 0; i < 10; ++i) rig.step(100, {arm_to(0.0)});
  // In front of the sensor's rays, which begin 0.04 m from the link and are 0.1 m long.
  const math::Pose at_tool = rig.body("Link7").T_world_body * math::Pose{{0, 0, 0.04 + 0.05 + 0.1}, {}};
  for (int i = 0; i < 8; ++i) rig.step(100, {arm_to(0.0), box_to(at_tool)});
  EXPECT_FALSE(actuated());
  rig.step(1, {arm_to(0.0), box_to(at_tool), hold});
  ASSERT_TRUE(actuated());
  for (int i = 0; i < 6; ++i) rig.step(100, {arm_to(0.0), hold});  // the box's command ends by its watchdog
  const auto relative = [&] {
    return math::inverse(rig.body("Link7").T_world_body) * rig.body("BODY Box").T_world_body;
  };
  rig.step(100, {arm_to(0.0), hold});
  const math::Pose before = relative(), first = rig.body("BODY Box").T_world_body;
  for (int i = 0; i < 15; ++i) rig.step(100, {arm_to(0.5), hold});
  EXPECT_GT(math::norm(rig.body("BODY Box").T_world_body.position - first.position), 0.02) << "it is carried";
  EXPECT_LT(math::norm(relative().position - before.position), 1e-4);
  const double height = rig.body("BODY Box").T_world_body.position.z;
  rig.step(200, {arm_to(0.5), let_go});
  EXPECT_FALSE(actuated());
  EXPECT_LT(rig.body("BODY Box").T_world_body.position.z, height - 0.02) << "it falls";
}

INSTANTIATE_TEST_SUITE_P(LoadOrders, CompatGrasp, ::testing::Bool(),
                         [](const auto& parameter) { return parameter.param ? "ArmFirst" : "ToolFirst"; });

}  // namespace
}  // namespace ambf::runtime::test
