// The part of JointBlockSolver for joints whose bodies turn fast. A row is straight, the path of a point on a turning
// body is not: where it turns by the angle a in a step, a pivot at the lever r ends r a^2 / 2 beside its counterpart.
// Below kFastTurn the rows know that beforehand. What turns faster is looked at when all is solved: where the bodies
// will end the step, and by how much the rows are wrong there. That goes into their targets, and all is solved again, a
// few times: Newton's method with the Jacobian of the step's start, so that impulses stay along it (as in SHAKE:
// Ryckaert, Ciccotti and Berendsen 1977). What turns less is not touched, to the bit.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "physics/detail/free_motion.h"
#include "physics/joints/detail/solver_joint_rows.h"
#include "physics/joints/joint_block_solver.h"
#include "physics/joints/joint_rows.h"

namespace ambf::physics {

using detail::JointData;
using detail::JointGeometry;
using detail::Row;

namespace {

constexpr double kTooFar = 1.0;           // rad in a step: beyond, the iteration may not converge
constexpr double kStraightEnough = 1e-7;  // m or rad that a row is wrong by

}  // namespace

btVector3 JointBlockSolver::turning_after(int body) const {
  const btSolverBody& at_start = m_tmpSolverBodyPool[body];
  const double* change = bodies_[body].angular;
  return at_start.m_angularVelocity + at_start.m_externalTorqueImpulse + btVector3(change[0], change[1], change[2]);
}

btTransform JointBlockSolver::pose_after(const detail::BodyData& body, int id, double h) const {
  const btTransform& pose = body.rigid.getWorldTransform();
  if (body.rigid.isStaticObject()) return pose;
  const btSolverBody& at_start = m_tmpSolverBodyPool[id];
  const double* change = bodies_[id].linear;
  const btVector3 linear =
      at_start.m_linearVelocity + at_start.m_externalForceImpulse + btVector3(change[0], change[1], change[2]);
  return detail::moved(pose, linear, turning_after(id), h);
}

bool JointBlockSolver::bend_targets(int joint, JointData& data, double h) {
  const OrderedJoint& order = joints_[static_cast<std::size_t>(joint)];
  const int a = m_tmpSolverNonContactConstraintPool[order.first_row].m_solverBodyIdA;
  const int b = m_tmpSolverNonContactConstraintPool[order.first_row].m_solverBodyIdB;
  const double turn = h * std::sqrt(std::max(turning_after(a).length2(), turning_after(b).length2()));
  if (turn < detail::kFastTurn || turn > kTooFar) return false;
  if (data.parent.stiffened || data.child.stiffened) return false;
  const JointGeometry next(data, pose_after(data.parent, a, h), pose_after(data.child, b, h));
  bool bent = false;
  detail::LockRates missing;
  const int locked = data.missing_rates(next, h, missing);
  for (int r = 0; r < locked; ++r) {
    const double by_impulses = rate_by_impulses(data.constraint.rows[static_cast<std::size_t>(r)], a, b);
    const double rate = missing[static_cast<std::size_t>(r)];
    set_target(joint, r, rate + by_impulses);
    bent |= h * std::abs(rate) > kStraightEnough;
  }
  if (data.freedom != detail::Freedom::turn) return bent;
  // Limits: the angle does not change quite by what its row says, either, where the axis turns.
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const double way = detail::twist_angle(next.relative) - data.wrapped_coordinate();
  for (int r = data.constraint.first_limit; r < order.all_rows(); ++r) {
    const bool passed = r == order.rows;
    const Row& limit = passed ? data.constraint.far_limits.row : data.constraint.rows[static_cast<std::size_t>(r)];
    const double start = rate_at_start(limit, a, b), rate = start + rate_by_impulses(limit, a, b);
    const double beside = std::remainder(way - h * rate, kTurn) / h;
    const btSolverConstraint& pool = m_tmpSolverNonContactConstraintPool[order.pool_row(r)];
    set_target(joint, r, (passed ? pool.m_rhs : limit.target - start) - beside);
  }
  return bent;
}

bool JointBlockSolver::bend_targets(btTypedConstraint** constraints, const btContactSolverInfo& info) {
  bool any = false;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    JointData* data = joint_of(*constraints[joints_[j].constraint]);
    if (data == nullptr || joints_[j].rows == 0) continue;
    any |= bend_targets(static_cast<int>(j), *data, info.m_timeStep);
  }
  return any;
}

}  // namespace ambf::physics
