// Contacts of surfaces with too many triangles near each other, found without bodies.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "physics/meshes/detail/constants.h"
#include "physics/meshes/detail/surface_contacts.h"
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
      contacts.touch(*plate, *floor, T_floor_plate, kContactReach, fine, {});
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

bool is_divided(const std::shared_ptr<const FeatureMesh>& mesh) { return &mesh->for_search() != mesh.get(); }

TEST(SurfaceSearch, DividesLongThinTrianglesOnlyWhereTheyAreMany) {
  const auto shaft = features(tube(64));
  ASSERT_TRUE(is_divided(shaft));
  EXPECT_LT(shaft->for_search().triangles.size(), 80000u);
  EXPECT_NEAR(area(shaft->for_search()), area(*shaft), 1e-9);
  EXPECT_FALSE(is_divided(features(tube(12))));
  EXPECT_FALSE(is_divided(features(testing::box_mesh({0.1, 0.1, 0.1}, 20))));
  // A large mesh with a few slivers is not prepared twice.
  TestMesh scan = testing::ring_mesh(0.05, 0.02, 256, 128);
  const auto base = static_cast<std::uint32_t>(scan.vertices.size());
  const TestMesh slivers = tube(64);
  for (const math::Vec3& v : slivers.vertices) scan.vertices.push_back(v + math::Vec3{1.0, 0, 0});
  for (const auto& t : slivers.triangles) scan.triangles.push_back({base + t[0], base + t[1], base + t[2]});
  EXPECT_FALSE(is_divided(features(scan)));
}

// A shaft that lies on a floor so fine that its contacts are searched for.
struct ShaftOnFloor {
  std::shared_ptr<const FeatureMesh> shaft = features(tube(64)), floor = features(testing::sheet_mesh(0.3, 300));
  btTransform T_floor_shaft{btMatrix3x3::getIdentity(), {0.0, 0.0, 0.005 + 2 * kMargin - 1e-4}};
  SurfaceContacts contacts;
  bool fine = false;

  std::vector<SurfaceContacts::Chosen> touch() {
    contacts.touch(*shaft, *floor, T_floor_shaft, kContactReach, fine, {});
    return contacts.choose();
  }
};

TEST(SurfaceSearch, PreparesASurfaceOnlyWhenASearchNeedsIt) {
  ShaftOnFloor scene;
  EXPECT_FALSE(scene.shaft->ready_for_search());
  scene.T_floor_shaft.setOrigin({0.0, 0.0, 0.02});
  scene.touch();
  EXPECT_FALSE(scene.shaft->ready_for_search()) << "out of reach";
  scene.T_floor_shaft.setOrigin({0.0, 0.0, 0.005 + 2 * kMargin - 1e-4});
  EXPECT_GE(scene.touch().size(), 2u);
  EXPECT_TRUE(scene.shaft->ready_for_search());
}

// In real time the step does not wait: contacts are there meanwhile, and afterwards they are those that a step
// without a clock finds.
TEST(SurfaceSearch, SearchesTheSurfaceAsItIsUntilAnotherThreadHasPreparedIt) {
  ShaftOnFloor waiting, scene;
  waiting.touch();
  const auto expected = waiting.touch();
  SurfacePreparation preparation;
  scene.contacts.prepare_by(&preparation);
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  do {
    EXPECT_FALSE(scene.touch().empty());
    ASSERT_LT(std::chrono::steady_clock::now(), deadline);
    std::this_thread::yield();
  } while (!scene.shaft->ready_for_search() || !scene.floor->ready_for_search());
  const auto found = scene.touch();
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].contact.point, expected[i].contact.point);
    EXPECT_EQ(found[i].contact.distance, expected[i].contact.distance);
  }
}

}  // namespace
}  // namespace ambf::physics::detail
