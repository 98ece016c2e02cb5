// What a Shape is made of: one Bullet shape and whatever that refers to. Private to physics/.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "physics/detail/bullet.h"
#include "physics/meshes/mesh_contacts.h"

namespace ambf::physics {
class Shape;
}

namespace ambf::physics::detail {

// Members are destroyed in reverse order: the shape before its parts before the mesh data.
struct ShapeData {
  std::shared_ptr<const void> keeps_alive;  // mesh data the shape points into
  std::unique_ptr<btTriangleIndexVertexArray> triangles;
  std::vector<SharedSurface> surfaces;                   // attached to meshes and boxes
  std::vector<std::unique_ptr<btCollisionShape>> parts;  // children of a compound
  std::vector<std::shared_ptr<const Shape>> hulls;       // further children, each perhaps also of other compounds
  std::unique_ptr<btCollisionShape> shape;
  std::vector<btVector4> hull_faces;  // of a hull: unit normal, outward, and its distance from the origin; flat: none
  std::vector<std::array<btVector3, 2>> hull_edges;  // of a hull that is not flat
  bool concave = false, infinite = false, empty = false;
};

inline void keep_surface(ShapeData& data, btCollisionShape& shape, SharedSurface surface) {
  attach_surface(shape, *surface);
  data.surfaces.push_back(std::move(surface));
}

}  // namespace ambf::physics::detail
