#include "kinematics/detail/decompositions.h"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>

namespace ambf::kinematics {

SingularParts singular_parts(const Eigen::MatrixXd& jacobian) {
  // Made square by zeros: for square matrices alone, Eigen needs no QR decomposition first.
  const Eigen::Index size = std::max(jacobian.rows(), jacobian.cols());
  Eigen::MatrixXd square = Eigen::MatrixXd::Zero(size, size);
  square.topLeftCorner(jacobian.rows(), jacobian.cols()) = jacobian;
  const Eigen::JacobiSVD<Eigen::MatrixXd, Eigen::NoQRPreconditioner> parts(square,
                                                                           Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {parts.matrixU().topRows(jacobian.rows()), parts.matrixV().topRows(jacobian.cols()), parts.singularValues()};
}

Eigen::VectorXd solve_lsq(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& vector, double threshold) {
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> parts;
  parts.setThreshold(threshold);
  parts.compute(matrix);
  return parts.solve(vector);
}

}  // namespace ambf::kinematics
