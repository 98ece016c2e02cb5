// Contacts of surfaces with too many triangles near each other, found without bodies.
#include <gtest/gtest.h>

#include "physics/detail/surface_contacts.h"
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

}  // namespace
}  // namespace ambf::physics::detail
