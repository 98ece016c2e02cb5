// The driver `gamepad` on FIFOs that carry the records of evdev and joydev.
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <random>
#include <thread>

#include "base/clock.h"
#include "devices/driver.h"
#include "math/rotation.h"
#include "tests/devices/input_records.h"

namespace ambf::devices {
namespace {

using namespace std::chrono_literals;

class GamepadTest : public testing::Test {
 protected:
  std::unique_ptr<Driver> make(std::map<std::string, std::string> options) {
    DriverRequest request;
    request.device = "Pad";
    request.type = "gamepad";
    request.options = std::move(options);
    return find_driver(request)->make(request);
  }
  // Opens it on the FIFO, which has a writer then.
  std::unique_ptr<Driver> opened(Fifo& fifo, std::map<std::string, std::string> options = {}) {
    options["path"] = fifo.path();
    auto driver = make(std::move(options));
    EXPECT_EQ(driver->open(), "");
    fifo.plug();
    return driver;
  }
  Sample sample(Driver& driver) {
    Sample sample;
    EXPECT_EQ(driver.read(sample, 0.0), Reading::sample);
    return sample;
  }
  struct Motion {
    math::Vec3 velocity, angular_velocity;
  };
  // Over 10 ms.
  Motion motion(Driver& driver) {
    const Sample before = sample(driver);
    std::this_thread::sleep_for(10ms);
    const Sample after = sample(driver);
    const double dt = base::to_seconds(after.stamp_ns - before.stamp_ns);
    return {(after.T_u_tip.position - before.T_u_tip.position) / dt,
            math::log(after.T_u_tip.orientation * math::inverse(before.T_u_tip.orientation)) / dt};
  }

  TemporaryFolder folder;
  Fifo js{folder.file("js0")}, event{folder.file("event0")};
};

void expect_near(const math::Vec3& a, const math::Vec3& b) { EXPECT_LT(math::norm(a - b), 1e-6) << a.x << " " << a.y; }

TEST_F(GamepadTest, SticksAreVelocitiesInTheOperatorsFrame) {
  const auto pad = opened(js, {{"speed", "0.2"}, {"turn speed", "0.5"}, {"dead zone", "0"}});
  expect_near(motion(*pad).velocity, {});
  js.send_joydev(JS_EVENT_AXIS, 0, 32767);  // left stick to the right
  expect_near(motion(*pad).velocity, {0.0, 0.2, 0.0});
  js.send_joydev(JS_EVENT_AXIS, 0, 0);
  js.send_joydev(JS_EVENT_AXIS, 1, -32767);  // away
  expect_near(motion(*pad).velocity, {-0.2, 0.0, 0.0});
  js.send_joydev(JS_EVENT_AXIS, 1, 0);
  js.send_joydev(JS_EVENT_AXIS, 4, -32767);  // right stick up
  expect_near(motion(*pad).velocity, {0.0, 0.0, 0.2});
  js.send_joydev(JS_EVENT_AXIS, 4, 0);
  js.send_joydev(JS_EVENT_AXIS, 6, 32767);  // cross to the right: clockwise as the operator sees it
  const Motion roll = motion(*pad);
  expect_near(roll.velocity, {});
  expect_near(roll.angular_velocity, {-0.5, 0.0, 0.0});
}

TEST_F(GamepadTest, WornStickWithinTheDeadZoneMovesNothing) {
  const auto pad = opened(js, {{"dead zone", "0.2"}, {"speed", "1"}});
  js.send_joydev(JS_EVENT_AXIS, 0, 6500);
  js.send_joydev(JS_EVENT_AXIS, 3, -6500);
  sample(*pad);
  std::this_thread::sleep_for(5ms);
  EXPECT_EQ(sample(*pad).T_u_tip, math::Pose{});
  // Beyond it the velocity begins at zero: half of the rest is half of the speed.
  js.send_joydev(JS_EVENT_AXIS, 0, 19660);
  EXPECT_NEAR(motion(*pad).velocity.y, 0.5, 1e-3);
}

TEST_F(GamepadTest, AxesOfTheFileReplaceTheDefaults) {
  const auto pad =
      opened(js, {{"axes/x", "none"}, {"axes/y", "-2"}, {"axes/jaw", "-7"}, {"dead zone", "0"}, {"speed", "0.1"}});
  js.send_joydev(JS_EVENT_AXIS, 1, 32767);
  js.send_joydev(JS_EVENT_AXIS, 2, 32767);
  js.send_joydev(JS_EVENT_AXIS, 7, 32767);
  expect_near(motion(*pad).velocity, {0.0, -0.1, 0.0});
  EXPECT_TRUE(pad->traits().gripper);
  EXPECT_DOUBLE_EQ(sample(*pad).jaw, 1.0);
}

TEST_F(GamepadTest, EvdevIsObeyedReportByReport) {
  const auto pad = opened(event, {{"stick range", "1000"}, {"dead zone", "0"}, {"speed", "0.1"}});
  EXPECT_EQ(pad->traits().buttons, 11U);
  EXPECT_DOUBLE_EQ(sample(*pad).jaw, 1.0) << "open until the trigger has sent something";
  event.send_evdev(EV_ABS, ABS_X, 1000);
  event.send_evdev(EV_KEY, BTN_WEST, 1);
  event.send_evdev(EV_ABS, ABS_RZ, 255);
  EXPECT_EQ(sample(*pad).buttons, 0U) << "not reported yet";
  event.report();
  EXPECT_EQ(sample(*pad).buttons, 8U) << "the fourth one, as joydev numbers them";
  EXPECT_DOUBLE_EQ(sample(*pad).jaw, 0.0) << "the trigger closes";
  expect_near(motion(*pad).velocity, {0.0, 0.1, 0.0});
  event.send_evdev(EV_ABS, ABS_X, 0);
  event.send_evdev(EV_KEY, BTN_WEST, 0);
  event.report();
  expect_near(motion(*pad).velocity, {});
  EXPECT_EQ(sample(*pad).buttons, 0U);
}

TEST_F(GamepadTest, EventsAfterAnOverrunAreIgnoredUntilTheNextReport) {
  const auto pad = opened(event);
  event.send_evdev(EV_SYN, SYN_DROPPED, 0);
  event.send_evdev(EV_KEY, BTN_SOUTH, 1);
  event.report();
  EXPECT_EQ(sample(*pad).buttons, 0U);
  event.send_evdev(EV_KEY, BTN_EAST, 1);
  event.report();
  EXPECT_EQ(sample(*pad).buttons, 2U);
}

TEST_F(GamepadTest, RecordsThatArriveInPiecesAreWhole) {
  const auto pad = opened(js);
  const js_event down{0, 1, JS_EVENT_BUTTON, 5};
  js.send(&down, 3);
  EXPECT_EQ(sample(*pad).buttons, 0U);
  js.send(reinterpret_cast<const char*>(&down) + 3, sizeof(down) - 3);
  EXPECT_EQ(sample(*pad).buttons, 32U);
}

TEST_F(GamepadTest, IsLostWhenUnpluggedAndFoundAgainAtRest) {
  const auto pad = opened(js, {{"dead zone", "0"}});
  js.send_joydev(JS_EVENT_AXIS, 0, 32767);
  js.send_joydev(JS_EVENT_BUTTON, 1, 1);
  motion(*pad);
  const math::Pose where = sample(*pad).T_u_tip;
  js.unplug();
  Sample last;
  EXPECT_EQ(pad->read(last, 0.0), Reading::lost);
  pad->close();
  EXPECT_EQ(pad->read(last, 0.0), Reading::lost);
  EXPECT_EQ(pad->open(), "");
  js.plug();
  EXPECT_EQ(sample(*pad).T_u_tip, where);
  expect_near(motion(*pad).velocity, {});
  EXPECT_EQ(sample(*pad).buttons, 0U) << "a button that was down when it vanished is not stuck";
}

TEST_F(GamepadTest, GarbageMovesItWithinItsSpeed) {
  for (Fifo* fifo : {&js, &event}) {
    const auto pad = opened(*fifo, {{"speed", "0.1"}});
    std::mt19937 random(7);
    for (int round = 0; round < 50; ++round) {
      std::uint32_t bytes[64];
      for (std::uint32_t& word : bytes) word = static_cast<std::uint32_t>(random());
      fifo->send(bytes, 1 + random() % sizeof(bytes));
      const Sample before = sample(*pad), after = sample(*pad);
      const double dt = base::to_seconds(after.stamp_ns - before.stamp_ns);
      EXPECT_LE(math::norm(after.T_u_tip.position - before.T_u_tip.position), 0.1 * std::sqrt(3.0) * dt + 1e-12);
      EXPECT_TRUE(math::is_finite(after.T_u_tip));
      EXPECT_TRUE(after.jaw >= 0.0 && after.jaw <= 1.0);
    }
  }
}

TEST_F(GamepadTest, SaysWhatItSearchedAndWhatIsWrong) {
  const std::string absent = make({{"path", folder.file("js7")}})->open();
  EXPECT_NE(absent.find(folder.file("js7") + ": No such file"), std::string::npos) << absent;
  const std::string wrong = make({{"speed", "fast"}, {"axes/x", "left"}, {"sped", "1"}, {"format", "usb"}})->open();
  for (const char* part : {"key 'driver'", "'speed' is 'fast', not a number from 0 to 10", "'axes/x' is 'left'",
                           "'sped' is no key", "'format' is 'usb', not one of by name, evdev, joydev"}) {
    EXPECT_NE(wrong.find(part), std::string::npos) << part << "\n" << wrong;
  }
}

}  // namespace
}  // namespace ambf::devices
