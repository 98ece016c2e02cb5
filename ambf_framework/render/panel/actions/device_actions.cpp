#include "render/panel/actions/device_actions.h"

namespace ambf::render {

state::DeviceStatus DeviceActions::status(unsigned device) const {
  state::DeviceStatus status;
  devices_->status(device, status);
  return status;
}

void DeviceActions::set(unsigned device, state::DeviceParameter parameter, const math::Vec3& value) {
  const std::string problem = devices_->set(device, parameter, value);
  if (!problem.empty()) notices_.warn(devices_->info(device)->name + ": " + problem);
}

}  // namespace ambf::render
