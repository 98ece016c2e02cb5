// The driver `keyboard_mouse`: a hand that a person moves in the simulator's own windows. Held keys are velocities;
// pointer and wheel move the hand in the plane of the picture and away from it, spread over the time between two
// pictures. C++17.
#pragma once

#include "devices/driver.h"
#include "exchange/broadcast.h"
#include "state/window_input.h"

namespace ambf::devices {

inline constexpr const char* kKeyboardMouse = "keyboard_mouse";  // its type

// `windows` outlives the driver. Options: speed, turn speed, pointer speed (m a pixel), wheel step (m a notch).
DriverKind keyboard_mouse_kind(const exchange::Broadcast<state::WindowInput>& windows);

}  // namespace ambf::devices
