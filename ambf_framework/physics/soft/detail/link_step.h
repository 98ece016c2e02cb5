// The step of a soft body of links. Private to physics/soft/. Physics thread.
#pragma once

#include "physics/detail/bullet.h"

namespace ambf::physics::detail {

struct BodyData;
struct SoftData;
struct TissueData;

// Of nodes with a shape of a body (links/link_contacts.cpp).
void add_contacts(SoftData& data, BodyData& body, const btCollisionShape& shape, const btTransform& pose);
// btSoftBody::solveConstraints() of a plain body, with the springs of held nodes among its links. `h`: the length of
// the step, s.
void solve_plain(SoftData& data, double h);

// Contacts of nodes with the tissue's surface, which is a wall that moves as it does now, and gives way as its mass
// lets it (link_touch.cpp).
void lay_on(SoftData& links, TissueData& tissue);
// What they did in the last step, before the passes of the solver over them; and one of these.
void push_as_before(SoftData& links);
void push_on_tissue(SoftData& links);
// What they gave the tissue is a force of its step of `h` seconds.
void press(const SoftData& links, TissueData& tissue, double h);

}  // namespace ambf::physics::detail
