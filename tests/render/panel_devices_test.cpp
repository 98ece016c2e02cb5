// The panel's tab of input devices.
#include <gtest/gtest.h>

#include "panel_rig.h"
#include "tests/support/fake_devices.h"

namespace ambf::render {
namespace {

using state::DeviceParameter;
using testing::PanelRig;

FakeDevices two_users() {
  FakeDevices fake;
  for (const char* name : {"left", "right"}) {
    FakeDevices::Device& device = fake.add(name);
    device.status.gains = {{500, 500, 500}, {5, 5, 5}, {10, 10, 10}, {1, 1, 1}};
    device.info.hardware_name = "MTM";
    device.info.effector_name = "/test/box";
  }
  return fake;
}

struct DevicesTab : ::testing::Test {
  DevicesTab() { rig.tab("Devices"); }
  FakeDevices fake = two_users();
  PanelRig rig{"", 1600, 2600, 2.0, nullptr, "", &fake};
};

TEST(PanelDevices, AreATabOnlyWhereThereAreSome) {
  PanelRig none;
  EXPECT_FALSE(none.shown("tab/Devices"));
  EXPECT_TRUE(none.shown("tab/Files"));
}

TEST_F(DevicesTab, ShowsWhatEachOneDoes) {
  EXPECT_TRUE(rig.shown("devices/left/moves its tool"));
  fake.devices[0].status.fault = state::DeviceFault::silent;
  fake.devices[1].status.clutched = true;
  rig.pictures(2);
  EXPECT_TRUE(rig.shown("devices/left/no sample arrives"));
  EXPECT_TRUE(rig.shown("devices/right/clutched"));
}

TEST_F(DevicesTab, NoControlMovesWhenAStateChanges) {
  const PanelRig::At before = rig.at("devices/set/dominance");
  fake.devices[0].status.fault = state::DeviceFault::bad_sample;
  fake.devices[0].status.at_limit = true;
  fake.devices[0].status.wrench_u_wanted.force = {123.0, 456.0, 789.0};
  fake.devices[0].status.jaw_follows = true;
  fake.forces_on = true;
  rig.pictures(2);
  const PanelRig::At after = rig.at("devices/set/dominance");
  EXPECT_EQ(before.x, after.x);
  EXPECT_EQ(before.y, after.y);
}

TEST_F(DevicesTab, ChangesTheDeviceThatIsChosen) {
  rig.click("devices/right", 0.1);
  rig.enter("devices/set/dominance", "0.8");
  ASSERT_EQ(fake.calls.size(), 1U);
  EXPECT_EQ(fake.calls[0].device, 1U);
  EXPECT_EQ(fake.calls[0].parameter, DeviceParameter::dominance);
  EXPECT_EQ(fake.calls[0].value.x, 0.8);
  rig.enter("devices/set/linear stiffness/y", "250");
  EXPECT_EQ(fake.devices[1].status.gains.linear_stiffness, (math::Vec3{500, 250, 500}));
  EXPECT_EQ(fake.devices[0].status.gains.linear_stiffness, (math::Vec3{500, 500, 500}));
  rig.click("devices/mode");
  rig.click("devices/mode/jaw");
  EXPECT_EQ(fake.devices[1].status.mode, state::DeviceMode::jaw);
}

TEST_F(DevicesTab, ChoosesWhoMovesAndFeelsASharedTool) {
  rig.click("devices/scheme");
  rig.click("devices/scheme/aiao");
  ASSERT_EQ(fake.calls.size(), 1u);
  EXPECT_EQ(fake.calls[0].parameter, DeviceParameter::scheme);
  EXPECT_EQ(fake.devices[0].status.scheme, state::SharingScheme::aiao);
}

TEST_F(DevicesTab, SwitchesTheForcesOfAllHands) {
  rig.click("devices/forces", 0.05);
  EXPECT_TRUE(fake.forces_on);
  rig.click("devices/forces", 0.05);
  EXPECT_FALSE(fake.forces_on);
}

}  // namespace
}  // namespace ambf::render
