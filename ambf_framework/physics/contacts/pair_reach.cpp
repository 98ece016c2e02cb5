#include "physics/contacts/pair_reach.h"

#include <BulletCollision/BroadphaseCollision/btDbvt.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>

namespace ambf::physics::detail {
namespace {

constexpr int kFewParts = 8;  // of more, the tree that Bullet has for them knows better

}  // namespace

bool comes_near(btCollisionObject& still, const btVector3& low, const btVector3& high) {
  if (!still.isStaticObject()) return true;
  const btTransform& pose = still.getWorldTransform();
  const btVector3 middle = 0.5 * (low + high), half = 0.5 * (high - low);
  if (still.getCollisionShape()->getShapeType() == STATIC_PLANE_PROXYTYPE) {
    const auto& plane = static_cast<const btStaticPlaneShape&>(*still.getCollisionShape());
    const btVector3 normal = pose.getBasis() * plane.getPlaneNormal();
    return normal.dot(middle - pose.getOrigin()) - normal.absolute().dot(half) <= plane.getPlaneConstant();
  }
  if (still.getCollisionShape()->getShapeType() != COMPOUND_SHAPE_PROXYTYPE) return true;
  auto& compound = static_cast<btCompoundShape&>(*still.getCollisionShape());  // Bullet lists parts of no other
  const int count = compound.getNumChildShapes();
  if (count > kFewParts || compound.getDynamicAabbTree() == nullptr) return true;
  // The other box, as it lies in the compound's frame.
  const btVector3 local = pose.invXform(middle), reach = pose.getBasis().transpose().absolute() * half;
  const btDbvtVolume box = btDbvtVolume::FromMM(local - reach, local + reach);
  for (int i = 0; i < count; ++i)
    if (Intersect(compound.getChildList()[i].m_node->volume, box)) return true;
  return false;
}

}  // namespace ambf::physics::detail
