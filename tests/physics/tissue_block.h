// Blocks of tissue for tests.
#pragma once

#include <cstdint>

#include "physics/tissue.h"
#include "physics/tissue_grid.h"

namespace ambf::physics::testing {

inline TissueSurface block(const math::Vec3& size, const math::Vec3& low = {}) {
  TissueSurface made;
  for (std::uint32_t k = 0; k < 8; ++k)
    made.vertices.push_back(low + math::Vec3{k & 1U ? size.x : 0.0, k & 2U ? size.y : 0.0, k & 4U ? size.z : 0.0});
  made.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return made;
}

inline TissueDefinition tissue_of(const TissueSurface& surface, double element_size, double young,
                                  double poisson = 0.45, std::size_t max_corners = 0) {
  TissueDefinition made;
  made.grid = make_tissue_grid(surface, element_size, max_corners > 0);
  made.max_corners = max_corners;
  made.material.young = young;
  made.material.poisson = poisson;
  return made;
}

}  // namespace ambf::physics::testing
