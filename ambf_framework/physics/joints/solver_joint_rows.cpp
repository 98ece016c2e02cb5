// The part of JointBlockSolver that loads rows of joints from Bullet's pools, and what mimics add to them.
#include "physics/joints/detail/solver_joint_rows.h"

#include <cmath>

#include "physics/joints/detail/solver_tools.h"
#include "physics/joints/joint_block_solver.h"

namespace ambf::physics {

using detail::MimicConstraint;

namespace {

// The place of a constraint's body in the elimination structure: its index in the world, which no allocator influences.
int structure_body(const btRigidBody& body) {
  const bool moves = body.getInvMass() != 0.0 && !body.isKinematicObject();
  return moves ? body.getWorldArrayIndex() : JointEnds::kNoBody;
}

const btVector3 kAllTurns(1, 1, 1);  // an angular factor that locks nothing

}  // namespace

const MimicConstraint* mimic_of(const btTypedConstraint& constraint) {
  const bool is_mimic = constraint.getUserConstraintType() == MimicConstraint::kUserType;
  return is_mimic ? static_cast<const MimicConstraint*>(&constraint) : nullptr;
}

JointEnds ends_of(const btTypedConstraint& constraint, int rows) {
  JointEnds ends{structure_body(constraint.getRigidBodyA()), structure_body(constraint.getRigidBodyB())};
  const MimicConstraint* mimic = mimic_of(constraint);
  if (mimic == nullptr) return ends;
  ends.ties_coordinates = true;
  if (rows == 0) return ends;  // its sides are not known
  const auto place = [&](const MimicConstraint::Side& side) {
    return side.body == nullptr ? JointEnds::kNoBody : structure_body(*side.body);
  };
  ends.body_c = place(mimic->sides()[2]);
  ends.body_d = place(mimic->sides()[3]);
  return ends;
}

// As Bullet's own convertJoint() does it, number for number, but straight from the rows of a joint of ours.
void JointBlockSolver::convert_joint(const detail::JointConstraint& joint, btSolverConstraint* to, int id_a, int id_b,
                                     const btContactSolverInfo& info) const {
  const btRigidBody &a = joint.getRigidBodyA(), &b = joint.getRigidBodyB();
  const btSolverBody &solver_a = m_tmpSolverBodyPool[id_a], &solver_b = m_tmpSolverBodyPool[id_b];
  const btVector3 linear_a = a.getLinearVelocity() + solver_a.m_externalForceImpulse;
  const btVector3 angular_a = a.getAngularVelocity() + solver_a.m_externalTorqueImpulse;
  const btVector3 linear_b = b.getLinearVelocity() + solver_b.m_externalForceImpulse;
  const btVector3 angular_b = b.getAngularVelocity() + solver_b.m_externalTorqueImpulse;
  const double most = joint.getBreakingImpulseThreshold();
  for (int i = 0; i < joint.row_count; ++i) {
    const detail::Row& row = joint.rows[static_cast<std::size_t>(i)];
    btSolverConstraint& out = to[i];
    out.m_contactNormal1 = row.linear_a;
    out.m_relpos1CrossNormal = row.angular_a;
    out.m_contactNormal2 = row.linear_b;
    out.m_relpos2CrossNormal = row.angular_b;
    const btVector3 turned_a = a.getInvInertiaTensorWorld() * row.angular_a;
    const btVector3 turned_b = b.getInvInertiaTensorWorld() * row.angular_b;
    out.m_angularComponentA = turned_a * a.getAngularFactor();
    out.m_angularComponentB = turned_b * b.getAngularFactor();
    double sum = (row.linear_a * a.getInvMass()).dot(row.linear_a);
    sum += turned_a.dot(row.angular_a);
    sum += (row.linear_b * b.getInvMass()).dot(row.linear_b);
    sum += turned_b.dot(row.angular_b);
    out.m_jacDiagABInv = std::fabs(sum) > SIMD_EPSILON ? 1.0 / sum : 0.0;
    const double rate_a = row.linear_a.dot(linear_a) + row.angular_a.dot(angular_a);
    const double rate_b = row.linear_b.dot(linear_b) + row.angular_b.dot(angular_b);
    const double missing = 0.0 - (rate_a + rate_b) * info.m_damping;
    out.m_rhs = row.target * out.m_jacDiagABInv + missing * out.m_jacDiagABInv;
    out.m_rhsPenetration = 0.0;
    out.m_cfm = row.softness;
    out.m_lowerLimit = row.lower <= -most ? -most : row.lower;
    out.m_upperLimit = row.upper >= most ? most : row.upper;
    out.m_appliedImpulse = out.m_appliedPushImpulse = 0.0;
    out.m_friction = 0.0;
    out.m_frictionIndex = 0;
    out.m_originalContactPoint = const_cast<detail::JointConstraint*>(&joint);
    out.m_overrideNumSolverIterations = info.m_numIterations;
    out.m_solverBodyIdA = id_a;
    out.m_solverBodyIdB = id_b;
  }
}

void JointBlockSolver::convertJoints(btTypedConstraint** constraints, int constraint_count,
                                     const btContactSolverInfo& info) {
  if (!options_.direct) {
    btSequentialImpulseConstraintSolver::convertJoints(constraints, constraint_count, info);
    return;
  }
  m_tmpConstraintSizesPool.resizeNoInitialize(constraint_count);
  int rows = 0;
  for (int i = 0; i < constraint_count; ++i) {
    btTypedConstraint& constraint = *constraints[i];
    constraint.buildJacobian();
    constraint.internalSetAppliedImpulse(0.0);
    if (btJointFeedback* feedback = constraint.getJointFeedback()) {
      feedback->m_appliedForceBodyA.setZero();
      feedback->m_appliedTorqueBodyA.setZero();
      feedback->m_appliedForceBodyB.setZero();
      feedback->m_appliedTorqueBodyB.setZero();
    }
    btTypedConstraint::btConstraintInfo1& size = m_tmpConstraintSizesPool[i];
    size.m_numConstraintRows = size.nub = 0;
    if (constraint.isEnabled()) constraint.getInfo1(&size);
    rows += size.m_numConstraintRows;
  }
  m_tmpSolverNonContactConstraintPool.resizeNoInitialize(rows);
  int row = 0;
  for (int i = 0; i < constraint_count; ++i) {
    btTypedConstraint& constraint = *constraints[i];
    const btTypedConstraint::btConstraintInfo1& size = m_tmpConstraintSizesPool[i];
    if (size.m_numConstraintRows == 0) continue;
    const int a = getOrInitSolverBody(constraint.getRigidBodyA(), info.m_timeStep);
    const int b = getOrInitSolverBody(constraint.getRigidBodyB(), info.m_timeStep);
    btSolverConstraint* to = &m_tmpSolverNonContactConstraintPool[row];
    if (const detail::JointData* joint = joint_of(constraint)) {
      convert_joint(joint->constraint, to, a, b, info);
    } else {
      convertJoint(to, &constraint, size, a, b, info);
    }
    row += size.m_numConstraintRows;
  }
}

std::array<int, kMaxSides> JointBlockSolver::moving_sides(const OrderedJoint& joint) const {
  const auto& first = m_tmpSolverNonContactConstraintPool[joint.first_row];
  const std::array<int, kMaxSides> places = joint.ends.bodies();
  std::array<int, kMaxSides> ids{first.m_solverBodyIdA, first.m_solverBodyIdB, -1, -1};
  for (int s = kSidesOfJoints; s < kMaxSides; ++s) {
    if (places[s] >= 0) ids[s] = joint.mimic->sides()[s].body->getCompanionId();
  }
  for (int s = 0; s < kMaxSides; ++s) {
    // What the structure does not count as moving (a body outside the world) must not move here either.
    const bool known = ids[s] >= 0 && ids[s] < m_tmpSolverBodyPool.size();
    if (places[s] < 0 || !known || !is_movable(ids[s])) ids[s] = -1;
  }
  return ids;
}

JointRow JointBlockSolver::row_of(const OrderedJoint& joint, int pool_row,
                                  const std::array<int, kMaxSides>& sides) const {
  const btSolverConstraint& from = m_tmpSolverNonContactConstraintPool[pool_row];
  JointRow row;
  const auto put = [&row](int s, const btVector3& linear, const btVector3& angular, const btVector3& linear_response,
                          const btVector3& angular_response) {
    copy3(row.jacobian + 6 * s, linear);
    copy3(row.jacobian + 6 * s + 3, angular);
    copy3(row.response + 6 * s, linear_response);
    copy3(row.response + 6 * s + 3, angular_response);
  };
  const auto fill = [&](int s, const btVector3& linear, const btVector3& angular) {
    if (sides[s] < 0) return put(s, linear, angular, {0, 0, 0}, {0, 0, 0});
    const btSolverBody& body = m_tmpSolverBodyPool[sides[s]];
    const btVector3& factor = body.m_angularFactor;
    put(s, linear, angular, linear * body.m_invMass,
        body.m_originalBody->getInvInertiaTensorWorld() * (angular * factor) * factor);
  };
  // What convertJoints() found already, but for rows that came later.
  const auto take = [&](int s, const btVector3& linear, const btVector3& angular, const btVector3& angular_response) {
    if (sides[s] < 0 || pool_row == joint.passed_row || m_tmpSolverBodyPool[sides[s]].m_angularFactor != kAllTurns)
      return fill(s, linear, angular);
    put(s, linear, angular, linear * m_tmpSolverBodyPool[sides[s]].m_invMass, angular_response);
  };
  take(0, from.m_contactNormal1, from.m_relpos1CrossNormal, from.m_angularComponentA);
  take(1, from.m_contactNormal2, from.m_relpos2CrossNormal, from.m_angularComponentB);
  row.target = from.m_jacDiagABInv != 0.0 ? from.m_rhs / from.m_jacDiagABInv : 0.0;
  row.softness = from.m_cfm;
  row.bounds = {from.m_lowerLimit, from.m_upperLimit};
  if (joint.mimic == nullptr) return row;
  for (int s = kSidesOfJoints; s < kMaxSides; ++s) {
    const MimicConstraint::Side& side = joint.mimic->sides()[s];
    fill(s, side.linear, side.angular);
    // Bullet took the velocities of the first two off the target.
    if (sides[s] >= 0) {
      const btSolverBody& body = m_tmpSolverBodyPool[sides[s]];
      row.target -= side.linear.dot(body.m_linearVelocity + body.m_externalForceImpulse) +
                    side.angular.dot(body.m_angularVelocity + body.m_externalTorqueImpulse);
    } else if (side.body != nullptr) {
      row.target -= side.linear.dot(side.body->getLinearVelocity()) + side.angular.dot(side.body->getAngularVelocity());
    }
  }
  return row;
}

}  // namespace ambf::physics
