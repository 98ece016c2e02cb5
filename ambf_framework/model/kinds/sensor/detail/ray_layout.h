// From a sensor's description to its rays. Loader thread.
#pragma once

#include <array>
#include <vector>

#include "mesh/cache.h"
#include "mesh/mesh.h"
#include "model/detail/findings.h"
#include "scene/sensor.h"
#include "state/sensors.h"

namespace ambf::model {

// Twice a triangle's area, m^2: smaller ones give no ray.
inline constexpr double kMinRayArea = 1e-12;

// Of `array` (or the older single ray) and of `parametric`; in the sensor's frame.
std::vector<state::SensorRay> listed_rays(const scene::Sensor& sensor);
// On each triangle, from `depth_m` below its centroid along its normal, range_m long (EQUATIONS 17, Alg. 12); likewise
// on the middle of each edge, along the mean normal of its triangles, and on each vertex, where they count by their
// angle. Triangles without area give none, nor do places whose normals cancel out. Faces come first, then edges, then
// vertices.
std::vector<state::SensorRay> rays_on(const mesh::CollisionMesh& mesh, const scene::Sensor& sensor);

// The surface through what the rays sense, as triangles of them (state::SensorInfo::skin). Rays on the faces of a mesh
// are joined about each vertex within it, those of a fan as the fan's grid, all others by a triangulation of where they
// end, seen along their mean direction: none where they point to all sides, or are very many. `mesh`: that they are on,
// else null.
std::vector<std::array<std::uint32_t, 3>> skin_of(const std::vector<state::SensorRay>& rays,
                                                  const mesh::CollisionMesh* mesh, const scene::Sensor& sensor);

// The rays of a sensor that casts some, and `info.skin`; false when there are none: an error says why.
bool lay_rays(mesh::MeshCache& meshes, const scene::Sensor& described, const scene::Identity& at,
              std::vector<state::SensorRay>& rays, Findings& findings, state::SensorInfo& info);

}  // namespace ambf::model
