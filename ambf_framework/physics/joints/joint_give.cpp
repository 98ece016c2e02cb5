// The part of JointSystem for what regularised rows of loops give way.
#include <algorithm>
#include <cmath>

#include "physics/joints/joint_system.h"

namespace ambf::physics {

// Forces of thousands of newtons in a loop (motors that pull against each other) open its pivots by what regularised
// rows give way: 0.025 mm were seen. What they gave goes into their targets, and the rows are solved again with the
// factor that is there: one step of the method of multipliers. Once in a step of time, and only there: where redundant
// rows contradict each other nothing is won, and each step more adds to what they press; five tear a loop of threads.
bool JointSystem::take_back(const BlockStructure::Component& component) {
  const int begin = cholesky_.row_begin(component.first), end = cholesky_.row_begin(component.last);
  const auto given = [this](int k) { return (softness_[k] - own_softness_[k]) * impulse_[k]; };
  double largest = 0.0;
  for (int k = begin; k < end; ++k)
    if (!is_bounded(bounds_[k])) largest = std::max(largest, std::fabs(given(k)));
  if (largest <= options_.max_given) return false;
  for (int k = begin; k < end; ++k)
    if (!is_bounded(bounds_[k])) target_[k] += given_back_[k] = given(k);
  return true;
}

bool JointSystem::solve(int c, BodyDelta* bodies, JointSolveCounts& counts) {
  const auto& component = structure_->components()[c];
  const bool exact = solve_rows(c, bodies, counts);
  if (!exact || !component.closes_loops || taken_back_[c] || !take_back(component)) return exact;
  taken_back_[c] = 1;
  return solve_rows(c, bodies, counts);
}

}  // namespace ambf::physics
