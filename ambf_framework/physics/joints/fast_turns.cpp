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
#include "physics/detail/world_data.h"
#include "physics/joints/detail/mechanism.h"
#include "physics/joints/detail/solver_joint_rows.h"
#include "physics/joints/joint_block_solver.h"
#include "physics/joints/joint_rows.h"

namespace ambf::physics {

using detail::JointData;
using detail::JointGeometry;
using detail::Row;

namespace {

constexpr double kTooFar = 1.0;  // rad in a step: beyond, the iteration may not converge
constexpr double kTurn = 2.0 * std::numbers::pi;

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
  return detail::moved(pose, linear, detail::mean_turn_after(body, turning_after(id), h), h);
}

double JointBlockSolver::bend_targets(int joint, JointData& data, double h) {
  JointSystem& system = current_->system;
  OrderedJoint& order = joints_[static_cast<std::size_t>(joint)];
  const int a = order.solver_bodies[0], b = order.solver_bodies[1];
  const double turn = h * std::sqrt(std::max(turning_after(a).length2(), turning_after(b).length2()));
  // What new targets have slowed down is looked at on.
  if ((turn < detail::kFastTurn && !order.bent) || turn > kTooFar) return 0.0;
  // Ropes and threads are chains of balls, and tuned as they are (decision 0024): their rows count on what is expected,
  // but in parts of a step (step_parts.cpp), which are there because something turns too fast for that.
  const bool ball = data.freedom == detail::Freedom::ball || data.freedom == detail::Freedom::cone;
  if (ball && data.world->part == 1.0) return 0.0;
  order.bent = true;
  const JointGeometry next(data, pose_after(data.parent, a, h), pose_after(data.child, b, h));
  double error = 0.0;
  detail::LockRates missing;
  const int locked = data.missing_rates(next, h, missing);
  for (int r = 0; r < locked; ++r) {
    const double by_impulses = rate_by_impulses(data.constraint.rows[static_cast<std::size_t>(r)], a, b);
    const double rate = missing[static_cast<std::size_t>(r)];
    system.set_target(joint, r, rate + by_impulses);
    error = std::max(error, h * std::abs(rate));
  }
  const bool turns = data.freedom == detail::Freedom::turn;
  if (!turns && data.freedom != detail::Freedom::shift) return error;
  // Limits: the coordinate does not change quite by what its row says, either. A hinge's axis turns; what slides away
  // from a turning body is thrown off it along a tangent, which leads outwards.
  const Row axis = data.coordinate_row();
  const double rate = rate_at_start(axis, a, b) + rate_by_impulses(axis, a, b);
  const double end = next.coordinate(data.freedom);
  const double beside = end - data.wrapped_coordinate() - h * rate;
  order.beside = (turns ? std::remainder(beside, kTurn) : beside) / h;
  // A limit's row wants the coordinate to change by `wanted` at least (low), or at most (high).
  const auto bend_limit = [&](int r, double wanted, bool low, bool high) {
    system.set_target(joint, r, wanted - order.beside - rate_at_start(axis, a, b));
    const double missing_rate = wanted - (rate + order.beside);
    if (missing_rate > 0.0 ? low : high) error = std::max(error, h * std::abs(missing_rate));
  };
  for (int r = data.constraint.first_limit; r < order.rows; ++r) {
    const Row& limit = data.constraint.rows[static_cast<std::size_t>(r)];
    bend_limit(r, limit.target, limit.upper > 0.0, limit.lower < 0.0);
  }
  if (order.passed_row < 0) return error;
  const btSolverConstraint& passed = m_tmpSolverNonContactConstraintPool[order.passed_row];
  const bool low = passed.m_upperLimit > 0.0;
  const detail::FarLimits& far = data.constraint.far_limits;
  bend_limit(order.rows, low ? far.slowest : far.fastest, low, !low);
  return error;
}

double JointBlockSolver::bend_targets(const btContactSolverInfo& info) {
  double error = 0.0;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    JointData* data = joints_[j].data;
    if (data == nullptr || joints_[j].rows == 0) continue;
    error = std::max(error, bend_targets(static_cast<int>(j), *data, info.m_timeStep));
  }
  return error;
}

}  // namespace ambf::physics
