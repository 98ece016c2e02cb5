#include "physics/contacts/crowd_limit.h"

#include <algorithm>

#include "base/limits.h"

namespace ambf::physics::detail {
namespace {

// Pairs of the broadphase below which there is no crowd: equal cubes, packed without gaps, have 13 each.
constexpr int kPairsPerBody = 16;
constexpr int kPairsOfFew = 1024;
// Near so many moving bodies, a body is in a crowd: one within packed cubes is near 26.
constexpr std::uint32_t kNearInCrowd = base::kMaxNearBodies;
// New partners that a body of a crowd meets at a time: on all sides, and few enough for steps of some 0.1 s with 1000
// boxes.
constexpr std::uint32_t kPartners = base::kNewNearBodies;

BodyData& body_of(const btBroadphaseProxy& proxy) {
  return data_of(*static_cast<btCollisionObject*>(proxy.m_clientObject));
}

}  // namespace

void CrowdLimit::begin_step(btOverlappingPairCache& cache, int moving_bodies) {
  crowded_ = false;
  const int count = cache.getNumOverlappingPairs();
  if (count <= kPairsPerBody * moving_bodies + kPairsOfFew) return;
  const btBroadphasePair* pairs = cache.getOverlappingPairArrayPtr();
  const auto each = [&](auto visit) {
    for (int i = 0; i < count; ++i) {
      const btBroadphasePair& pair = pairs[i];
      BodyData &a = body_of(*pair.m_pProxy0), &b = body_of(*pair.m_pProxy1);
      if (!a.is_static() && !b.is_static()) visit(static_cast<std::size_t>(i), pair, a, b);
    }
  };
  each([](std::size_t, const btBroadphasePair&, BodyData& a, BodyData& b) {
    a.near_bodies = b.near_bodies = a.met_bodies = b.met_bodies = 0;
  });
  each([](std::size_t, const btBroadphasePair& pair, BodyData& a, BodyData& b) {
    const btBroadphaseProxy &one = *pair.m_pProxy0, &other = *pair.m_pProxy1;
    if (!TestAabbAgainstAabb2(one.m_aabbMin, one.m_aabbMax, other.m_aabbMin, other.m_aabbMax)) return;
    ++a.near_bodies;
    ++b.near_bodies;
  });
  admitted_.assign(static_cast<std::size_t>(count), 1);
  // First what was met in the step before, so that contacts last.
  each([&](std::size_t i, const btBroadphasePair& pair, BodyData& a, BodyData& b) {
    if (std::min(a.near_bodies, b.near_bodies) < kNearInCrowd) return;
    admitted_[i] = pair.m_algorithm != nullptr ? 1 : 0;
    a.met_bodies += admitted_[i];
    b.met_bodies += admitted_[i];
  });
  Crowd crowd{nullptr, 0, crowd_.steps};
  each([&](std::size_t i, const btBroadphasePair&, BodyData& a, BodyData& b) {
    if (admitted_[i] != 0) return;
    if (std::max(a.met_bodies, b.met_bodies) < kPartners) {
      admitted_[i] = 1;
      ++a.met_bodies;
      ++b.met_bodies;
    } else {
      crowded_ = true;
      const BodyData& most = a.near_bodies < b.near_bodies ? b : a;
      if (most.near_bodies > crowd.near_bodies) crowd = {&most, most.near_bodies, crowd.steps};
    }
  });
  if (!crowded_) return;
  ++crowd.steps;
  crowd_ = crowd;
}

}  // namespace ambf::physics::detail
