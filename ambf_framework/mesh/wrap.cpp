#include "mesh/wrap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "math/rotation.h"

namespace ambf::mesh {

namespace {

constexpr double kMinNormal = 1e-6;  // of a sum of unit normals
constexpr double kEdge = 1e-9;       // a ray that meets an edge meets both triangles, not neither

std::vector<math::Vec3> vertex_normals(const CollisionMesh& mesh) {
  std::vector<math::Vec3> sums(mesh.vertices.size());
  for (const auto& triangle : mesh.triangles) {
    const math::Vec3* v[3];
    for (std::size_t i = 0; i < 3; ++i) v[i] = &mesh.vertices[triangle[i]];
    const math::Vec3 normal = math::normalized(math::cross(*v[1] - *v[0], *v[2] - *v[1]));
    for (std::size_t i = 0; i < 3; ++i) {
      const math::Vec3 a = math::normalized(*v[(i + 1) % 3] - *v[i]), b = math::normalized(*v[(i + 2) % 3] - *v[i]);
      sums[triangle[i]] += normal * std::acos(std::clamp(math::dot(a, b), -1.0, 1.0));
    }
  }
  return sums;
}

struct Meeting {
  double distance_m = std::numeric_limits<double>::infinity();
  bool from_outside = false;
};

// The first triangle on the ray (Moeller and Trumbore).
Meeting first_met(const CollisionMesh& surface, const math::Vec3& from, const math::Vec3& along) {
  Meeting first;
  for (const auto& triangle : surface.triangles) {
    const math::Vec3& corner = surface.vertices[triangle[0]];
    const math::Vec3 a = surface.vertices[triangle[1]] - corner, b = surface.vertices[triangle[2]] - corner;
    const math::Vec3 p = math::cross(along, b);
    const double determinant = math::dot(a, p);  // of the ray and the triangle; above 0: it comes from outside
    if (determinant == 0.0) continue;
    const math::Vec3 s = from - corner, q = math::cross(s, a);
    const double u = math::dot(s, p) / determinant, v = math::dot(along, q) / determinant;
    if (u < -kEdge || v < -kEdge || u + v > 1.0 + kEdge) continue;
    const double distance = math::dot(b, q) / determinant;
    if (distance >= 0.0 && distance < first.distance_m) first = {distance, determinant > 0.0};
  }
  return first;
}

}  // namespace

CollisionMesh wrapped(const CollisionMesh& patch, const CollisionMesh& surface, double offset_m) {
  const std::vector<math::Vec3> normals = vertex_normals(patch);
  CollisionMesh skin;
  std::vector<std::optional<std::uint32_t>> now(patch.vertices.size());
  for (std::size_t i = 0; i < patch.vertices.size(); ++i) {
    const double length = math::norm(normals[i]);
    if (length < kMinNormal) continue;
    const math::Vec3 along = normals[i] / length;
    const Meeting met = first_met(surface, patch.vertices[i], along);
    if (!met.from_outside || met.distance_m < offset_m) continue;
    now[i] = static_cast<std::uint32_t>(skin.vertices.size());
    skin.vertices.push_back(patch.vertices[i] + along * (met.distance_m - offset_m));
  }
  for (const auto& [a, b, c] : patch.triangles)
    if (now[a] && now[b] && now[c]) skin.triangles.push_back({*now[a], *now[c], *now[b]});
  skin.bounds = bounds_of(skin.vertices);
  return skin;
}

}  // namespace ambf::mesh
