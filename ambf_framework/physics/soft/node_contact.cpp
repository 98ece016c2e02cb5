#include "physics/soft/detail/node_contact.h"

#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>

#include <algorithm>

namespace ambf::physics::detail {
namespace {

constexpr double kNoDirection = 1e-12;  // m: below it a difference of points has none

PointDistance of_sphere(const btSphereShape& sphere, const btVector3& point) {
  const double length = point.length();
  return {length - sphere.getRadius(), length > kNoDirection ? point / length : btVector3(0, 0, 1)};
}

PointDistance of_box(const btBoxShape& box, const btVector3& point) {
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

PointDistance of_capsule(const btCapsuleShape& capsule, const btVector3& point) {
  const int axis = capsule.getUpAxis();
  const double half = capsule.getHalfHeight();
  btVector3 away = point;
  away[axis] -= std::min(std::max(point[axis], -half), half);
  const double length = away.length();
  btVector3 across(0, 0, 0);
  across[(axis + 1) % 3] = 1.0;
  return {length - capsule.getRadius(), length > kNoDirection ? away / length : across};
}

PointDistance of_convex(const btConvexShape& convex, const btVector3& point, double limit) {
  const PointDistance far{2.0 * limit + 1.0, {0, 0, 1}};
  btVector3 low, high;
  convex.getAabb(btTransform::getIdentity(), low, high);
  const btVector3 reach(limit, limit, limit);
  const btVector3 below = low - reach, above = high + reach;
  for (int i = 0; i < 3; ++i)
    if (!(point[i] >= below[i] && point[i] <= above[i])) return far;
  btGjkEpaSolver2::sResults result;
  result.normal.setZero();
  const double distance = btGjkEpaSolver2::SignedDistance(point, 0.0, &convex, btTransform::getIdentity(), result);
  // No normal: on the surface to rounding; infinity: Bullet found no answer.
  return result.normal.length2() > 0.5 && distance < limit ? PointDistance{distance, result.normal} : far;
}

}  // namespace

PointDistance distance_from(const btCollisionShape& shape, const btVector3& point, double limit) {
  switch (shape.getShapeType()) {
    case STATIC_PLANE_PROXYTYPE: {
      const auto& plane = static_cast<const btStaticPlaneShape&>(shape);
      return {plane.getPlaneNormal().dot(point) - plane.getPlaneConstant(), plane.getPlaneNormal()};
    }
    case SPHERE_SHAPE_PROXYTYPE: return of_sphere(static_cast<const btSphereShape&>(shape), point);
    case BOX_SHAPE_PROXYTYPE: return of_box(static_cast<const btBoxShape&>(shape), point);
    case CAPSULE_SHAPE_PROXYTYPE: return of_capsule(static_cast<const btCapsuleShape&>(shape), point);
    default: return of_convex(static_cast<const btConvexShape&>(shape), point, limit);
  }
}

}  // namespace ambf::physics::detail
