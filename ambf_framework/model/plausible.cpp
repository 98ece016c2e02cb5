#include "model/detail/plausible.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/bounds.h"
#include "scene/keys.h"

namespace ambf::model {

namespace {

// Rounding in files is no fault.
constexpr double kRounding = 1e-3;

std::string text_of(const math::Vec3& v) {
  return "{" + scene::text_of(v.x) + ", " + scene::text_of(v.y) + ", " + scene::text_of(v.z) + "}";
}

}  // namespace

math::Vec3 usable_inertia(const math::Vec3& given, const scene::Identity& body, Findings& findings) {
  math::Vec3 used = given;
  std::array<double*, 3> sorted{&used.x, &used.y, &used.z};
  std::sort(sorted.begin(), sorted.end(), [](const double* a, const double* b) { return *a < *b; });
  auto& [small, middle, large] = sorted;
  const double sum = *small + *middle;
  if (sum == 0.0 || *large <= sum * (1.0 + kRounding)) return given;  // zeros: not given (physics::Body)
  if (*large <= sum * base::kMaxInertiaExcess) {
    findings.information(body, "inertia", text_of(given) + ": no body has a moment above the sum of the other two",
                         "check the values; they are used as they are");
    return given;
  }
  // The nearest point of the plane large = small + middle.
  const double excess = (*large - sum) / 3.0;
  *small += excess;
  *middle += excess;
  *large -= excess;
  findings.warning(body, "inertia", text_of(given) + ": no body has a moment above the sum of the other two",
                   text_of(used) + ", the nearest that a body can have, is used");
  return used;
}

bool usable_cloud(std::size_t points, const scene::Body& body, Findings& findings) {
  if (body.collision.mesh_type != scene::CollisionMeshType::point_cloud || points <= base::kMaxCloudPoints) return true;
  findings.error(body.identity, "collision mesh type",
                 "a POINT_CLOUD of " + std::to_string(points) + " points; expected at most " +
                     std::to_string(base::kMaxCloudPoints),
                 "CONVEX_HULL takes meshes of any size; the body is there without a collision shape");
  return false;
}

bool usable_size(const physics::Shape& shape, const scene::Body& body, const char* key, Findings& findings) {
  if (shape.empty() || shape.infinite()) return true;
  const physics::BoundingBox box = shape.bounds();
  const double size = std::max({box.max.x - box.min.x, box.max.y - box.min.y, box.max.z - box.min.z});
  if (!(size <= base::kMaxLength_m)) {  // also of NaN
    findings.error(body.identity, key,
                   "the collision shape would be " + scene::text_of(size) + " m large; expected at most " +
                       scene::text_of(base::kMaxLength_m) + " m",
                   "the body is there without it");
    return false;
  }
  if (body.mass > 0.0 && body.collision.shapes.empty() && size > base::kPlausibleMeshSize_m) {
    findings.information(body.identity, key, "the mesh is " + scene::text_of(std::round(size)) + " m large",
                         "meshes are in metres; of one in millimetres the `scale` is 0.001");
  }
  return true;
}

}  // namespace ambf::model
