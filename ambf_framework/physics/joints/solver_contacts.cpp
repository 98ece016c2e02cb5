// The part of JointBlockSolver that takes contacts over from Bullet.
#include <algorithm>

#include "physics/detail/contact_memory.h"
#include "physics/joints/detail/solver_tools.h"
#include "physics/joints/joint_block_solver.h"

namespace ambf::physics {
namespace {

// Ratios of two bodies' masses: from kHeavy on there are more sweeps, in proportion beyond what the usual ones hold up.
constexpr double kHeavy = 200.0, kHeldByFewSweeps = 20.0;
constexpr double kMaxMoreSweeps = 50.0;
constexpr double kMaxRowVisits = 1e4;  // of an island in a step: some 1 ms
constexpr double kMaxPushSpeed = 0.8;  // m/s, at which depth is pushed out in a step
// New points come to an even load within some dozen steps; what statics makes uneven about it they hold ever stiffer.
constexpr double kEvening = 0.3;
constexpr double kEveningSteps = 30.0;
// m/s that the mass of a whole island gets from the impulse that a contact may start with, without joints and with
// their motors: far more than weights and presses come to in a step.
constexpr double kMaxWarmStart = 20.0, kMaxWarmStartOfMotors = 200.0;

}  // namespace

// How often loose bodies meet here. docs/solver.md says what the three starts are for; the numbers were found by
// trial on straight and leaning towers of up to ten boxes.
JointBlockSolver::WarmStart JointBlockSolver::choose_warm_start() const {
  constexpr int kHighPile = 4;
  int meetings = 0;
  int last_a = -1;
  int last_b = -1;
  for (int i = 0; i < m_tmpSolverContactConstraintPool.size(); ++i) {
    const btSolverConstraint& row = m_tmpSolverContactConstraintPool[i];
    const int a = row.m_solverBodyIdA;
    const int b = row.m_solverBodyIdB;
    if (a == last_a && b == last_b) continue;
    last_a = a;
    last_b = b;
    const auto loose = [this](int id) { return is_movable(id) && (current_ == nullptr || component_of_body_[id] < 0); };
    if (loose(a) && loose(b)) ++meetings;
  }
  if (meetings <= 1) return {1.0, 1.0, true};
  if (meetings < kHighPile) return {1.0, 0.0, false};
  return {0.95, 0.95, false};
}

// Ns. Contacts that contradict each other (a needle between a mat and a board that leave it less room than it takes)
// press harder in each step than in the last; without a bound, 80 s of it threw the needle at 135 m/s once one of
// twenty contacts went away.
double JointBlockSolver::max_warm_start() const {
  double mass = 0.0;
  for (int id = 0; id < m_tmpSolverBodyPool.size(); ++id) {
    if (is_movable(id)) mass += 1.0 / m_tmpSolverBodyPool[id].m_originalBody->getInvMass();
  }
  return mass * (current_ == nullptr ? kMaxWarmStart : kMaxWarmStartOfMotors);
}

// What to add to the velocity that Bullet asks of a contact that bounces but does not touch yet. Bullet asks for the
// bounce less the speed at which the gap may close, so that bodies brake before they touch and hardly bounce where
// steps are short. Here the bounce comes, whole, in the step in which the gap would close.
double JointBlockSolver::bounce_correction(const btSolverConstraint& row, const btContactSolverInfo& info,
                                           BouncingRow& bouncing) {
  const auto& point = *static_cast<const btManifoldPoint*>(row.m_originalContactPoint);
  const btSolverBody& a = m_tmpSolverBodyPool[row.m_solverBodyIdA];
  const btSolverBody& b = m_tmpSolverBodyPool[row.m_solverBodyIdB];
  const auto along_row = [&row](const btVector3& linear_a, const btVector3& angular_a, const btVector3& linear_b,
                                const btVector3& angular_b) {
    return row.m_contactNormal1.dot(linear_a) + row.m_relpos1CrossNormal.dot(angular_a) +
           row.m_contactNormal2.dot(linear_b) + row.m_relpos2CrossNormal.dot(angular_b);
  };
  const double now = along_row(a.m_linearVelocity, a.m_angularVelocity, b.m_linearVelocity, b.m_angularVelocity);
  const double by_forces = along_row(a.m_externalForceImpulse, a.m_externalTorqueImpulse, b.m_externalForceImpulse,
                                     b.m_externalTorqueImpulse);
  const double bounce =
      std::max(0.0, restitutionCurve(now, point.m_combinedRestitution, info.m_restitutionVelocityThreshold));
  bouncing.restitution = point.m_combinedRestitution;
  bouncing.start_velocity = now + by_forces;
  bouncing.gap = point.getDistance() + info.m_linearSlop;
  bouncing.bounce = bounce;
  if (!(bouncing.gap > 0.0) || !(bounce > 0.0)) return 0.0;
  const bool touches = bouncing.start_velocity * info.m_timeStep + bouncing.gap <= 0.0;
  if (touches) return bouncing.gap / info.m_timeStep;
  bouncing.bounce = 0.0;
  return -bounce;
}

// What the step's torques alone make of a row's velocity. Bullet counts it for normals, and forgets it for friction:
// what a torque turns would then turn on at the speed that it gains in a step, whatever the friction.
double JointBlockSolver::turned_by_torques(const btSolverConstraint& row) const {
  return row.m_relpos1CrossNormal.dot(m_tmpSolverBodyPool[row.m_solverBodyIdA].m_externalTorqueImpulse) +
         row.m_relpos2CrossNormal.dot(m_tmpSolverBodyPool[row.m_solverBodyIdB].m_externalTorqueImpulse);
}

void JointBlockSolver::pass_on_impacts(const btContactSolverInfo& info) {
  impacts_.pass_on(contacts_, bodies_.data(), info.m_timeStep, info.m_restitutionVelocityThreshold,
                   [this] { return !any_touched_ || solve_joints(true); });
}

// A sweep brings what a heavy body presses on a light one nearer to its end by about the share light / heavy, so that
// 10 of them hold up a hundredfold mass, but let one of 1000 times the mass sink in and slide off. Not for islands
// with joints: each of their sweeps solves the joints, too.
int JointBlockSolver::max_sweeps(const btContactSolverInfo& info) {
  double ratio = 1.0;
  for (const NormalRow& normal : contacts_.normals()) {
    if (normal.body_a < 0 || normal.body_b < 0) continue;
    const double a = bodies_[normal.body_a].inverse_mass[0], b = bodies_[normal.body_b].inverse_mass[0];
    ratio = std::max(ratio, a > b ? a / b : b / a);
  }
  if (ratio < kHeavy) return info.m_numIterations;
  const double wanted = info.m_numIterations * std::min(ratio / kHeldByFewSweeps, kMaxMoreSweeps);
  const double affordable = kMaxRowVisits / static_cast<double>(contacts_.normals().size());
  return std::max(info.m_numIterations, static_cast<int>(std::min(wanted, affordable)));
}

void JointBlockSolver::load_contacts(const btContactSolverInfo& info) {
  contacts_.clear();
  impacts_.clear();
  const bool two_directions = (info.m_solverMode & SOLVER_USE_2_FRICTION_DIRECTIONS) != 0;
  const bool steady_directions = (info.m_solverMode & SOLVER_DISABLE_VELOCITY_DEPENDENT_FRICTION_DIRECTION) != 0;
  start_ = choose_warm_start();
  const bool warm = (info.m_solverMode & SOLVER_USE_WARMSTARTING) != 0;
  const double max_start = max_warm_start();
  const double friction_start = warm && two_directions && steady_directions ? start_.friction : 0.0;
  const auto pack = [](const btSolverConstraint& from, ContactRow& to) {
    // One body may be immovable; its normal is zero then.
    const btVector3 axis = from.m_contactNormal1.isZero() ? -from.m_contactNormal2 : from.m_contactNormal1;
    copy3(to.axis, axis);
    copy3(to.angular_a, from.m_relpos1CrossNormal);
    copy3(to.response_a, from.m_angularComponentA);
    copy3(to.angular_b, from.m_relpos2CrossNormal);
    copy3(to.response_b, from.m_angularComponentB);
    to.target = from.m_rhs;
    to.inverse_diagonal = from.m_jacDiagABInv;
    to.softness = from.m_cfm;
    to.impulse = from.m_appliedImpulse;
  };
  const auto body = [this](int id) { return is_movable(id) ? id : -1; };
  for (int i = 0; i < m_tmpSolverContactConstraintPool.size(); ++i) {
    const btSolverConstraint& from = m_tmpSolverContactConstraintPool[i];
    NormalRow& normal = contacts_.normals().emplace_back();
    pack(from, normal);
    const auto* point = static_cast<const btManifoldPoint*>(from.m_originalContactPoint);
    if (point->m_combinedRestitution > 0.0) {
      BouncingRow& bouncing = impacts_.rows().emplace_back();
      normal.target += bounce_correction(from, info, bouncing) * normal.inverse_diagonal;
      bouncing.normal = i;
      bouncing.pair =
          static_cast<std::uint64_t>(from.m_solverBodyIdA) << 32 | static_cast<std::uint32_t>(from.m_solverBodyIdB);
    }
    normal.body_a = body(from.m_solverBodyIdA);
    normal.body_b = body(from.m_solverBodyIdB);
    normal.push = std::min<double>(kPushInterval * from.m_rhsPenetration, kMaxPushSpeed * normal.inverse_diagonal);
    normal.push_impulse = detail::push_impulse(*point);
    if (current_ != nullptr) {
      const double age = point->getLifeTime() / kEveningSteps;
      normal.evening = kEvening / (1.0 + age * age);
    }
    FrictionRows& friction = contacts_.frictions().emplace_back();
    friction.body_a = normal.body_a;
    friction.body_b = normal.body_b;
    friction.normal = i;
    friction.count = two_directions ? 2 : 1;
    friction.coefficient = from.m_friction;
    const double started = normal.impulse;  // convertContacts() has started with all of it
    const double share = warm ? std::min(start_.normal, started > max_start ? max_start / started : 1.0) : 1.0;
    if (share < 1.0) {
      const double less = (share - 1.0) * started;
      normal.impulse += less;
      ContactSystem::apply(normal, less, normal.body_a, normal.body_b, bodies_.data());
    }
    for (int d = 0; d < friction.count; ++d) {
      ContactRow& row = friction.direction[d];
      const btSolverConstraint& lateral = m_tmpSolverContactFrictionConstraintPool[from.m_frictionIndex + d];
      pack(lateral, row);
      row.target -= turned_by_torques(lateral) * row.inverse_diagonal;
      if (friction_start == 0.0) continue;
      row.impulse = std::min(friction_start, share) *
                    (d == 0 ? point->m_appliedImpulseLateral1 : point->m_appliedImpulseLateral2);
      ContactSystem::apply(row, row.impulse, friction.body_a, friction.body_b, bodies_.data());
    }
    if (friction.count == 1) friction.direction[1] = {};
    ContactSystem::couple(friction, bodies_.data());
  }
  if (current_ != nullptr) contacts_.even_out();
  for (int i = 0; i < m_tmpSolverContactRollingFrictionConstraintPool.size(); ++i) {
    const btSolverConstraint& from = m_tmpSolverContactRollingFrictionConstraintPool[i];
    RollingRow& row = contacts_.rollings().emplace_back();
    pack(from, row);
    row.body_a = body(from.m_solverBodyIdA);
    row.body_b = body(from.m_solverBodyIdB);
    row.normal = from.m_frictionIndex;
    row.coefficient = from.m_friction;
    row.target -= turned_by_torques(from) * row.inverse_diagonal;
  }
}

}  // namespace ambf::physics
