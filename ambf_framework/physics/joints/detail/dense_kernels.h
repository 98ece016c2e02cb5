// Dense kernels on the small blocks of the joint factorisation. A block is column-major; its leading dimension ld is
// its row count rounded up to even and the padding row is zero, so that every inner loop is a whole number of
// two-lane vectors (written out: compilers take single numbers for these short loops). The common sizes are
// instantiated with a fixed ld, which is what makes them fast. What is written as vectors gives each number the same
// operations in the same order as a plain loop would, so the same bits. Blocks and vectors begin at 16 bytes, as
// std::vector's do. Pure functions, any thread.
#pragma once

#include <cmath>
#include <utility>

namespace ambf::physics::dense {

constexpr int padded(int rows) { return (rows + 1) & ~1; }

using Pair __attribute__((vector_size(16), may_alias)) = double;

// Calls f with ld as a compile-time constant where it is a usual one, else with 0 (meaning: use the run-time value).
template <class F>
inline void with_fixed_ld(int ld, F&& f) {
  switch (ld) {
    case 2: f.template operator()<2>(); break;
    case 4: f.template operator()<4>(); break;
    case 6: f.template operator()<6>(); break;
    case 8: f.template operator()<8>(); break;
    default: f.template operator()<0>(); break;
  }
}

// out[pairs kFirst .. kLast) += kSign * sum_k left[those, k] right[k right_ld], k ascending.
template <int kFirst, int kLast, int kSign>
inline void add_products(double* __restrict out, const double* __restrict left, const double* __restrict right, int ld,
                         int depth, int right_ld) {
  Pair sum[kLast - kFirst];
  auto* const to = reinterpret_cast<Pair*>(out) + kFirst;
  for (int i = 0; i < kLast - kFirst; ++i) sum[i] = to[i];
  for (int k = 0; k < depth; ++k) {
    const Pair factor{*right, *right};
    const auto* const from = reinterpret_cast<const Pair*>(left) + kFirst;
    for (int i = 0; i < kLast - kFirst; ++i) {
      if constexpr (kSign > 0) {
        sum[i] += from[i] * factor;
      } else {
        sum[i] -= from[i] * factor;
      }
    }
    left += ld;
    right += right_ld;
  }
  for (int i = 0; i < kLast - kFirst; ++i) to[i] = sum[i];
}

// The same for the pairs from `first` on.
template <int kLd, int kSign>
inline void add_products_from(int first, double* __restrict out, const double* __restrict left,
                              const double* __restrict right, int run_time_ld, int depth, int right_ld) {
  if constexpr (kLd > 0) {
    [&]<int... kFirst>(std::integer_sequence<int, kFirst...>) {
      (void)((first == kFirst &&
              (add_products<kFirst, kLd / 2, kSign>(out, left, right, kLd, depth, right_ld), true)) ||
             ...);
    }
    (std::make_integer_sequence<int, kLd / 2>());
  } else {
    for (int i = 2 * first; i < run_time_ld; i += 2)
      add_products<0, 1, kSign>(out + i, left + i, right, run_time_ld, depth, right_ld);
  }
}

// C[ld x columns] += sign * sum_k left[:, k] right[column, k], with `depth` terms; right has leading dimension
// right_ld.
template <int kLd, int kSign>
inline void multiply_transposed(double* __restrict c, const double* __restrict left, const double* __restrict right,
                                int run_time_ld, int columns, int depth, int right_ld) {
  const int ld = kLd > 0 ? kLd : run_time_ld;
  for (int column = 0; column < columns; ++column)
    add_products_from<kLd, kSign>(0, c + column * ld, left, right + column, ld, depth, right_ld);
}

// The same for the lower triangle of a block; what it makes of the upper one means nothing.
template <int kLd, int kSign>
inline void multiply_transposed_lower(double* __restrict c, const double* __restrict left,
                                      const double* __restrict right, int run_time_ld, int columns, int depth,
                                      int right_ld) {
  const int ld = kLd > 0 ? kLd : run_time_ld;
  for (int column = 0; column < columns; ++column)
    add_products_from<kLd, kSign>(column / 2, c + column * ld, left, right + column, ld, depth, right_ld);
}

// X[ld x columns] := X L^-T for the lower triangular L of a diagonal block; inverse_pivots holds 1 / L(i, i).
template <int kLd>
inline void solve_right(double* x, const double* __restrict lower, const double* __restrict inverse_pivots,
                        int run_time_ld, int columns, int lower_ld) {
  const int ld = kLd > 0 ? kLd : run_time_ld;
  for (int column = 0; column < columns; ++column) {
    double* const out = x + column * ld;
    add_products_from<kLd, -1>(0, out, x, lower + column, ld, column, lower_ld);
    const Pair scale{inverse_pivots[column], inverse_pivots[column]};
    for (int i = 0; i < ld; i += 2) *reinterpret_cast<Pair*>(out + i) *= scale;
  }
}

// In-place Cholesky of the lower triangle of a diagonal block. A pivot that is not above its threshold (a dead row, a
// NaN) is replaced by one that pins the row: its unknown becomes 0. Returns the number of such rows.
template <int kLd>
inline int factor_diagonal(double* block, double* __restrict inverse_pivots, const double* __restrict thresholds,
                           int rows, int run_time_ld) {
  const int ld = kLd > 0 ? kLd : run_time_ld;
  int dead = 0;
  for (int j = 0; j < rows; ++j) {
    double* const column = block + j * ld;
    add_products_from<kLd, -1>(j / 2, column, block, block + j, ld, j, ld);
    const double pivot = column[j];
    const bool alive = pivot > thresholds[j];
    const double root = alive ? std::sqrt(pivot) : 1.0, inverse = alive ? 1.0 / root : 0.0;
    inverse_pivots[j] = inverse;
    if (alive) {
      for (int i = j & ~1; i < ld; i += 2) *reinterpret_cast<Pair*>(column + i) *= Pair{inverse, inverse};
    } else {
      ++dead;
      for (int i = j & ~1; i < ld; i += 2) *reinterpret_cast<Pair*>(column + i) = Pair{0.0, 0.0};
    }
    column[j] = root;
  }
  return dead;
}

// x := L^-1 x for the lower triangle of a diagonal block.
inline void solve_lower(double* __restrict x, const double* __restrict lower, const double* __restrict inverse_pivots,
                        int rows, int ld) {
  for (int c = 0; c < rows; ++c) {
    const double value = x[c] * inverse_pivots[c];
    const double* const column = lower + c * ld;
    x[c] = value;
    for (int r = c + 1; r < rows; ++r) x[r] -= column[r] * value;
  }
}

// x := L^-T x.
inline void solve_upper(double* __restrict x, const double* __restrict lower, const double* __restrict inverse_pivots,
                        int rows, int ld) {
  for (int c = rows - 1; c >= 0; --c) {
    const double* const column = lower + c * ld;
    double value = x[c];
    for (int r = c + 1; r < rows; ++r) value -= column[r] * x[r];
    x[c] = value * inverse_pivots[c];
  }
}

// x[column] -= sum_i block[i, column] y[i] for all columns.
template <int kLd>
inline void subtract_dots(double* __restrict x, const double* __restrict block, const double* __restrict y,
                          int run_time_ld, int columns) {
  const int ld = kLd > 0 ? kLd : run_time_ld;
  int c = 0;
  for (; c + 1 < columns; c += 2) {
    const double *const first = block + c * ld, *const second = first + ld;
    Pair sum{0.0, 0.0};
    for (int i = 0; i < ld; ++i) sum += Pair{first[i], second[i]} * Pair{y[i], y[i]};
    *reinterpret_cast<Pair*>(x + c) -= sum;
  }
  if (c == columns) return;
  double sum = 0.0;
  for (int i = 0; i < ld; ++i) sum += block[c * ld + i] * y[i];
  x[c] -= sum;
}

}  // namespace ambf::physics::dense
