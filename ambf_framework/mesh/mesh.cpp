#include "mesh/mesh.h"

#include <algorithm>

namespace ambf::mesh {

namespace {
void grow(BoundingBox& box, const math::Vec3& p, bool first) {
  if (first) {
    box.min = box.max = p;
    return;
  }
  box.min = {std::min(box.min.x, p.x), std::min(box.min.y, p.y), std::min(box.min.z, p.z)};
  box.max = {std::max(box.max.x, p.x), std::max(box.max.y, p.y), std::max(box.max.z, p.z)};
}
}  // namespace

std::size_t Mesh::vertex_count() const {
  std::size_t n = 0;
  for (const Submesh& s : submeshes) n += s.vertex_count();
  return n;
}

std::size_t Mesh::triangle_count() const {
  std::size_t n = 0;
  for (const Submesh& s : submeshes) n += s.triangle_count();
  return n;
}

BoundingBox bounds_of(const std::vector<Submesh>& submeshes) {
  BoundingBox box;
  bool first = true;
  for (const Submesh& s : submeshes) {
    for (std::size_t i = 0; i < s.vertex_count(); ++i) {
      grow(box, s.vertex(i), first);
      first = false;
    }
  }
  return box;
}

BoundingBox bounds_of(const std::vector<math::Vec3>& points) {
  BoundingBox box;
  for (std::size_t i = 0; i < points.size(); ++i) grow(box, points[i], i == 0);
  return box;
}

}  // namespace ambf::mesh
