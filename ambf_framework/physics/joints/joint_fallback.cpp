// The part of JointSystem for islands whose active set is not found within the limit of rounds.
#include <algorithm>

#include "physics/joints/joint_system.h"

namespace ambf::physics {

// The fallback: projected sweeps over single rows find the bounded rows, then the others are solved exactly around
// them.
void JointSystem::sweep(const BlockStructure::Component& component, BodyDelta* bodies) {
  for (int i = 0; i < options_.fallback_sweeps; ++i) {
    for (int p = component.first; p < component.last; ++p) {
      const int begin = cholesky_.row_begin(p);
      for (int r = 0; r < rows_[p]; ++r) {
        const int k = begin + r;
        if (!(diagonal_[k] > 0.0)) continue;
        residual_of(p, bodies, residual_.data() + begin);
        const double wanted = impulse_[k] + residual_[k] / (diagonal_[k] + softness_[k]);
        const double allowed = std::max(bounds_[k].lower, std::min(bounds_[k].upper, wanted));
        std::fill_n(change_.begin() + begin, cholesky_.leading_dimension(p), 0.0);
        change_[k] = allowed - impulse_[k];
        impulse_[k] = allowed;
        apply(p, change_.data() + begin, bodies);
      }
    }
  }
  // Held where the sweeps left them while the rest is solved; then each becomes what the next solve starts from.
  const int c = structure_->component_of(component.first);
  for (int b = bounded_begin_[c]; b < bounded_begin_[c + 1]; ++b) {
    pinned_[bounded_[b].row] = 1;
    cholesky_.mark_changed(bounded_[b].position);
  }
  factored_[c] = 0;
  JointSolveCounts ignored;
  solve_free(component, bodies, ignored);
  for (int b = bounded_begin_[c]; b < bounded_begin_[c + 1]; ++b) {
    const auto [k, p] = bounded_[b];
    const RowBounds& bounds = bounds_[k];
    state_[k] = impulse_[k] <= bounds.lower   ? RowState::at_lower
                : impulse_[k] >= bounds.upper ? RowState::at_upper
                                              : RowState::free;
    pinned_[k] = state_[k] != RowState::free;
    cholesky_.mark_changed(p);
  }
  factored_[c] = 0;
}

}  // namespace ambf::physics
