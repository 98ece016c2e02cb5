// The input devices of a replay: runs the cycles that a recording holds, each on the frame that it saw, and compares
// what they post. Not thread-safe.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "devices/replayed_device.h"
#include "inputs/device_records.h"
#include "inputs/recording.h"
#include "state/frame.h"

namespace ambf::runtime {

class ReplayedDevices {
 public:
  // `recording` must outlive it.
  ReplayedDevices(std::vector<devices::ReplayedDevice::Setup> setups, inputs::Recording& recording);

  enum class Ran : std::uint8_t {
    done,
    at_end,  // the recording was cut off: it has no more cycles of this device
    failed   // problem() says why
  };
  // The cycles of a device up to a time, and those of all devices that saw no frame after `newest` (null: none).
  Ran run_until(state::Source source, std::int64_t until_ns, const state::Frame* newest);
  Ran finish_frame(const state::Frame* newest);

  // What run_until() made the device post last by that time; null: nothing.
  const state::SetPoint* set_point(state::Source source, std::int64_t until_ns) const;
  const math::Pose* camera_pose(state::Source source, state::ObjectId camera, std::int64_t until_ns) const;

  const std::string& problem() const { return problem_; }
  std::uint64_t cycles() const { return cycles_; }
  std::uint64_t set_points() const { return set_points_; }

 private:
  // A device and the cycle that it runs next.
  struct Device {
    explicit Device(devices::ReplayedDevice::Setup setup)
        : stream(static_cast<inputs::Stream>(inputs::kFirstDeviceStream + setup.number)), device(std::move(setup)) {}
    const inputs::Stream stream;
    devices::ReplayedDevice device;
    std::optional<inputs::CycleRecord> next;
  };

  Device* device_of(state::Source source) const;
  const inputs::CycleRecord* next_cycle(Device& device);
  template <class Belongs>
  Ran run(Device& device, const state::Frame* newest, Belongs&& belongs);
  Ran fail(std::string problem);

  inputs::Recording& recording_;
  std::vector<std::unique_ptr<Device>> devices_;  // by number; null: it did not run
  std::string problem_;
  std::uint64_t cycles_ = 0, set_points_ = 0;
};

}  // namespace ambf::runtime
