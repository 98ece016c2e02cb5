#include "render/window/device_keys.h"

#include <algorithm>

#include "render/marks/device_text.h"

namespace ambf::render {

namespace {

// What the key makes of a device's value.
math::Vec3 wanted(const KeyBinding& binding, const state::DeviceStatus& status, state::DeviceParameter parameter) {
  const math::Vec3 now = state::value_of(status, parameter);
  if (binding.action == Action::device_rotation_camera) return {};
  if (binding.action == Action::device_rotation_world) return {1.0, 0.0, 0.0};
  if (binding.action == Action::device_mode) {
    const auto count = static_cast<unsigned>(state::DeviceMode::count);
    return {static_cast<double>((static_cast<unsigned>(status.mode) + 1) % count), 0.0, 0.0};
  }
  const state::DeviceParameterInfo& info = state::info_of(parameter);
  const auto moved = [&](double value) { return std::clamp(value + binding.step, info.min, info.max); };
  return {moved(now.x), moved(now.y), moved(now.z)};
}

state::DeviceParameter parameter_of(const KeyBinding& binding) {
  if (binding.action == Action::device_gain) return binding.parameter;
  return binding.action == Action::device_mode ? state::DeviceParameter::mode
                                               : state::DeviceParameter::rotation_reference;
}

}  // namespace

std::string act_on_devices(const KeyBinding& binding, state::DeviceAbility* devices, state::ObjectId camera) {
  if (devices == nullptr || devices->count() == 0) return "there are no input devices (options -n and -i)";
  if (binding.action == Action::device_forces) {
    devices->set_forces(!devices->forces());
    return devices->forces() ? "forces of all hands on" : "forces of all hands off";
  }
  const state::DeviceParameter parameter = parameter_of(binding);
  std::string done;
  for (unsigned device = 0; device < devices->count(); ++device) {
    const std::shared_ptr<const state::DeviceInfo> info = devices->info(device);
    state::DeviceStatus status;
    if (!pairs_with(*info, camera) || !devices->status(device, status)) continue;
    const math::Vec3 value = wanted(binding, status, parameter);
    const std::string problem = devices->set(device, parameter, value);
    done += (done.empty() ? "" : "; ") + info->name + ": ";
    done += problem.empty() ? value_text(parameter, value) : problem;
  }
  if (done.empty()) return "no input device sees through this window's camera";
  return std::string(state::info_of(parameter).name) + " of " + done;
}

}  // namespace ambf::render
