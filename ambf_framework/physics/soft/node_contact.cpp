#include "physics/soft/detail/node_contact.h"

#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>

namespace ambf::physics::detail {

PointDistance distance_from_convex(const btConvexShape& convex, const btVector3& point, double limit) {
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

}  // namespace ambf::physics::detail
