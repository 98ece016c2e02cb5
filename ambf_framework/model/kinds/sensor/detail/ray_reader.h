// The rays of one sensor: reads hits from the world as it is now. For the types of sensors that cast rays.
#pragma once

#include "model/kinds/sensor.h"

namespace ambf::model {

// What its rays leave out beside its own body; the stricter ones leave out soft bodies, too: they act on rigid ones.
enum class RayRules { own_body, own_body_and_what_it_passes };

class RayReader {
 public:
  RayReader(const std::vector<state::SensorRay>& rays, RayRules rules, int rays_per_step);

  std::size_t count() const { return rays_.size(); }
  const physics::Ray& ray(std::size_t element) const { return rays_[element]; }
  // In a step: as many as are due.
  void read(const LiveWorld::Impl& live, std::uint32_t slot, std::vector<ElementHit>& hits);
  // Between steps. What is read in turns waits for its step, unless nothing is known.
  void refresh(const LiveWorld::Impl& live, std::uint32_t slot, std::vector<ElementHit>& hits);
  void forget(std::vector<ElementHit>& hits);

 private:
  std::vector<physics::Ray> rays_;
  RayRules rules_;
  std::size_t rays_per_step_;  // 0: all
  bool known_ = false;
  physics::RayBundle bundle_;
};

}  // namespace ambf::model
