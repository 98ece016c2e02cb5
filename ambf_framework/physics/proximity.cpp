#include "physics/proximity.h"

#include <BulletCollision/CollisionShapes/btConcaveShape.h>
#include <BulletCollision/CollisionShapes/btTriangleShape.h>
#include <BulletCollision/NarrowPhaseCollision/btConvexPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include "physics/detail/body_data.h"
#include "physics/detail/shape_data.h"

namespace ambf::physics {

namespace {

using detail::BodyData;
using detail::from_bullet;

struct Box {
  btVector3 low, high;  // world

  bool meets(const Box& other) const { return TestAabbAgainstAabb2(low, high, other.low, other.high); }
};

Box box_of(const btCollisionShape& shape, const btTransform& pose, double margin) {
  Box box;
  shape.getAabb(pose, box.low, box.high);
  const btVector3 more(margin, margin, margin);
  box.low -= more;
  box.high += more;
  return box;
}

// A convex part of a body, or a half-space.
struct Part {
  const btConvexShape* convex = nullptr;
  const btStaticPlaneShape* plane = nullptr;
  btTransform pose;
};

// Hands on each triangle as a convex part, until `visit` returns false.
template <class Visit>
struct Triangles final : btTriangleCallback {
  Triangles(const btTransform& at, double surface_margin, Visit& each)
      : pose(at), margin(surface_margin), visit(each) {}
  void processTriangle(btVector3* corners, int, int) override {
    if (!more) return;
    btTriangleShape triangle(corners[0], corners[1], corners[2]);
    triangle.setMargin(margin);
    more = visit(Part{&triangle, nullptr, pose});
  }
  const btTransform& pose;
  const double margin;
  Visit& visit;
  bool more = true;
};

// Calls visit(Part) for the parts of a shape whose boxes meet `near`, until it returns false; returns whether it never
// did.
template <class Visit>
bool each_part(const btCollisionShape& shape, const btTransform& pose, const Box& near, Visit& visit) {
  if (shape.getShapeType() == STATIC_PLANE_PROXYTYPE)
    return visit(Part{nullptr, &static_cast<const btStaticPlaneShape&>(shape), pose});
  if (shape.isCompound()) {
    const auto& compound = static_cast<const btCompoundShape&>(shape);
    for (int i = 0; i < compound.getNumChildShapes(); ++i)
      if (!each_part(*compound.getChildShape(i), pose * compound.getChildTransform(i), near, visit)) return false;
    return true;
  }
  if (shape.isConvex()) {
    if (!box_of(shape, pose, 0.0).meets(near)) return true;
    return visit(Part{&static_cast<const btConvexShape&>(shape), nullptr, pose});
  }
  if (!shape.isConcave()) return true;
  const btTransform T_shape_world = pose.inverse();
  btVector3 low, high;
  btTransformAabb(0.5 * (near.high - near.low), shape.getMargin(),
                  btTransform(T_shape_world.getBasis(), T_shape_world * (0.5 * (near.low + near.high))), low, high);
  Triangles<Visit> triangles(pose, shape.getMargin(), visit);
  static_cast<const btConcaveShape&>(shape).processAllTriangles(&triangles, low, high);
  return triangles.more;
}

// The lowest point of a convex part above a half-space; b is the half-space.
Proximity above_plane(const Part& a, const Part& b) {
  const btVector3 normal = b.pose.getBasis() * b.plane->getPlaneNormal();
  const btVector3 lowest = a.pose * a.convex->localGetSupportingVertex(a.pose.getBasis().transpose() * -normal);
  const double distance = normal.dot(lowest - b.pose.getOrigin()) - b.plane->getPlaneConstant();
  return {from_bullet(lowest), from_bullet(lowest - normal * distance), from_bullet(normal), distance};
}

Proximity swapped(const Proximity& found) {
  return {found.point_on_b, found.point_on_a, -found.normal_on_b, found.distance};
}

std::optional<Proximity> between(const Part& a, const Part& b, double max_distance) {
  if (a.plane != nullptr || b.plane != nullptr) {
    if (a.plane != nullptr && b.plane != nullptr) return std::nullopt;
    const Proximity found = a.plane != nullptr ? swapped(above_plane(b, a)) : above_plane(a, b);
    return found.distance <= max_distance ? std::optional(found) : std::nullopt;
  }
  btVoronoiSimplexSolver simplex;
  btGjkEpaPenetrationDepthSolver depths;
  btGjkPairDetector detector(a.convex, b.convex, &simplex, &depths);
  btGjkPairDetector::ClosestPointInput input;
  input.m_transformA = a.pose;
  input.m_transformB = b.pose;
  const double reach = max_distance + a.convex->getMargin() + b.convex->getMargin();
  input.m_maximumDistanceSquared = reach * reach;
  btPointCollector nearest;
  detector.getClosestPoints(input, nearest, nullptr);
  if (!nearest.m_hasResult || nearest.m_distance > max_distance) return std::nullopt;
  const btVector3 &on_b = nearest.m_pointInWorld, &normal = nearest.m_normalOnBInWorld;
  return Proximity{from_bullet(on_b + normal * nearest.m_distance), from_bullet(on_b), from_bullet(normal),
                   nearest.m_distance};
}

// Notes that cores (shapes without their margins) overlap, and computes no depth: that takes ten times as long.
struct CoresOverlap final : btConvexPenetrationDepthSolver {
  bool calcPenDepth(btSimplexSolverInterface&, const btConvexShape*, const btConvexShape*, const btTransform&,
                    const btTransform&, btVector3&, btVector3&, btVector3&, btIDebugDraw*) override {
    found = true;
    return false;
  }
  bool found = false;
};

bool overlap(const Part& a, const Part& b) {
  if (a.plane != nullptr || b.plane != nullptr) {
    const auto found = between(a, b, 0.0);
    return found && found->distance < 0.0;
  }
  btVoronoiSimplexSolver simplex;
  CoresOverlap cores;
  btGjkPairDetector detector(a.convex, b.convex, &simplex, &cores);
  btGjkPairDetector::ClosestPointInput input;
  input.m_transformA = a.pose;
  input.m_transformB = b.pose;
  const double reach = a.convex->getMargin() + b.convex->getMargin();
  input.m_maximumDistanceSquared = reach * reach;
  btPointCollector nearest;
  detector.getClosestPoints(input, nearest, nullptr);
  return cores.found || (nearest.m_hasResult && nearest.m_distance < 0.0);
}

// Calls visit(Part of a, Part of b) for parts that may be within `max_distance` of each other, until it returns false.
template <class Visit>
void each_near_pair(const Body& body_a, const Body& body_b, double max_distance, Visit visit) {
  const BodyData &a = body_a.data(), &b = body_b.data();
  if (!within_reach(body_a, body_b, max_distance)) return;
  const btTransform &pose_a = a.rigid.getWorldTransform(), &pose_b = b.rigid.getWorldTransform();
  const btCollisionShape &shape_a = *a.shape->data().shape, &shape_b = *b.shape->data().shape;
  const Box near_b = box_of(shape_b, pose_b, max_distance);
  if (!near_b.meets(box_of(shape_a, pose_a, 0.0))) return;
  const auto with_part = [&](const Part& part_a) {
    const auto with_both = [&](const Part& part_b) { return visit(part_a, part_b); };
    if (part_a.plane != nullptr) return each_part(shape_b, pose_b, near_b, with_both);
    return each_part(shape_b, pose_b, box_of(*part_a.convex, part_a.pose, max_distance), with_both);
  };
  each_part(shape_a, pose_a, near_b, with_part);
}

}  // namespace

bool within_reach(const Body& body_a, const Body& body_b, double max_distance) {
  const BodyData &a = body_a.data(), &b = body_b.data();
  if (a.shape->empty() || b.shape->empty()) return false;
  if (a.shape->infinite() || b.shape->infinite()) return true;
  const double reach = a.reach + b.reach + max_distance;
  return (a.rigid.getWorldTransform().getOrigin() - b.rigid.getWorldTransform().getOrigin()).length2() <= reach * reach;
}

std::optional<Proximity> proximity(const Body& a, const Body& b, double max_distance) {
  std::optional<Proximity> nearest;
  each_near_pair(a, b, max_distance, [&](const Part& part_a, const Part& part_b) {
    const auto found = between(part_a, part_b, nearest ? std::min(nearest->distance, max_distance) : max_distance);
    if (found && (!nearest || found->distance < nearest->distance)) nearest = found;
    return true;
  });
  return nearest;
}

bool overlap(const Body& a, const Body& b) {
  bool overlaps = false;
  each_near_pair(a, b, 0.0, [&](const Part& part_a, const Part& part_b) {
    overlaps = overlap(part_a, part_b);
    return !overlaps;
  });
  return overlaps;
}

bool groups_meet(const Body& a, const Body& b) { return detail::groups_meet(a.data(), b.data()); }
bool may_meet(const Body& a, const Body& b) { return detail::may_meet(a.data(), b.data()); }

}  // namespace ambf::physics
