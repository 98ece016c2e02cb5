// The part of JointBlockSolver that loads rows of joints from Bullet's pools, and what mimics add to them.
#include "physics/joints/detail/solver_joint_rows.h"

#include <cmath>

#include "physics/detail/lanes.h"
#include "physics/joints/detail/mechanism.h"
#include "physics/joints/detail/solver_tools.h"
#include "physics/joints/joint_block_solver.h"
#include "physics/joints/joint_rows.h"

namespace ambf::physics {

using detail::MimicConstraint;

namespace {

// The place of a constraint's body in the elimination structure: its index in the world, which no allocator influences.
int structure_body(const btRigidBody& body) {
  const bool moves = body.getInvMass() != 0.0 && !body.isKinematicObject();
  return moves ? body.getWorldArrayIndex() : JointEnds::kNoBody;
}

const detail::Row kNoRow = detail::angular_row({0.0, 0.0, 0.0});  // beside the last one of an odd number

AMBF_INLINED Pair both(double value) { return Pair{value, value}; }

// A vector of each of two rows.
struct Pair3 {
  Pair x, y, z;
};
AMBF_INLINED Pair3 lanes(const btVector3& first, const btVector3& second) {
  return {Pair{first.x(), second.x()}, Pair{first.y(), second.y()}, Pair{first.z(), second.z()}};
}
AMBF_INLINED Pair3 both(const btVector3& v) { return {both(v.x()), both(v.y()), both(v.z())}; }
AMBF_INLINED Pair3 operator*(const Pair3& a, const Pair3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
AMBF_INLINED Pair sum(const Pair3& v) { return v.x + v.y + v.z; }

// Of two rows: J M^-1 J^T in Bullet's order of summands, and in ours of the bodies that move; J v at the step's start.
struct RowSums {
  Pair inertia{0.0, 0.0}, diagonal{0.0, 0.0}, rate{0.0, 0.0};
};

// A body of a joint as its rows see it, each number in both lanes. (Bodies of ours lock no axis by Bullet's factors.)
struct RowSide {
  AMBF_INLINED RowSide(const btRigidBody& body, const btSolverBody& solver_body, bool is_moved)
      : inverse_mass(both(body.getInvMass())),
        linear_velocity(both(body.getLinearVelocity() + solver_body.m_externalForceImpulse)),
        angular_velocity(both(body.getAngularVelocity() + solver_body.m_externalTorqueImpulse)),
        moved(is_moved) {
    for (int i = 0; i < 3; ++i) inverse_inertia[i] = both(body.getInvInertiaTensorWorld()[i]);
  }

  // Six columns of two rows; `ld` numbers apart. shifts: false where their linear parts are zero.
  AMBF_INLINED void put(const Pair3& linear, const Pair3& angular, bool shifts, double* jacobian, double* response,
                        int ld, RowSums& sums) const {
    const auto put3 = [ld](double* to, const Pair3& values) AMBF_INLINED_LAMBDA {
      *reinterpret_cast<Pair*>(to) = values.x;
      *reinterpret_cast<Pair*>(to + ld) = values.y;
      *reinterpret_cast<Pair*>(to + 2 * ld) = values.z;
    };
    const Pair3 zero{both(0.0), both(0.0), both(0.0)};
    const Pair3 turned{sum(inverse_inertia[0] * angular), sum(inverse_inertia[1] * angular),
                       sum(inverse_inertia[2] * angular)};
    const Pair3 of_angular = turned * angular;
    Pair rate = both(0.0);
    put3(jacobian, shifts ? linear : zero);
    put3(jacobian + 3 * ld, angular);
    put3(response + 3 * ld, moved ? turned : zero);
    if (shifts) {
      const Pair3 pushed{linear.x * inverse_mass, linear.y * inverse_mass, linear.z * inverse_mass};
      const Pair3 of_linear = pushed * linear;
      sums.inertia += sum(of_linear);
      if (moved) sums.diagonal = sums.diagonal + of_linear.x + of_linear.y + of_linear.z;
      rate = sum(linear * linear_velocity);
      put3(response, moved ? pushed : zero);
    } else {
      put3(response, zero);
    }
    sums.inertia += sum(of_angular);
    if (moved) sums.diagonal = sums.diagonal + of_angular.x + of_angular.y + of_angular.z;
    sums.rate += rate + sum(angular * angular_velocity);
  }

  Pair3 inverse_inertia[3];
  Pair inverse_mass;
  Pair3 linear_velocity, angular_velocity;  // with what the forces of the step give
  bool moved;
};

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
  joint_rows_ = rows;
  solver_bodies_.resize(static_cast<std::size_t>(constraint_count));
  m_tmpSolverNonContactConstraintPool.resizeNoInitialize(0);
  for (int i = 0; i < constraint_count; ++i) {
    btTypedConstraint& constraint = *constraints[i];
    const btTypedConstraint::btConstraintInfo1& size = m_tmpConstraintSizesPool[i];
    if (size.m_numConstraintRows == 0) continue;
    const int a = getOrInitSolverBody(constraint.getRigidBodyA(), info.m_timeStep);
    const int b = getOrInitSolverBody(constraint.getRigidBodyB(), info.m_timeStep);
    solver_bodies_[static_cast<std::size_t>(i)] = {a, b};
    if (joint_of(constraint) != nullptr) continue;  // load_joint() takes its rows as they are
    const int first = m_tmpSolverNonContactConstraintPool.size();
    m_tmpSolverNonContactConstraintPool.resize(first + size.m_numConstraintRows);
    convertJoint(&m_tmpSolverNonContactConstraintPool[first], &constraint, size, a, b, info);
  }
}

std::array<int, kMaxSides> JointBlockSolver::moving_sides(const OrderedJoint& joint) const {
  const std::array<int, kMaxSides> places = joint.ends.bodies();
  std::array<int, kMaxSides> ids{joint.solver_bodies[0], joint.solver_bodies[1], -1, -1};
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

// What Bullet's convertJoint() would make of the rows of a joint of ours, number for number, straight into the system:
// two rows at a time, as the lanes of vectors.
AMBF_INLINED void JointBlockSolver::load_joint(int joint, const std::array<int, kMaxSides>& sides,
                                               const btContactSolverInfo& info) {
  const OrderedJoint& order = joints_[static_cast<std::size_t>(joint)];
  const detail::JointConstraint& constraint = order.data->constraint;
  const auto side = [&](int s, const btRigidBody& body) AMBF_INLINED_LAMBDA {
    return RowSide(body, m_tmpSolverBodyPool[order.solver_bodies[static_cast<std::size_t>(s)]],
                   sides[static_cast<std::size_t>(s)] >= 0);
  };
  const RowSide a = side(0, constraint.getRigidBodyA()), b = side(1, constraint.getRigidBodyB());
  const JointSystem::Place place = current_->system.place_of(joint);
  const double most = constraint.getBreakingImpulseThreshold();
  for (int r = 0; r < order.rows; r += 2) {
    const detail::Row& first = constraint.rows[static_cast<std::size_t>(r)];
    const detail::Row& second = r + 1 < order.rows ? constraint.rows[static_cast<std::size_t>(r) + 1] : kNoRow;
    RowSums sums;
    const bool shifts = first.shifts || second.shifts;
    double *const jacobian = place.jacobian + r, *const response = place.response + r;
    a.put(lanes(first.linear_a, second.linear_a), lanes(first.angular_a, second.angular_a), shifts, jacobian, response,
          place.ld, sums);
    b.put(lanes(first.linear_b, second.linear_b), lanes(first.angular_b, second.angular_b), shifts,
          jacobian + 6 * place.ld, response + 6 * place.ld, place.ld, sums);
    const Pair missing = Pair{0.0, 0.0} - sums.rate * both(info.m_damping);
    for (int lane = 0; lane < 2 && r + lane < order.rows; ++lane) {
      const detail::Row& row = lane == 0 ? first : second;
      const double inverse = std::fabs(sums.inertia[lane]) > SIMD_EPSILON ? 1.0 / sums.inertia[lane] : 0.0;
      const double impulse = row.target * inverse + missing[lane] * inverse;
      const RowBounds bounds{row.lower <= -most ? -most : row.lower, row.upper >= most ? most : row.upper};
      current_->system.finish_row(place, r + lane, sums.diagonal[lane], inverse != 0.0 ? impulse / inverse : 0.0,
                                  row.softness, bounds, row.shifts);
    }
  }
}

AMBF_WIDE void JointBlockSolver::load_joint_wide(int joint, const std::array<int, kMaxSides>& sides,
                                                 const btContactSolverInfo& info) {
  load_joint(joint, sides, info);
}

void JointBlockSolver::load_rows(int joint, const btContactSolverInfo& info) {
  const OrderedJoint& order = joints_[static_cast<std::size_t>(joint)];
  if (order.rows == 0) return;
  JointSystem& system = current_->system;
  const std::array<int, kMaxSides> sides = moving_sides(order);
  system.set_bodies(joint, sides);
  const int component = current_->structure.component_of(current_->structure.position_of(joint));
  for (const int body : sides)
    if (body >= 0) component_of_body_[static_cast<std::size_t>(body)] = component;
  if (order.data != nullptr)
    options_.joints.wide ? load_joint_wide(joint, sides, info) : load_joint(joint, sides, info);
  for (int r = order.data != nullptr ? order.rows : 0; r < order.all_rows(); ++r)
    system.set_row(joint, r, row_of(order, order.pool_row(r), sides));
}

// As Bullet's own writeBackJoints() does it, number for number, for a joint of ours.
void JointBlockSolver::write_back_joint(int joint, double h) {
  const OrderedJoint& order = joints_[static_cast<std::size_t>(joint)];
  detail::JointConstraint& constraint = order.data->constraint;
  btJointFeedback& feedback = order.data->feedback;
  const double per_step = 1.0 / h;
  for (int r = 0; r < order.rows; ++r) {
    const detail::Row& row = constraint.rows[static_cast<std::size_t>(r)];
    const double impulse = current_->system.impulse(joint, r);
    if (row.shifts) {
      feedback.m_appliedForceBodyA += row.linear_a * impulse * per_step;
      feedback.m_appliedForceBodyB += row.linear_b * impulse * per_step;
    }
    feedback.m_appliedTorqueBodyA += row.angular_a * impulse * per_step;
    feedback.m_appliedTorqueBodyB += row.angular_b * impulse * per_step;
    constraint.internalSetAppliedImpulse(impulse);
    if (std::fabs(impulse) >= constraint.getBreakingImpulseThreshold()) constraint.setEnabled(false);
  }
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
