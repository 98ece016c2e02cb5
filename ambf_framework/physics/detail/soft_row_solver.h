// Bullet's sequential impulse with rows whose softness may be of any size: Bullet applies a row's softness as a plain factor on
// the accumulated impulse, which diverges beyond 2; here it enters the row's effective mass, as it should. Private to physics/.
#pragma once

#include "physics/detail/bullet.h"

namespace ambf::physics::detail {

class SoftRowSolver final : public btSequentialImpulseConstraintSolver {
 public:
  BT_DECLARE_ALIGNED_ALLOCATOR();

 protected:
  void convertJoint(btSolverConstraint* rows, btTypedConstraint* constraint,
                    const btTypedConstraint::btConstraintInfo1& info, int body_a, int body_b,
                    const btContactSolverInfo& settings) override {
    btSequentialImpulseConstraintSolver::convertJoint(rows, constraint, info, body_a, body_b, settings);
    // Bullet's step: d = (rhs - J dv) / A - cfm x. Wanted: d = (rhs - J dv - softness A x) / (A + softness A).
    for (int i = 0; i < info.m_numConstraintRows; ++i) {
      btSolverConstraint& row = rows[i];
      if (row.m_cfm <= 0.0) continue;
      const double share = 1.0 / (1.0 + row.m_cfm);
      row.m_jacDiagABInv *= share;
      row.m_rhs *= share;
      row.m_cfm *= share;
    }
  }
};

}  // namespace ambf::physics::detail
