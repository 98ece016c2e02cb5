// The ability to see and command input devices. They are numbered as `-i` names them; their number does not change
// while the simulation runs. Implemented by devices/hub.h. Any thread; nothing waits for a device's thread. C++17.
#pragma once

#include <memory>
#include <string>

#include "math/types.h"
#include "state/devices.h"

namespace ambf::state {

class DeviceAbility {
 public:
  virtual ~DeviceAbility() = default;
  virtual unsigned count() const = 0;
  // Never null for device < count().
  virtual std::shared_ptr<const DeviceInfo> info(unsigned device) const = 0;
  // The newest cycle of its thread, whole. False: it has not run yet, or there is no such device. Neither waits nor
  // allocates.
  virtual bool status(unsigned device, DeviceStatus& status) const = 0;

  // From the device's next cycle on. Empty, or why the value is refused (state::check).
  virtual std::string set(unsigned device, DeviceParameter parameter, const math::Vec3& value) = 0;
  // Forces of all devices (-e). Off: hands feel nothing; on: forces ramp up.
  virtual bool forces() const = 0;
  virtual void set_forces(bool on) = 0;

  // Adds a wrench at the tip, in W, to what the hand feels, within the device's limits. Ends kDeviceCommandS after the
  // last call.
  virtual void push(unsigned device, const math::Wrench& wrench_world) = 0;
  // The hand is pulled to this pose of REF instead of to where its effector is. Ends as push().
  virtual void pull_to(unsigned device, const math::Pose& T_world_target) = 0;
};

}  // namespace ambf::state
