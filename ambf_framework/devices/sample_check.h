// Whether a driver's sample can be a hand's: no NaN, a rotation, newer than the last one, reached at a human speed.
// Device's thread.
#pragma once

#include <cstdint>

#include "devices/driver.h"
#include "state/devices.h"

namespace ambf::devices {

class SampleCheck {
 public:
  // Faster than any arm: 10 m/s and 100 rad/s, with room for what a tremor of the sensor adds at high rates.
  static constexpr double kMaxSpeed = 10.0, kRoom_m = 0.01;
  static constexpr double kMaxTurn = 100.0, kRoom_rad = 0.3;

  // After the hardware was opened, any pose is a beginning.
  void restart() { known_ = false; }
  // none: it is fit for use, and its rotation is normalised. After a jump the next one is compared with where it went.
  state::DeviceFault check(Sample& sample);

 private:
  bool known_ = false;
  Sample last_;
};

}  // namespace ambf::devices
