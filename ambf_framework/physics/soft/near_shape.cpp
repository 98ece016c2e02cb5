#include "physics/soft/detail/near_shape.h"

#include <algorithm>

#include "physics/meshes/surface_distance.h"

namespace ambf::physics::detail {

namespace {

// Behind a triangle of a mesh a node is pushed out up to this depth (m): deeper, another side may be nearer.
constexpr double kMaxMeshDepth = 0.005;

}  // namespace

bool Box::overlaps(const btVector3& other_low, const btVector3& other_high) const {
  for (int i = 0; i < 3; ++i)
    if (!(other_low[i] <= high[i] && other_high[i] >= low[i])) return false;
  return true;
}

Box box_of(const btCollisionShape& shape, const btTransform& pose, double margin) {
  Box box;
  shape.getAabb(pose, box.low, box.high);
  box.low -= btVector3(margin, margin, margin);
  box.high += btVector3(margin, margin, margin);
  return box;
}

bool groups_meet(const std::vector<int>& a, const std::vector<int>& b) {
  if (a.empty() || b.empty()) return true;
  return std::any_of(a.begin(), a.end(), [&](int group) { return std::find(b.begin(), b.end(), group) != b.end(); });
}

MetShape::MetShape(const btCollisionShape& of)
    : shape(of),
      is_mesh(of.isConcave() && of.getShapeType() != STATIC_PLANE_PROXYTYPE),
      can_be_met(is_mesh || of.isConvex() || of.getShapeType() == STATIC_PLANE_PROXYTYPE) {}

std::optional<PointDistance> MetShape::near_mesh(const btVector3& point, double margin) const {
  const double own = shape.getMargin();
  const auto surface = distance_to_surface(shape, point, margin + own + kMaxMeshDepth);
  if (!surface.near || surface.distance < -kMaxMeshDepth || !(surface.distance - own < margin)) return std::nullopt;
  return PointDistance{surface.distance - own, surface.normal};
}

}  // namespace ambf::physics::detail
