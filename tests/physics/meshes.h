// Triangle meshes for tests, made by formula.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "physics/shape.h"

namespace ambf::physics::testing {

struct TestMesh {
  std::vector<math::Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  SharedShape shape(const ShapeOptions& options = {}) const {
    return MeshSource(vertices, triangles).shape(scene::CollisionMeshType::triangle_mesh, {}, options);
  }
  // Every triangle wound the other way round.
  TestMesh turned() const {
    TestMesh result = *this;
    for (auto& triangle : result.triangles) std::swap(triangle[1], triangle[2]);
    return result;
  }
};

// A flat grid of n x n cells in the x-y plane, facing +z.
inline TestMesh sheet_mesh(double size, int n) {
  TestMesh mesh;
  const auto side = static_cast<std::uint32_t>(n + 1);
  for (int i = 0; i <= n; ++i)
    for (int k = 0; k <= n; ++k) mesh.vertices.push_back({size * (1.0 * i / n - 0.5), size * (1.0 * k / n - 0.5), 0.0});
  for (std::uint32_t i = 0; i + 1 < side; ++i)
    for (std::uint32_t k = 0; k + 1 < side; ++k) {
      const std::uint32_t at = i * side + k;
      mesh.triangles.push_back({at, at + side, at + side + 1});
      mesh.triangles.push_back({at, at + side + 1, at + 1});
    }
  return mesh;
}

// A box whose six faces are grids of n x n cells.
inline TestMesh box_mesh(const math::Vec3& size, int n = 1) {
  TestMesh mesh;
  const TestMesh face = sheet_mesh(1.0, n);
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0}) {
      const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
      for (const math::Vec3& v : face.vertices) {
        const double flat[3] = {v.x, sign * v.y, sign * 0.5};
        double at[3];
        for (int k = 0; k < 3; ++k) at[(axis + 1 + k) % 3] = flat[k];
        mesh.vertices.push_back({at[0] * size.x, at[1] * size.y, at[2] * size.z});
      }
      for (const auto& t : face.triangles) mesh.triangles.push_back({base + t[0], base + t[1], base + t[2]});
    }
  return mesh;
}

// A ring about z.
inline TestMesh ring_mesh(double radius, double thickness, int around, int across) {
  TestMesh mesh;
  for (int i = 0; i < around; ++i)
    for (int k = 0; k < across; ++k) {
      const double turn = 2.0 * std::numbers::pi * i / around, roll = 2.0 * std::numbers::pi * k / across;
      const double out = radius + thickness * std::cos(roll);
      mesh.vertices.push_back({out * std::cos(turn), out * std::sin(turn), thickness * std::sin(roll)});
    }
  const auto at = [=](int i, int k) { return static_cast<std::uint32_t>((i % around) * across + k % across); };
  for (int i = 0; i < around; ++i)
    for (int k = 0; k < across; ++k) {
      mesh.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      mesh.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  return mesh;
}

}  // namespace ambf::physics::testing
