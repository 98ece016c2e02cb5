// A sheet to make soft bodies of.
#pragma once

#include "physics/soft_body.h"

namespace ambf::physics::testing {

// n x n nodes, `size` wide, in the plane z = 0.
inline SoftDefinition sheet(std::uint32_t n, double size) {
  SoftDefinition made;
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) made.nodes.push_back({size * i / (n - 1.0), size * j / (n - 1.0), 0.0});
  for (std::uint32_t j = 0; j + 1 < n; ++j)
    for (std::uint32_t i = 0; i + 1 < n; ++i) {
      const std::uint32_t a = j * n + i;
      made.triangles.push_back({a, a + 1, a + n});
      made.triangles.push_back({a + 1, a + n + 1, a + n});
    }
  return made;
}

}  // namespace ambf::physics::testing
