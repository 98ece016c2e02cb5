// The step of a soft body of links. Private to physics/soft/. Physics thread.
#pragma once

#include <cstddef>

#include "physics/detail/bullet.h"

namespace ambf::physics::detail {

struct BodyData;
struct SoftData;

// As btSoftColliders::CollideSDF_RS makes it, from an exact distance (m, margin taken off) along a normal (world).
void add_contact(SoftData& data, std::size_t node, BodyData& body, const btVector3& normal, double distance);
// btSoftBody::solveConstraints() of a plain body, with the springs of held nodes among its links. `h`: the length of
// the step, s.
void solve_plain(SoftData& data, double h);

}  // namespace ambf::physics::detail
