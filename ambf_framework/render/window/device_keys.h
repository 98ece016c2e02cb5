// What a window's keys do to input devices. Main thread.
#pragma once

#include <string>

#include "render/window/keys.h"
#include "state/abilities/devices.h"
#include "state/ids.h"

namespace ambf::render {

// Acts on the devices that see through `camera`; on all where the window has a view of its own. Returns what was done,
// for the user; `devices` may be null.
std::string act_on_devices(const KeyBinding& binding, state::DeviceAbility* devices, state::ObjectId camera);

}  // namespace ambf::render
