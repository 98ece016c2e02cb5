// What the parts of JointBlockSolver share. Private to physics/joints/.
#pragma once

#include <LinearMath/btVector3.h>

namespace ambf::physics {

// Depth is pushed out only every so many steps, and by as much more: it costs less so.
inline constexpr int kPushInterval = 2;

inline void copy3(double* to, const btVector3& from) {
  to[0] = from.x();
  to[1] = from.y();
  to[2] = from.z();
}

}  // namespace ambf::physics
