// Private to mesh/: hulls of clouds without volume, and the error of a reduced hull.
#pragma once

#include "mesh/hull.h"

namespace ambf::mesh {

// The outline of a cloud that lies in a plane, on a line or in a point, with at most `limit` points.
ReducedHull reduce_flat_hull(const std::vector<math::Vec3>& points, std::size_t limit, double tolerance);

// Distance (m) of the farthest of `points` outside a hull with triangles.
double hull_deviation(const ReducedHull& hull, const std::vector<math::Vec3>& points);

}  // namespace ambf::mesh
