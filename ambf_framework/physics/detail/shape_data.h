// What a Shape is made of: one Bullet shape and whatever that refers to. Private to physics/.
#pragma once

#include <memory>
#include <vector>

#include "physics/detail/bullet.h"
#include "physics/meshes/feature_mesh.h"

namespace ambf::physics::detail {

// Members are destroyed in reverse order: the shape before its parts before the mesh data.
struct ShapeData {
  std::shared_ptr<const void> keeps_alive;  // mesh data the shape points into
  std::unique_ptr<btTriangleIndexVertexArray> triangles;
  std::vector<std::shared_ptr<const FeatureMesh>> features;  // of meshes and boxes, whose user pointers lead here
  std::vector<std::unique_ptr<btCollisionShape>> parts;      // children of a compound
  std::unique_ptr<btCollisionShape> shape;
  bool concave = false, infinite = false, empty = false;
};

inline void keep_features(ShapeData& data, btCollisionShape& shape, std::shared_ptr<const FeatureMesh> features) {
  shape.setUserPointer(const_cast<FeatureMesh*>(features.get()));
  data.features.push_back(std::move(features));
}
// Null for shapes that are neither meshes nor boxes.
inline const FeatureMesh* features_of(const btCollisionShape& shape) {
  return static_cast<const FeatureMesh*>(shape.getUserPointer());
}

}  // namespace ambf::physics::detail
