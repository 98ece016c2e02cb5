// Dense kernels on the small blocks of the joint factorisation. A block is column-major; its leading dimension ld is
// its row count rounded up to even and the padding row is zero, so that every inner loop is a whole number of
// two-lane vectors (written out: compilers take single numbers for these short loops). The common sizes are
// instantiated with a fixed ld, which is what makes them fast. What is written as vectors gives each number the same
// operations in the same order as a plain loop would, so the same bits. Blocks and vectors begin at 16 bytes, as
// std::vector's do. Pure functions, any thread.
// kWide: with vectors of four numbers where two pairs follow each other (lanes.h).
#pragma once

#include <cmath>
#include <cstdint>
#include <utility>

#include "physics/detail/lanes.h"

namespace ambf::physics::dense {

constexpr int padded(int rows) { return (rows + 1) & ~1; }

// Calls f with ld as a compile-time constant where it is a usual one, else with 0 (meaning: use the run-time value).
template <class F>
AMBF_INLINED void with_fixed_ld(int ld, F&& f) {
  switch (ld) {
    case 2: f.template operator()<2>(); break;
    case 4: f.template operator()<4>(); break;
    case 6: f.template operator()<6>(); break;
    case 8: f.template operator()<8>(); break;
    default: f.template operator()<0>(); break;
  }
}

// kPairs pairs of a column, in registers.
template <bool kWide, int kPairs>
struct Run {
  static constexpr int kQuads = kWide ? kPairs / 2 : 0, kRest = kPairs - 2 * kQuads;
  Quad quads[kQuads > 0 ? kQuads : 1];
  Pair pairs[kRest > 0 ? kRest : 1];

  AMBF_INLINED void clear() {
    for (int i = 0; i < kQuads; ++i) quads[i] = Quad{0.0, 0.0, 0.0, 0.0};
    for (int i = 0; i < kRest; ++i) pairs[i] = Pair{0.0, 0.0};
  }
  AMBF_INLINED void load(const double* from) {
    for (int i = 0; i < kQuads; ++i) quads[i] = *reinterpret_cast<const Quad*>(from + 4 * i);
    for (int i = 0; i < kRest; ++i) pairs[i] = *reinterpret_cast<const Pair*>(from + 4 * kQuads + 2 * i);
  }
  AMBF_INLINED void store(double* to) const {
    for (int i = 0; i < kQuads; ++i) *reinterpret_cast<Quad*>(to + 4 * i) = quads[i];
    for (int i = 0; i < kRest; ++i) *reinterpret_cast<Pair*>(to + 4 * kQuads + 2 * i) = pairs[i];
  }
  // += kSign * from * factor
  template <int kSign>
  AMBF_INLINED void add(const double* from, double factor) {
    const Quad four{factor, factor, factor, factor};  // its half, so that it is loaded once
    const Pair two = kQuads > 0 ? __builtin_shufflevector(four, four, 0, 1) : Pair{factor, factor};
    for (int i = 0; i < kQuads; ++i) {
      const Quad product = *reinterpret_cast<const Quad*>(from + 4 * i) * four;
      quads[i] = kSign > 0 ? quads[i] + product : quads[i] - product;
    }
    for (int i = 0; i < kRest; ++i) {
      const Pair product = *reinterpret_cast<const Pair*>(from + 4 * kQuads + 2 * i) * two;
      pairs[i] = kSign > 0 ? pairs[i] + product : pairs[i] - product;
    }
  }
};

// f(0), f(1), .., two a turn.
template <class F>
AMBF_INLINED void for_each_term(int depth, F&& f) {
  int k = 0;
  for (; k + 1 < depth; k += 2) {
    f(k);
    f(k + 1);
  }
  if (k < depth) f(k);
}

// out[pairs kFirst .. kLast) += kSign * sum_k left[those, k] right[k right_ld], k ascending.
template <bool kWide, int kFirst, int kLast, int kSign>
AMBF_INLINED void add_products(double* __restrict out, const double* __restrict left, const double* __restrict right,
                               int ld, int depth, int right_ld) {
  Run<kWide, kLast - kFirst> sum;
  sum.load(out + 2 * kFirst);
  for_each_term(depth, [&](int k) AMBF_INLINED_LAMBDA {
    sum.template add<kSign>(left + 2 * kFirst + k * ld, right[k * right_ld]);
  });
  sum.store(out + 2 * kFirst);
}

// The same for two columns that follow each other, which want right[k right_ld] and the number after it. kFresh: they
// begin with zero.
template <bool kWide, int kFirst, int kLast, int kSign, bool kFresh>
AMBF_INLINED void add_products_twice(double* __restrict out, const double* __restrict left,
                                     const double* __restrict right, int ld, int depth, int right_ld) {
  Run<kWide, kLast - kFirst> first, second;
  if constexpr (kFresh) {
    first.clear();
    second.clear();
  } else {
    first.load(out + 2 * kFirst);
    second.load(out + ld + 2 * kFirst);
  }
  for_each_term(depth, [&](int k) AMBF_INLINED_LAMBDA {
    first.template add<kSign>(left + 2 * kFirst + k * ld, right[k * right_ld]);
    second.template add<kSign>(left + 2 * kFirst + k * ld, right[k * right_ld + 1]);
  });
  first.store(out + 2 * kFirst);
  second.store(out + ld + 2 * kFirst);
}

// Calls f with the constant that `first` is.
template <int kCount, class F>
AMBF_INLINED void with_constant(int first, F&& f) {
  [&]<int... kFirst>(std::integer_sequence<int, kFirst...>) AMBF_INLINED_LAMBDA {
    (void)((first == kFirst && (f.template operator()<kFirst>(), true)) || ...);
  }
  (std::make_integer_sequence<int, kCount>());
}

// add_products() for the pairs from `first` on.
template <bool kWide, int kLd, int kSign>
AMBF_INLINED void add_products_from(int first, double* __restrict out, const double* __restrict left,
                                    const double* __restrict right, int run_time_ld, int depth, int right_ld) {
  if constexpr (kLd > 0) {
    with_constant<kLd / 2>(first, [&]<int kFirst>() AMBF_INLINED_LAMBDA {
      add_products<kWide, kFirst, kLd / 2, kSign>(out, left, right, kLd, depth, right_ld);
    });
  } else {
    for (int i = 2 * first; i < run_time_ld; i += 2)
      add_products<kWide, 0, 1, kSign>(out + i, left + i, right, run_time_ld, depth, right_ld);
  }
}

// C[ld x columns] += sign * sum_k left[:, k] right[column, k], with `depth` terms; right has leading dimension
// right_ld. kLower: only the lower triangle of a block; what it makes of the upper one means nothing.
template <bool kWide, int kLd, int kSign, bool kLower>
AMBF_INLINED void multiply_transposed(double* __restrict c, const double* __restrict left,
                                      const double* __restrict right, int run_time_ld, int columns, int depth,
                                      int right_ld) {
  const int ld = kLd > 0 ? kLd : run_time_ld;
  int column = 0;
  if constexpr (kLd > 0) {
    for (; column + 1 < columns; column += 2) {
      double* const out = c + column * kLd;
      if constexpr (kLower) {
        with_constant<kLd / 2>(column / 2, [&]<int kFirst>() AMBF_INLINED_LAMBDA {
          add_products_twice<kWide, kFirst, kLd / 2, kSign, false>(out, left, right + column, kLd, depth, right_ld);
        });
      } else {
        add_products_twice<kWide, 0, kLd / 2, kSign, false>(out, left, right + column, kLd, depth, right_ld);
      }
    }
  }
  for (; column < columns; ++column)
    add_products_from<kWide, kLd, kSign>(kLower ? column / 2 : 0, c + column * ld, left, right + column, ld, depth,
                                         right_ld);
}

// The same for a block of J M^-1 J^T: the six columns of one body's Jacobian (left) and response (right), of which the
// first three are zero in rows of `right` that do not shift. kFresh: C begins with zero.
template <bool kWide, int kLd, bool kLower, bool kFresh>
AMBF_INLINED void multiply_jacobian(double* __restrict c, const double* __restrict left, const double* __restrict right,
                                    const std::uint8_t* __restrict right_shifts, int run_time_ld, int columns,
                                    int right_ld) {
  const int ld = kLd > 0 ? kLd : run_time_ld;
  int column = 0;
  if constexpr (kLd > 0) {
    for (; column + 1 < columns; column += 2) {
      double* const out = c + column * kLd;
      const bool shifts = right_shifts[column] | right_shifts[column + 1];
      with_constant<kLower ? kLd / 2 : 1>(kLower ? column / 2 : 0, [&]<int kFirst>() AMBF_INLINED_LAMBDA {
        if (shifts) {
          add_products_twice<kWide, kFirst, kLd / 2, 1, kFresh>(out, left, right + column, kLd, 6, right_ld);
        } else {
          add_products_twice<kWide, kFirst, kLd / 2, 1, kFresh>(out, left + 3 * kLd, right + 3 * right_ld + column, kLd,
                                                                3, right_ld);
        }
      });
    }
  }
  for (; column < columns; ++column) {
    double* const out = c + column * ld;
    const int first = kLower ? column / 2 : 0;
    if (kFresh)
      for (int i = 2 * first; i < ld; ++i) out[i] = 0.0;
    add_products_from<kWide, kLd, 1>(first, out, left, right + column, ld, 6, right_ld);
  }
}

// X[ld x columns] := X L^-T for the lower triangular L of a diagonal block; inverse_pivots holds 1 / L(i, i).
template <bool kWide, int kLd>
AMBF_INLINED void solve_right(double* x, const double* __restrict lower, const double* __restrict inverse_pivots,
                              int run_time_ld, int columns, int lower_ld) {
  const int ld = kLd > 0 ? kLd : run_time_ld;
  for (int column = 0; column < columns; ++column) {
    double* const out = x + column * ld;
    add_products_from<kWide, kLd, -1>(0, out, x, lower + column, ld, column, lower_ld);
    const Pair scale{inverse_pivots[column], inverse_pivots[column]};
    for (int i = 0; i < ld; i += 2) *reinterpret_cast<Pair*>(out + i) *= scale;
  }
}

// In-place Cholesky of the lower triangle of a diagonal block. A pivot that is not above its threshold (a dead row, a
// NaN) is replaced by one that pins the row: its unknown becomes 0. Returns the number of such rows.
template <bool kWide, int kLd>
AMBF_INLINED int factor_diagonal(double* block, double* __restrict inverse_pivots, const double* __restrict thresholds,
                                 int rows, int run_time_ld) {
  const int ld = kLd > 0 ? kLd : run_time_ld;
  int dead = 0;
  for (int j = 0; j < rows; ++j) {
    double* const column = block + j * ld;
    add_products_from<kWide, kLd, -1>(j / 2, column, block, block + j, ld, j, ld);
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
AMBF_INLINED void solve_lower(double* __restrict x, const double* __restrict lower,
                              const double* __restrict inverse_pivots, int rows, int ld) {
  for (int c = 0; c < rows; ++c) {
    const double value = x[c] * inverse_pivots[c];
    const double* const column = lower + c * ld;
    x[c] = value;
    for (int r = c + 1; r < rows; ++r) x[r] -= column[r] * value;
  }
}

// x := L^-T x.
AMBF_INLINED void solve_upper(double* __restrict x, const double* __restrict lower,
                              const double* __restrict inverse_pivots, int rows, int ld) {
  for (int c = rows - 1; c >= 0; --c) {
    const double* const column = lower + c * ld;
    double value = x[c];
    for (int r = c + 1; r < rows; ++r) value -= column[r] * x[r];
    x[c] = value * inverse_pivots[c];
  }
}

// x[column] -= sum_i block[i, column] y[i] for all columns.
template <int kLd>
AMBF_INLINED void subtract_dots(double* __restrict x, const double* __restrict block, const double* __restrict y,
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
