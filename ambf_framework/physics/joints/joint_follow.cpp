// The part of JointSystem for moves beside the velocities.
#include <algorithm>

#include "physics/joints/joint_system.h"

namespace ambf::physics {
namespace {

constexpr double kMaxPassed = 1e-4;  // rad/s or m/s: a tenth of a micrometre in a step of 1 ms

}  // namespace

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

bool JointSystem::hold_passed(int c, const BodyDelta* bodies, const BodyDelta* moves) {
  bool any = false;
  for (int b = bounded_begin_[c]; b < bounded_begin_[c + 1]; ++b) {
    const auto [k, p] = bounded_[b];
    const bool low = bounds_[k].lower == 0.0 && bounds_[k].upper >= kUnbounded;
    const bool high = bounds_[k].upper == 0.0 && bounds_[k].lower <= -kUnbounded;
    if (!pinned_[k] || low == high) continue;
    residual_of(p, bodies, residual_.data() + cholesky_.row_begin(p));
    subtract_velocities(p, moves, residual_.data() + cholesky_.row_begin(p));
    if (low ? residual_[k] < kMaxPassed : residual_[k] > -kMaxPassed) continue;
    pinned_[k] = 0;
    cholesky_.mark_changed(p);
    factored_[c] = 0;
    any = true;
  }
  return any;
}

}  // namespace ambf::physics
