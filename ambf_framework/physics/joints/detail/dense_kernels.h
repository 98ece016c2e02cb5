// Dense kernels on the small blocks of the joint factorisation. A block is column-major; its leading dimension ld is
// its row count rounded up to even and the padding row is zero, so that every inner loop is a whole number of
// two-lane vectors. The common sizes are instantiated with a fixed ld, which is what makes them fast. Pure functions,
// any thread.
#pragma once

#include <cmath>

namespace ambf::physics::dense {

constexpr int padded(int rows) { return (rows + 1) & ~1; }

// Calls f with ld as a compile-time constant where it is a usual one, else with 0 (meaning: use the run-time value).
template <class F>
inline void with_fixed_ld(int ld, F&& f) {
  switch (ld) {
    case 2: f.template operator()<2>(); break;
    case 4: f.template operator()<4>(); break;
    case 6: f.template operator()<6>(); break;
    default: f.template operator()<0>(); break;
  }
}

// C[ld x columns] += sign * sum_k left[:, k] right[column, k], with `depth` terms; right has leading dimension
// right_ld.
template <int kLd, int kSign>
inline void multiply_transposed(double* __restrict c, const double* __restrict left, const double* __restrict right,
                                int run_time_ld, int columns, int depth, int right_ld) {
  const int ld = kLd > 0 ? kLd : run_time_ld;
  for (int column = 0; column < columns; ++column) {
    double* out = c + column * ld;
    for (int k = 0; k < depth; ++k) {
      const double factor = kSign * right[k * right_ld + column];
      const double* in = left + k * ld;
      for (int i = 0; i < ld; ++i) out[i] += in[i] * factor;
    }
  }
}

// X[ld x columns] := X L^-T for the lower triangular L of a diagonal block; inverse_pivots holds 1 / L(i, i).
template <int kLd>
inline void solve_right(double* __restrict x, const double* __restrict lower, const double* __restrict inverse_pivots,
                        int run_time_ld, int columns, int lower_ld) {
  const int ld = kLd > 0 ? kLd : run_time_ld;
  for (int column = 0; column < columns; ++column) {
    double* out = x + column * ld;
    for (int k = 0; k < column; ++k) {
      const double factor = lower[k * lower_ld + column];
      const double* in = x + k * ld;
      for (int i = 0; i < ld; ++i) out[i] -= in[i] * factor;
    }
    const double scale = inverse_pivots[column];
    for (int i = 0; i < ld; ++i) out[i] *= scale;
  }
}

// In-place Cholesky of the lower triangle of a diagonal block. A pivot that is not above its threshold (a dead row, a
// NaN) is replaced by one that pins the row: its unknown becomes 0. Returns the number of such rows.
inline int factor_diagonal(double* block, double* inverse_pivots, const double* thresholds, int rows, int ld) {
  int dead = 0;
  for (int j = 0; j < rows; ++j) {
    double* column = block + j * ld;
    for (int k = 0; k < j; ++k) {
      const double* left = block + k * ld;
      const double factor = left[j];
      for (int i = j; i < rows; ++i) column[i] -= left[i] * factor;
    }
    const double pivot = column[j];
    if (pivot > thresholds[j]) {
      const double root = std::sqrt(pivot);
      const double inverse = 1.0 / root;
      column[j] = root;
      inverse_pivots[j] = inverse;
      for (int i = j + 1; i < rows; ++i) column[i] *= inverse;
    } else {
      ++dead;
      column[j] = 1.0;
      inverse_pivots[j] = 0.0;
      for (int i = j + 1; i < rows; ++i) column[i] = 0.0;
    }
  }
  return dead;
}

}  // namespace ambf::physics::dense
