// The exact distance of a point from a rigid shape, for nodes of soft bodies. Private to physics/soft/. Physics
// thread.
#pragma once

#include "physics/detail/bullet.h"

namespace ambf::physics::detail {

struct PointDistance {
  double distance;   // m, from the surface with its margin; negative: inside
  btVector3 normal;  // unit, out of the shape, in its frame
};

// Of a convex shape or half-space. `limit` (m): what is farther away may be answered by any distance above it.
PointDistance distance_from(const btCollisionShape& shape, const btVector3& point, double limit);

}  // namespace ambf::physics::detail
