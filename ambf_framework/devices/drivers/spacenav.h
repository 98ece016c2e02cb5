// The driver `spacenav`: a space mouse through spacenavd (or 3Dconnexion's daemon of that protocol). The puck's
// deflection is a velocity in all six axes. C++17.
#pragma once

#include "devices/driver.h"

namespace ambf::devices {

// Options: path (spacenavd's socket; default $SPNAV_SOCKET, else /run/spnav.sock), axes/x .. axes/yaw (x, y, z, rx, ry,
// rz, reversed by a minus), full (value at full deflection), speed, turn speed, dead zone.
DriverKind spacenav_kind();

}  // namespace ambf::devices
