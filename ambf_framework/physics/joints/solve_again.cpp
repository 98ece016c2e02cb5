// The part of JointBlockSolver for what is known only when all is solved: limits that joints passed
// (passed_limits.cpp), and where bodies that turn fast end the step (fast_turns.cpp).
#include <algorithm>

#include "physics/detail/free_motion.h"
#include "physics/detail/world_data.h"
#include "physics/joints/detail/mechanism.h"
#include "physics/joints/joint_block_solver.h"
#include "physics/joints/joint_data.h"

namespace ambf::physics {
namespace {

constexpr int kMaxLimitRounds = 4;        // in which limits that are passed get rows
constexpr int kMaxTurnRounds = 3;         // in which bodies turn as impulses make them that nobody expected
constexpr int kMaxBends = 6;              // in which what turns fast gets new targets
constexpr double kStraightEnough = 1e-7;  // m or rad that a row is wrong by

}  // namespace

void JointBlockSolver::solve_from_start(const btContactSolverInfo& info) {
  load_bodies();
  load_all_rows(true, info);
  load_contacts(info);
  m_analyticsData.m_numIterationsUsed += iterate(info);
}

bool JointBlockSolver::expect_turns(double h, bool last) {
  bool any = false;
  for (const OrderedJoint& order : joints_) {
    if (order.data == nullptr || order.rows == 0) continue;
    for (int s = 0; s < kSidesOfJoints; ++s) {
      detail::BodyData& body = s == 0 ? order.data->parent : order.data->child;
      const int id = order.solver_bodies[static_cast<std::size_t>(s)];
      if (!is_movable(id)) continue;
      const btVector3 more = detail::unexpected_turn(body, turning_after(id), h);
      if (more.isZero()) continue;
      if (last) {
        body.slow_turn = false;
        continue;
      }
      any = true;
      body.start_angular += more;
      m_tmpSolverBodyPool[id].m_deltaAngularVelocity += more;  // for solve_from_start()
      for (int i = 0; i < 3; ++i) bodies_[static_cast<std::size_t>(id)].angular[i] += more[i];
    }
  }
  return any;
}

// The world may take the step in parts then (step_parts.cpp).
void JointBlockSolver::leave_bent(double error) const {
  const auto first =
      std::find_if(joints_.begin(), joints_.end(), [](const auto& each) { return each.data != nullptr; });
  if (first == joints_.end()) return;
  double& left = first->data->world->bent_error;
  left = std::max(left, error);
}

void JointBlockSolver::solve_again(btTypedConstraint** constraints, const btContactSolverInfo& info) {
  double straight_error = 0.0;
  int limits = 0, turns = 0, bends = 0;
  while (current_ != nullptr && !current_->system.exhausted()) {
    if (limits < kMaxLimitRounds && add_passed_limits(constraints)) {
      ++limits;
      solve_from_start(info);
      continue;
    }
    if (turns <= kMaxTurnRounds && expect_turns(info.m_timeStep, turns == kMaxTurnRounds)) {
      ++turns;
      solve_joints(false);
      m_analyticsData.m_numIterationsUsed += sweep_contacts(info);
      continue;
    }
    const double error = bend_targets(info);
    if (error <= kStraightEnough) return;
    if (bends == 0) straight_error = error;
    if (bends == kMaxBends) {
      if (error > straight_error) solve_from_start(info);  // it does not converge: rather straight
      leave_bent(std::min(error, straight_error));
      return;
    }
    ++bends;
    solve_joints(false);
    m_analyticsData.m_numIterationsUsed += sweep_contacts(info);
  }
}

}  // namespace ambf::physics
