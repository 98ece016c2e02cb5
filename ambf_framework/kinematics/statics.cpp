#include "kinematics/statics.h"

#include "kinematics/detail/decompositions.h"

namespace ambf::kinematics {

namespace {

using Matrix = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor>;

constexpr double kFelt = 1e-3;     // of the largest singular value: below, the arm does not move that way
constexpr double kSlowed = 0.05;   // a singular value (m or rad a rad) below which velocities are damped,
constexpr double kDamping = 0.05;  // up to this at 0

Eigen::Map<const Matrix> as_matrix(const std::vector<double>& jacobian) {
  return {jacobian.data(), 6, static_cast<Eigen::Index>(jacobian.size() / 6)};
}

Eigen::Map<const Eigen::VectorXd> as_vector(const Joints& joints) {
  return {joints.data(), static_cast<Eigen::Index>(joints.size())};
}

Eigen::Map<const Eigen::Matrix<double, 6, 1>> as_vector(const SixVector& six) {
  return Eigen::Map<const Eigen::Matrix<double, 6, 1>>(six.data());
}

template <class Vector>
SixVector as_six(const Vector& vector) {
  SixVector made{};
  Eigen::Map<Eigen::Matrix<double, 6, 1>>(made.data()) = vector;
  return made;
}

template <class Vector>
Joints as_joints(const Vector& vector) {
  return {vector.data(), vector.data() + vector.size()};
}

}  // namespace

SixVector wrench_of(const std::vector<double>& jacobian, const Joints& efforts) {
  if (jacobian.size() != 6 * efforts.size() || efforts.empty()) return {};
  const SingularParts parts = singular_parts(as_matrix(jacobian));
  Eigen::VectorXd along = parts.v.transpose() * as_vector(efforts);
  for (Eigen::Index i = 0; i < along.size(); ++i) {
    const double value = parts.values[i];
    along[i] = value > kFelt * parts.values[0] ? along[i] / value : 0.0;
  }
  return as_six(parts.u * along);
}

Joints rates_for(const std::vector<double>& jacobian, const SixVector& twist) {
  const std::size_t n = jacobian.size() / 6;
  if (n == 0) return {};
  const SingularParts parts = singular_parts(as_matrix(jacobian));
  Eigen::VectorXd along = parts.u.transpose() * as_vector(twist);
  for (Eigen::Index i = 0; i < along.size(); ++i) {
    const double value = parts.values[i];
    const double near = value < kSlowed ? (1.0 - value * value / (kSlowed * kSlowed)) * kDamping * kDamping : 0.0;
    along[i] *= value / (value * value + near);
  }
  const Eigen::VectorXd rates = parts.v * along;
  return as_joints(rates);
}

SixVector twist_of(const std::vector<double>& jacobian, const Joints& rates) {
  if (jacobian.size() != 6 * rates.size() || rates.empty()) return {};
  return as_six(as_matrix(jacobian) * as_vector(rates));
}

Joints efforts_for(const std::vector<double>& jacobian, const SixVector& wrench) {
  if (jacobian.empty()) return {};
  const Eigen::VectorXd efforts = as_matrix(jacobian).transpose() * as_vector(wrench);
  return as_joints(efforts);
}

}  // namespace ambf::kinematics
