// How far a point is from the triangles that a shape is met by: what nodes of soft bodies ask. Private to physics/.
// Physics thread.
#pragma once

#include "physics/detail/bullet.h"

namespace ambf::physics::detail {

struct SurfaceDistance {
  bool near = false;          // there is a triangle within range
  double distance = 0.0;      // m, the shape's margin not counted; negative behind the triangle: a sheet has no back
  btVector3 normal{0, 0, 0};  // unit, along which the distance grows
};

// Of the nearest triangle within `range` (m). The shape needs an attached surface (mesh_contacts.h).
SurfaceDistance distance_to_surface(const btCollisionShape& shape, const btVector3& point, double range);

}  // namespace ambf::physics::detail
