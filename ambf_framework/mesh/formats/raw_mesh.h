// Private to mesh/: a mesh as files hold it: polygons over shared positions, with separate indices for normals and
// texture coordinates. The readers fill it; build_mesh() makes the drawable Mesh of it.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/detail/normals.h"
#include "mesh/mesh.h"

namespace ambf::mesh {

class ReadContext;

constexpr std::uint32_t kNoIndex = 0xFFFFFFFFU;

struct RawCorner {
  std::uint32_t position = 0;
  std::uint32_t texcoord = kNoIndex;
  std::uint32_t normal = kNoIndex;
};

struct RawFace {
  std::uint32_t first = 0;  // into RawMesh::corners
  std::uint32_t count = 0;  // >= 3; convex or not
  std::int32_t material = -1;
  std::uint32_t smoothing = kSmoothByAngle;  // see normals.h
};

struct RawLine {
  std::uint32_t a = 0, b = 0;  // positions
  std::int32_t material = -1;
};

struct RawMesh {
  std::vector<float> positions;  // xyz
  std::vector<float> texcoords;  // uv
  std::vector<float> normals;    // xyz, any length
  std::vector<RawCorner> corners;
  std::vector<RawFace> faces;
  std::vector<RawLine> lines;
  std::vector<Material> materials;
  Pictures pictures;

  std::size_t position_count() const { return positions.size() / 3; }
};

// Triangulates, drops degenerate triangles, computes missing normals and tangents, splits by material, joins equal
// vertices. False after context.fail() when nothing drawable is left or a limit is hit. Consumes `raw`.
bool build_mesh(RawMesh&& raw, ReadContext& context, Mesh& out);

// Corner numbers (0-based within the polygon) of the triangles of one planar polygon with n >= 3 corners at `points`:
// ear clipping, so that concave ones come out right; a fan for very large ones and for those that cross themselves.
void triangulate(const std::vector<math::Vec3>& points, std::vector<std::uint32_t>& out_triangles);

}  // namespace ambf::mesh
