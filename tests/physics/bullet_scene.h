// A bare Bullet world for tests and benchmarks of the solver: no framework between the numbers and the solver under
// test.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

#include "physics/joints/joint_block_solver.h"

namespace ambf::physics::testing {

inline constexpr double kStep = 1e-3;  // s

struct SceneOptions {
  JointBlockOptions solver;
  int iterations = 10;
  double joint_erp = 0.8;
  // Off: Bullet's own mode (one friction direction that follows the slip).
  bool two_friction_directions = true;
  int batch_size = 1;
};

class BulletScene {
 public:
  explicit BulletScene(const SceneOptions& options = {});
  ~BulletScene();
  BulletScene(const BulletScene&) = delete;
  BulletScene& operator=(const BulletScene&) = delete;

  btRigidBody& add_box(const btVector3& half_extents, double mass, const btTransform& pose, bool collides = true,
                       double friction = 0.5);
  btRigidBody& add_box(const btVector3& half_extents, double mass, const btVector3& position, bool collides = true);
  btRigidBody& add_ground();  // the half-space z <= 0

  // All joints: frames given in world axes at the present poses, collision between the two bodies off.
  btHingeConstraint& add_hinge(btRigidBody& a, btRigidBody& b, const btVector3& pivot, const btVector3& axis);
  btHingeConstraint& add_hinge(btRigidBody& a, const btVector3& pivot, const btVector3& axis);  // to the world
  btPoint2PointConstraint& add_ball(btRigidBody& a, btRigidBody& b, const btVector3& pivot);
  btPoint2PointConstraint& add_ball(btRigidBody& a, const btVector3& pivot);
  btSliderConstraint& add_slider(btRigidBody& a, const btVector3& axis);  // to the world
  btSliderConstraint& add_slider(btRigidBody& a, btRigidBody& b, const btVector3& pivot, const btVector3& axis);
  btFixedConstraint& add_weld(btRigidBody& a, btRigidBody& b);

  void step(int count = 1);
  btDiscreteDynamicsWorld& world() { return *world_; }
  JointBlockSolver& solver() { return solver_; }
  const std::vector<std::unique_ptr<btRigidBody>>& bodies() const { return bodies_; }
  const std::vector<std::unique_ptr<btTypedConstraint>>& joints() const { return joints_; }

  // Largest distance between the two pivots of any ball, hinge or slider (across its axis), m.
  double largest_gap() const;
  double gap(const btTypedConstraint& joint) const;
  // Bits of all poses and velocities, in order of creation.
  std::vector<double> state() const;
  void restore(const std::vector<double>& state);

 private:
  template <class Joint>
  Joint& keep(std::unique_ptr<Joint> joint);

  SceneOptions options_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  JointBlockSolver solver_;
  std::unique_ptr<btDiscreteDynamicsWorld> world_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
  std::vector<std::unique_ptr<btTypedConstraint>> joints_;
};

}  // namespace ambf::physics::testing
