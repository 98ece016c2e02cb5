#include "mesh/mass_properties.h"

#include <algorithm>
#include <cmath>

namespace ambf::mesh {

namespace {

using math::Vec3;

// Integrals of 1, x, and x x^T over a set of simplices, relative to one reference point.
struct Moments {
  double mass = 0.0;
  Vec3 first;
  std::array<double, 6> second{};  // xx, yy, zz, xy, xz, yz

  void add(double m, const Vec3& mean, const std::array<double, 6>& square) {
    mass += m;
    first += mean * m;
    for (std::size_t i = 0; i < 6; ++i) second[i] += m * square[i];
  }
};

std::array<double, 6> outer(const Vec3& a) {
  return {a.x * a.x, a.y * a.y, a.z * a.z, a.x * a.y, a.x * a.z, a.y * a.z};
}

// Mean of x x^T over a simplex with n corners: (sum x_i x_i^T + s s^T) / (n (n + 1)), s the sum of the corners.
template <std::size_t N>
std::array<double, 6> mean_square(const std::array<Vec3, N>& corners) {
  Vec3 sum;
  for (const Vec3& c : corners) sum += c;
  std::array<double, 6> out = outer(sum);
  for (const Vec3& c : corners) {
    const auto o = outer(c);
    for (std::size_t i = 0; i < 6; ++i) out[i] += o[i];
  }
  for (double& value : out) value /= static_cast<double>(N * (N + 1));
  return out;
}

}  // namespace

bool is_closed(const CollisionMesh& mesh) {
  std::vector<std::uint64_t> edges;  // every directed one once, and its opposite once
  edges.reserve(3 * mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) edges.push_back(std::uint64_t{t[k]} << 32 | t[(k + 1) % 3]);
  }
  std::sort(edges.begin(), edges.end());
  if (edges.empty() || std::adjacent_find(edges.begin(), edges.end()) != edges.end()) return false;
  return std::all_of(edges.begin(), edges.end(), [&edges](std::uint64_t e) {
    return std::binary_search(edges.begin(), edges.end(), e << 32 | e >> 32);
  });
}

MassProperties mass_properties(const CollisionMesh& mesh) {
  MassProperties out;
  out.closed = is_closed(mesh);
  // Near the mesh, so that far-off meshes lose no digits.
  const Vec3 reference = (mesh.bounds.min + mesh.bounds.max) * 0.5;
  Moments solid, shell;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]] - reference, b = mesh.vertices[t[1]] - reference,
               c = mesh.vertices[t[2]] - reference;
    const double area = 0.5 * math::norm(math::cross(b - a, c - a));
    shell.add(area, (a + b + c) / 3.0, mean_square<3>({a, b, c}));
    const double volume = math::dot(a, math::cross(b, c)) / 6.0;  // signed tetrahedron with the reference point
    solid.add(volume, (a + b + c) / 4.0, mean_square<4>({a, b, c, Vec3{}}));
  }
  out.volume = solid.mass;
  out.area = shell.mass;
  const double diagonal = mesh.bounds.diagonal();
  const bool is_solid = out.closed && std::abs(solid.mass) > 1e-9 * diagonal * diagonal * diagonal;
  const Moments& m = is_solid ? solid : shell;
  out.centre = reference;
  if (m.mass == 0.0) return out;
  const Vec3 mean = m.first / m.mass;
  out.centre = reference + mean;
  // About the centre: E[x x^T] - mean mean^T, then inertia = trace * 1 - that.
  const auto shift = outer(mean);
  std::array<double, 6> s{};
  for (std::size_t i = 0; i < 6; ++i) s[i] = m.second[i] / m.mass - shift[i];
  out.inertia_per_mass = {s[1] + s[2], s[0] + s[2], s[0] + s[1], -s[3], -s[4], -s[5]};
  return out;
}

Vec3 corner_mean(const Mesh& mesh) {
  Vec3 sum;
  std::size_t count = 0;
  for (const Submesh& s : mesh.submeshes) {
    for (std::uint32_t v : s.triangles) sum += s.vertex(v);
    count += s.triangles.size();
  }
  return count == 0 ? sum : sum / static_cast<double>(count);
}

}  // namespace ambf::mesh
