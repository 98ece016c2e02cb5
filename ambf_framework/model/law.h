// A law: what one source does to one body in each step, as a wrench from the body's state: an input device's spring and
// damper, an anchor, a servo of a plugin. Laws of a body and its commands add; each source's share of the last step is
// in the frame (state::LawShare). Held with LiveWorld::hold(). Physics thread.
#pragma once

#include "math/types.h"
#include "physics/body.h"

namespace ambf::model {

class Law {
 public:
  virtual ~Law() = default;
  // The wrench on `body` during the coming step of h_s seconds, at its centre of mass in world axes. Must neither
  // allocate, lock nor wait; must not change the body. A wrench of zeros does not wake a sleeping body.
  virtual math::Wrench act(const physics::Body& body, double h_s) = 0;
};

// A force at a point of the world, as a wrench at the body's centre of mass.
inline math::Wrench wrench_of(const physics::Body& body, const math::Vec3& force_world, const math::Vec3& point_world) {
  return {force_world, math::cross(point_world - body.com_pose().position, force_world)};
}

// Sets the velocity of a moving body at once; returns the wrench that changes its momentum as much within a step.
math::Wrench set_twist(physics::Body& body, const math::Twist& twist_com_world);

}  // namespace ambf::model
