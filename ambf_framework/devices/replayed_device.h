// An input device out of a recording of inputs: its mapping, faults, limits and laws run again, cycle by cycle, on
// what its driver gave, on the frames that it saw and at the times at which it ran. No threads and no clock; not
// thread-safe.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "devices/device_settings.h"
#include "devices/driver.h"
#include "inputs/device_records.h"
#include "state/frame.h"

namespace ambf::devices {

class ReplayedDevice {
 public:
  struct Setup {
    std::uint16_t number = 0;  // its source is device_0 + number
    std::string name;
    DeviceSettings settings;
    DriverTraits traits;
    double period_s = 1e-3;
  };
  explicit ReplayedDevice(Setup setup);
  ~ReplayedDevice();
  ReplayedDevice(const ReplayedDevice&) = delete;
  ReplayedDevice& operator=(const ReplayedDevice&) = delete;

  const std::string& name() const;
  // What it moves from the next cycle on.
  void bind(const inputs::BindingRecord& binding);
  // The next cycle. `frame`: that which the record names; null: none. False: it posted another set-point than it did
  // when it was recorded.
  bool run(const inputs::CycleRecord& cycle, const state::Frame* frame);
  // What it posted last by a time; null: nothing.
  const state::SetPoint* set_point(std::int64_t until_ns) const;
  const math::Pose* camera_pose(state::ObjectId camera, std::int64_t until_ns) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ambf::devices
