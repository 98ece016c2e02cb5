// Input devices: what they are now, and the panel's requests that change them. Main thread.
#pragma once

#include <memory>

#include "render/panel/notices.h"
#include "state/abilities/devices.h"

namespace ambf::render {

class DeviceActions {
 public:
  // `devices`: null where there are none.
  DeviceActions(state::DeviceAbility* devices, const Notices& notices) : devices_(devices), notices_(notices) {}

  unsigned count() const { return devices_ == nullptr ? 0 : devices_->count(); }
  // For device < count(). A status of cycle 0: its thread has not run yet.
  std::shared_ptr<const state::DeviceInfo> info(unsigned device) const { return devices_->info(device); }
  state::DeviceStatus status(unsigned device) const;
  bool forces() const { return devices_ != nullptr && devices_->forces(); }

  void set_forces(bool on) { devices_->set_forces(on); }
  // A value that the device refuses is reported instead.
  void set(unsigned device, state::DeviceParameter parameter, const math::Vec3& value);

 private:
  state::DeviceAbility* const devices_;
  const Notices& notices_;
};

}  // namespace ambf::render
