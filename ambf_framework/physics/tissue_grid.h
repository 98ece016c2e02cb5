// From a closed surface to the grid of tetrahedra that tissue is made of, and from any mesh to a sheet. Pure functions;
// off the physics thread. SI units, body frame.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "physics/tissue.h"

namespace ambf::physics {

struct TissueSurface {
  std::vector<math::Vec3> vertices;  // no two at one place
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

// Edges that are not shared by two triangles that run along it in opposite directions; 0: the surface is closed.
std::size_t open_edges(const TissueSurface& surface);
// m^3; below 0: its triangles are seen from within.
double volume_within(const TissueSurface& surface);
// An upper bound of how many a grid will have, before it is made.
double max_elements(const TissueSurface& surface, double element_size);

// Cubes of at most `element_size`, as many as fit the surface's bounding box, of five tetrahedra each. Those that have
// no part within are left out, and what is partly within counts by its share, so that the volume is the surface's. No
// elements: the surface is too thin for this size. Edges of the surface that are longer than `element_size` are
// divided. The same surface gives the same grid. Of what is to be cut, its surface is divided along all elements.
TissueGrid make_tissue_grid(const TissueSurface& surface, double element_size, bool to_be_cut = false);

// Edges at which more than two triangles meet: a sheet has none.
std::size_t crowded_edges(const TissueSurface& surface);
// A sheet of these triangles, of which edges longer than `longest` are divided (0: none); first its vertices, in their
// order. The element size is the mean length of edges. Of what is to be cut, further points lie on those: each corner
// of each triangle has its own.
TissueGrid make_sheet_grid(const TissueSurface& surface, double thickness, double longest = 0.0,
                           bool to_be_cut = false);

}  // namespace ambf::physics
