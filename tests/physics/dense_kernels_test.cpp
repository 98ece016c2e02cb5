// The kernels on blocks of joint rows give, for every size, the bits of the plain loops that they stand for.
#include "physics/joints/detail/dense_kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <tuple>
#include <vector>

namespace ambf::physics::dense {
namespace {

template <class F>
AMBF_WIDE void run_wide(const F& f) {
  f.template operator()<true>();
}

struct Kernels : ::testing::TestWithParam<std::tuple<int, bool>> {
  int rows = std::get<0>(GetParam()), ld = padded(rows);
  bool wide = std::get<1>(GetParam());
  std::mt19937 generator{7};

  void SetUp() override {
    if (wide && !has_wide_vectors()) GTEST_SKIP() << "this processor has no AVX2";
  }

  // f with kWide as a constant.
  template <class F>
  void run(const F& f) const {
    wide ? run_wide(f) : f.template operator()<false>();
  }

  // Column-major, the padding row zero.
  std::vector<double> block(int columns) {
    std::uniform_real_distribution<double> values(-1, 1);
    std::vector<double> out(static_cast<std::size_t>(ld * columns), 0.0);
    for (int c = 0; c < columns; ++c)
      for (int r = 0; r < rows; ++r) out[static_cast<std::size_t>(c * ld + r)] = values(generator);
    return out;
  }
};

double& at(std::vector<double>& block, int ld, int row, int column) {
  return block[static_cast<std::size_t>(column * ld + row)];
}

TEST_P(Kernels, ProductsAreThoseOfPlainLoops) {
  const int depth = 5;
  std::vector<double> left = block(depth), right = block(depth), sum = block(rows), lower = sum, plain = sum;
  for (int c = 0; c < rows; ++c)
    for (int k = 0; k < depth; ++k)
      for (int r = 0; r < ld; ++r) at(plain, ld, r, c) -= at(left, ld, r, k) * at(right, ld, c, k);
  run([&]<bool kWide>() AMBF_INLINED_LAMBDA {
    with_fixed_ld(ld, [&]<int kLd>() AMBF_INLINED_LAMBDA {
      multiply_transposed<kWide, kLd, -1, false>(sum.data(), left.data(), right.data(), ld, rows, depth, ld);
      multiply_transposed<kWide, kLd, -1, true>(lower.data(), left.data(), right.data(), ld, rows, depth, ld);
    });
  });
  EXPECT_EQ(sum, plain);
  for (int c = 0; c < rows; ++c)
    for (int r = c; r < ld; ++r) EXPECT_EQ(at(lower, ld, r, c), at(plain, ld, r, c)) << r << ' ' << c;
}

TEST_P(Kernels, ProductsOfJacobiansAreThoseOfPlainLoops) {
  const int columns = 7;  // of another joint, the last four of which do not shift
  const int column_ld = padded(columns);
  const std::vector<std::uint8_t> shifts{1, 1, 1, 0, 0, 0, 0, 1};
  std::vector<double> left = block(6), right(static_cast<std::size_t>(6 * column_ld), 0.0);
  std::uniform_real_distribution<double> values(-1, 1);
  for (int d = 0; d < 6; ++d)
    for (int c = 0; c < columns; ++c)
      if (d >= 3 || shifts[static_cast<std::size_t>(c)]) at(right, column_ld, c, d) = values(generator);
  std::vector<double> sum = block(columns), twice = sum, plain(sum.size(), 0.0), plain_twice = sum;
  for (int d = 0; d < 6; ++d)
    for (int c = 0; c < columns; ++c)
      for (int r = 0; r < ld; ++r) {
        at(plain, ld, r, c) += at(left, ld, r, d) * at(right, column_ld, c, d);
        at(plain_twice, ld, r, c) += at(left, ld, r, d) * at(right, column_ld, c, d);
      }
  run([&]<bool kWide>() AMBF_INLINED_LAMBDA {
    with_fixed_ld(ld, [&]<int kLd>() AMBF_INLINED_LAMBDA {
      multiply_jacobian<kWide, kLd, false, true>(sum.data(), left.data(), right.data(), shifts.data(), ld, columns,
                                                 column_ld);
      multiply_jacobian<kWide, kLd, false, false>(twice.data(), left.data(), right.data(), shifts.data(), ld, columns,
                                                  column_ld);
    });
  });
  EXPECT_EQ(sum, plain);
  EXPECT_EQ(twice, plain_twice);
}

TEST_P(Kernels, FactorsAndSolvesAreThoseOfPlainLoops) {
  const int dead_row = rows > 2 ? 2 : -1;  // as a row that others make redundant
  std::vector<double> l = block(rows);
  std::vector<double> thresholds(static_cast<std::size_t>(ld), 0.0), inverse(thresholds);
  for (int i = 0; i < rows; ++i) at(l, ld, i, i) += 3.0 + rows;
  if (dead_row >= 0) thresholds[static_cast<std::size_t>(dead_row)] = 1e9;
  std::vector<double> plain = l, plain_inverse = inverse;
  for (int j = 0; j < rows; ++j) {
    for (int k = 0; k < j; ++k)
      for (int i = j; i < rows; ++i) at(plain, ld, i, j) -= at(plain, ld, i, k) * at(plain, ld, j, k);
    const double root = std::sqrt(at(plain, ld, j, j)), one_by = j == dead_row ? 0.0 : 1.0 / root;
    for (int i = j; i < rows; ++i) at(plain, ld, i, j) *= one_by;
    at(plain, ld, j, j) = j == dead_row ? 1.0 : root;
    plain_inverse[static_cast<std::size_t>(j)] = one_by;
  }
  int dead = 0;
  run([&]<bool kWide>() AMBF_INLINED_LAMBDA {
    with_fixed_ld(ld, [&]<int kLd>() AMBF_INLINED_LAMBDA {
      dead = factor_diagonal<kWide, kLd>(l.data(), inverse.data(), thresholds.data(), rows, ld);
    });
  });
  EXPECT_EQ(dead, dead_row >= 0 ? 1 : 0);
  EXPECT_EQ(inverse, plain_inverse);
  for (int c = 0; c < rows; ++c)
    for (int r = c; r < rows; ++r) EXPECT_EQ(at(l, ld, r, c), at(plain, ld, r, c)) << r << ' ' << c;

  const int columns = 5;  // of another joint, whose factor this block is divided by
  std::vector<double> other = block(rows), divided = other, y = block(1), x(6, 1.0), plain_x = x;
  for (int c = 0; c < rows; ++c) {
    for (int k = 0; k < c; ++k)
      for (int r = 0; r < ld; ++r) at(other, ld, r, c) -= at(other, ld, r, k) * at(l, ld, c, k);
    for (int r = 0; r < ld; ++r) at(other, ld, r, c) *= inverse[static_cast<std::size_t>(c)];
  }
  run([&]<bool kWide>() AMBF_INLINED_LAMBDA {
    with_fixed_ld(ld, [&]<int kLd>() AMBF_INLINED_LAMBDA {
      solve_right<kWide, kLd>(divided.data(), l.data(), inverse.data(), ld, rows, ld);
    });
  });
  EXPECT_EQ(divided, other);
  std::vector<double> dotted = block(columns);
  for (int c = 0; c < columns; ++c) {
    double sum = 0.0;
    for (int r = 0; r < ld; ++r) sum += at(dotted, ld, r, c) * y[static_cast<std::size_t>(r)];
    plain_x[static_cast<std::size_t>(c)] -= sum;
  }
  run([&]<bool kWide>() AMBF_INLINED_LAMBDA {
    with_fixed_ld(
        ld, [&]<int kLd>() AMBF_INLINED_LAMBDA { subtract_dots<kLd>(x.data(), dotted.data(), y.data(), ld, columns); });
  });
  EXPECT_EQ(x, plain_x);
}

INSTANTIATE_TEST_SUITE_P(Rows, Kernels, ::testing::Combine(::testing::Range(1, 11), ::testing::Bool()),
                         [](const auto& parameter) {
                           return std::to_string(std::get<0>(parameter.param)) +
                                  (std::get<1>(parameter.param) ? "Wide" : "");
                         });

}  // namespace
}  // namespace ambf::physics::dense
