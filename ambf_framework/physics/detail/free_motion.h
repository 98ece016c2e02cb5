// How bodies move between the impulses of the solver: half kicks of gravity and the variational rotation of rigid
// bodies. docs/solver.md ("Motion between impulses") has the equations, decision 0022 the reasons. Private to
// physics/. Physics thread.
//
// A step changes velocities, and then poses with those velocities: they are the means over the step, half a step
// before the pose that they lead to. A body that nothing but known forces acted on (it flies) shows the twist of its
// pose's instant instead (BodyData::instant_twist), and a twist that is set is one of that instant, too.
#pragma once

#include <span>

#include "physics/detail/body_data.h"
#include "physics/detail/mean_turns.h"

namespace ambf::physics::detail {

// A pose after h at constant twist (m/s and rad/s, world axes), exactly.
btTransform moved(const btTransform& pose, const btVector3& linear, const btVector3& angular, double h);

// Before the rows of joints are made: replaces the twists by those that impulses of this step are added to, and
// predicts where the bodies go. Their joints are expected to turn them as they did in the last step. At most
// kTurnsAtOnce bodies; none knows of another.
void begin_motion(std::span<BodyData* const> bodies, double h);
// The mean angular velocity with which a body on joints turns in this step when the solver leaves it with `angular`:
// that of the impulses which it found for the rotation that was expected. rad/s, world axes.
btVector3 mean_turn_after(const BodyData& body, const btVector3& angular, double h);
// By how much more (rad/s, world axes) that is than `angular`, if it is worth another look: from kUnexpectedTurn on,
// and for a body that turns slowly (fast ones: joints/fast_turns.cpp). Else zero.
btVector3 unexpected_turn(const BodyData& body, const btVector3& angular, double h);
// After the solver: moves bodies by these shares of their ways (swept_motion.h), and shows the twists of the instant
// where they fly. At most kTurnsAtOnce.
struct EndingBody {
  BodyData* body;
  double share;
};
void end_motion(std::span<const EndingBody> bodies, double h);

}  // namespace ambf::physics::detail
