#include "physics/joints/detail/active_set.h"

namespace ambf::physics {

bool offends(RowState state, double x, double w, const RowBounds& bounds, double tolerance_x, double tolerance_w) {
  if (is_held(bounds)) return false;
  switch (state) {
    case RowState::free: return x < bounds.lower - tolerance_x || x > bounds.upper + tolerance_x;
    case RowState::at_lower: return w < -tolerance_w;
    case RowState::at_upper: return w > tolerance_w;
  }
  return false;
}

RowState exchanged(RowState state, double x, const RowBounds& bounds) {
  if (state != RowState::free) return RowState::free;
  return x < bounds.lower ? RowState::at_lower : RowState::at_upper;
}

PivotRule::Exchange PivotRule::next(int offenders) {
  if (offenders == 0) return Exchange::none;
  if (fewest_ < 0 || offenders < fewest_) {
    fewest_ = offenders;
    patience_ = kPatience;
    return Exchange::all;
  }
  if (patience_ > 0) {
    --patience_;
    return Exchange::all;
  }
  return Exchange::last;
}

}  // namespace ambf::physics
