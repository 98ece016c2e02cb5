// Flat sheets of tissue for tests.
#pragma once

#include <cstdint>
#include <vector>

#include "physics/tissue.h"
#include "physics/tissue_grid.h"

namespace ambf::physics::testing {

enum class Mesh { diagonals, crossed };

// In the plane z = 0, from -x/2 to x/2 and likewise along y; `crossed`: diagonals turn from square to square.
inline TissueSurface rectangle(double x, double y, std::uint32_t nx, std::uint32_t ny, Mesh mesh = Mesh::diagonals) {
  TissueSurface made;
  for (std::uint32_t j = 0; j <= ny; ++j)
    for (std::uint32_t i = 0; i <= nx; ++i) made.vertices.push_back({x * i / nx - 0.5 * x, y * j / ny - 0.5 * y, 0.0});
  for (std::uint32_t j = 0; j < ny; ++j)
    for (std::uint32_t i = 0; i < nx; ++i) {
      const std::uint32_t a = j * (nx + 1) + i, b = a + 1, c = a + nx + 1, d = c + 1;
      if (mesh == Mesh::crossed && (i + j) % 2 == 1) {
        made.triangles.push_back({a, b, d});
        made.triangles.push_back({a, d, c});
      } else {
        made.triangles.push_back({a, b, c});
        made.triangles.push_back({b, d, c});
      }
    }
  return made;
}

inline TissueDefinition sheet_of(const TissueSurface& surface, double thickness, double young, double poisson = 0.45,
                                 std::size_t max_corners = 0) {
  TissueDefinition made;
  made.grid = make_sheet_grid(surface, thickness, 0.0, max_corners > 0);
  made.max_corners = max_corners;
  made.material.young = young;
  made.material.poisson = poisson;
  return made;
}

template <class Fits>
std::vector<std::uint32_t> those(const TissueDefinition& of, const Fits& fits) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < of.grid.corners.size(); ++i)
    if (fits(of.grid.corners[i])) found.push_back(i);
  return found;
}

}  // namespace ambf::physics::testing
