#include "physics/contacts/plane_contact.h"

#include <array>
#include <cmath>

namespace ambf::physics::detail {

namespace {

constexpr int kMaxContacts = 4;          // what a manifold holds
constexpr double kFlatSine = 1e-3;       // a round face tilted by less stands on fixed points of its rim
constexpr double kDepthPreference = 20;  // how much being lower counts against being farther out

// Corners of one shape above the plane, in world coordinates, and the choice among them.
class Corners {
 public:
  Corners(const btTransform& pose, const btVector3& normal, double constant, double reach)
      : pose_(pose), normal_(normal), constant_(constant), reach_(reach) {}

  void add_world(const btVector3& point) {
    const double distance = normal_.dot(point) - constant_;
    if (distance > reach_ || count_ == static_cast<int>(points_.size())) return;
    points_[static_cast<std::size_t>(count_)] = point;
    distances_[static_cast<std::size_t>(count_++)] = distance;
  }
  void add_local(const btVector3& point) { add_world(pose_ * point); }

  void report(btManifoldResult& result) const {
    if (count_ <= kMaxContacts) {
      for (int i = 0; i < count_; ++i) put(result, i);
      return;
    }
    // The extreme ones in four directions that turn with the body, so that the choice is the same in every step.
    btVector3 side, other;
    btPlaneSpace1(pose_.getBasis().transpose() * normal_, side, other);
    side = pose_.getBasis() * side;
    other = pose_.getBasis() * other;
    unsigned long long taken = 0;
    for (const btVector3& direction : {side + other, -side - other, side - other, other - side}) {
      int best = 0;
      double best_score = -SIMD_INFINITY;
      for (int i = 0; i < count_; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const double score = direction.dot(points_[k]) - kDepthPreference * distances_[k];
        if (score > best_score + 1e-9) {
          best = i;
          best_score = score;
        }
      }
      if (!(taken & (1ULL << best))) put(result, best);
      taken |= 1ULL << best;
    }
  }

 private:
  void put(btManifoldResult& result, int i) const {
    const auto k = static_cast<std::size_t>(i);
    result.addContactPoint(normal_, points_[k] - normal_ * distances_[k], distances_[k]);
  }

  const btTransform& pose_;
  btVector3 normal_;
  double constant_, reach_;
  std::array<btVector3, 64> points_;
  std::array<double, 64> distances_{};
  int count_ = 0;
};

// A disc: fixed points of its rim where it lies flat, its lowest point where it stands on edge.
void add_rim(Corners& corners, const btTransform& pose, const btVector3& centre, int axis, double radius,
             const btVector3& local_normal) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const double down_u = -local_normal[u], down_v = -local_normal[v], sine = std::hypot(down_u, down_v);
  btVector3 point = centre;
  if (sine > kFlatSine) {
    point[u] = centre[u] + radius * down_u / sine;
    point[v] = centre[v] + radius * down_v / sine;
    corners.add_world(pose * point);
    if (sine > 20.0 * kFlatSine) return;
  }
  for (int i = 0; i < 4; ++i) {
    point = centre;
    (i % 2 ? point[v] : point[u]) += i < 2 ? radius : -radius;
    corners.add_world(pose * point);
  }
}

void add_corners(Corners& corners, const btConvexShape& shape, const btTransform& pose, const btVector3& normal) {
  const btVector3 local_normal = pose.getBasis().transpose() * normal;
  switch (shape.getShapeType()) {
    case SPHERE_SHAPE_PROXYTYPE:
      corners.add_world(pose.getOrigin() - normal * static_cast<const btSphereShape&>(shape).getRadius());
      return;
    case CAPSULE_SHAPE_PROXYTYPE: {
      const auto& capsule = static_cast<const btCapsuleShape&>(shape);
      btVector3 end(0, 0, 0);
      end[capsule.getUpAxis()] = capsule.getHalfHeight();
      corners.add_world(pose * end - normal * capsule.getRadius());
      corners.add_world(pose * -end - normal * capsule.getRadius());
      return;
    }
    case BOX_SHAPE_PROXYTYPE: {
      const btVector3 half = static_cast<const btBoxShape&>(shape).getHalfExtentsWithMargin();
      for (int i = 0; i < 8; ++i)
        corners.add_local({i & 1 ? half.x() : -half.x(), i & 2 ? half.y() : -half.y(), i & 4 ? half.z() : -half.z()});
      return;
    }
    case CYLINDER_SHAPE_PROXYTYPE: {
      const auto& cylinder = static_cast<const btCylinderShape&>(shape);
      const int axis = cylinder.getUpAxis();
      for (const double side : {1.0, -1.0}) {
        btVector3 centre(0, 0, 0);
        centre[axis] = side * cylinder.getHalfExtentsWithMargin()[axis];
        add_rim(corners, pose, centre, axis, cylinder.getRadius(), local_normal);
      }
      return;
    }
    case CONE_SHAPE_PROXYTYPE: {
      const auto& cone = static_cast<const btConeShape&>(shape);
      const int axis = cone.getConeUpIndex();
      btVector3 tip(0, 0, 0);
      tip[axis] = 0.5 * cone.getHeight();
      corners.add_local(tip);
      add_rim(corners, pose, -tip, axis, cone.getRadius(), local_normal);
      return;
    }
    case CONVEX_HULL_SHAPE_PROXYTYPE: {
      const auto& hull = static_cast<const btConvexHullShape&>(shape);
      const btVector3 sunk = normal * hull.getMargin();
      for (int i = 0; i < hull.getNumPoints(); ++i) corners.add_world(pose * hull.getScaledPoint(i) - sunk);
      return;
    }
    default: corners.add_local(shape.localGetSupportingVertex(-local_normal)); return;
  }
}

}  // namespace

PlaneContactAlgorithm::PlaneContactAlgorithm(const btCollisionAlgorithmConstructionInfo& info,
                                             const btCollisionObjectWrapper& convex,
                                             const btCollisionObjectWrapper& plane, bool swapped)
    : btCollisionAlgorithm(info), manifold_(info.m_manifold), swapped_(swapped) {
  const btCollisionObject *a = convex.getCollisionObject(), *b = plane.getCollisionObject();
  if (!manifold_ && m_dispatcher->needsCollision(a, b)) {
    manifold_ = m_dispatcher->getNewManifold(a, b);
    owned_ = true;
  }
}

PlaneContactAlgorithm::~PlaneContactAlgorithm() {
  if (owned_) m_dispatcher->releaseManifold(manifold_);
}

void PlaneContactAlgorithm::processCollision(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b,
                                             const btDispatcherInfo&, btManifoldResult* result) {
  if (!manifold_) return;
  const btCollisionObjectWrapper &convex = swapped_ ? *b : *a, &plane = swapped_ ? *a : *b;
  const auto& half_space = static_cast<const btStaticPlaneShape&>(*plane.getCollisionShape());
  const btVector3 normal = plane.getWorldTransform().getBasis() * half_space.getPlaneNormal();
  const double constant = half_space.getPlaneConstant() + normal.dot(plane.getWorldTransform().getOrigin());
  result->setPersistentManifold(manifold_);
  Corners corners(convex.getWorldTransform(), normal, constant,
                  manifold_->getContactBreakingThreshold() + result->m_closestPointDistanceThreshold);
  add_corners(corners, static_cast<const btConvexShape&>(*convex.getCollisionShape()), convex.getWorldTransform(),
              normal);
  corners.report(*result);
  if (owned_ && manifold_->getNumContacts() > 0) result->refreshContactPoints();
}

PlaneContactRegistration::PlaneContactRegistration(btCollisionDispatcher& dispatcher) {
  swapped_.m_swapped = true;
  for (int type = 0; type < CONCAVE_SHAPES_START_HERE; ++type) {
    if (!btBroadphaseProxy::isConvex(type)) continue;
    dispatcher.registerCollisionCreateFunc(type, STATIC_PLANE_PROXYTYPE, &straight_);
    dispatcher.registerCollisionCreateFunc(STATIC_PLANE_PROXYTYPE, type, &swapped_);
  }
}

}  // namespace ambf::physics::detail
