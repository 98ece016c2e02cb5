// The original's rover, its two files as they are, in either load order: its wheels carry it, it drives, turns and
// brakes. Skipped visibly where the compatibility models are absent.
#include <gtest/gtest.h>

#include <cmath>

#include "model_rig.h"
#include "state/vehicles.h"

namespace ambf::runtime::test {
namespace {

class CompatVehicle : public ::testing::TestWithParam<bool> {
 protected:
  void SetUp() override { AMBF_NEEDS_COMPAT(); }
};

TEST_P(CompatVehicle, TheRoverDrivesTurnsAndBrakes) {
  // Its parts are placed above a ground 1.5 m below the origin.
  scene::World world = bare_world();
  world.environment_file = ::testing::TempDir() + "/rover_ground.yaml";
  std::ofstream(world.environment_file)
      << "adf version: 1.0\nnamespace: /test/\nbodies: [BODY Ground]\nBODY Ground: {name: Ground, mass: 0, collision "
         "shape: PLANE, collision geometry: {normal: {x: 0, y: 0, z: 1}, offset: -1.5}}\n";
  ModelRig rig(world);
  rig.log.allow("mesh not found");
  const std::string folder = "robots/rover_car/";
  const std::string parts = compat::model(folder + "rover_parts.yaml"),
                    info = compat::model(folder + "rover_info.yaml");
  for (const std::string& file : {GetParam() ? info : parts, GetParam() ? parts : info})
    ASSERT_TRUE(rig.load(file).success) << file;
  const auto structure = rig.simulation.structure();
  const std::uint32_t rover = state::find(*structure, "FormulaOne", state::vehicle_kind().kind);
  ASSERT_NE(rover, state::kNone);
  const std::uint32_t slot = structure->objects[rover].slot;
  const auto car = [&]() -> const state::VehicleState& {
    return state::rows(rig.frame(), state::vehicle_kind().column).at(slot);
  };
  const auto drive = [&](double seconds, double power, double steering, double brake) {
    state::VehicleCommand command;
    command.drive.assign(4, power);
    command.steering = {steering, steering, -steering, -steering};  // all of its wheels steer
    command.brake.assign(4, brake);
    for (int i = 0; i < static_cast<int>(seconds * 10.0 + 0.5); ++i)
      rig.step(100, {{structure->objects[rover].id, state::KindCommand{command}}});
  };
  drive(5.0, 0.0, 0.0, 0.0);
  EXPECT_NEAR(car().T_world_object.position.z, -1.5 + 1.0 - 0.3 + 0.5 + 0.3 - 9.81 * 12.0 / (10.0 * 4.0 * 20.0), 0.03)
      << "12 kg on springs that are made for the 10 kg of the chassis";
  const state::WheelRange wheels = state::wheels_of(rig.frame(), slot);
  for (const state::WheelState& wheel : wheels) EXPECT_NE(wheel.ground, state::kNone);
  EXPECT_NEAR(rig.body("BODY Wheel1").T_world_body.position.z, -1.5 + 0.3, 0.05) << "its body is the wheel";

  // Gently: its springs are soft, and its arms stand high.
  drive(1.0, -4.0, 0.0, 0.0);
  const double damping = std::log(2.0);  // 1/s: `damping: {linear: 0.5}` takes half of the speed in a second
  EXPECT_NEAR(car().speed, -0.5 * 4.0 * 4.0 / 12.0 / damping, 0.15);
  drive(0.8, -4.0, 0.2, 0.0);
  EXPECT_LT(rig.body("BODY Chassis").twist_world.angular.z, -0.15) << "backwards, steered to the left";
  drive(4.0, 0.0, 0.0, 4.0);
  EXPECT_NEAR(car().speed, 0.0, 0.1);
  const math::Vec3 up = math::rotate(car().T_world_object.orientation, {0, 0, 1});
  EXPECT_GT(up.z, 0.95) << "it stands on its wheels";
}

INSTANTIATE_TEST_SUITE_P(LoadOrders, CompatVehicle, ::testing::Bool(),
                         [](const auto& parameter) { return parameter.param ? "InfoFirst" : "PartsFirst"; });

}  // namespace
}  // namespace ambf::runtime::test
