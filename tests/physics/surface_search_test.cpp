// Contacts of surfaces with too many triangles near each other, found without bodies.
#include <gtest/gtest.h>

#include "physics/meshes/surface_contacts.h"
#include "tests/physics/meshes.h"

namespace ambf::physics::detail {
namespace {

using testing::TestMesh;

constexpr double kMargin = 0.001;  // m, of each surface

std::shared_ptr<const FeatureMesh> features(const TestMesh& mesh) {
  std::vector<std::array<int, 3>> triangles;
  for (const auto& t : mesh.triangles)
    triangles.push_back({static_cast<int>(t[0]), static_cast<int>(t[1]), static_cast<int>(t[2])});
  return make_feature_mesh(mesh.vertices, triangles, kMargin, true);
}

// Whatever there was the last time and however many pairs of triangles are near each other now: what touches is found.
TEST(SurfaceSearch, FindsWhatTouchesAtAnyNumberOfPairs) {
  const auto floor = features(testing::sheet_mesh(0.32, 32));  // a full tree: all leaves at one level
  SurfaceContacts contacts;
  for (double size = 0.01; size < 0.3; size += 0.002)
    for (const bool was_fine : {false, true}) {
      const auto plate =
          features({{{-size / 2, -size / 2, 0}, {size / 2, -size / 2, 0}, {0, size / 2, 0}}, {{0, 1, 2}}});
      const btTransform T_floor_plate(btMatrix3x3::getIdentity(), {0.0013, 0.0017, 2 * kMargin - 1e-4});
      bool fine = was_fine;
      contacts.touch(*plate, *floor, T_floor_plate, SurfaceContacts::kReach, fine, {});
      const auto& chosen = contacts.choose();
      ASSERT_GE(chosen.size(), 3u) << size << was_fine;
      for (const auto& at : chosen) EXPECT_NEAR(at.contact.distance, -1e-4, 1e-9) << size;
    }
}

// Sides of a tube in triangles from end to end.
TestMesh tube(int around) {
  TestMesh mesh;
  for (int i = 0; i < around; ++i)
    for (const double x : {-0.1, 0.1}) {
      const double turn = 2.0 * std::numbers::pi * i / around;
      mesh.vertices.push_back({x, 0.005 * std::cos(turn), 0.005 * std::sin(turn)});
    }
  const auto at = [=](int i, int end) { return static_cast<std::uint32_t>(2 * (i % around) + end); };
  for (int i = 0; i < around; ++i) {
    mesh.triangles.push_back({at(i, 0), at(i, 1), at(i + 1, 1)});
    mesh.triangles.push_back({at(i, 0), at(i + 1, 1), at(i + 1, 0)});
  }
  return mesh;
}

double area(const FeatureMesh& mesh) {
  double sum = 0.0;
  for (const FeatureMesh::Triangle& t : mesh.triangles) {
    const btVector3& origin = mesh.vertices[static_cast<std::size_t>(t.vertex[0])].at;
    sum += 0.5 * (mesh.vertices[static_cast<std::size_t>(t.vertex[1])].at - origin)
                     .cross(mesh.vertices[static_cast<std::size_t>(t.vertex[2])].at - origin)
                     .length();
  }
  return sum;
}

TEST(SurfaceSearch, DividesLongThinTrianglesOnlyWhereTheyAreMany) {
  const auto shaft = features(tube(64));
  ASSERT_NE(shaft->divided, nullptr);
  EXPECT_EQ(shaft->divided->divided, nullptr);
  EXPECT_LT(shaft->divided->triangles.size(), 80000u);
  EXPECT_NEAR(area(*shaft->divided), area(*shaft), 1e-9);
  EXPECT_EQ(features(tube(12))->divided, nullptr);
  EXPECT_EQ(features(testing::box_mesh({0.1, 0.1, 0.1}, 20))->divided, nullptr);
  // A large mesh with a few slivers is not prepared twice.
  TestMesh scan = testing::ring_mesh(0.05, 0.02, 256, 128);
  const auto base = static_cast<std::uint32_t>(scan.vertices.size());
  const TestMesh slivers = tube(64);
  for (const math::Vec3& v : slivers.vertices) scan.vertices.push_back(v + math::Vec3{1.0, 0, 0});
  for (const auto& t : slivers.triangles) scan.triangles.push_back({base + t[0], base + t[1], base + t[2]});
  EXPECT_EQ(features(scan)->divided, nullptr);
}

}  // namespace
}  // namespace ambf::physics::detail
