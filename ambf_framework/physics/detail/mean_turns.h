// Rotation of free rigid bodies in one step of h (s), in body axes at the step's start: the angular momentum (Nms) that
// belongs to the mean angular velocity of a step (rad/s), and the other way round. `inertia` is principal (kg m^2); the
// attitude turns by exp(h omega). Private to physics/. Any thread.
#pragma once

#include <cstddef>
#include <span>

#include "physics/detail/bullet.h"
#include "physics/detail/lanes.h"

namespace ambf::physics::detail {

// Angular momentum at the step's start that belongs to this mean velocity:
//   l = exp(h/2 omega) (I omega - h^2/24 (I a x omega + I omega x a) - h^2/12 I (omega x a) - h^2/8 a x I omega),
//   a = I^-1 (I omega x omega). Without the terms in h^2 it is the discrete Euler equation of Moser and Veselov
// (second order); with them the fourth order of the Magnus series. Odd in omega: a step back undoes a step.
btVector3 momentum_before(const btVector3& omega, const btVector3& inertia, double h);
// The same at the step's end, in body axes there: momentum_before(omega, inertia, -h).
inline btVector3 momentum_after(const btVector3& omega, const btVector3& inertia, double h) {
  return momentum_before(omega, inertia, -h);
}

struct Turn {
  btVector3 momentum, inertia;
  btVector3 omega;  // where to begin; then the mean velocity, unchanged where there is none
  bool found = false;
};
constexpr std::size_t kTurnsAtOnce = 4;

// The mean velocities that belong to momenta. None is found where a body turns by more than about a radian a step. Each
// gets the same bits alone and beside others; `wide` (lanes.h): four at a time, not two.
void find_mean_velocities(std::span<Turn> turns, double h, bool wide = has_wide_vectors());

}  // namespace ambf::physics::detail
