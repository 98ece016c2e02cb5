#include <algorithm>
#include <bit>
#include <cmath>

#include "physics/detail/world_data.h"
#include "physics/rays.h"
#include "physics/rays/detail/shape_ray.h"
#include "physics/soft/face_rays.h"

namespace ambf::physics {

using detail::BodyData;
using detail::from_bullet;
using detail::RayCandidate;
using detail::to_bullet;
using detail::WorldData;

namespace {

struct Box {
  btVector3 low{SIMD_INFINITY, SIMD_INFINITY, SIMD_INFINITY}, high{-SIMD_INFINITY, -SIMD_INFINITY, -SIMD_INFINITY};
  void add(const btVector3& point) {
    low.setMin(point);
    high.setMax(point);
  }
};

std::uint64_t mixed(std::uint64_t sum, std::uint64_t value) {  // the finalizer of SplitMix64
  value += sum + 0x9e3779b97f4a7c15U;
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9U;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebU;
  return value ^ (value >> 31);
}

std::uint64_t mixed(std::uint64_t sum, const btTransform& pose) {
  const btVector3 rows[] = {pose.getBasis()[0], pose.getBasis()[1], pose.getBasis()[2], pose.getOrigin()};
  for (const btVector3& row : rows)
    for (int axis = 0; axis < 3; ++axis) sum = mixed(sum, std::bit_cast<std::uint64_t>(row[axis]));
  return sum;
}

// The broadphase knows bodies where the last step found them; since then none has moved by more than this.
double drift(WorldData& world) {
  if (world.rays.drift_step == world.steps) return world.rays.drift;
  double most = 0.0;
  for (const BodyData* body : world.bodies)
    if (body->collided && body->rigid.isActive() && !body->is_static())
      most = std::max(most, body->displacement_from(body->collided_pose));
  world.rays.drift_step = world.steps;
  return world.rays.drift = most;
}

struct Within final : btBroadphaseAabbCallback {
  Within(const BundleFilter& rules, std::vector<RayCandidate>& found) : filter(rules), candidates(found) {}
  bool process(const btBroadphaseProxy* proxy) override {
    const BodyData& body = detail::data_of(*static_cast<btCollisionObject*>(proxy->m_clientObject));
    if (body.shape->empty() || &body.owner == filter.ignored) return true;
    if (filter.as_it_collides && filter.ignored != nullptr && !collides(filter.ignored->data(), body)) return true;
    const btTransform& pose = body.rigid.getWorldTransform();
    candidates.push_back({&body, pose, proxy->m_uniqueId});
    seen += mixed(static_cast<std::uint64_t>(proxy->m_uniqueId), pose);  // in whatever order the tree visits them
    return true;
  }
  bool collides(const BodyData& ignored, const BodyData& body) const {
    if (filter.as_if_solid && ignored.shape->empty()) return !body.mounted && groups_meet(ignored, body);
    return may_collide(ignored, body);
  }

  const BundleFilter& filter;
  std::vector<RayCandidate>& candidates;
  std::uint64_t seen = 0;
};

bool misses(const btVector3& start, const btVector3& end, const RayCandidate& candidate) {
  for (int axis = 0; axis < 3; ++axis)
    if (std::max(start[axis], end[axis]) < candidate.low[axis] ||
        std::min(start[axis], end[axis]) > candidate.high[axis])
      return true;
  return false;
}

BundleHit cast_one(const btVector3& start, const btVector3& end, const std::vector<RayCandidate>& candidates,
                   bool from_inside) {
  BundleHit hit;
  hit.fraction = 1.0;
  detail::LocalHit nearest;
  const RayCandidate* body = nullptr;
  for (const RayCandidate& candidate : candidates) {
    if (misses(start, end, candidate)) continue;
    const btMatrix3x3 into = candidate.pose.getBasis().transpose();
    const detail::LocalRay local{into * (start - candidate.pose.getOrigin()), into * (end - start)};
    detail::LocalHit met;
    met.fraction = nearest.fraction;
    cast_ray(candidate.body->shape->data(), local, from_inside, met);
    if (!met.hit || met.fraction >= nearest.fraction) continue;
    met.normal = candidate.pose.getBasis() * met.normal;
    nearest = met;
    body = &candidate;
  }
  if (body == nullptr) return hit;
  const btVector3 along = end - start;
  if (nearest.normal.dot(along) > 0.0) nearest.normal = -nearest.normal;
  hit.body = &body->body->owner;
  hit.fraction = nearest.fraction;
  hit.point = from_bullet(start + along * nearest.fraction);
  hit.normal = from_bullet(nearest.normal);
  hit.triangle = nearest.triangle;
  return hit;
}

void cast_soft(const std::vector<SoftBody*>& bodies, const btVector3& start, const btVector3& end, BundleHit& hit) {
  const btVector3 along = end - start;
  const detail::FaceHit found = detail::cast_at_faces(bodies, start, along, hit.fraction);
  if (found.body == nullptr) return;
  hit.body = nullptr;
  hit.soft = found.body;
  hit.fraction = found.fraction;
  hit.point = from_bullet(start + along * found.fraction);
  hit.normal = from_bullet(found.normal);
  hit.triangle = found.face;
}

}  // namespace

std::size_t RayBundle::cast(const World& world, const math::Pose& T_world_bundle, std::span<const Ray> rays,
                            const BundleFilter& filter, std::span<BundleHit> hits, std::size_t limit) {
  if (rays.empty()) return 0;
  WorldData& data = world.data();
  const btTransform T_world = to_bullet(T_world_bundle);
  Box reach;
  for (const Ray& ray : rays) {
    reach.add(T_world * to_bullet(ray.start));
    reach.add(T_world * to_bullet(ray.end));
  }
  const double slack = drift(data);
  std::vector<RayCandidate>& candidates = data.rays.candidates;
  candidates.clear();
  Within within(filter, candidates);
  data.broadphase->aabbTest(reach.low - btVector3(slack, slack, slack), reach.high + btVector3(slack, slack, slack),
                            within);
  const bool meets_soft = filter.soft_bodies && data.soft != nullptr;
  if (meets_soft) within.seen += detail::find_faces(data.soft->all(), reach.low, reach.high);
  const std::uint64_t seen = mixed(within.seen, T_world);
  const bool first = !known_ || hits.size() < rays.size();
  if (first || seen != seen_) stale_ = rays.size();
  known_ = true;
  seen_ = seen;
  const std::size_t count = first || limit == 0 ? stale_ : std::min(stale_, limit);
  if (count == 0) return 0;

  for (RayCandidate& candidate : candidates) candidate.body->rigid.getAabb(candidate.low, candidate.high);
  // The order of the tree must not decide between bodies at one place.
  std::sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) { return a.order < b.order; });
  for (std::size_t i = 0; i < count; ++i) {
    const Ray& ray = rays[next_];
    const btVector3 start = T_world * to_bullet(ray.start), end = T_world * to_bullet(ray.end);
    hits[next_] = cast_one(start, end, candidates, filter.from_inside);
    if (meets_soft) cast_soft(data.soft->all(), start, end, hits[next_]);
    next_ = (next_ + 1) % rays.size();
  }
  stale_ -= count;
  return count;
}

}  // namespace ambf::physics
