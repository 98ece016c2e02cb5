// The part of JointBlockSolver that loads rows of joints from Bullet's pools, and what mimics add to them.
#include "physics/joints/detail/solver_joint_rows.h"

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
  const auto fill = [&](int s, const btVector3& linear, const btVector3& angular) {
    btVector3 linear_response(0, 0, 0), angular_response(0, 0, 0);
    if (sides[s] >= 0) {
      const btSolverBody& body = m_tmpSolverBodyPool[sides[s]];
      const btVector3& factor = body.m_angularFactor;
      linear_response = linear * body.m_invMass;
      angular_response = body.m_originalBody->getInvInertiaTensorWorld() * (angular * factor) * factor;
    }
    copy3(row.jacobian + 6 * s, linear);
    copy3(row.jacobian + 6 * s + 3, angular);
    copy3(row.response + 6 * s, linear_response);
    copy3(row.response + 6 * s + 3, angular_response);
  };
  fill(0, from.m_contactNormal1, from.m_relpos1CrossNormal);
  fill(1, from.m_contactNormal2, from.m_relpos2CrossNormal);
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
