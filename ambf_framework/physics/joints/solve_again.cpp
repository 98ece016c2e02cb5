// The part of JointBlockSolver for what is known only when all is solved: limits that joints passed
// (passed_limits.cpp), and where bodies that turn fast end the step (fast_turns.cpp).
#include "physics/joints/detail/mechanism.h"
#include "physics/joints/joint_block_solver.h"

namespace ambf::physics {
namespace {

constexpr int kMaxLimitRounds = 4;        // in which limits that are passed get rows
constexpr int kMaxBends = 6;              // in which what turns fast gets new targets
constexpr double kStraightEnough = 1e-7;  // m or rad that a row is wrong by

}  // namespace

void JointBlockSolver::solve_from_start(const btContactSolverInfo& info) {
  load_bodies();
  load_all_rows(true, info);
  load_contacts(info);
  m_analyticsData.m_numIterationsUsed += iterate(info);
}

void JointBlockSolver::solve_again(btTypedConstraint** constraints, const btContactSolverInfo& info) {
  double straight_error = 0.0;
  int limits = 0, bends = 0;
  while (current_ != nullptr && !current_->system.exhausted()) {
    if (limits < kMaxLimitRounds && add_passed_limits(constraints)) {
      ++limits;
      solve_from_start(info);
      continue;
    }
    const double error = bend_targets(info);
    if (error <= kStraightEnough) return;
    if (bends == 0) straight_error = error;
    if (bends == kMaxBends) {
      if (error > straight_error) solve_from_start(info);  // it does not converge: rather straight
      return;
    }
    ++bends;
    solve_joints(false);
    m_analyticsData.m_numIterationsUsed += sweep_contacts(info);
  }
}

}  // namespace ambf::physics
