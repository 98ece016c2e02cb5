#include "physics/joints/mimic_constraint.h"

#include <algorithm>

#include "physics/detail/world_data.h"

namespace ambf::physics::detail {

namespace {

// A follower that begins far from its place is brought there no faster than this.
constexpr double kFastestShift = 2.0;  // m/s
constexpr double kFastestTurn = 20.0;  // rad/s

btRigidBody& end_of(JointData& joint, const btRigidBody* taken) {
  for (BodyData* body : {&joint.child, &joint.parent})
    if (!body->is_static() && &body->rigid != taken) return body->rigid;
  return &joint.child.rigid != taken ? joint.child.rigid : joint.parent.rigid;
}

}  // namespace

// One body of each joint, moving ones if there are any: Bullet makes one island of what it joins.
MimicConstraint::MimicConstraint(JointData& follower, JointData& leader, double multiplier, double offset)
    : btTypedConstraint(D6_CONSTRAINT_TYPE, end_of(follower, nullptr), end_of(leader, &end_of(follower, nullptr))),
      follower_(&follower),
      leader_(&leader),
      multiplier_(multiplier),
      offset_(offset) {
  setUserConstraintType(kUserType);
}

bool MimicConstraint::acts() const {
  return leader_ != nullptr && follower_->constraint.isEnabled() && leader_->constraint.isEnabled() &&
         follower_->world->options.solver == SolverKind::direct;
}

void MimicConstraint::add(const Row& row, const JointData& joint, double factor) {
  const auto put = [&](btRigidBody& body, const btVector3& linear, const btVector3& angular) {
    const auto side = std::find_if(sides_.begin(), sides_.end(),
                                   [&body](const Side& s) { return s.body == &body || s.body == nullptr; });
    side->body = &body;
    side->linear += linear * factor;
    side->angular += angular * factor;
  };
  put(joint.parent.rigid, row.linear_a, row.angular_a);
  put(joint.child.rigid, row.linear_b, row.angular_b);
}

void MimicConstraint::getInfo1(btConstraintInfo1* info) {
  info->m_numConstraintRows = acts() ? 1 : 0;
  info->nub = 0;
  if (!acts()) return;
  sides_ = {};
  sides_[0].body = &getRigidBodyA();
  sides_[1].body = &getRigidBodyB();
  add(follower_->coordinate_row(), *follower_, 1.0);
  add(leader_->coordinate_row(), *leader_, -multiplier_);
}

void MimicConstraint::getInfo2(btConstraintInfo2* info) {
  const auto put = [](btScalar* to, const btVector3& from) { std::copy_n(from.m_floats, 3, to); };
  put(info->m_J1linearAxis, sides_[0].linear);
  put(info->m_J1angularAxis, sides_[0].angular);
  put(info->m_J2linearAxis, sides_[1].linear);
  put(info->m_J2angularAxis, sides_[1].angular);
  const double error = follower_->coordinate() - multiplier_ * leader_->coordinate() - offset_;
  const double fastest = follower_->freedom == Freedom::shift ? kFastestShift : kFastestTurn;
  info->m_constraintError[0] = -std::clamp(follower_->erp * error / follower_->world->h, -fastest, fastest);
  info->cfm[0] = follower_->cfm;
  info->m_lowerLimit[0] = -SIMD_INFINITY;
  info->m_upperLimit[0] = SIMD_INFINITY;
}

}  // namespace ambf::physics::detail
