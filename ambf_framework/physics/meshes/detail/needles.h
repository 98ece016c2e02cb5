// Divides long thin triangles, such as CAD programs make of the sides of a shaft: searches look at vertices, and
// those have none where they touch. Off the physics thread. Private to physics/.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "physics/meshes/detail/feature_mesh.h"

namespace ambf::physics::detail {

struct DividedSurface {
  std::vector<math::Vec3> vertices;
  std::vector<std::array<int, 3>> triangles;
};

// The same surface in shorter triangles, where many long thin ones meet at convex edges; of very many some stay long.
// Null: there are too few to matter.
std::optional<DividedSurface> divide_needles(const FeatureMesh& mesh);

}  // namespace ambf::physics::detail
