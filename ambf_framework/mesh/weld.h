// Welding: which vertices are the same point (dissertation Alg. 7, Alg. 8, Table 5.1, with its errata mended: the cell
// size comes from the tolerance, so distinct vertices never merge and flat meshes work). Linear in the number of
// vertices. Pure functions; any thread but the physics thread.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh.h"

namespace ambf::mesh {

constexpr double kWeldEpsilonRelative = 1e-6;  // of the bounding box diagonal

// For vertex i: first[i] is the lowest original vertex within epsilon (i itself when none), welded[i] its number among
// the distinct ones. Only distinct vertices are compared against, so chains of near vertices do not creep together.
struct Weld {
  std::vector<std::uint32_t> first;
  std::vector<std::uint32_t> welded;
  std::vector<std::uint32_t> distinct;  // distinct[welded[i]] == first[i]
};

// `epsilon` in metres (>= 0; 0 joins only equal positions).
Weld weld(const std::vector<math::Vec3>& vertices, double epsilon);

// One welded mesh of all submeshes, in file order. Vertex numbers run over the submeshes one after another, so
// `out_weld` (may be null) maps drawn vertices to collision vertices. Degenerate triangles and duplicate lines are
// dropped.
CollisionMesh make_collision_mesh(const Mesh& mesh, double epsilon_relative = kWeldEpsilonRelative,
                                  Weld* out_weld = nullptr);

}  // namespace ambf::mesh
