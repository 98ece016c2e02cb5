// Input devices files: all keys, both meanings of the haptic gain, and what is wrong with them.

#include "tests/adf/support.h"

namespace ambf::adf {
namespace {

using math::Vec3;
using scene::HapticGainKind;

TEST(InputDevices, AllKeysAreRead) {
  const InputDevicesResult result = parse_input_devices(R"(
input devices: [A, B]
A:
  hardware name: MTMR
  driver: {type: gamepad, path: /dev/x, axes: {x: 1, y: -2}, base: {position: {x: 1, y: 2, z: 3}}}
  haptic gain: {linear: {x: 1, y: 2, z: 3}, angular: 0.5}
  controller gain: {linear: {P: 500, D: {x: 1, y: 2, z: 3}}}
  haptic gain kind: ratio
  deadband: 0.1
  max force: 3
  max torque: 0.2
  max jerk: 0.4
  workspace scaling: 5
  camera scaling: 2
  location: {position: {x: 1, y: 2, z: 3}}
  orientation offset: {r: 0, p: 0, y: 3.14159265358979}
  simulated multibody: g.yaml
  root link: palm
  enable joint control: false
  pair cameras: [c1, c2]
  button mapping: {a1: 1, a2: 2, g1: 3, next mode: 4, prev mode: 5}
  dominance: 0.7
  on loss: release
  ramp: 2
  color: red
  visible: true
  visible size: 0.1
  visible color: blue
B: {hardware name: Falcon, root link: tip}
)",
                                                        "/folder/d.yaml");
  ASSERT_TRUE(result.devices);
  EXPECT_FALSE(base::has_warnings(result.diagnostics) || base::has_errors(result.diagnostics));
  ASSERT_EQ(result.devices->devices.size(), 2u);
  const scene::InputDevice& a = result.devices->devices[0];
  EXPECT_EQ(a.name, "A");
  EXPECT_EQ(a.driver.type, "gamepad");
  EXPECT_EQ(a.driver.options.at("path"), "/dev/x");
  EXPECT_EQ(a.driver.options.at("axes/y"), "-2");
  EXPECT_EQ(a.driver.options.count("type") + a.driver.options.count("base/position/x"), 0u);
  EXPECT_EQ(a.driver.T_base_offset->position, (Vec3{1.0, 2.0, 3.0}));
  EXPECT_EQ(*a.haptic_linear.p, (Vec3{1.0, 2.0, 3.0}));
  EXPECT_EQ(*a.haptic_angular.p, (Vec3{0.5, 0.5, 0.5}));
  EXPECT_EQ(*a.controller_linear.p, (Vec3{500.0, 500.0, 500.0}));
  EXPECT_EQ(*a.controller_linear.d, (Vec3{1.0, 2.0, 3.0}));
  EXPECT_FALSE(a.controller_angular.given());
  EXPECT_EQ(a.haptic_gain_kind, HapticGainKind::ratio);
  EXPECT_EQ(a.deadband_N, 0.1);
  EXPECT_EQ(a.max_force_N, 3.0);
  EXPECT_EQ(a.max_torque_Nm, 0.2);
  EXPECT_EQ(a.max_jerk_N_per_ms, 0.4);
  EXPECT_EQ(a.workspace_scaling, 5.0);
  EXPECT_EQ(a.camera_scaling, 2.0);
  EXPECT_EQ(a.location->position, (Vec3{1.0, 2.0, 3.0}));
  EXPECT_NEAR(a.orientation_offset.z, 1.0, 1e-12);
  EXPECT_EQ(a.multibody_file, "/folder/g.yaml");
  EXPECT_EQ(a.root_link, "palm");
  EXPECT_FALSE(a.enable_joint_control);
  EXPECT_EQ(a.cameras, (std::vector<std::string>{"c1", "c2"}));
  EXPECT_EQ(a.buttons.clutch, 1);
  EXPECT_EQ(a.buttons.previous_mode, 5);
  EXPECT_EQ(a.dominance, 0.7);
  EXPECT_EQ(a.on_loss, state::OnLoss::release);
  EXPECT_EQ(a.ramp_s, 2.0);
  EXPECT_EQ(a.color, "red");
  EXPECT_TRUE(a.visible);
  const scene::InputDevice& b = result.devices->devices[1];
  EXPECT_EQ(b.haptic_gain_kind, HapticGainKind::stiffness);
  EXPECT_EQ(b.camera_scaling, 10.0);
  EXPECT_FALSE(b.location);
}

TEST(InputDevices, ThoseThatAreWrongAreLeftOutAndTheRestIsThere) {
  const InputDevicesResult result = parse_input_devices(
      "input devices: [A, B, C, D]\nA: {hardware name: Falcon}\nB: {root link: x}\n"
      "C: {hardware name: Falcon, cameras: [c], dedband: 0.1, root link: A}\n"
      "D: {hardware name: Falcon, root link: x, workspace scaling: 0}\n",
      "d.yaml");
  ASSERT_TRUE(result.devices);
  ASSERT_EQ(result.devices->devices.size(), 1u);
  EXPECT_EQ(result.devices->devices[0].name, "C");
  EXPECT_EQ(result.devices->devices[0].cameras, std::vector<std::string>{"c"});
  EXPECT_TRUE(says(result.diagnostics, "error: \\[A\\] the device has neither"));
  EXPECT_TRUE(says(result.diagnostics, "error: \\[B: hardware name\\] missing"));
  EXPECT_TRUE(says(result.diagnostics, "warning: \\[C: dedband\\] unknown key.*did you mean `deadband`"));
  EXPECT_TRUE(says(result.diagnostics, "warning: \\[C: cameras\\] older spelling \\(write `pair cameras`\\)"));
  EXPECT_TRUE(says(result.diagnostics, "error: \\[D: workspace scaling\\]"));
}

TEST(InputDevices, AFileOfTheDissertationsFormGivesShares) {
  const std::string old_form =
      "A: {hardware name: MTMR, root link: x, cameras: [c], controller gain: {linear: {P: 500, D: 10}}, "
      "haptic gain: {linear: 0.03}}\n";
  const std::string mixed =
      "B: {hardware name: Falcon, root link: x, haptic gain: {linear: 0.05}, controller gain: {linear: {P: 200}}}\n"
      "C: {hardware name: Razer Hydra, root link: x, haptic gain: {linear: 10}}\n";
  InputDevicesResult result = parse_input_devices("input devices: [A, B, C]\n" + old_form + mixed, "d.yaml");
  ASSERT_EQ(result.devices->devices.size(), 3u);
  EXPECT_EQ(result.devices->devices[0].haptic_gain_kind, HapticGainKind::ratio);
  EXPECT_EQ(result.devices->devices[1].haptic_gain_kind, HapticGainKind::ratio) << "the test goes for the file";
  EXPECT_EQ(result.devices->devices[2].haptic_gain_kind, HapticGainKind::stiffness) << "10 is no share";
  EXPECT_TRUE(says(result.diagnostics, "info: \\[A: haptic gain\\] the form of this file"));
  result = parse_input_devices("input devices: [B, C]\n" + mixed, "d.yaml");
  EXPECT_EQ(result.devices->devices[0].haptic_gain_kind, HapticGainKind::stiffness);
}

}  // namespace
}  // namespace ambf::adf
