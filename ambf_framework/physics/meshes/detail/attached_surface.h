// The surface that a shape of Bullet's is met by: its user pointer, which only this room sets. Private to
// physics/meshes/.
#pragma once

#include "physics/meshes/detail/feature_mesh.h"

namespace ambf::physics::detail {

// Null for shapes without one: all but meshes and boxes.
inline const FeatureMesh* attached_surface(const btCollisionShape& shape) {
  return static_cast<const FeatureMesh*>(shape.getUserPointer());
}

}  // namespace ambf::physics::detail
