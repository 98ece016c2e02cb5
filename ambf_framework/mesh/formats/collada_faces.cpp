#include "mesh/formats/detail/collada_faces.h"

#include <algorithm>
#include <utility>

#include "mesh/formats/read_context.h"

namespace ambf::mesh {

bool ColladaFaces::add(std::string_view kind, const std::vector<RawCorner>& c, const std::vector<std::uint32_t>& vcount,
                       std::int32_t material, bool mirrored, int line) {
  const std::size_t n = c.size();
  if (kind == "lines" || kind == "linestrips") {
    for (std::size_t i = 1; i < n; i += kind == "lines" ? 2 : 1) {
      if (c[i - 1].position != c[i].position) out_.lines.push_back({c[i - 1].position, c[i].position, material});
    }
    return context_.allow_vertices(2 * out_.lines.size());
  }
  if (kind == "polygons") return n < 3 || add_face(c.data(), n, material, mirrored);
  if (kind == "polylist") {
    std::size_t at = 0;
    for (std::uint32_t count : vcount) {
      if (count > n - at)
        return context_.fail("a polylist has fewer corners than its vcount says", "export the mesh again", line);
      if (count >= 3 && !add_face(c.data() + at, count, material, mirrored)) return false;
      at += count;
    }
    return true;
  }
  for (std::size_t i = 2; i < n; i += kind == "triangles" ? 3 : 1) {
    RawCorner triangle[3] = {c[i - 2], c[i - 1], c[i]};
    if (kind == "trifans") triangle[0] = c[0];
    if (kind == "tristrips" && i % 2 == 1) std::swap(triangle[0], triangle[1]);
    if (!add_face(triangle, 3, material, mirrored)) return false;
  }
  return true;
}

bool ColladaFaces::add_face(const RawCorner* corners, std::size_t count, std::int32_t material, bool mirrored) {
  triangles_ += count - 2;
  if (!context_.allow_triangles(triangles_)) return false;
  RawFace face;
  face.first = static_cast<std::uint32_t>(out_.corners.size());
  face.count = static_cast<std::uint32_t>(count);
  face.material = material;
  out_.corners.insert(out_.corners.end(), corners, corners + count);
  if (mirrored) std::reverse(out_.corners.end() - static_cast<std::ptrdiff_t>(count), out_.corners.end());
  out_.faces.push_back(face);
  return true;
}

}  // namespace ambf::mesh
