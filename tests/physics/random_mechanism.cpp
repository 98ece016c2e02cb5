#include "tests/physics/random_mechanism.h"

#include <cmath>
#include <utility>

namespace ambf::physics::testing {

std::vector<double> DenseMatrix::times(const std::vector<double>& x) const {
  std::vector<double> result(x.size(), 0.0);
  for (int i = 0; i < size_; ++i) {
    for (int j = 0; j < size_; ++j) result[i] += (*this)(i, j) * x[j];
  }
  return result;
}

std::vector<double> DenseMatrix::solve(const std::vector<double>& right_side) const {
  DenseMatrix a = *this;
  std::vector<double> b = right_side;
  std::vector<int> column_of(size_);
  for (int i = 0; i < size_; ++i) column_of[i] = i;
  for (int k = 0; k < size_; ++k) {
    int best_row = k;
    int best_column = k;
    for (int i = k; i < size_; ++i) {
      for (int j = k; j < size_; ++j) {
        if (std::fabs(a(i, j)) > std::fabs(a(best_row, best_column))) best_row = i, best_column = j;
      }
    }
    for (int j = 0; j < size_; ++j) std::swap(a(k, j), a(best_row, j));
    std::swap(b[k], b[best_row]);
    for (int i = 0; i < size_; ++i) std::swap(a(i, k), a(i, best_column));
    std::swap(column_of[k], column_of[best_column]);
    for (int i = k + 1; i < size_; ++i) {
      const double factor = a(i, k) / a(k, k);
      for (int j = k; j < size_; ++j) a(i, j) -= factor * a(k, j);
      b[i] -= factor * b[k];
    }
  }
  std::vector<double> x(right_side.size());
  for (int k = size_ - 1; k >= 0; --k) {
    double sum = b[k];
    for (int j = k + 1; j < size_; ++j) sum -= a(k, j) * x[column_of[j]];
    x[column_of[k]] = sum / a(k, k);
  }
  return x;
}

RandomMechanism RandomMechanism::make(std::mt19937& random, Shape shape, bool bounded, bool redundant) {
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution<>(low, high)(random); };
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  RandomMechanism result;
  result.body_count = 2 + below(12);
  const int n = result.body_count;
  for (int body = 0; body < n; ++body) {
    if (shape == Shape::separate && body % 4 == 0) {
      result.joints.push_back({JointEnds::kNoBody, body});  // each fourth begins a mechanism of its own
    } else {
      const int parent = shape == Shape::separate ? body - 1 : below(body + 1) - 1;
      result.joints.push_back({parent < 0 ? JointEnds::kNoBody : parent, body});
    }
  }
  if (shape == Shape::loops) {
    for (int k = 0; k < 1 + n / 3; ++k) {
      const int a = below(n);
      const int b = below(n);
      if (a != b) result.joints.push_back({a, b});
    }
  }
  // A symmetric positive definite inverse inertia for each body.
  std::vector<double> inverse_mass(n);
  std::vector<std::vector<double>> inverse_inertia(n, std::vector<double>(9));
  for (int body = 0; body < n; ++body) {
    inverse_mass[body] = std::pow(10.0, uniform(-2.0, 2.0));
    double root[9];
    for (double& value : root) value = uniform(-1.0, 1.0);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        double sum = i == j ? 0.2 : 0.0;
        for (int k = 0; k < 3; ++k) sum += root[3 * i + k] * root[3 * j + k];
        inverse_inertia[body][3 * i + j] = 10.0 * inverse_mass[body] * sum;
      }
    }
  }
  std::vector<int> used(n, 0);  // rows on a body: more than its freedoms would make A singular
  for (std::size_t joint = 0; joint < result.joints.size(); ++joint) {
    const bool loop_closer = joint >= static_cast<std::size_t>(n);
    const int count = loop_closer ? 1 : below(7);
    std::vector<JointRow> rows;
    for (int r = 0; r < count; ++r) {
      JointRow row{};
      for (const int side : {0, 1}) {
        const int body = side == 0 ? result.joints[joint].body_a : result.joints[joint].body_b;
        if (body < 0) continue;
        for (int d = 0; d < 6; ++d) row.jacobian[6 * side + d] = uniform(-1.0, 1.0);
        for (int d = 0; d < 3; ++d) {
          row.response[6 * side + d] = inverse_mass[body] * row.jacobian[6 * side + d];
          for (int k = 0; k < 3; ++k) {
            row.response[6 * side + 3 + d] += inverse_inertia[body][3 * d + k] * row.jacobian[6 * side + 3 + k];
          }
        }
      }
      row.target = uniform(-1.0, 1.0);
      row.softness = below(3) == 0 ? uniform(0.0, 0.1) : 0.0;
      if (bounded && below(3) == 0) {
        const double scale = 0.05;
        switch (below(4)) {
          case 0: row.bounds = {0.0, kUnbounded}; break;
          case 1: row.bounds = {-kUnbounded, 0.0}; break;
          case 2: row.bounds = {-scale * uniform(0.0, 1.0), scale * uniform(0.0, 1.0)}; break;
          default: row.bounds = {0.01, 0.01}; break;
        }
      }
      rows.push_back(row);
    }
    result.rows.push_back(count);
    result.row_data.push_back(rows);
  }
  if (redundant) {
    const std::size_t count = result.joints.size();
    for (std::size_t joint = 0; joint < count; joint += 3) {
      result.joints.push_back(result.joints[joint]);
      result.rows.push_back(result.rows[joint]);
      result.row_data.push_back(result.row_data[joint]);
    }
  }
  return result;
}

int RandomMechanism::row_count() const {
  int count = 0;
  for (const int r : rows) count += r;
  return count;
}

void RandomMechanism::load(JointSystem& system) const {
  system.begin(rows);
  for (std::size_t joint = 0; joint < joints.size(); ++joint) {
    system.set_bodies(static_cast<int>(joint), {joints[joint].body_a, joints[joint].body_b, -1, -1});
    for (int r = 0; r < rows[joint]; ++r) system.set_row(static_cast<int>(joint), r, row_data[joint][r]);
  }
  system.assemble();
}

DenseMatrix RandomMechanism::dense(double regularisation) const {
  DenseMatrix a(row_count());
  int i = 0;
  for (std::size_t p = 0; p < joints.size(); ++p) {
    for (const JointRow& left : row_data[p]) {
      int j = 0;
      for (std::size_t q = 0; q < joints.size(); ++q) {
        for (const JointRow& right : row_data[q]) {
          const int ends_left[2] = {joints[p].body_a, joints[p].body_b};
          const int ends_right[2] = {joints[q].body_a, joints[q].body_b};
          for (const int s : {0, 1}) {
            for (const int t : {0, 1}) {
              if (ends_left[s] < 0 || ends_left[s] != ends_right[t]) continue;
              for (int d = 0; d < 6; ++d) a(i, j) += left.jacobian[6 * s + d] * right.response[6 * t + d];
            }
          }
          ++j;
        }
      }
      double diagonal = 0.0;
      for (int d = 0; d < 12; ++d) diagonal += left.jacobian[d] * left.response[d];
      a(i, i) += (left.softness + (is_bounded(left.bounds) ? 1e-4 : 1.0) * regularisation) * diagonal;
      ++i;
    }
  }
  return a;
}

std::vector<double> RandomMechanism::targets() const {
  std::vector<double> result;
  for (const auto& list : row_data) {
    for (const JointRow& row : list) result.push_back(row.target);
  }
  return result;
}

std::vector<RowBounds> RandomMechanism::bounds() const {
  std::vector<RowBounds> result;
  for (const auto& list : row_data) {
    for (const JointRow& row : list) result.push_back(row.bounds);
  }
  return result;
}

}  // namespace ambf::physics::testing
