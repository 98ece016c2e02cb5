// Smooth vertex normals for triangles that come without: weighted by area and angle at the vertex, so that the slivers
// of CAD exports do not disturb them; edges sharper than the crease angle stay hard. Pure functions; any thread but the
// physics thread.
#pragma once

#include <cstdint>
#include <vector>

namespace ambf::mesh {

constexpr std::uint32_t kSmoothByAngle = 0xFFFFFFFFU;

// Input of compute_corner_normals: triangles over shared positions.
struct NormalInput {
  const std::vector<float>* positions = nullptr;          // xyz
  const std::vector<std::uint32_t>* triangles = nullptr;  // three position indices each, all valid
  const std::vector<std::uint32_t>* smoothing =
      nullptr;  // per triangle: group bits, 0 flat, or kSmoothByAngle; or null
  double crease_angle_rad = 0.7;
};

// One unit normal (xyz) per triangle corner. Triangles that share a vertex are smoothed together when they share a
// group bit, or, where both say kSmoothByAngle, when their normals differ by less than the crease angle.
std::vector<float> compute_corner_normals(const NormalInput& input);

}  // namespace ambf::mesh
