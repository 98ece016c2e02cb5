// Convex hull of a point cloud with at most so many points: a collision query on a hull is linear in its points, so
// meshes of thousands are reduced. Deterministic. Pure function; any thread but the physics thread.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "math/types.h"

namespace ambf::mesh {

struct HullOptions {
  int max_points = 64;  // >= 4
  double tolerance_relative =
      1e-4;  // of the bounding box diagonal: stop earlier once no point is farther out than this
};

struct ReducedHull {
  std::vector<math::Vec3> points;                       // a subset of the input; empty only for empty input
  std::vector<std::array<std::uint32_t, 3>> triangles;  // of `points`, outward; empty when the input is flat or a line
  double max_deviation = 0.0;                           // m: how far the farthest input point lies outside the hull
};

// Greedy: of all points outside the hull so far, the farthest one is added next.
ReducedHull reduce_hull(const std::vector<math::Vec3>& points, const HullOptions& options = {});

}  // namespace ambf::mesh
