// A device's cycle neither allocates, frees nor locks: counted, not believed.
#include <gtest/gtest.h>

#include "devices/driver.h"
#include "tests/devices/cycle_rig.h"
#include "tests/devices/interposer.h"

namespace ambf::devices::testing {
namespace {

void expect_none_since(const Calls& before) {
  const Calls now = calls_of_this_thread();
  EXPECT_EQ(now.memory - before.memory, 0);
  EXPECT_EQ(now.locks - before.locks, 0);
  EXPECT_EQ(now.waits - before.waits, 0);
}

TEST(DeviceAllocation, ACycleDoesNothingThatWaits) {
  CycleRig rig;
  rig.start();
  rig.run_until_engaged();
  rig.run(1.0);  // percentiles and rates were counted once
  const Calls before = calls_of_this_thread();
  ASSERT_GT(before.memory, 0) << "the counter itself works";
  for (int i = 0; i < 1000; ++i) {
    rig.driver.next.T_u_tip.position += math::Vec3{1e-5, 0.0, 0.0};
    if (i % 100 == 50) rig.press(0, i % 200 == 50);
    if (i == 600) rig.driver.reading = Reading::nothing_new;  // a fault, and its end
    if (i == 700) rig.driver.reading = Reading::sample;
    rig.step();
  }
  expect_none_since(before);
}

TEST(DeviceAllocation, NorDoesReadingAScriptedDevice) {
  DriverRequest request;
  request.type = "scripted";
  request.options = {{"motion", "ellipse"}, {"noise", "0.001"}, {"delay", "0.001"}};
  const auto driver = find_driver(request)->make(request);
  ASSERT_EQ(driver->open(), "");
  const Calls before = calls_of_this_thread();
  Sample sample;
  for (int i = 0; i < 1000; ++i) driver->read(sample, 0.0);
  expect_none_since(before);
}

}  // namespace
}  // namespace ambf::devices::testing
