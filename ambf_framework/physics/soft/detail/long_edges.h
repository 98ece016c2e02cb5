// Finer surfaces for tissue. Off the physics thread. Private to physics/soft/.
#pragma once

#include "physics/tissue_grid.h"

namespace ambf::physics::detail {

// Divides long edges in their middle, on both of their sides, until there are none.
void divide_long_edges(TissueSurface& surface, double longest);

}  // namespace ambf::physics::detail
