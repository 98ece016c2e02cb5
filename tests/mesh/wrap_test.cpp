// A patch wrapped onto a surface (Alg. 13) lies on it, looks away from it, and loses what does not meet it.
#include "mesh/wrap.h"

#include <gtest/gtest.h>

#include <cmath>

#include "math/rotation.h"
#include "mesh/primitives.h"
#include "mesh/weld.h"

namespace ambf::mesh {
namespace {

// Squares of `side` in the plane at z, each two triangles; normals along -z, or along z.
CollisionMesh patch(int squares, double side, double z, bool upwards = false) {
  CollisionMesh mesh;
  const double half = 0.5 * squares * side;
  for (int i = 0; i <= squares; ++i)
    for (int k = 0; k <= squares; ++k) mesh.vertices.push_back({k * side - half, i * side - half, z});
  const auto row = static_cast<std::uint32_t>(squares + 1);
  for (std::uint32_t i = 0; i + 1 < row; ++i)
    for (std::uint32_t k = 0; k + 1 < row; ++k) {
      const std::uint32_t a = i * row + k;
      for (auto t : {std::array<std::uint32_t, 3>{a, a + row, a + 1}, {a + 1, a + row, a + row + 1}}) {
        if (upwards) std::swap(t[1], t[2]);
        mesh.triangles.push_back(t);
      }
    }
  return mesh;
}

CollisionMesh ball(double radius) { return make_collision_mesh(make_sphere(radius)); }

math::Vec3 normal_of(const CollisionMesh& mesh, std::size_t triangle) {
  const auto& t = mesh.triangles[triangle];
  return math::normalized(
      math::cross(mesh.vertices[t[1]] - mesh.vertices[t[0]], mesh.vertices[t[2]] - mesh.vertices[t[0]]));
}

TEST(Wrap, LaysAPatchOntoABallAndTurnsItsNormalsOutward) {
  constexpr double kRadius = 0.1, kOffset = 0.002;
  const CollisionMesh skin = wrapped(patch(6, 0.01, 0.15), ball(kRadius), kOffset);
  ASSERT_EQ(skin.triangles.size(), 72U);
  ASSERT_EQ(skin.vertices.size(), 49U);
  for (const math::Vec3& v : skin.vertices) {
    // The ball is of flat triangles: a little within the sphere.
    const double expected = std::sqrt(kRadius * kRadius - v.x * v.x - v.y * v.y) + kOffset;
    EXPECT_NEAR(v.z, expected, 0.001);
    EXPECT_LE(v.z, expected + 1e-6);
  }
  for (std::size_t i = 0; i < skin.triangles.size(); ++i) EXPECT_GT(normal_of(skin, i).z, 0.7);
  EXPECT_NEAR(skin.bounds.max.z, kRadius + kOffset, 1e-3);
}

TEST(Wrap, TheOffsetIsMetExactlyOnAPlane) {
  const CollisionMesh skin = wrapped(patch(2, 0.01, 0.02), patch(10, 0.01, 0.0, true), 0.0005);
  ASSERT_EQ(skin.vertices.size(), 9U);
  for (const math::Vec3& v : skin.vertices) EXPECT_NEAR(v.z, 0.0005, 1e-15);
}

TEST(Wrap, WhatMeetsNothingIsLeftOutWithItsTriangles) {
  const CollisionMesh skin = wrapped(patch(10, 0.04, 0.15), ball(0.1), 0.0);
  EXPECT_LT(skin.triangles.size(), 60U);
  EXPECT_GT(skin.triangles.size(), 10U);
  for (const auto& t : skin.triangles)
    for (const std::uint32_t i : t) ASSERT_LT(i, skin.vertices.size());
  for (const math::Vec3& v : skin.vertices) EXPECT_LE(math::norm(v), 0.1 + 1e-6);
}

TEST(Wrap, BacksOfTrianglesAndWhatIsTooNearDoNotCount) {
  EXPECT_TRUE(wrapped(patch(2, 0.01, 0.02), patch(10, 0.01, 0.0, false), 0.0).triangles.empty()) << "from behind";
  EXPECT_TRUE(wrapped(patch(2, 0.01, 0.0), ball(0.1), 0.0).triangles.empty()) << "from inside";
  EXPECT_TRUE(wrapped(patch(2, 0.01, 0.02, true), patch(10, 0.01, 0.0, true), 0.0).triangles.empty()) << "looks away";
  EXPECT_TRUE(wrapped(patch(2, 0.01, 0.02), patch(10, 0.01, 0.0, true), 0.03).triangles.empty()) << "too near";
}

}  // namespace
}  // namespace ambf::mesh
