// One row that ties the coordinate of a joint (the follower) to that of another (the leader), both ways:
//   q_follower - multiplier q_leader = offset,   J = J_follower - multiplier J_leader.
// It acts on up to four bodies: Bullet knows the first two, JointBlockSolver all of them. Other solvers would let it
// push the two without their counterparts, so that there it has no row. Private to physics/. Physics thread once in a
// world.
#pragma once

#include <array>

#include "physics/joints/joint_data.h"

namespace ambf::physics::detail {

class MimicConstraint final : public btTypedConstraint {
 public:
  static constexpr int kUserType = 0x4D494D;  // btTypedConstraint::getUserConstraintType() of these
  struct Side {
    btRigidBody* body = nullptr;  // null: no such side
    btVector3 linear{0, 0, 0}, angular{0, 0, 0};
  };

  MimicConstraint(JointData& follower, JointData& leader, double multiplier, double offset);

  void getInfo1(btConstraintInfo1* info) override;
  void getInfo2(btConstraintInfo2* info) override;
  void setParam(int, btScalar, int) override {}
  btScalar getParam(int, int) const override { return 0.0; }

  // Since the last getInfo1(); no body twice. The first two are getRigidBodyA() and getRigidBodyB().
  const std::array<Side, 4>& sides() const { return sides_; }
  JointData& follower() const { return *follower_; }
  JointData* leader() const { return leader_; }
  void forget_leader() { leader_ = nullptr; }  // it leaves the world for good

  bool attached = false;  // the dynamics world has it

 private:
  bool acts() const;
  void add(const Row& row, const JointData& joint, double factor);

  JointData* follower_;
  JointData* leader_;  // null: gone
  const double multiplier_, offset_;
  std::array<Side, 4> sides_;
};

}  // namespace ambf::physics::detail
