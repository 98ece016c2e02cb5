// The driver `keyboard_mouse` on what a window publishes at picture rate.
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <thread>
#include <vector>

#include "base/clock.h"
#include "devices/drivers/keyboard_mouse.h"
#include "math/rotation.h"

namespace ambf::devices {
namespace {

using namespace std::chrono_literals;
using state::HandKey;

class KeyboardMouseTest : public testing::Test {
 protected:
  std::unique_ptr<Driver> make(std::map<std::string, std::string> options = {}) {
    DriverRequest request;
    request.device = "Keys";
    request.options = std::move(options);
    return keyboard_mouse_kind(windows).make(request);
  }
  std::unique_ptr<Driver> opened(std::map<std::string, std::string> options = {}) {
    publish();
    auto driver = make(std::move(options));
    EXPECT_EQ(driver->open(), "");
    return driver;
  }
  // As a window does after a picture.
  void publish(std::int64_t stamp_ns = base::steady_ns()) {
    input.stamp_ns = stamp_ns;
    windows.publish(input);
  }
  void hold(HandKey key, bool down = true) {
    const std::uint32_t bit = 1U << static_cast<unsigned>(key);
    input.held = down ? input.held | bit : input.held & ~bit;
    publish();
  }
  Sample sample(Driver& driver) {
    Sample sample;
    EXPECT_EQ(driver.read(sample, 0.0), Reading::sample);
    return sample;
  }
  math::Twist motion(Driver& driver) {
    const Sample before = sample(driver);
    std::this_thread::sleep_for(10ms);
    const Sample after = sample(driver);
    const double dt = base::to_seconds(after.stamp_ns - before.stamp_ns);
    return {(after.T_u_tip.position - before.T_u_tip.position) / dt,
            math::log(after.T_u_tip.orientation * math::inverse(before.T_u_tip.orientation)) / dt};
  }

  exchange::Broadcast<state::WindowInput> windows;
  state::WindowInput input{.open = true, .controls = true};
};

void expect_near(const math::Vec3& a, const math::Vec3& b) {
  EXPECT_LT(math::norm(a - b), 1e-6) << a.x << " " << a.y << " " << a.z;
}

TEST_F(KeyboardMouseTest, HeldKeysAreVelocitiesAlongWhatThePersonSees) {
  const auto keys = opened({{"speed", "0.1"}, {"turn speed", "2"}});
  hold(HandKey::right);
  hold(HandKey::up);
  hold(HandKey::away);
  expect_near(motion(*keys).linear, {-0.1, 0.1, 0.1});
  hold(HandKey::left);
  hold(HandKey::slow);
  expect_near(motion(*keys).linear, {-0.01, 0.0, 0.01});
  input.held = 0;
  hold(HandKey::roll_right);
  expect_near(motion(*keys).angular, {-2.0, 0.0, 0.0});
  hold(HandKey::roll_right, false);
  hold(HandKey::pitch_up);
  expect_near(motion(*keys).angular, {0.0, 2.0, 0.0});
  hold(HandKey::pitch_up, false);
  hold(HandKey::yaw_left);
  expect_near(motion(*keys).angular, {0.0, 0.0, 2.0});
  hold(HandKey::yaw_left, false);
  const math::Pose rest = sample(*keys).T_u_tip;
  std::this_thread::sleep_for(5ms);
  EXPECT_EQ(sample(*keys).T_u_tip, rest);
}

TEST_F(KeyboardMouseTest, PointerMotionOfOnePictureIsSpreadUntilTheNext) {
  const auto keys = opened({{"pointer speed", "0.001"}, {"wheel step", "0.01"}});
  std::int64_t picture_ns = input.stamp_ns;
  sample(*keys);
  input.pointer_right_px += 100.0;  // 0.1 m in the 90 ms since the picture before
  input.wheel_away_notches += 2.0;
  publish(picture_ns += 90'000'000);
  double largest = 0.0;
  const Sample first = sample(*keys);
  std::int64_t last_ns = first.stamp_ns;
  double last_y = first.T_u_tip.position.y;
  for (Sample now = sample(*keys); now.T_u_tip.position.y < 0.1 - 1e-9; now = sample(*keys)) {
    const double dt = base::to_seconds(now.stamp_ns - last_ns);
    if (dt < 0.05) largest = std::max(largest, (now.T_u_tip.position.y - last_y) / std::max(dt, 1e-6));
    last_y = now.T_u_tip.position.y;
    last_ns = now.stamp_ns;
    std::this_thread::sleep_for(1ms);
    ASSERT_LT(base::to_seconds(now.stamp_ns - picture_ns), 10.0) << "it never arrives";
  }
  EXPECT_LT(largest, 1.5 * 0.1 / 0.09) << "m/s: no leap";
  expect_near(sample(*keys).T_u_tip.position, {-0.02, 0.1, 0.0});
}

TEST_F(KeyboardMouseTest, NothingMovesBeforeItIsSwitchedOnAndAfterTheFocusIsLost) {
  input.controls = false;
  const auto keys = opened();
  hold(HandKey::right);
  input.pointer_right_px = 500.0;
  publish();
  Sample now = sample(*keys);
  EXPECT_FALSE(now.ready);
  EXPECT_STREQ(now.not_ready, "press G in a window to move it by keyboard and mouse");
  std::this_thread::sleep_for(2ms);
  EXPECT_EQ(sample(*keys).T_u_tip, math::Pose{});
  input.controls = true;
  publish();
  EXPECT_NEAR(motion(*keys).linear.y, 0.05, 1e-6) << "the pointer's way before does not count";
  input.pointer_right_px += 100.0;
  publish();
  sample(*keys);
  input.controls = false;
  publish();
  now = sample(*keys);
  std::this_thread::sleep_for(2ms);
  EXPECT_EQ(sample(*keys).T_u_tip, now.T_u_tip) << "what was left of a pointer's motion is dropped";
}

TEST_F(KeyboardMouseTest, AFrozenWindowMovesNothing) {
  const auto keys = opened();
  hold(HandKey::right);
  publish(base::steady_ns() - 600'000'000);
  sample(*keys);
  std::this_thread::sleep_for(2ms);
  EXPECT_EQ(sample(*keys).T_u_tip, math::Pose{});
}

TEST_F(KeyboardMouseTest, JawClosesInHalfASecondAndButtonsFollow) {
  const auto keys = opened();
  EXPECT_DOUBLE_EQ(sample(*keys).jaw, 1.0);
  input.jaw_closed = true;
  hold(HandKey::clutch);
  const Sample before = sample(*keys);
  std::this_thread::sleep_for(20ms);
  const Sample after = sample(*keys);
  EXPECT_NEAR(before.jaw - after.jaw, 2.0 * base::to_seconds(after.stamp_ns - before.stamp_ns), 1e-9);
  EXPECT_EQ(after.buttons, 3U) << "gripper and clutch";
  hold(HandKey::clutch, false);
  hold(HandKey::camera_clutch);
  EXPECT_EQ(sample(*keys).buttons, 5U);
}

TEST_F(KeyboardMouseTest, WaitsForAWindow) {
  EXPECT_NE(make()->open().find("no window"), std::string::npos);
  const auto keys = opened();
  input.open = false;
  publish();
  const Sample closed = sample(*keys);
  EXPECT_FALSE(closed.ready);
  EXPECT_STREQ(closed.not_ready, "no window is open");
  EXPECT_EQ(closed.buttons, 0U);
  input.open = true;
  publish();
  EXPECT_TRUE(sample(*keys).ready);
}

}  // namespace
}  // namespace ambf::devices
