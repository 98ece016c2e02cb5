// The driver `gamepad`: gamepads and joysticks of Linux's input layer. Sticks are velocities, a trigger closes the jaw,
// buttons keep the kernel's numbers. Unplugged, it is lost; open() finds it again. C++17.
#pragma once

#include "devices/driver.h"

namespace ambf::devices {

// Options: path, format (by name, evdev, joydev), axes/x .. axes/yaw, axes/jaw (an axis's number, reversed by a minus),
// speed, turn speed, dead zone; for nodes that cannot be asked: axis count, button count, stick range, trigger range.
DriverKind gamepad_kind();

}  // namespace ambf::devices
