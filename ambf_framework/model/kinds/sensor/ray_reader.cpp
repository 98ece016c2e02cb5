#include "model/kinds/sensor/detail/ray_reader.h"

#include <algorithm>

namespace ambf::model {

RayReader::RayReader(const std::vector<state::SensorRay>& rays, RayRules rules, int rays_per_step)
    : rules_(rules), rays_per_step_(static_cast<std::size_t>(std::max(0, rays_per_step))) {
  for (const state::SensorRay& ray : rays) rays_.push_back({ray.start, ray.end});
}

void RayReader::read(const LiveWorld::Impl& live, std::uint32_t slot, std::vector<ElementHit>& hits) {
  const bool strict = rules_ == RayRules::own_body_and_what_it_passes;
  const physics::BundleFilter filter{
      .ignored = carrier_of(live, slot), .as_it_collides = strict, .from_inside = strict, .soft_bodies = !strict};
  bundle_.cast(*live.physics, pose_of_sensor(live, slot), rays_, filter, hits, rays_per_step_);
  known_ = true;
}

void RayReader::refresh(const LiveWorld::Impl& live, std::uint32_t slot, std::vector<ElementHit>& hits) {
  if (!known_ || rays_per_step_ == 0) read(live, slot, hits);
}

void RayReader::forget(std::vector<ElementHit>& hits) {
  ElementHit nothing;
  nothing.fraction = 1.0;
  hits.assign(rays_.size(), nothing);
  bundle_.forget();
  known_ = false;
}

}  // namespace ambf::model
