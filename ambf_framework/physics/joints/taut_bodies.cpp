// Geometric stiffness, implicitly. A force f that a joint exerts on a body at the lever r (both from the last step)
// resists the body's rotation d by the torque (d x r) x f = -((f.r) I - r f^T) d: a rope under tension is a row of
// stiff springs. Explicit, they are unstable from omega h = 2 on: forty links of 10 g that carry 100 kg have omega h =
// 5 in steps of 1 ms, and tear. Implicit, they add h^2 K to the inertia (Tournier et al. 2015, "Stable constrained
// dynamics", section 4; Andrews et al. 2017, "Geometric stiffness for real-time constrained multibody dynamics",
// section 4: of K its diagonal, and only where it is needed). Here a body is as inert as omega h = kStableTurn asks for
// and no more, so that mechanisms without such tension keep their bits, and ropes their motion as far as steps can show
// it.
#include <algorithm>
#include <cmath>

#include "physics/detail/world_data.h"

namespace ambf::physics::detail {
namespace {

constexpr double kStableTurn = 1.0;  // omega h

double smallest(const btVector3& v) { return std::min({v.x(), v.y(), v.z()}); }

}  // namespace

void BodyData::stiffen(double h) {
  if (is_static()) return;
  double most = 0.0;  // of |f| |r|
  for (const JointData* joint : joints) {
    const bool is_parent = &joint->parent == this;
    const btVector3& force = is_parent ? joint->feedback.m_appliedForceBodyA : joint->feedback.m_appliedForceBodyB;
    const btVector3& lever = (is_parent ? joint->frame_a : joint->frame_b).getOrigin();
    most += std::sqrt(force.length2() * lever.length2());
  }
  const double share = h * h / (kStableTurn * kStableTurn);
  if (most * share <= smallest(inertia) && !stiffened) return;
  btVector3 stiffness(0, 0, 0);  // the diagonal of K in the COM frame
  btVector3 pinned(0, 0, 0);     // what mass adds to the inertia, because the body turns about a fixed point
  for (const JointData* joint : joints) {
    const bool is_parent = &joint->parent == this;
    const btVector3& force_world =
        is_parent ? joint->feedback.m_appliedForceBodyA : joint->feedback.m_appliedForceBodyB;
    const btVector3& lever = (is_parent ? joint->frame_a : joint->frame_b).getOrigin();
    const btVector3 force = force_world * rigid.getWorldTransform().getBasis();
    const double along = force.dot(lever);
    for (int i = 0; i < 3; ++i) stiffness[i] += along - lever[i] * force[i];
    const bool pins = joint->freedom == Freedom::ball || joint->freedom == Freedom::turn;
    if (!pins || !(is_parent ? joint->child : joint->parent).is_static()) continue;
    for (int i = 0; i < 3; ++i)
      pinned[i] = std::max(pinned[i], (lever.length2() - lever[i] * lever[i]) / rigid.getInvMass());
  }
  // Equal about all axes that need it: a difference of moments that the body does not have would make it spin.
  const double needed = share * stiffness[stiffness.maxAxis()];
  const btVector3 before = rigid.getInvInertiaDiagLocal();
  btVector3 inverse, kept;  // what keeps the energy of rotation from growing with the inertia
  stiffened = false;
  for (int i = 0; i < 3; ++i) {
    const bool more = share * stiffness[i] > inertia[i] + pinned[i];
    stiffened |= more;
    inverse[i] = 1.0 / (more ? std::max(inertia[i], needed - pinned[i]) : inertia[i]);
    kept[i] = std::sqrt(std::min(1.0, inverse[i] / before[i]));
  }
  const btMatrix3x3& basis = rigid.getWorldTransform().getBasis();
  rigid.setAngularVelocity(basis * ((rigid.getAngularVelocity() * basis) * kept));
  rigid.setInvInertiaDiagLocal(inverse);
  rigid.updateInertiaTensor();
}

void BodyData::set_stiffness(const btVector3& inverse_inertia) {
  btVector3 inverse;
  for (int i = 0; i < 3; ++i) inverse[i] = std::min(inverse_inertia[i], 1.0 / inertia[i]);
  rigid.setInvInertiaDiagLocal(inverse);
  rigid.updateInertiaTensor();
  stiffened = true;
}

void BodyData::end_stiffness() {
  if (!stiffened) return;
  set_stiffness({SIMD_INFINITY, SIMD_INFINITY, SIMD_INFINITY});
  stiffened = false;
}

}  // namespace ambf::physics::detail
