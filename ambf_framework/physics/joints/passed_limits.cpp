// The part of JointBlockSolver for limits that a joint would pass within the step although it was far from them at the
// step's start (JointConstraint::far_limits): a strong motor on a light link, an effort of a neighbour, a hit. They get
// rows, and all is solved again. Where none is passed nothing changes, to the bit.
#include "physics/joints/detail/solver_joint_rows.h"
#include "physics/joints/joint_block_solver.h"
#include "physics/joints/joint_data.h"

namespace ambf::physics {

using detail::FarLimits;
using detail::JointConstraint;
using detail::Row;

detail::JointData* joint_of(btTypedConstraint& constraint) {
  if (constraint.getUserConstraintType() != JointConstraint::kUserType) return nullptr;
  return static_cast<detail::JointData*>(constraint.getUserConstraintPtr());
}

const FarLimits* far_limits_of(const btTypedConstraint& constraint) {
  if (constraint.getUserConstraintType() != JointConstraint::kUserType) return nullptr;
  const FarLimits& far = static_cast<const JointConstraint&>(constraint).far_limits;
  return far.any() ? &far : nullptr;
}

double JointBlockSolver::rate_at_start(const Row& row, int body_a, int body_b) const {
  const btSolverBody &a = m_tmpSolverBodyPool[body_a], &b = m_tmpSolverBodyPool[body_b];
  return row.linear_a.dot(a.m_linearVelocity + a.m_externalForceImpulse) +
         row.angular_a.dot(a.m_angularVelocity + a.m_externalTorqueImpulse) +
         row.linear_b.dot(b.m_linearVelocity + b.m_externalForceImpulse) +
         row.angular_b.dot(b.m_angularVelocity + b.m_externalTorqueImpulse);
}

double JointBlockSolver::rate_by_impulses(const Row& row, int body_a, int body_b) const {
  const auto vector = [](const double* v) { return btVector3(v[0], v[1], v[2]); };
  const BodyDelta &a = bodies_[body_a], &b = bodies_[body_b];
  return row.linear_a.dot(vector(a.linear)) + row.angular_a.dot(vector(a.angular)) +
         row.linear_b.dot(vector(b.linear)) + row.angular_b.dot(vector(b.angular));
}

bool JointBlockSolver::add_passed_limits(btTypedConstraint** constraints) {
  bool any = false;
  for (OrderedJoint& joint : joints_) {
    if (joint.far_limits == nullptr || joint.rows == 0) continue;
    const FarLimits& far = *joint.far_limits;
    const auto [a, b] = joint.solver_bodies;
    const double start = rate_at_start(far.row, a, b), end = start + rate_by_impulses(far.row, a, b) + joint.beside;
    const bool below = end<far.slowest, above = end> far.fastest;
    if (!below && !above) continue;
    btSolverConstraint* row = nullptr;
    if (joint.passed_row < 0) {
      joint.passed_row = m_tmpSolverNonContactConstraintPool.size();
      row = &m_tmpSolverNonContactConstraintPool.expandNonInitializing();
    } else {
      row = &m_tmpSolverNonContactConstraintPool[joint.passed_row];
      // Held by its row, as exactly as the solution is.
      if (below ? row->m_upperLimit > 0.0 : row->m_lowerLimit < 0.0) continue;
    }
    row->m_originalContactPoint = constraints[joint.constraint];
    row->m_solverBodyIdA = a;
    row->m_solverBodyIdB = b;
    row->m_contactNormal1 = far.row.linear_a;
    row->m_relpos1CrossNormal = far.row.angular_a;
    row->m_contactNormal2 = far.row.linear_b;
    row->m_relpos2CrossNormal = far.row.angular_b;
    row->m_jacDiagABInv = 1.0;
    row->m_rhs = (below ? far.slowest : far.fastest) - joint.beside - start;
    row->m_cfm = far.row.softness;
    row->m_lowerLimit = below ? 0.0 : -SIMD_INFINITY;
    row->m_upperLimit = below ? SIMD_INFINITY : 0.0;
    row->m_appliedImpulse = row->m_appliedPushImpulse = 0.0;
    ++statistics_.passed_limits;
    any = true;
  }
  return any;
}

}  // namespace ambf::physics
