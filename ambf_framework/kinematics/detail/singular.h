// Singular values of a Jacobian. One file compiles Eigen's decomposition, which takes its time, for all who ask.
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

}  // namespace ambf::kinematics
