// The triangles and edges of a mesh as debug drawings show them: positions only, joined where they are equal. Pure
// function, any thread. Private to render/.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh.h"

namespace ambf::render {

struct DebugGeometry {
  std::vector<float> vertices;           // xyz each, m, mesh frame
  std::vector<std::uint32_t> triangles;  // three each
  std::vector<std::uint32_t>
      edges;              // two each; first those at borders and where the surface bends by more than kSharp_rad
  std::size_t sharp = 0;  // so many edges
};

inline constexpr double kSharp_rad = 0.4;

DebugGeometry debug_geometry(const mesh::Mesh& mesh);

}  // namespace ambf::render
