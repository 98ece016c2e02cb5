#include "physics/meshes/surface_distance.h"

#include "physics/meshes/detail/attached_surface.h"
#include "physics/meshes/detail/surface_probe.h"

namespace ambf::physics::detail {

SurfaceDistance distance_to_surface(const btCollisionShape& shape, const btVector3& point, double range) {
  const FeatureMesh* mesh = attached_surface(shape);
  if (mesh == nullptr) return {};
  const Probed found = MeshProbe(*mesh, 0.0).probe(point, {0, 0, 0}, 0.0, range);
  // Without a triangle in range the answer has no normal.
  return {!found.normal.isZero(), found.distance, found.normal};
}

}  // namespace ambf::physics::detail
