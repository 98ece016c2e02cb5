// Random joint problems for property tests, with a dense copy of the same equations to check against.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "physics/joints/joint_system.h"

namespace ambf::physics::testing {

// Dense symmetric matrices, row-major; as plain as can be, because they are the reference.
class DenseMatrix {
 public:
  explicit DenseMatrix(int size) : size_(size), values_(static_cast<std::size_t>(size) * size, 0.0) {}
  int size() const { return size_; }
  double& operator()(int row, int column) { return values_[static_cast<std::size_t>(row) * size_ + column]; }
  double operator()(int row, int column) const { return values_[static_cast<std::size_t>(row) * size_ + column]; }
  std::vector<double> times(const std::vector<double>& x) const;
  // Gaussian elimination with full pivoting.
  std::vector<double> solve(const std::vector<double>& right_side) const;

 private:
  int size_;
  std::vector<double> values_;
};

struct RandomMechanism {
  enum class Shape { tree, loops, separate };

  std::vector<JointEnds> joints;
  std::vector<int> rows;                        // by joint
  std::vector<std::vector<JointRow>> row_data;  // by joint
  int body_count = 0;

  // `redundant`: some joints are repeated, so that A without regularisation is singular.
  static RandomMechanism make(std::mt19937& random, Shape shape, bool bounded, bool redundant);

  int row_count() const;
  void load(JointSystem& system) const;
  // J M^-1 J^T + softness, rows in the order of joints.
  DenseMatrix dense(double regularisation) const;
  std::vector<double> targets() const;
  std::vector<RowBounds> bounds() const;
};

}  // namespace ambf::physics::testing
