// Bullet's sequential impulse and MLCP solvers with joint rows whose softness may be of any size: Bullet applies a
// row's softness as a plain factor on the accumulated impulse, which diverges beyond 2 (and MLCP ignores it); here it
// enters the row's effective mass, as it should. Private to physics/.
#pragma once

#include <BulletDynamics/MLCPSolvers/btMLCPSolver.h>

#include "physics/detail/bullet.h"

namespace ambf::physics::detail {

// Bullet's step: d = (rhs - J dv) / A - cfm x. Wanted: d = (rhs - J dv - softness A x) / (A + softness A).
inline void soften(btConstraintArray& rows) {
  for (int i = 0; i < rows.size(); ++i) {
    btSolverConstraint& row = rows[i];
    if (row.m_cfm <= 0.0) continue;
    const double share = 1.0 / (1.0 + row.m_cfm);
    row.m_jacDiagABInv *= share;
    row.m_rhs *= share;
    row.m_cfm *= share;
  }
}

// One moving body on immovable ones starts from all of the last step's impulses and stands still exactly, after one
// sweep; in piles such a start ends in limit cycles.
inline btContactSolverInfo for_island(const btContactSolverInfo& settings, int bodies) {
  btContactSolverInfo own = settings;
  if (bodies == 1) own.m_warmstartingFactor = 1.0;
  return own;
}

// Bullet gives an island each manifold of its bodies, also one without a contact, whose other body may belong to
// another island: that body then has its forces once more. They are left out here.
template <class Solver>
class TouchingSolver : public Solver {
 public:
  BT_DECLARE_ALIGNED_ALLOCATOR();
  using Solver::Solver;
  btScalar solveGroup(btCollisionObject** bodies, int body_count, btPersistentManifold** manifolds, int manifold_count,
                      btTypedConstraint** constraints, int constraint_count, const btContactSolverInfo& settings,
                      btIDebugDraw* drawer, btDispatcher* dispatcher) override {
    touching_.resizeNoInitialize(0);
    for (int i = 0; i < manifold_count; ++i)
      if (manifolds[i]->getNumContacts() > 0) touching_.push_back(manifolds[i]);
    return Solver::solveGroup(bodies, body_count, touching_.size() > 0 ? &touching_[0] : nullptr, touching_.size(),
                              constraints, constraint_count, settings, drawer, dispatcher);
  }

 private:
  btAlignedObjectArray<btPersistentManifold*> touching_;  // grows as Bullet's own
};

template <class Solver>
class IslandSolver : public TouchingSolver<Solver> {
 public:
  BT_DECLARE_ALIGNED_ALLOCATOR();
  using TouchingSolver<Solver>::TouchingSolver;
  btScalar solveGroup(btCollisionObject** bodies, int body_count, btPersistentManifold** manifolds, int manifold_count,
                      btTypedConstraint** constraints, int constraint_count, const btContactSolverInfo& settings,
                      btIDebugDraw* drawer, btDispatcher* dispatcher) override {
    const btContactSolverInfo own = for_island(settings, body_count);
    return TouchingSolver<Solver>::solveGroup(bodies, body_count, manifolds, manifold_count, constraints,
                                              constraint_count, own, drawer, dispatcher);
  }
};

class SoftRowSolver : public btSequentialImpulseConstraintSolver {
 public:
  BT_DECLARE_ALIGNED_ALLOCATOR();

 protected:
  void convertJoints(btTypedConstraint** constraints, int count, const btContactSolverInfo& settings) override {
    btSequentialImpulseConstraintSolver::convertJoints(constraints, count, settings);
    soften(m_tmpSolverNonContactConstraintPool);
  }
};

class SoftMlcpSolver : public btMLCPSolver {
 public:
  BT_DECLARE_ALIGNED_ALLOCATOR();
  using btMLCPSolver::btMLCPSolver;

 protected:
  void convertJoints(btTypedConstraint** constraints, int count, const btContactSolverInfo& settings) override {
    btMLCPSolver::convertJoints(constraints, count, settings);
    soften(m_tmpSolverNonContactConstraintPool);
  }

  void createMLCPFast(const btContactSolverInfo& settings) override {
    btMLCPSolver::createMLCPFast(settings);
    // Joint rows come first. The matrix holds A; softened rows remember r / (1 + r).
    for (int i = 0; i < m_tmpSolverNonContactConstraintPool.size(); ++i) {
      const double softened = m_tmpSolverNonContactConstraintPool[i].m_cfm;
      if (softened > 0.0 && softened < 1.0) m_A.setElem(i, i, m_A(i, i) * (1.0 + softened / (1.0 - softened)));
    }
  }
};

}  // namespace ambf::physics::detail
