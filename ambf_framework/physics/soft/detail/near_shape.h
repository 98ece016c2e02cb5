// Which shapes soft bodies are near, and how deep their points are in them. Private to physics/soft/. Physics thread.
#pragma once

#include <optional>
#include <vector>

#include "physics/soft/detail/node_contact.h"

namespace ambf::physics::detail {

struct Box {
  btVector3 low, high;  // world
  bool contains(const btVector3& p) const {
    return p.x() >= low.x() && p.x() <= high.x() && p.y() >= low.y() && p.y() <= high.y() && p.z() >= low.z() &&
           p.z() <= high.z();
  }
  bool overlaps(const btVector3& other_low, const btVector3& other_high) const;
};

// Around a shape at `pose`, by `margin` larger on all sides.
Box box_of(const btCollisionShape& shape, const btTransform& pose, double margin);

// Whether collision groups let two bodies meet; none are all.
bool groups_meet(const std::vector<int>& a, const std::vector<int>& b);

// A shape that is no compound: what points can be near.
struct MetShape {
  explicit MetShape(const btCollisionShape& of);
  const btCollisionShape& shape;
  bool is_mesh;
  bool can_be_met;  // false: an empty shape
  // Of a point in the shape's frame; none: it is `margin` away or farther. Behind a mesh it is found down to 5 mm.
  std::optional<PointDistance> near(const btVector3& point, double margin) const {
    if (is_mesh) return near_mesh(point, margin);
    const PointDistance found = distance_from(shape, point, margin);
    if (found.distance < margin) return found;
    return std::nullopt;
  }

 private:
  std::optional<PointDistance> near_mesh(const btVector3& point, double margin) const;
};

}  // namespace ambf::physics::detail
