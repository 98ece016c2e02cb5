#include "physics/joints/joint_block_solver.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>

#include "physics/detail/contact_memory.h"
#include "physics/joints/detail/mechanism.h"
#include "physics/joints/detail/solver_joint_rows.h"
#include "physics/joints/detail/solver_tools.h"
#include "physics/joints/detail/stopwatch.h"

namespace ambf::physics {
namespace {

constexpr std::size_t kUsualMechanisms = 64;
constexpr int kMaxRowVisits = 100'000;  // of joints, by all sweeps of an island in a step: some 50 ms
constexpr int kFewestSweeps = 4;
constexpr double kSlowestPush = 2e-5;  // m/s: half a micrometre of depth may stay

}  // namespace

JointBlockSolver::JointBlockSolver(const JointBlockOptions& options) : options_(options) {
  mechanisms_.reserve(kUsualMechanisms);
}

JointBlockSolver::~JointBlockSolver() = default;

void JointBlockSolver::reset() {
  btSequentialImpulseConstraintSolver::reset();
  mechanisms_.clear();
  current_ = nullptr;
  call_ = 0;
}

void JointBlockSolver::set_options(const JointBlockOptions& options) {
  options_ = options;
  reset();
}

void JointBlockSolver::load_bodies() {
  const int count = m_tmpSolverBodyPool.size();
  bodies_.resize(count);
  movable_.resize(count);
  for (int i = 0; i < count; ++i) {
    const btSolverBody& from = m_tmpSolverBodyPool[i];
    BodyDelta& to = bodies_[i];
    const btRigidBody* body = from.m_originalBody;
    movable_[i] = body != nullptr && body->getInvMass() != 0.0 && !body->isKinematicObject();
    copy3(to.linear, from.m_deltaLinearVelocity);
    copy3(to.angular, from.m_deltaAngularVelocity);
    copy3(to.inverse_mass, from.m_invMass);
  }
}

// Bullet's own conversion, with a full warm start and a gentle push out of depth: docs/solver.md says why they belong
// together.
void JointBlockSolver::convertContacts(btPersistentManifold** manifolds, int manifold_count,
                                       const btContactSolverInfo& info) {
  if (!options_.direct) {
    btSequentialImpulseConstraintSolver::convertContacts(manifolds, manifold_count, info);
    return;
  }
  btContactSolverInfo ours = info;
  ours.m_warmstartingFactor = 1.0;
  ours.m_erp2 = std::min(info.m_erp2, options_.contact_rate * info.m_timeStep);
  if (has_joints()) {
    // The push out of depth apart from the rest of each row's target: push_out() does it.
    ours.m_splitImpulse = 1;
    ours.m_splitImpulsePenetrationThreshold = BT_LARGE_FLOAT;
  }
  btSequentialImpulseConstraintSolver::convertContacts(manifolds, manifold_count, ours);
}

bool JointBlockSolver::load_joints(btTypedConstraint** constraints, int constraint_count,
                                   const btContactSolverInfo& info) {
  current_ = nullptr;
  if (!has_joints()) return false;
  joints_.clear();
  int row = 0;
  for (int i = 0; i < constraint_count; ++i) {
    btTypedConstraint& constraint = *constraints[i];
    const int rows = m_tmpConstraintSizesPool[i].m_numConstraintRows;
    detail::JointData* data = joint_of(constraint);
    joints_.push_back({ends_of(constraint, rows), i, rows, row, solver_bodies_[static_cast<std::size_t>(i)], data,
                       mimic_of(constraint), far_limits_of(constraint)});
    if (data == nullptr) row += rows;
  }
  // The world sorts constraints by island, unstably: the same joints may arrive in another order tomorrow.
  std::sort(joints_.begin(), joints_.end(), [](const OrderedJoint& a, const OrderedJoint& b) {
    if (a.ends.body_a != b.ends.body_a) return a.ends.body_a < b.ends.body_a;
    if (a.ends.body_b != b.ends.body_b) return a.ends.body_b < b.ends.body_b;
    if (a.ends.ties_coordinates != b.ends.ties_coordinates) return b.ends.ties_coordinates;
    return a.constraint < b.constraint;
  });
  current_ = &find_mechanism(constraint_count);
  // So that rows for limits find their storage.
  m_tmpSolverNonContactConstraintPool.reserve(m_tmpSolverNonContactConstraintPool.size() + constraint_count);
  load_all_rows(false, info);
  return true;
}

void JointBlockSolver::load_all_rows(bool again, const btContactSolverInfo& info) {
  rows_of_joint_.resize(joints_.size());
  for (std::size_t j = 0; j < joints_.size(); ++j) rows_of_joint_[j] = joints_[j].all_rows();
  current_->system.begin(rows_of_joint_, again);
  component_of_body_.assign(bodies_.size(), -1);
  for (std::size_t j = 0; j < joints_.size(); ++j) load_rows(static_cast<int>(j), info);
  current_->system.assemble();
}

JointBlockSolver::Mechanism& JointBlockSolver::find_mechanism(int constraint_count) {
  std::uint64_t hash = static_cast<std::uint64_t>(constraint_count);
  for (const OrderedJoint& joint : joints_) {
    for (const int body : joint.ends.bodies()) {
      hash = (hash ^ static_cast<std::uint64_t>(body + 1)) * 0x9E3779B97F4A7C15ULL;
      hash ^= hash >> 29;
    }
  }
  ++call_;
  Mechanism* oldest = nullptr;
  for (const auto& mechanism : mechanisms_) {
    if (mechanism->matches(hash, joints_)) {
      mechanism->last_call = call_;
      return *mechanism;
    }
    if (oldest == nullptr || mechanism->last_call < oldest->last_call) oldest = mechanism.get();
  }
  ++statistics_.symbolic_analyses;
  auto fresh = std::make_unique<Mechanism>(joints_, options_.joints);
  fresh->hash = hash;
  fresh->last_call = call_;
  // Replace what has long not been seen; grow while everything is in use.
  if (mechanisms_.size() >= kUsualMechanisms && oldest->last_call + 4 * mechanisms_.size() < call_) {
    const auto slot =
        std::find_if(mechanisms_.begin(), mechanisms_.end(), [&](const auto& m) { return m.get() == oldest; });
    *slot = std::move(fresh);
    return **slot;
  }
  mechanisms_.push_back(std::move(fresh));
  return *mechanisms_.back();
}

void JointBlockSolver::find_touched() {
  any_touched_ = false;
  if (current_ == nullptr) return;
  touched_.assign(current_->structure.components().size(), 0);
  for (const NormalRow& normal : contacts_.normals()) {
    for (const int body : {normal.body_a, normal.body_b}) {
      if (body < 0 || component_of_body_[body] < 0) continue;
      touched_[component_of_body_[body]] = 1;
      any_touched_ = true;
    }
  }
}

bool JointBlockSolver::solve_joints(bool touched_only) {
  const int count = static_cast<int>(current_->structure.components().size());
  for (int c = 0; c < count; ++c) {
    if (!touched_only || touched_[c]) current_->system.solve(c, bodies_.data(), statistics_.joints);
  }
  return !current_->system.exhausted();
}

// Chains of a thousand links and more have fewer.
int JointBlockSolver::joint_sweeps(const btContactSolverInfo& info) const {
  if (!any_touched_) return info.m_numIterations;
  const int affordable = kMaxRowVisits / std::max(current_->system.rows(), 1);
  return std::clamp(affordable, std::min(kFewestSweeps, info.m_numIterations), info.m_numIterations);
}

int JointBlockSolver::iterate(const btContactSolverInfo& info) {
  if (current_) {
    const Stopwatch watch(options_.measure, statistics_.joint_time_ns);
    solve_joints(false);
  }
  pass_on_impacts(info);
  return sweep_contacts(info);
}

int JointBlockSolver::sweep_contacts(const btContactSolverInfo& info) {
  if (contacts_.empty()) {
    m_leastSquaresResidual = 0.0;
    return 1;
  }
  const double tolerance =
      std::max(options_.contact_tolerance * options_.contact_tolerance, info.m_leastSquaresResidualThreshold);
  // A grasp at a hair's breadth of its limit has points that slip; what sweeps leave there is creep.
  const double tolerance_of_slip = any_touched_ ? options_.grasp_tolerance * options_.grasp_tolerance : tolerance;
  const int sweep_limit = current_ ? joint_sweeps(info) : max_sweeps(info);
  for (int sweep = 1;; ++sweep) {
    {
      const Stopwatch watch(options_.measure, statistics_.contact_time_ns);
      m_leastSquaresResidual = contacts_.sweep(bodies_.data(), start_.to_and_fro && sweep % 2 == 0);
    }
    ++statistics_.contact_sweeps;
    if (any_touched_) {
      const Stopwatch watch(options_.measure, statistics_.joint_time_ns);
      solve_joints(true);
    }
    const bool done = m_leastSquaresResidual <= (contacts_.slipped() ? tolerance_of_slip : tolerance);
    if (done || sweep >= sweep_limit) return sweep;
  }
}

void JointBlockSolver::push_out(const btContactSolverInfo& info) {
  if (current_ == nullptr || contacts_.empty()) return;
  if (++current_->calls_with_contacts % kPushInterval != 0) return;
  // Bullet applies moves beside the velocities where impulses are split, and rotates by this share of the value it
  // is given.
  const double turned = info.m_splitImpulse ? info.m_splitImpulseTurnErp : 0.0;
  if (turned > 0.0 && push_.solve(contacts_, bodies_, current_->system, touched_, kSlowestPush, statistics_.joints)) {
    for (int i = 0; i < m_tmpSolverBodyPool.size(); ++i) {
      if (!is_movable(i)) continue;
      const BodyDelta& move = push_.moves()[i];
      btSolverBody& body = m_tmpSolverBodyPool[i];
      body.m_pushVelocity.setValue(move.linear[0], move.linear[1], move.linear[2]);
      body.m_turnVelocity.setValue(move.angular[0], move.angular[1], move.angular[2]);
      body.m_turnVelocity /= turned;
    }
  }
}

void JointBlockSolver::write_back(double h) {
  for (int i = 0; i < m_tmpSolverBodyPool.size(); ++i) {
    if (!is_movable(i)) continue;
    const BodyDelta& from = bodies_[i];
    m_tmpSolverBodyPool[i].m_deltaLinearVelocity.setValue(from.linear[0], from.linear[1], from.linear[2]);
    m_tmpSolverBodyPool[i].m_deltaAngularVelocity.setValue(from.angular[0], from.angular[1], from.angular[2]);
  }
  for (std::size_t i = 0; i < contacts_.normals().size(); ++i) {
    const NormalRow& normal = contacts_.normals()[i];
    const FrictionRows& friction = contacts_.frictions()[i];
    btSolverConstraint& to = m_tmpSolverContactConstraintPool[static_cast<int>(i)];
    to.m_appliedImpulse = normal.impulse;
    auto& point = *static_cast<btManifoldPoint*>(to.m_originalContactPoint);
    detail::set_passed_impulse(point, normal.passed);
    detail::set_push_impulse(point, current_ ? normal.push_impulse : 0.0);
    for (int d = 0; d < friction.count; ++d) {
      m_tmpSolverContactFrictionConstraintPool[to.m_frictionIndex + d].m_appliedImpulse = friction.direction[d].impulse;
    }
  }
  if (current_ == nullptr) return;
  for (int j = 0; j < static_cast<int>(joints_.size()); ++j) {
    const OrderedJoint& joint = joints_[static_cast<std::size_t>(j)];
    if (joint.data != nullptr) write_back_joint(j, h);
    for (int r = joint.data != nullptr ? joint.rows : 0; r < joint.all_rows(); ++r)
      m_tmpSolverNonContactConstraintPool[joint.pool_row(r)].m_appliedImpulse = current_->system.impulse(j, r);
  }
}

btScalar JointBlockSolver::solveGroupCacheFriendlyIterations(btCollisionObject** bodies, int body_count,
                                                             btPersistentManifold** manifolds, int manifold_count,
                                                             btTypedConstraint** constraints, int constraint_count,
                                                             const btContactSolverInfo& info, btIDebugDraw* drawer) {
  ++statistics_.calls;
  if (!options_.direct) {
    return btSequentialImpulseConstraintSolver::solveGroupCacheFriendlyIterations(
        bodies, body_count, manifolds, manifold_count, constraints, constraint_count, info, drawer);
  }
  if (!has_joints()) {
    solveGroupCacheFriendlySplitImpulseIterations(bodies, body_count, manifolds, manifold_count, constraints,
                                                  constraint_count, info, drawer);
  }
  load_bodies();
  {
    const Stopwatch watch(options_.measure, statistics_.joint_time_ns);
    load_joints(constraints, constraint_count, info);
  }
  {
    const Stopwatch watch(options_.measure, statistics_.contact_time_ns);
    load_contacts(info);
  }
  find_touched();
  m_analyticsData.m_numIterationsUsed = iterate(info);
  solve_again(constraints, info);
  push_out(info);
  m_analyticsData.m_numSolverCalls++;
  m_analyticsData.m_islandId = body_count > 0 ? bodies[0]->getCompanionId() : -2;
  m_analyticsData.m_numBodies = body_count;
  m_analyticsData.m_numContactManifolds = manifold_count;
  m_analyticsData.m_remainingLeastSquaresResidual = m_leastSquaresResidual;
  if (options_.measure && current_) {
    statistics_.last_residual = 0.0;
    for (int c = 0; c < static_cast<int>(current_->structure.components().size()); ++c) {
      statistics_.last_residual = std::max(statistics_.last_residual, current_->system.residual(c, bodies_.data()));
    }
  }
  write_back(info.m_timeStep);
  return 0.0;
}

}  // namespace ambf::physics
