// Angles of the ADF keys {r, p, y} that read back to a rotation, also where math::to_rpy loses digits. Pure function.
#pragma once

#include "math/types.h"

namespace ambf::adf {

// Roll, pitch, yaw (rad) with R = Rz(y) Ry(p) Rx(r), exact to rounding also near pitches of 90 degrees.
math::Vec3 exact_rpy(const math::Quat& q);

}  // namespace ambf::adf
