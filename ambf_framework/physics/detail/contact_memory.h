// What we keep with a contact point from step to step, in fields of Bullet's manifold points: every field that is
// ours is written and read here and nowhere else. Bullet itself keeps the impulses (m_appliedImpulse and the two
// lateral ones) and writes none of the others in contacts of rigid bodies that our algorithms make. Private to
// physics/. Physics thread.
#pragma once

#include "physics/detail/bullet.h"

namespace ambf::physics::detail {

// The impulse with which depth_push.h pushes the contact out of depth (Ns); its next push starts from it.
inline double push_impulse(const btManifoldPoint& point) { return point.m_prevRHS; }
inline void set_push_impulse(btManifoldPoint& point, double impulse) { point.m_prevRHS = impulse; }

// What the contact gave in bounces that were passed on (impacts.h) in the last step (Ns), beside m_appliedImpulse, from
// which the next step starts.
inline double passed_impulse(const btManifoldPoint& point) { return point.m_contactMotion1; }
inline void set_passed_impulse(btManifoldPoint& point, double impulse) { point.m_contactMotion1 = impulse; }

// The vertex of a mesh that found the contact; -1: none did.
struct FoundBy {
  int vertex = -1;
  bool of_a = true;  // the vertex is one of the first surface
};
inline FoundBy found_by(const btManifoldPoint& point) { return {point.m_index0, point.m_partId0 == 0}; }
inline void set_found_by(btManifoldPoint& point, const FoundBy& found) {
  point.m_index0 = found.vertex;
  point.m_partId0 = found.of_a ? 0 : 1;
}

// `to` continues the contact `from` of the step before: it starts from its impulses and its age.
inline void continue_contact(const btManifoldPoint& from, btManifoldPoint& to) {
  to.m_appliedImpulse = from.m_appliedImpulse;
  to.m_appliedImpulseLateral1 = from.m_appliedImpulseLateral1;
  to.m_appliedImpulseLateral2 = from.m_appliedImpulseLateral2;
  to.m_lifeTime = from.m_lifeTime;
  set_push_impulse(to, push_impulse(from));
}

}  // namespace ambf::physics::detail
