// Input devices in windows: what keys do to them, what labels and marks say of them.
#include <gtest/gtest.h>

#include <algorithm>

#include "render/marks/device_text.h"
#include "render/marks/layer_shapes.h"
#include "render/window/device_keys.h"
#include "tests/support/fake_devices.h"

namespace ambf::render {
namespace {

using state::DeviceParameter;

constexpr state::ObjectId kLeftCamera{1, 1}, kRightCamera{2, 1};

FakeDevices two_users() {
  FakeDevices fake;
  fake.add("left").info.cameras = {kLeftCamera};
  fake.add("right").info.cameras = {kRightCamera};
  fake.devices[0].info.hardware_name = "MTML";
  fake.devices[0].status.rate_hz = 998.4;
  for (FakeDevices::Device& device : fake.devices) device.info.force = true;
  fake.devices[0].info.color = {0.0, 1.0, 0.0};
  return fake;
}

const KeyBinding& key(const char* name, Modifiers modifiers = {}) { return *binding_of(name, modifiers, false); }

TEST(DeviceKeys, ChangeGainsOfTheDevicesThatSeeThroughTheWindowsCamera) {
  FakeDevices fake = two_users();
  fake.devices[0].status.gains.linear_stiffness = {500.0, 510.0, 520.0};
  const std::string said = act_on_devices(key("8"), &fake, kLeftCamera);
  EXPECT_EQ(fake.devices[0].status.gains.linear_stiffness, (math::Vec3{550.0, 560.0, 570.0}));
  EXPECT_EQ(fake.devices[1].status.gains.linear_stiffness, math::Vec3{});
  EXPECT_NE(said.find("left: 550, 560, 570 N/m"), std::string::npos) << said;
}

TEST(DeviceKeys, StepAsTheyAlwaysDid) {
  struct Row {
    const char* key;
    DeviceParameter parameter;
    double step;
  };
  for (const Row& row :
       {Row{"3", DeviceParameter::haptic_linear, -0.05}, Row{"4", DeviceParameter::haptic_linear, 0.05},
        Row{"5", DeviceParameter::haptic_angular, -0.05}, Row{"6", DeviceParameter::haptic_angular, 0.05},
        Row{"7", DeviceParameter::linear_stiffness, -50.0}, Row{"9", DeviceParameter::angular_stiffness, -1.0},
        Row{"0", DeviceParameter::angular_stiffness, 1.0}, Row{"PgUp", DeviceParameter::linear_damping, 0.1},
        Row{"PgDn", DeviceParameter::linear_damping, -0.1}, Row{"Home", DeviceParameter::angular_damping, 0.1},
        Row{"End", DeviceParameter::angular_damping, -0.1}}) {
    FakeDevices fake = two_users();
    fake.set(0, row.parameter, {100.0, 100.0, 100.0});
    act_on_devices(key(row.key), &fake, kLeftCamera);
    EXPECT_NEAR(state::value_of(fake.devices[0].status, row.parameter).y, 100.0 + row.step, 1e-12) << row.key;
  }
}

TEST(DeviceKeys, GainsStopAtTheirBounds) {
  FakeDevices fake = two_users();
  act_on_devices(key("7"), &fake, kLeftCamera);
  EXPECT_EQ(fake.devices[0].status.gains.linear_stiffness, math::Vec3{});
}

TEST(DeviceKeys, AWindowWithoutACameraActsOnAllDevices) {
  FakeDevices fake = two_users();
  act_on_devices(key("W"), &fake, {});
  for (const FakeDevices::Device& device : fake.devices)
    EXPECT_EQ(device.status.rotation, state::RotationReference::world);
  act_on_devices(key("C"), &fake, kRightCamera);
  EXPECT_EQ(fake.devices[0].status.rotation, state::RotationReference::world);
  EXPECT_EQ(fake.devices[1].status.rotation, state::RotationReference::camera);
}

TEST(DeviceKeys, ModesFollowEachOtherInACircle) {
  FakeDevices fake = two_users();
  for (unsigned i = 1; i <= static_cast<unsigned>(state::DeviceMode::count); ++i) {
    act_on_devices(key("N"), &fake, kLeftCamera);
    EXPECT_EQ(static_cast<unsigned>(fake.devices[0].status.mode), i % static_cast<unsigned>(state::DeviceMode::count));
  }
}

TEST(DeviceKeys, ForcesOfAllHandsAreSwitchedAndAbsentDevicesAreNamed) {
  FakeDevices fake = two_users();
  act_on_devices(key("E", {true, false, false}), &fake, kLeftCamera);
  EXPECT_TRUE(fake.forces_on);
  EXPECT_NE(act_on_devices(key("8"), nullptr, kLeftCamera).find("no input devices"), std::string::npos);
  EXPECT_NE(act_on_devices(key("8"), &fake, {9, 1}).find("camera"), std::string::npos);
}

TEST(DeviceLabels, NameRateAndWhatIsWrong) {
  FakeDevices fake = two_users();
  std::vector<DeviceLine> lines = device_lines(fake, kLeftCamera);
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0].text, "Controlling Devices: [ left ]");
  EXPECT_EQ(lines[1].text, "left [MTML] : 998 Hz");
  EXPECT_EQ(lines[1].color, (DebugColor{0.0F, 1.0F, 0.0F, 1.0F}));
  EXPECT_EQ(lines[2].text, "forces off");
  fake.forces_on = true;
  fake.devices[0].status.clutched = true;
  fake.devices[0].status.mode = state::DeviceMode::jaw;
  lines = device_lines(fake, {});
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0].text, "Controlling Devices: [ left <> right ]");
  EXPECT_EQ(lines[1].text, "left [MTML] : 998 Hz : jaw : clutched");
  EXPECT_EQ(lines[1].color, kDeviceWaits);
  EXPECT_TRUE(device_lines(fake, {9, 1}).empty());
}

TEST(DeviceLabels, OneWithoutADriverIsRedWithWhatWasSearchedAndWhatToSet) {
  FakeDevices fake = two_users();
  fake.devices[0].status.cycle = 0;
  fake.devices[0].info.driver.clear();
  fake.devices[0].info.message = "no driver answers to the hardware name 'sigma.7'";
  std::vector<DeviceLine> lines = device_lines(fake, kLeftCamera);
  EXPECT_EQ(lines.at(1).color, kDeviceFails);
  EXPECT_NE(lines[1].text.find("no driver answers to the hardware name 'sigma.7'"), std::string::npos);
  fake.devices[1].status.fault = state::DeviceFault::not_found;
  fake.devices[1].info.message = "no gamepad at js7; plug it in";
  lines = device_lines(fake, kRightCamera);
  EXPECT_EQ(lines.at(1).color, kDeviceFails);
  EXPECT_NE(lines[1].text.find("no gamepad at js7; plug it in"), std::string::npos);
}

TEST(DeviceLabels, OneThatIsTakenInHandAtWillInvitesAndIsNoFault) {
  FakeDevices fake = two_users();
  FakeDevices::Device& keys = fake.devices[0];
  keys.info.on_demand = true;
  keys.info.force = false;
  keys.info.effector = {5, 1};
  keys.info.effector_name = "/ambf/env/right_gripper";
  keys.status.ready = keys.status.engaged = false;
  keys.status.fault = state::DeviceFault::not_ready;
  keys.status.not_ready = "press G";
  std::vector<DeviceLine> lines = device_lines(fake, kLeftCamera);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].text, "right_gripper: press G");
  EXPECT_EQ(lines[0].color, color_of(keys.info));
  keys.info.effector = {};  // a scene without its tool
  EXPECT_TRUE(device_lines(fake, kLeftCamera).empty());
  keys.status.ready = true;
  keys.status.fault = state::DeviceFault::none;
  lines = device_lines(fake, kLeftCamera);
  ASSERT_EQ(lines.size(), 2U);  // without "forces off": this hand feels none
  EXPECT_EQ(lines[1].text, "left [MTML] : 998 Hz");
}

TEST(DeviceLabels, AFaultComesBeforeAClutchAndIsRed) {
  const state::DeviceInfo info;
  state::DeviceStatus status;
  status.cycle = 1;
  status.started = true;
  status.clutched = true;
  status.fault = state::DeviceFault::lost;
  EXPECT_EQ(remark_on(info, status).alert, DeviceAlert::fails);
  EXPECT_EQ(remark_on(info, status).text, "the hardware is gone");
  status.fault = state::DeviceFault::none;
  EXPECT_EQ(remark_on(info, status).text, "clutched");
  status.camera_clutched = status.camera_locked = true;
  EXPECT_EQ(remark_on(info, status).text, "camera");
  status.clutched = status.camera_clutched = false;
  EXPECT_EQ(remark_on(info, status).alert, DeviceAlert::none);
  status.at_limit = true;
  EXPECT_EQ(remark_on(info, status).text, "at the limit");
}

// A structure of one body at `tool`.
struct Tool {
  Tool() {
    auto all = std::make_shared<state::Structure>();
    all->objects.resize(1);
    all->objects[0].id = {0, 1};
    all->objects[0].slot = 0;
    all->objects[0].kind = state::ObjectKind::rigid_body;
    all->bodies.resize(1);
    frame.structure = all;
    poses.bodies = {{{1.0, 0.0, 0.0}, {}}};
    camera.T_world_camera = {{5.0, 0.0, 0.0}, {}};
  }
  LayerInput input(const state::DeviceAbility* devices) const {
    return {frame, poses, {}, PixelScale(camera, 640, 480, 1.0), {}, devices};
  }
  state::Frame frame;
  ScenePoses poses;
  Camera camera;
};

TEST(DeviceMarks, AToolHasItsUsersColourAndName) {
  const Tool tool;
  FakeDevices fake = two_users();
  fake.devices[0].info.effector = {0, 1};
  WorldShapes out;
  draw_devices(tool.input(&fake), out);
  ASSERT_EQ(out.texts().size(), 1U);  // the other one's tool is not loaded
  EXPECT_EQ(out.texts()[0].text, "left");
  EXPECT_EQ(out.texts()[0].point.x, 1.0);
  EXPECT_EQ(out.texts()[0].color, (DebugColor{0.0F, 1.0F, 0.0F, 1.0F}));
  EXPECT_TRUE(out.lines(Seen::in_front).empty());
  fake.devices[0].info.visible = true;
  fake.devices[0].status.fault = state::DeviceFault::silent;
  out.clear();
  draw_devices(tool.input(&fake), out);
  EXPECT_EQ(out.texts()[0].text, "left: no sample arrives");
  EXPECT_EQ(out.texts()[0].color, kDeviceFails);
  EXPECT_FALSE(out.lines(Seen::in_front).empty());  // the ball at REF
  out.clear();
  draw_devices(tool.input(nullptr), out);
  EXPECT_TRUE(out.empty());
}

TEST(DeviceMarks, TheLayerShowsAll17FramesWhereTheyAreInTheWorld) {
  const Tool tool;
  FakeDevices fake = two_users();
  fake.devices.pop_back();
  state::MappingFrames& frames = fake.devices[0].status.frames;
  frames.T_world_u = {{0.0, 0.0, 1.0}, {}};
  frames.T_u_base = {{0.0, 1.0, 0.0}, {}};
  frames.T_base_e = {{1.0, 0.0, 0.0}, {}};
  frames.T_e_to = {{0.0, 0.0, 1.0}, {}};
  WorldShapes out;
  draw_device_frames(tool.input(&fake), out);
  EXPECT_EQ(out.texts().size(), 17U);
  const auto tip = std::find_if(out.texts().begin(), out.texts().end(),
                                [](const DebugText& text) { return text.text == "left IID-TO"; });
  ASSERT_NE(tip, out.texts().end());
  EXPECT_EQ(tip->point, (math::Vec3{1.0, 1.0, 2.0}));
}

}  // namespace
}  // namespace ambf::render
