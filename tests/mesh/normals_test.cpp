#include "mesh/detail/normals.h"

#include <cmath>
#include <set>

#include "mesh/primitives.h"
#include "tests/mesh/files.h"

namespace ambf::mesh {
namespace {

using namespace test;  // NOLINT

TEST(Normals, CubeFromStlHasHardEdges) {
  const LoadResult r = load_bytes(binary_stl(corners_of(make_box(1, 1, 1))), "cube.stl");
  ASSERT_TRUE(r.ok);
  const Submesh& s = r.mesh.submeshes[0];
  EXPECT_EQ(s.vertex_count(), 24U);  // three normals at each corner, no more
  for (std::size_t t = 0; t < s.triangles.size(); t += 3) {
    const math::Vec3 a = s.vertex(s.triangles[t]), b = s.vertex(s.triangles[t + 1]), c = s.vertex(s.triangles[t + 2]);
    const math::Vec3 face = math::cross(b - a, c - a);
    for (std::size_t k = 0; k < 3; ++k) {
      const float* n = s.normals.data() + std::size_t{3} * s.triangles[t + k];
      EXPECT_NEAR(math::dot(face, {n[0], n[1], n[2]}) / math::norm(face), 1.0, 1e-6);
    }
  }
}

TEST(Normals, SphereFromStlIsSmooth) {
  const LoadResult r = load_bytes(binary_stl(corners_of(make_sphere(2.0, 48))), "sphere.stl");
  ASSERT_TRUE(r.ok);
  const Submesh& s = r.mesh.submeshes[0];
  for (std::size_t i = 0; i < s.vertex_count(); ++i) {
    const math::Vec3 p = s.vertex(i), n{s.normals[3 * i], s.normals[3 * i + 1], s.normals[3 * i + 2]};
    EXPECT_GT(math::dot(p, n) / math::norm(p), 0.998);
  }
  // Smooth means one vertex a place.
  EXPECT_EQ(s.vertex_count(), 48U * 23U + 2U);
}

TEST(Normals, CylinderFromStlIsSmoothAroundAndHardAtItsCaps) {
  const LoadResult r = load_bytes(binary_stl(corners_of(make_cylinder(0.5, 2.0))), "cylinder.stl");
  ASSERT_TRUE(r.ok);
  const Submesh& s = r.mesh.submeshes[0];
  for (std::size_t i = 0; i < s.vertex_count(); ++i) {
    const math::Vec3 p = s.vertex(i), n{s.normals[3 * i], s.normals[3 * i + 1], s.normals[3 * i + 2]};
    const double along_axis = std::abs(n.z), outward = (n.x * p.x + n.y * p.y) / 0.5;
    EXPECT_TRUE(along_axis > 0.9999 || outward > 0.995) << n.x << " " << n.y << " " << n.z;
  }
}

TEST(Normals, NearlyEqualPositionsAreSmoothedTogether) {
  std::vector<math::Vec3> corners = corners_of(make_sphere(1.0, 32));
  for (std::size_t i = 0; i < corners.size(); ++i) corners[i].x += (i % 7 < 3 ? 2e-7 : 0.0);  // an exporter's rounding
  const LoadResult r = load_bytes(binary_stl(corners), "sphere.stl");
  ASSERT_TRUE(r.ok);
  EXPECT_EQ(r.mesh.vertex_count(), 32U * 15U + 2U);
}

// A roof: two quads that meet at a right angle.
const char* const kRoof = "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nv 1 1 0\nv 0 1 0\n%s\nf 4 3 2 1\n%s\nf 1 2 5 6\n";

std::size_t roof_vertices(const std::string& first, const std::string& second) {
  char text[300];
  std::snprintf(text, sizeof text, kRoof, first.c_str(), second.c_str());
  return load_bytes(text, "roof.obj").mesh.vertex_count();
}

TEST(Normals, SmoothingGroupsOverrideTheCreaseAngle) {
  EXPECT_EQ(roof_vertices("", ""), 8U);        // a right angle is hard
  EXPECT_EQ(roof_vertices("s 1", "s 1"), 6U);  // one group: smooth all the same
  EXPECT_EQ(roof_vertices("s 1", "s 2"), 8U);  // two groups
  EXPECT_EQ(roof_vertices("s off", "s off"), 8U);
}

TEST(Normals, NormalsOfTheFileAreKept) {
  const LoadResult r = load_bytes("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 3 4\nf 1//1 2//1 3//1\n", "a.obj");
  ASSERT_TRUE(r.ok);
  EXPECT_FLOAT_EQ(r.mesh.submeshes[0].normals[1], 0.6F);
  EXPECT_FLOAT_EQ(r.mesh.submeshes[0].normals[2], 0.8F);
}

TEST(Normals, FewAndManyTrianglesAtATipAgree) {
  // The tip of a blunt cone must not change when there are more triangles around it than are compared pair by pair.
  for (int n : {24, 400}) {
    const Mesh cone = make_cone(1.0, 0.3, Axis::z, n);
    const LoadResult r = load_bytes(binary_stl(corners_of(cone)), "cone.stl");
    ASSERT_TRUE(r.ok);
    const Submesh& s = r.mesh.submeshes[0];
    for (std::size_t i = 0; i < s.vertex_count(); ++i) {
      if (s.vertex(i).z > 0.149) {
        EXPECT_GT(s.normals[3 * i + 2], 0.95F) << n;
      }
    }
  }
}

}  // namespace
}  // namespace ambf::mesh
