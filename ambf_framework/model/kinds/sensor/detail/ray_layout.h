// From a sensor's description to its rays. Loader thread.
#pragma once

#include <vector>

#include "mesh/mesh.h"
#include "scene/sensor.h"
#include "state/sensors.h"

namespace ambf::model {

// Of `array` (or the older single ray) and of `parametric`; in the sensor's frame.
std::vector<state::SensorRay> listed_rays(const scene::Sensor& sensor);
// On each triangle, from `depth_m` below its centroid along its normal, range_m long (EQUATIONS 17, Alg. 12); likewise
// on the middle of each edge, along the mean normal of its triangles, and on each vertex, where they count by their
// angle. Triangles without area give none, nor do places whose normals cancel out. Faces come first, then edges, then
// vertices.
std::vector<state::SensorRay> rays_on(const mesh::CollisionMesh& mesh, const scene::Sensor& sensor);

}  // namespace ambf::model
