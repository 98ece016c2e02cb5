// The active set of bounded rows: which of them are free and which are held at a bound, and how to change that until
//   lo <= x <= hi;  x = lo: w >= 0;  x = hi: w <= 0;  else w = 0,   w = A x - b
// holds (dissertation Eq. 2.17, made componentwise). Block principal pivoting: every offending row is exchanged at once
// while that reduces their number; when it stops doing so, only the last offending row is (Murty's rule), which ends
// for every positive definite A. It never solves anything itself: JointSystem does that between two exchanges. Plain
// data, one thread at a time, allocates nothing.
#pragma once

#include <cstdint>

namespace ambf::physics {

enum class RowState : std::uint8_t { free, at_lower, at_upper };

// Bounds this large are none.
inline constexpr double kUnbounded = 1e30;

struct RowBounds {
  double lower = -kUnbounded;
  double upper = kUnbounded;
};

constexpr bool is_bounded(const RowBounds& b) { return b.lower > -kUnbounded || b.upper < kUnbounded; }
// A row without room between its bounds is held at the lower one for good.
constexpr bool is_held(const RowBounds& b) { return b.lower >= b.upper; }
constexpr double bound_value(RowState state, const RowBounds& b) {
  return state == RowState::at_upper ? b.upper : b.lower;
}

// A remembered or guessed state, made possible under today's bounds.
constexpr RowState possible_state(RowState state, const RowBounds& bounds) {
  if (is_held(bounds)) return RowState::at_lower;
  if (state == RowState::at_lower && bounds.lower <= -kUnbounded) return RowState::free;
  if (state == RowState::at_upper && bounds.upper >= kUnbounded) return RowState::free;
  return state;
}

// Whether a row offends the conditions above, by more than the tolerances.
bool offends(RowState state, double x, double w, const RowBounds& bounds, double tolerance_x, double tolerance_w);

// The state an offending row changes to.
RowState exchanged(RowState state, double x, const RowBounds& bounds);

// Decides how much to exchange in one round.
class PivotRule {
 public:
  enum class Exchange { none, all, last };
  // `offenders`: how many rows offend now.
  Exchange next(int offenders);

 private:
  static constexpr int kPatience = 3;  // rounds without progress before exchanging one row at a time
  int fewest_ = -1;
  int patience_ = kPatience;
};

}  // namespace ambf::physics
