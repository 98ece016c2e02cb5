// Decompositions of matrices. One file compiles Eigen's, which takes its time, for all who ask.
#pragma once

#include <Eigen/Core>

namespace ambf::kinematics {

// J = u diag(values) v^T, values falling. There are max(6, n) of them for a Jacobian of 6 rows and n columns: those
// beyond min(6, n) are 0, and u (6 rows) or v (n rows) is 0 in the column of one that J does not have.
struct SingularParts {
  Eigen::MatrixXd u, v;
  Eigen::VectorXd values;
};

SingularParts singular_parts(const Eigen::MatrixXd& jacobian);

// The shortest x for which |matrix x - vector| is least. Directions in which the matrix does less than this share of
// what it does in the strongest one count as directions in which it does nothing.
Eigen::VectorXd solve_lsq(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& vector, double threshold);

}  // namespace ambf::kinematics
