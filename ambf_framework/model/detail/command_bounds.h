// What commands may ask of a body in one step. No command takes a body, by itself, beyond base::kMaxCommandedSpeed:
// forces and torques are cut to what reaches it, velocities to it. A wrench within the bound is passed on bit for bit.
// Physics thread; allocates nothing. For use inside model/ only.
#pragma once

#include "math/types.h"
#include "model/detail/live_objects.h"
#include "state/structure.h"

namespace ambf::model {

class CommandBound {
 public:
  // For one step of h_s seconds of a moving body.
  CommandBound(const LiveBody& live, double h_s) : live_(live), h_s_(h_s) {}

  // A wrench at the centre of mass.
  math::Wrench wrench(const math::Wrench& wrench_world);
  // Of the centre of mass, m/s or rad/s.
  math::Vec3 velocity(const math::Vec3& velocity_world);

  // Joints whose child (or, where that is static, whose parent) is this body.
  double effort(const physics::Joint& joint, double effort);
  double rate(double rate);  // rad/s or m/s
  // An error or its rate, that a servo of `servo_gain` (h K + D, physics/joint.h) answers with gain * value.
  double servo_input(const physics::Joint& joint, double value, double gain, double servo_gain);

  // Whether anything was cut.
  bool cut() const { return cut_; }

 private:
  double inertia_about(const physics::Joint& joint) const;

  const LiveBody& live_;
  double h_s_;
  bool cut_ = false;
};

// Adds up what joints connect, after a change of the structure; inertias are those of the poses in which
// the bodies were loaded, so that a restored world has the same.
void weigh_mechanisms(const TypedTable<LiveBody>& bodies, const state::Structure& structure);

}  // namespace ambf::model
