// Where a joint's frames are, and rows that measure motion along and about their axes.
#include <cmath>

#include "physics/detail/lanes.h"
#include "physics/joints/joint_rows.h"

namespace ambf::physics::detail {

namespace {

using LoosePair __attribute__((vector_size(16), may_alias, aligned(8))) = double;  // within Bullet's vectors

// a b as Bullet has it, number for number, by vectors.
inline void multiply(const btMatrix3x3& a, const btMatrix3x3& b, btMatrix3x3& out) {
  const auto pair = [&b](int row, int first) -> Pair { return *reinterpret_cast<const LoosePair*>(&b[row][first]); };
  for (int i = 0; i < 3; ++i) {
    const Pair x{a[i].x(), a[i].x()}, y{a[i].y(), a[i].y()}, z{a[i].z(), a[i].z()};
    for (const int first : {0, 2})
      *reinterpret_cast<LoosePair*>(&out[i][first]) = pair(0, first) * x + pair(1, first) * y + pair(2, first) * z;
  }
}

}  // namespace

JointGeometry::JointGeometry(const JointData& joint)
    : JointGeometry(joint, joint.parent.rigid.getWorldTransform(), joint.child.rigid.getWorldTransform()) {}

JointGeometry::JointGeometry(const JointData& joint, const btTransform& com_a, const btTransform& com_b) {
  multiply(com_a.getBasis(), joint.frame_a.getBasis(), basis_a);
  multiply(com_b.getBasis(), joint.frame_b.getBasis(), basis_b);
  lever_b = com_b.getBasis() * joint.frame_b.getOrigin();
  const btVector3 pivot_b = com_b.getOrigin() + lever_b;
  lever_a = pivot_b - com_a.getOrigin();
  pivot_gap = lever_a - com_a.getBasis() * joint.frame_a.getOrigin();
}

double JointGeometry::twist() const {
  const btVector3 xa = basis_a.getColumn(0), ya = basis_a.getColumn(1);
  const btVector3 xb = basis_b.getColumn(0), yb = basis_b.getColumn(1);
  return std::atan2(ya.dot(xb) - xa.dot(yb), xa.dot(xb) + ya.dot(yb));
}

LockErrors::LockErrors(Freedom freedom, const JointGeometry& geometry) {
  if (freedom == Freedom::six) return;
  const auto add = [this](double error) { errors[static_cast<std::size_t>(count++)] = error; };
  shifts = freedom == Freedom::shift ? 2 : 3;
  for (int i = 0; i < shifts; ++i) add(geometry.basis_a.getColumn(i).dot(geometry.pivot_gap));
  if (freedom == Freedom::turn) {
    // Keeps the z axes together: the child would have to turn by z_b x z_a.
    const btVector3 apart = geometry.axis().cross(geometry.basis_b.getColumn(2));
    for (int i = 0; i < 2; ++i) add(geometry.basis_a.getColumn(i).dot(apart));
  } else if (freedom == Freedom::none || freedom == Freedom::shift) {
    const btVector3 apart = rotation_vector(geometry.relative());
    for (int i = 0; i < 3; ++i) add(apart[i]);
  }
}

btVector3 rotation_vector(const btMatrix3x3& rotation) {
  btQuaternion q;
  rotation.getRotation(q);
  if (q.w() < 0.0) q = -q;
  const btVector3 v(q.x(), q.y(), q.z());
  const double sine = v.length();
  return sine < 1e-12 ? v * 2.0 : v * (2.0 * std::atan2(sine, q.w()) / sine);
}

double rate_of(const Row& row, const btRigidBody& a, const btRigidBody& b) {
  return row.linear_a.dot(a.getLinearVelocity()) + row.angular_a.dot(a.getAngularVelocity()) +
         row.linear_b.dot(b.getLinearVelocity()) + row.angular_b.dot(b.getAngularVelocity());
}

double inverse_mass_of(const Row& row, const btRigidBody& a, const btRigidBody& b) {
  return row.linear_a.length2() * a.getInvMass() + row.angular_a.dot(a.getInvInertiaTensorWorld() * row.angular_a) +
         row.linear_b.length2() * b.getInvMass() + row.angular_b.dot(b.getInvInertiaTensorWorld() * row.angular_b);
}

}  // namespace ambf::physics::detail
