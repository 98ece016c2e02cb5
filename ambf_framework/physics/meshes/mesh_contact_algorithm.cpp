#include "physics/meshes/detail/mesh_contact_algorithm.h"

#include <algorithm>

#include "physics/detail/contact_memory.h"
#include "physics/meshes/detail/attached_surface.h"

namespace ambf::physics::detail {

namespace {

btPersistentManifold& manifold_of(btPersistentManifold*& slot, btDispatcher& dispatcher, const btCollisionObject& a,
                                  const btCollisionObject& b) {
  if (!slot) slot = dispatcher.getNewManifold(&a, &b);
  return *slot;
}

btManifoldPoint new_point(const btCollisionObject& a, const btCollisionObject& b, const btVector3& on_a,
                          const btVector3& on_b, const btVector3& normal, double distance) {
  btManifoldPoint point(a.getWorldTransform().invXform(on_a), b.getWorldTransform().invXform(on_b), normal, distance);
  point.m_positionWorldOnA = on_a;
  point.m_positionWorldOnB = on_b;
  point.m_combinedFriction = btManifoldResult::calculateCombinedFriction(&a, &b);
  point.m_combinedRestitution = btManifoldResult::calculateCombinedRestitution(&a, &b);
  point.m_combinedRollingFriction = btManifoldResult::calculateCombinedRollingFriction(&a, &b);
  point.m_combinedSpinningFriction = btManifoldResult::calculateCombinedSpinningFriction(&a, &b);
  btPlaneSpace1(normal, point.m_lateralFrictionDir1, point.m_lateralFrictionDir2);
  return point;
}

// Normals rotate with B (by `turned` since the last step): where bodies are deep in each other, forces along
// directions that stay behind would be a couple that speeds the rotation up. For a few steps both surfaces count as
// flat, so that what slides keeps its footing.
void carry_along(btPersistentManifold& manifold, const btTransform& T_world_a, const btTransform& T_world_b,
                 const btMatrix3x3& turned, bool slide) {
  for (int i = 0; i < manifold.getNumContacts(); ++i) {
    btManifoldPoint& point = manifold.getContactPoint(i);
    for (btVector3* direction : {&point.m_normalWorldOnB, &point.m_lateralFrictionDir1, &point.m_lateralFrictionDir2})
      *direction = turned * *direction;
    if (!slide) continue;
    const btVector3 on_a = T_world_a * point.m_localPointA, on_b = T_world_b * point.m_localPointB;
    const double distance = (on_a - on_b).dot(point.m_normalWorldOnB);
    point.m_localPointB = T_world_b.invXform(on_a - point.m_normalWorldOnB * distance);
  }
  manifold.refreshContactPoints(T_world_a, T_world_b);
}

}  // namespace

// The contacts of the last time, with their impulses.
struct MeshContactAlgorithm::Known {
  std::array<btManifoldPoint, kMaxPoints> points;
  std::array<bool, kMaxPoints> used{};
  std::size_t count = 0;

  void hand_on(btManifoldPoint& to) {
    std::size_t best = count;
    double nearest = kWarmStartDistance * kWarmStartDistance;
    for (std::size_t i = 0; i < count; ++i) {
      const double squared = (points[i].m_localPointB - to.m_localPointB).length2();
      if (used[i] || squared >= nearest || points[i].m_normalWorldOnB.dot(to.m_normalWorldOnB) < kWarmStartCosine)
        continue;
      best = i;
      nearest = squared;
    }
    if (best == count) return;
    used[best] = true;
    const btManifoldPoint& from = points[best];
    continue_contact(from, to);
  }
};

MeshContactAlgorithm::~MeshContactAlgorithm() {
  for (btPersistentManifold* manifold : manifolds_)
    if (manifold) m_dispatcher->releaseManifold(manifold);
}

void MeshContactAlgorithm::getAllContactManifolds(btManifoldArray& manifolds) {
  for (btPersistentManifold* manifold : manifolds_)
    if (manifold) manifolds.push_back(manifold);
}

void MeshContactAlgorithm::processCollision(const btCollisionObjectWrapper* first,
                                            const btCollisionObjectWrapper* second, const btDispatcherInfo&,
                                            btManifoldResult* result) {
  const btCollisionObjectWrapper &mesh = swapped_ ? *second : *first, &other = swapped_ ? *first : *second;
  const btCollisionObject &a = *mesh.getCollisionObject(), &b = *other.getCollisionObject();
  const btTransform &T_world_a = mesh.getWorldTransform(), &T_world_b = other.getWorldTransform();

  const double reach = std::min({kContactReach + result->m_closestPointDistanceThreshold,
                                 mesh.getCollisionShape()->getContactBreakingThreshold(gContactBreakingThreshold),
                                 other.getCollisionShape()->getContactBreakingThreshold(gContactBreakingThreshold)});
  const bool wait = contacts_.budget().must_wait(ticket_, cost_);
  const btQuaternion q_world_b = T_world_b.getRotation();
  const btMatrix3x3 turned(q_world_b * q_world_b_.inverse());
  q_world_b_ = q_world_b;
  Known known;
  for (btPersistentManifold* manifold : manifolds_) {
    if (!manifold) continue;
    if (wait) {
      carry_along(*manifold, a.getWorldTransform(), b.getWorldTransform(), turned,
                  contacts_.budget().interval() <= kMaxSlideInterval);
      continue;
    }
    manifold->refreshContactPoints(a.getWorldTransform(), b.getWorldTransform());
    for (int i = 0; i < manifold->getNumContacts(); ++i) known.points[known.count++] = manifold->getContactPoint(i);
    manifold->clearManifold();
  }
  if (wait) return;
  find(mesh, other, T_world_b.inverseTimes(T_world_a), reach, known);
  cost_ = contacts_.cost();
  ticket_ = contacts_.budget().charge(cost_);
  for (const SurfaceContacts::Chosen& chosen : contacts_.choose()) {
    const SurfaceContact& contact = chosen.contact;
    const btVector3 normal = T_world_b.getBasis() * contact.normal, on_b = T_world_b * contact.point;
    btManifoldPoint point = new_point(a, b, on_b + normal * contact.distance, on_b, normal, contact.distance);
    set_found_by(point, {contact.vertex.vertex, contact.vertex.of_a});
    known.hand_on(point);
    manifold_of(manifolds_[static_cast<std::size_t>(chosen.group)], *m_dispatcher, a, b).addManifoldPoint(point);
  }
}

void MeshContactAlgorithm::find(const btCollisionObjectWrapper& mesh, const btCollisionObjectWrapper& other,
                                const btTransform& T_b_a, double reach, const Known& known) {
  const FeatureMesh& of_a = *attached_surface(*mesh.getCollisionShape());
  if (const FeatureMesh* of_b = attached_surface(*other.getCollisionShape())) {
    std::array<SurfaceVertex, kMaxPoints> vertices;
    std::size_t count = 0;
    for (std::size_t i = 0; i < known.count; ++i)
      if (const FoundBy found = found_by(known.points[i]); found.vertex >= 0)
        vertices[count++] = {found.vertex, found.of_a};
    contacts_.touch(of_a, *of_b, T_b_a, reach, fine_, {vertices.data(), count});
    return;
  }
  contacts_.touch(of_a, static_cast<const btConvexShape&>(*other.getCollisionShape()), T_b_a, reach);
  // A round shape shows one contact a triangle; those of the steps before make them a whole footing.
  const btTransform& T_world_b = other.getWorldTransform();
  for (std::size_t i = 0; i < known.count; ++i) {
    const btManifoldPoint& point = known.points[i];
    contacts_.add_old({T_world_b.invXform(point.m_positionWorldOnB),
                       T_world_b.getBasis().transpose() * point.m_normalWorldOnB, point.m_distance1});
  }
}

}  // namespace ambf::physics::detail
