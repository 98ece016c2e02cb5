// What an explicit spring and damper may have: B h <= m / 2 and K h^2 <= m / 4, with m the mass that a force at the
// body's mesh origin moves in its softest direction, or the inertia about a body axis. A body's own mass and inertia
// count: what joints connect to it only adds. Physics thread; allocates nothing. For use inside model/ only.
#pragma once

#include "math/types.h"
#include "physics/body.h"

namespace ambf::model {

struct EffectiveMass {
  double linear = 0.0;  // kg
  math::Vec3 angular;   // kg m^2, by body axis; infinite where no torque turns it
};
EffectiveMass effective_mass(const physics::Body& moving_body);

inline double max_stiffness(double effective_mass, double h_s) { return 0.25 * effective_mass / (h_s * h_s); }
inline double max_damping(double effective_mass, double h_s) { return 0.5 * effective_mass / h_s; }

// What is left of gains, by axis.
struct GainScale {
  math::Vec3 linear_stiffness{1, 1, 1}, linear_damping{1, 1, 1};    // world axes
  math::Vec3 angular_stiffness{1, 1, 1}, angular_damping{1, 1, 1};  // body axes
};

}  // namespace ambf::model
