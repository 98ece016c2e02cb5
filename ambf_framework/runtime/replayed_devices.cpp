#include "runtime/detail/replayed_devices.h"

#include <utility>

namespace ambf::runtime {

ReplayedDevices::ReplayedDevices(std::vector<devices::ReplayedDevice::Setup> setups, inputs::Recording& recording)
    : recording_(recording) {
  for (devices::ReplayedDevice::Setup& setup : setups) {
    const std::size_t number = setup.number;
    if (devices_.size() <= number) devices_.resize(number + 1);
    devices_[number] = std::make_unique<Device>(std::move(setup));
  }
}

ReplayedDevices::Ran ReplayedDevices::fail(std::string problem) {
  if (problem_.empty()) problem_ = std::move(problem);
  return Ran::failed;
}

ReplayedDevices::Device* ReplayedDevices::device_of(state::Source source) const {
  const auto number = static_cast<std::size_t>(source) - static_cast<std::size_t>(state::Source::device_0);
  return number < devices_.size() ? devices_[number].get() : nullptr;
}

// Null at its end, and after a failure.
const inputs::CycleRecord* ReplayedDevices::next_cycle(Device& device) {
  while (problem_.empty() && !device.next) {
    const inputs::RawRecord* raw = recording_.next(device.stream);
    if (raw == nullptr) return nullptr;
    if (const auto binding = raw->as<inputs::BindingRecord>()) {
      device.device.bind(*binding);
    } else {
      device.next = raw->as<inputs::CycleRecord>();
      if (!device.next) fail("the recording is damaged: a cycle of '" + device.device.name() + "' is none");
    }
  }
  return device.next ? &*device.next : nullptr;
}

template <class Belongs>
ReplayedDevices::Ran ReplayedDevices::run(Device& device, const state::Frame* newest, Belongs&& belongs) {
  const inputs::CycleRecord* cycle = next_cycle(device);
  for (; cycle != nullptr && belongs(*cycle); cycle = next_cycle(device)) {
    const std::string which = "device '" + device.device.name() + "', cycle " + std::to_string(cycle->cycle);
    if (cycle->frame != 0 && (newest == nullptr || newest->sequence != cycle->frame)) {
      return fail(which + ": the recording is damaged: it saw a frame that is not there");
    }
    const bool same = device.device.run(*cycle, cycle->frame == 0 ? nullptr : newest);
    if (!same) {
      return fail(which + ": its set-point differs from the recording, at step " +
                  std::to_string(newest == nullptr ? 0 : newest->sim_step));
    }
    ++cycles_;
    set_points_ += cycle->set_point ? 1 : 0;
    device.next.reset();
  }
  if (!problem_.empty()) return Ran::failed;
  const bool cut = !recording_.ended_properly() || recording_.gap();
  return cycle == nullptr && cut ? Ran::at_end : Ran::done;
}

ReplayedDevices::Ran ReplayedDevices::run_until(state::Source source, std::int64_t until_ns,
                                                const state::Frame* newest) {
  Device* device = device_of(source);
  if (device == nullptr) return fail("the recording is damaged: it has no such device");
  return run(*device, newest, [until_ns](const inputs::CycleRecord& cycle) { return cycle.now_ns <= until_ns; });
}

ReplayedDevices::Ran ReplayedDevices::finish_frame(const state::Frame* newest) {
  const std::uint64_t sequence = newest == nullptr ? 0 : newest->sequence;
  for (const auto& device : devices_) {
    if (device == nullptr) continue;
    const auto saw_no_later = [sequence](const inputs::CycleRecord& cycle) { return cycle.frame <= sequence; };
    if (run(*device, newest, saw_no_later) == Ran::failed) return Ran::failed;
  }
  return Ran::done;
}

const state::SetPoint* ReplayedDevices::set_point(state::Source source, std::int64_t until_ns) const {
  const Device* device = device_of(source);
  return device == nullptr ? nullptr : device->device.set_point(until_ns);
}

const math::Pose* ReplayedDevices::camera_pose(state::Source source, state::ObjectId camera,
                                               std::int64_t until_ns) const {
  const Device* device = device_of(source);
  return device == nullptr ? nullptr : device->device.camera_pose(camera, until_ns);
}

}  // namespace ambf::runtime
