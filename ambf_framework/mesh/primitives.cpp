#include "mesh/primitives.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/rotation.h"

namespace ambf::mesh {

namespace {

using math::Vec3;
constexpr double kPi = std::numbers::pi;

std::uint32_t add_vertex(Submesh& s, const Vec3& p, const Vec3& n, double u, double v) {
  for (double value : {p.x, p.y, p.z}) s.positions.push_back(static_cast<float>(value));
  for (double value : {n.x, n.y, n.z}) s.normals.push_back(static_cast<float>(value));
  s.texcoords.push_back(static_cast<float>(u));
  s.texcoords.push_back(static_cast<float>(v));
  return static_cast<std::uint32_t>(s.vertex_count() - 1);
}

// Shapes of revolution are made about z; a cyclic turn of the axes brings z to the axis asked for and keeps handedness.
void turn_to(Submesh& s, Axis axis) {
  if (axis == Axis::z) return;
  for (std::vector<float>* values : {&s.positions, &s.normals}) {
    for (std::size_t i = 0; i + 2 < values->size(); i += 3) {
      const float x = (*values)[i], y = (*values)[i + 1], z = (*values)[i + 2];
      (*values)[i] = axis == Axis::x ? z : y;
      (*values)[i + 1] = axis == Axis::x ? x : z;
      (*values)[i + 2] = axis == Axis::x ? y : x;
    }
  }
}

Mesh finished(Submesh&& s, Axis axis = Axis::z) {
  turn_to(s, axis);
  Mesh mesh;
  mesh.submeshes.push_back(std::move(s));
  mesh.bounds = bounds_of(mesh.submeshes);
  return mesh;
}

// One point of an outline in the r-z half plane, with the outward normal there.
struct Outline {
  double r, z, normal_r, normal_z;
};

// The surface swept by the outline from bottom to top; triangles without area (at the poles) are left out.
void sweep(Submesh& s, const std::vector<Outline>& outline, int slices) {
  const auto rows = static_cast<std::uint32_t>(outline.size());
  const auto first = static_cast<std::uint32_t>(s.vertex_count());
  for (int i = 0; i <= slices; ++i) {
    const double share = static_cast<double>(i) / slices;
    // The seam closes exactly: the last column has the first one's positions.
    const double angle_rad = 2.0 * kPi * (i == slices ? 0.0 : share);
    const double c = std::cos(angle_rad), k = std::sin(angle_rad);
    for (std::uint32_t row = 0; row < rows; ++row) {
      const Outline& o = outline[row];
      add_vertex(s, {o.r * c, o.r * k, o.z}, {o.normal_r * c, o.normal_r * k, o.normal_z}, share,
                 static_cast<double>(row) / (rows - 1));
    }
  }
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(slices); ++i) {
    for (std::uint32_t row = 0; row + 1 < rows; ++row) {
      const std::uint32_t a = first + i * rows + row, b = a + rows;
      if (outline[row].r > 0.0) s.triangles.insert(s.triangles.end(), {a, b, a + 1});
      if (outline[row + 1].r > 0.0) s.triangles.insert(s.triangles.end(), {b, b + 1, a + 1});
    }
  }
}

// A flat disc at height z facing up or down.
void cap(Submesh& s, double radius, double z, bool up, int slices) {
  const Vec3 normal{0.0, 0.0, up ? 1.0 : -1.0};
  const std::uint32_t centre = add_vertex(s, {0.0, 0.0, z}, normal, 0.5, 0.5);
  for (int i = 0; i < slices; ++i) {
    const double angle_rad = 2.0 * kPi * i / slices;
    const double c = std::cos(angle_rad), k = std::sin(angle_rad);
    add_vertex(s, {radius * c, radius * k, z}, normal, 0.5 + 0.5 * c, 0.5 + 0.5 * k);
  }
  const auto n = static_cast<std::uint32_t>(slices);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t a = centre + 1 + i, b = centre + 1 + (i + 1) % n;
    s.triangles.insert(s.triangles.end(), {centre, up ? a : b, up ? b : a});
  }
}

// Half circle of an outline, from angle `from` to `to` (rad, -pi/2: bottom pole) about height z.
void add_arc(std::vector<Outline>& outline, double radius, double z, double from_rad, double to_rad, int steps) {
  for (int i = 0; i <= steps; ++i) {
    const double angle_rad = from_rad + (to_rad - from_rad) * i / steps;
    const bool pole = std::abs(std::abs(angle_rad) - kPi / 2.0) < 1e-9;
    const double c = pole ? 0.0 : std::cos(angle_rad), k = pole ? std::copysign(1.0, angle_rad) : std::sin(angle_rad);
    outline.push_back({radius * c, z + radius * k, c, k});
  }
}

int at_least_three(int slices) { return std::max(3, slices); }

}  // namespace

Mesh make_box(double x, double y, double z) {
  Submesh s;
  const Vec3 half{0.5 * x, 0.5 * y, 0.5 * z};
  const Vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int k = 0; k < 3; ++k) {
    for (double sign : {1.0, -1.0}) {
      // u x v = n for both directions.
      const Vec3 n = axes[k] * sign, u = axes[(k + 1) % 3] * sign, v = axes[(k + 2) % 3];
      const auto first = static_cast<std::uint32_t>(s.vertex_count());
      for (const auto& [a, b] : {std::pair{0.0, 0.0}, std::pair{1.0, 0.0}, std::pair{1.0, 1.0}, std::pair{0.0, 1.0}}) {
        add_vertex(s, math::scaled(half, n + u * (2.0 * a - 1.0) + v * (2.0 * b - 1.0)), n, a, b);
      }
      s.triangles.insert(s.triangles.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
    }
  }
  return finished(std::move(s));
}

Mesh make_sphere(double radius, int slices) {
  slices = at_least_three(slices);
  Submesh s;
  std::vector<Outline> outline;
  add_arc(outline, radius, 0.0, -kPi / 2.0, kPi / 2.0, std::max(2, slices / 2));
  sweep(s, outline, slices);
  return finished(std::move(s));
}

Mesh make_cylinder(double radius, double height, Axis axis, int slices) {
  slices = at_least_three(slices);
  Submesh s;
  sweep(s, {{radius, -0.5 * height, 1.0, 0.0}, {radius, 0.5 * height, 1.0, 0.0}}, slices);
  cap(s, radius, -0.5 * height, false, slices);
  cap(s, radius, 0.5 * height, true, slices);
  return finished(std::move(s), axis);
}

Mesh make_cone(double radius, double height, Axis axis, int slices) {
  slices = at_least_three(slices);
  Submesh s;
  const double slant = std::max(std::hypot(radius, height), 1e-300);
  const double normal_r = height / slant, normal_z = radius / slant;
  sweep(s, {{radius, -0.5 * height, normal_r, normal_z}, {0.0, 0.5 * height, normal_r, normal_z}}, slices);
  cap(s, radius, -0.5 * height, false, slices);
  return finished(std::move(s), axis);
}

Mesh make_capsule(double radius, double height, Axis axis, int slices) {
  slices = at_least_three(slices);
  const double half = std::max(0.0, 0.5 * height - radius);  // of the cylindrical part
  const int steps = std::max(2, slices / 4);
  Submesh s;
  std::vector<Outline> outline;
  add_arc(outline, radius, -half, -kPi / 2.0, 0.0, steps);
  if (half == 0.0) outline.pop_back();  // a sphere: the two arcs share their middle
  add_arc(outline, radius, half, 0.0, kPi / 2.0, steps);
  sweep(s, outline, slices);
  return finished(std::move(s), axis);
}

Mesh make_plane(const math::Vec3& normal, double offset, double side, double tile) {
  const Vec3 n = math::normalized(normal);
  const math::Quat turn = math::rotation_between({0.0, 0.0, 1.0}, n);
  const double half = 0.5 * side, tiles = tile > 0.0 ? side / tile : 1.0;
  Submesh s;
  for (const auto& [a, b] : {std::pair{0.0, 0.0}, std::pair{1.0, 0.0}, std::pair{1.0, 1.0}, std::pair{0.0, 1.0}}) {
    const Vec3 flat{(2.0 * a - 1.0) * half, (2.0 * b - 1.0) * half, 0.0};
    add_vertex(s, n * offset + math::rotate(turn, flat), n, a * tiles, b * tiles);
  }
  s.triangles = {0, 1, 2, 0, 2, 3};
  return finished(std::move(s));
}

namespace {

// `function` of each vector (xyz at the start of `stride` numbers).
template <typename Function>
void for_each_vector(std::vector<float>& values, std::size_t stride, const Function& function) {
  for (std::size_t i = 0; i + 2 < values.size(); i += stride) {
    const Vec3 changed = function(Vec3{values[i], values[i + 1], values[i + 2]});
    values[i] = static_cast<float>(changed.x);
    values[i + 1] = static_cast<float>(changed.y);
    values[i + 2] = static_cast<float>(changed.z);
  }
}

}  // namespace

Mesh stretched(Mesh mesh, const math::Vec3& factors) {
  const bool mirrors = factors.x * factors.y * factors.z < 0.0;
  const Vec3 inverse{1.0 / factors.x, 1.0 / factors.y, 1.0 / factors.z};
  for (Submesh& s : mesh.submeshes) {
    for_each_vector(s.positions, 3, [&](const Vec3& p) { return math::scaled(p, factors); });
    for_each_vector(s.normals, 3, [&](const Vec3& n) { return math::normalized(math::scaled(n, inverse), n); });
    for_each_vector(s.tangents, 4, [&](const Vec3& t) { return math::normalized(math::scaled(t, factors), t); });
    if (!mirrors) continue;
    for (std::size_t i = 3; i < s.tangents.size(); i += 4) s.tangents[i] = -s.tangents[i];
    for (std::size_t i = 0; i + 2 < s.triangles.size(); i += 3) std::swap(s.triangles[i + 1], s.triangles[i + 2]);
  }
  mesh.bounds = bounds_of(mesh.submeshes);
  return mesh;
}

void append(Mesh& mesh, const Mesh& part, const math::Pose& T_mesh_part) {
  const auto first_material = static_cast<int>(mesh.materials.size());
  mesh.materials.insert(mesh.materials.end(), part.materials.begin(), part.materials.end());
  for (Submesh s : part.submeshes) {
    if (s.material >= 0) s.material += first_material;
    const auto turned = [&T_mesh_part](const Vec3& v) { return math::rotate(T_mesh_part.orientation, v); };
    for_each_vector(s.positions, 3, [&T_mesh_part](const Vec3& p) { return T_mesh_part * p; });
    for_each_vector(s.normals, 3, turned);
    for_each_vector(s.tangents, 4, turned);
    mesh.submeshes.push_back(std::move(s));
  }
  mesh.bounds = bounds_of(mesh.submeshes);
}

}  // namespace ambf::mesh
