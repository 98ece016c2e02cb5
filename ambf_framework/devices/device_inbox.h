// What other threads hand to a device's thread, and what it publishes. Nothing in here waits or allocates on the
// device's side.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>

#include "base/event_count.h"
#include "devices/device_settings.h"
#include "exchange/bounded_queue.h"
#include "exchange/broadcast.h"
#include "exchange/latest_slot.h"
#include "state/devices.h"

namespace ambf::devices {

// Whose the driver is: while open, only the device's thread calls it; else only the searching thread does.
enum class DriverState : std::uint8_t { closed, open, lost };

struct DeviceInbox {
  struct Setting {
    state::DeviceParameter parameter = state::DeviceParameter::count;
    math::Vec3 value;
  };
  // What a client asks of the hand; ends state::kDeviceCommandS after it was posted.
  struct External {
    math::Wrench wrench_world;
    bool pulls = false;
    math::Pose T_world_target;
  };

  std::atomic<DriverState> driver{DriverState::closed};
  base::EventCount driver_lost;  // wakes the searching thread

  std::atomic<bool> forces{false};
  exchange::BoundedQueue<Setting> settings{64};
  exchange::LatestSlot<External> external;  // writers take turns (the hub's mutex)

  // The hub puts a binding; the thread puts the one before into `retired`, which the hub empties.
  std::atomic<EffectorBinding*> incoming{nullptr};
  std::atomic<EffectorBinding*> retired{nullptr};

  exchange::Broadcast<state::DeviceStatus> status;

  ~DeviceInbox() {
    delete incoming.load();
    delete retired.load();
  }
};

}  // namespace ambf::devices
