#include "physics/soft/detail/segments.h"

#include <algorithm>

namespace ambf::physics::detail {

using math::Vec3;

namespace {

constexpr double kParallel = 1e-4;  // of a sine's square: below it the middle of what lies beside each other counts

}  // namespace

// Ericson, Real-Time Collision Detection, 5.1.9.
NearestShares nearest_shares(const Segment& a, const Segment& b) {
  const Vec3 along_a = a.to - a.from, along_b = b.to - b.from, between = a.from - b.from;
  const double aa = math::dot(along_a, along_a), bb = math::dot(along_b, along_b), ab = math::dot(along_a, along_b);
  const double ac = math::dot(along_a, between), bc = math::dot(along_b, between);
  NearestShares found;
  const double square = aa * bb - ab * ab;
  if (square > kParallel * aa * bb) {
    found.a = std::clamp((ab * bc - ac * bb) / square, 0.0, 1.0);
  } else if (aa > 0.0) {
    // Where b's ends are along a.
    const double first = -ac / aa, second = first + ab / aa;
    const double low = std::clamp(std::min(first, second), 0.0, 1.0);
    const double high = std::clamp(std::max(first, second), 0.0, 1.0);
    found.a = 0.5 * (low + high);
  }
  found.b = bb > 0.0 ? (ab * found.a + bc) / bb : 0.0;
  if (!(found.b >= 0.0 && found.b <= 1.0)) {
    found.b = std::clamp(found.b, 0.0, 1.0);
    found.a = aa > 0.0 ? std::clamp((ab * found.b - ac) / aa, 0.0, 1.0) : 0.0;
  }
  found.gap = a.at(found.a) - b.at(found.b);
  return found;
}

}  // namespace ambf::physics::detail
