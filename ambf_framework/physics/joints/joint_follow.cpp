// The part of JointSystem for moves beside the velocities.
#include <algorithm>

#include "physics/joints/joint_system.h"

namespace ambf::physics {

void JointSystem::begin_follow() { std::fill(follow_impulse_.begin(), follow_impulse_.end(), 0.0); }

void JointSystem::follow(int c, BodyDelta* moves, JointSolveCounts& counts) {
  const auto& component = structure_->components()[c];
  if (cholesky_.row_begin(component.first) == cholesky_.row_begin(component.last)) return;
  factor(component, counts);
  for (int p = component.first; p < component.last; ++p) {
    if (rows_[p] == 0) continue;
    const int begin = cholesky_.row_begin(p);
    const int ld = cholesky_.leading_dimension(p);
    for (int i = 0; i < ld; ++i) change_[begin + i] = -own_softness_[begin + i] * follow_impulse_[begin + i];
    subtract_velocities(p, moves, change_.data() + begin);
  }
  for (int b = bounded_begin_[c]; b < bounded_begin_[c + 1]; ++b) {
    if (pinned_[bounded_[b].row]) change_[bounded_[b].row] = 0.0;
  }
  cholesky_.solve(component, change_.data());
  ++counts.solves;
  for (int p = component.first; p < component.last; ++p) {
    if (rows_[p] == 0) continue;
    const int begin = cholesky_.row_begin(p);
    for (int i = 0; i < rows_[p]; ++i) follow_impulse_[begin + i] += change_[begin + i];
    apply(p, change_.data() + begin, moves);
  }
}

}  // namespace ambf::physics
