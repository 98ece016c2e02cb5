#include "mesh/weld.h"

#include <algorithm>
#include <unordered_set>

#include "mesh/detail/weld_points.h"

namespace ambf::mesh {

Weld weld(const std::vector<math::Vec3>& vertices, double epsilon) {
  return weld_points(
      vertices.size(), [&vertices](std::size_t i) { return vertices[i]; }, epsilon);
}

CollisionMesh make_collision_mesh(const Mesh& mesh, double epsilon_relative, Weld* out_weld) {
  std::vector<math::Vec3> all;
  all.reserve(mesh.vertex_count());
  for (const Submesh& s : mesh.submeshes) {
    for (std::size_t i = 0; i < s.vertex_count(); ++i) all.push_back(s.vertex(i));
  }
  Weld joined = weld(all, epsilon_relative * bounds_of(all).diagonal());

  CollisionMesh out;
  out.vertices.reserve(joined.distinct.size());
  for (std::uint32_t original : joined.distinct) out.vertices.push_back(all[original]);
  out.bounds = bounds_of(out.vertices);

  std::unordered_set<std::uint64_t> seen_lines;
  std::uint32_t base = 0;
  out.triangles.reserve(mesh.triangle_count());
  for (const Submesh& s : mesh.submeshes) {
    for (std::size_t t = 0; t + 2 < s.triangles.size(); t += 3) {
      const std::uint32_t a = joined.welded[base + s.triangles[t]], b = joined.welded[base + s.triangles[t + 1]],
                          c = joined.welded[base + s.triangles[t + 2]];
      if (a != b && b != c && a != c) out.triangles.push_back({a, b, c});
    }
    for (const auto& line : s.lines) {
      const std::uint32_t a = joined.welded[base + line[0]], b = joined.welded[base + line[1]];
      const std::uint64_t key = std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
      if (a != b && seen_lines.insert(key).second) out.lines.push_back({a, b});
    }
    base += static_cast<std::uint32_t>(s.vertex_count());
  }
  if (out_weld != nullptr) *out_weld = std::move(joined);
  return out;
}

}  // namespace ambf::mesh
