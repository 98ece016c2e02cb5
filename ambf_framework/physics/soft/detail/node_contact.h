// The exact distance of a point from a rigid shape, for nodes of soft bodies. Private to physics/soft/. Physics
// thread.
#pragma once

#include <algorithm>

#include "physics/detail/bullet.h"

namespace ambf::physics::detail {

struct PointDistance {
  double distance;   // m, from the surface with its margin; negative: inside
  btVector3 normal;  // unit, out of the shape, in its frame
};

constexpr double kNoDirection = 1e-12;  // m: below it a difference of points has none

inline PointDistance distance_from(const btSphereShape& sphere, const btVector3& point) {
  const double length = point.length();
  return {length - sphere.getRadius(), length > kNoDirection ? point / length : btVector3(0, 0, 1)};
}

inline PointDistance distance_from(const btBoxShape& box, const btVector3& point) {
  const btVector3 beyond = point.absolute() - box.getHalfExtentsWithMargin();
  const auto side = [&](int axis) { return point[axis] < 0.0 ? -1.0 : 1.0; };
  btVector3 outside = beyond;
  outside.setMax({0, 0, 0});
  const double length = outside.length();
  if (length > kNoDirection)
    return {length, btVector3(outside.x() * side(0), outside.y() * side(1), outside.z() * side(2)) / length};
  const int axis = beyond.maxAxis();
  btVector3 normal(0, 0, 0);
  normal[axis] = side(axis);
  return {beyond[axis], normal};
}

inline PointDistance distance_from(const btCapsuleShape& capsule, const btVector3& point) {
  const int axis = capsule.getUpAxis();
  const double half = capsule.getHalfHeight();
  btVector3 away = point;
  away[axis] -= std::min(std::max(point[axis], -half), half);
  const double length = away.length();
  btVector3 across(0, 0, 0);
  across[(axis + 1) % 3] = 1.0;
  return {length - capsule.getRadius(), length > kNoDirection ? away / length : across};
}

// By Bullet's search, for shapes that have no formula here.
PointDistance distance_from_convex(const btConvexShape& convex, const btVector3& point, double limit);

// Of a convex shape or half-space. `limit` (m): what is farther away may be answered by any distance above it. Asked of
// thousands of points in a step, so the compiler is to see it there.
inline PointDistance distance_from(const btCollisionShape& shape, const btVector3& point, double limit) {
  switch (shape.getShapeType()) {
    case STATIC_PLANE_PROXYTYPE: {
      const auto& plane = static_cast<const btStaticPlaneShape&>(shape);
      return {plane.getPlaneNormal().dot(point) - plane.getPlaneConstant(), plane.getPlaneNormal()};
    }
    case SPHERE_SHAPE_PROXYTYPE: return distance_from(static_cast<const btSphereShape&>(shape), point);
    case BOX_SHAPE_PROXYTYPE: return distance_from(static_cast<const btBoxShape&>(shape), point);
    case CAPSULE_SHAPE_PROXYTYPE: return distance_from(static_cast<const btCapsuleShape&>(shape), point);
    default: return distance_from_convex(static_cast<const btConvexShape&>(shape), point, limit);
  }
}

}  // namespace ambf::physics::detail
