// The faces of a grid of tissue that can be cut: its surface divided along the elements, and the faces between them.
// Off the physics thread. Private to physics/soft/.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "physics/tissue_grid.h"

namespace ambf::physics::detail {

using Tetrahedron = std::array<math::Vec3, 4>;

// Points (first the surface's vertices, in their order), faces and seams. `left_out` are the parts of the lattice that
// became no elements: what of the surface lies in them moves with the element that `embed` finds.
void add_cut_faces(TissueGrid& grid, const TissueSurface& surface, const std::vector<Tetrahedron>& left_out,
                   const std::function<TissuePoint(const math::Vec3&)>& embed);

}  // namespace ambf::physics::detail
