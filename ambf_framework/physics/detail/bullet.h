// Bullet's headers and conversions to and from our plain values. Private to physics/: never included by a public
// header.
#pragma once

#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <btBulletCollisionCommon.h>
#include <btBulletDynamicsCommon.h>

#include "math/types.h"

namespace ambf::physics::detail {

inline btVector3 to_bullet(const math::Vec3& v) { return {v.x, v.y, v.z}; }
inline btQuaternion to_bullet(const math::Quat& q) { return {q.x, q.y, q.z, q.w}; }
inline btTransform to_bullet(const math::Pose& p) {
  return btTransform(to_bullet(p.orientation), to_bullet(p.position));
}

inline math::Vec3 from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }
inline math::Quat from_bullet(const btQuaternion& q) { return {q.x(), q.y(), q.z(), q.w()}; }
inline math::Pose from_bullet(const btTransform& t) {
  return {from_bullet(t.getOrigin()), from_bullet(t.getRotation())};
}

}  // namespace ambf::physics::detail
