// How bodies move between the impulses of the solver: half kicks of gravity and the variational rotation of rigid
// bodies. docs/solver.md ("Motion between impulses") has the equations, decision 0022 the reasons. Private to
// physics/. Physics thread.
//
// A step changes velocities, and then poses with those velocities: they are the means over the step, half a step
// before the pose that they lead to. A body that nothing but known forces acted on (it flies) shows the twist of its
// pose's instant instead (BodyData::instant_twist), and a twist that is set is one of that instant, too.
#pragma once

#include "physics/detail/body_data.h"

namespace ambf::physics::detail {

// Rotation of a free rigid body in one step of h, in body axes at the step's start. `inertia` is principal (kg m^2),
// omega the mean angular velocity of the step (rad/s): the attitude turns by exp(h omega).
//
// Angular momentum (Nms) at the step's start that belongs to this mean velocity:
//   l = exp(h/2 omega) (I omega - h^2/24 (I a x omega + I omega x a) - h^2/12 I (omega x a) - h^2/8 a x I omega),
//   a = I^-1 (I omega x omega). Without the terms in h^2 it is the discrete Euler equation of Moser and Veselov
// (second order); with them the fourth order of the Magnus series. Odd in omega: a step back undoes a step.
btVector3 momentum_before(const btVector3& omega, const btVector3& inertia, double h);
// The same at the step's end, in body axes there: momentum_before(omega, inertia, -h).
inline btVector3 momentum_after(const btVector3& omega, const btVector3& inertia, double h) {
  return momentum_before(omega, inertia, -h);
}
// The mean velocity that belongs to a momentum; false: none was found (the body turns by more than about a radian a
// step), `omega` is unchanged.
bool mean_velocity(const btVector3& momentum, const btVector3& inertia, double h, btVector3& omega);

// A pose after h at constant twist (m/s and rad/s, world axes), exactly.
btTransform moved(const btTransform& pose, const btVector3& linear, const btVector3& angular, double h);

// Before the rows of joints are made: replaces the twist by the one that impulses of this step are added to, and
// predicts where the body goes. Its joints are expected to turn it as they did in the last step.
void begin_motion(BodyData& body, double h);
// The mean angular velocity with which a body on joints turns in this step when the solver leaves it with `angular`:
// that of the impulses which it found for the rotation that was expected. rad/s, world axes.
btVector3 mean_turn_after(const BodyData& body, const btVector3& angular, double h);
// After the solver: moves the body by this share of its way (swept_motion.h), and shows the twist of the instant where
// it flies.
void end_motion(BodyData& body, double h, double share);

}  // namespace ambf::physics::detail
