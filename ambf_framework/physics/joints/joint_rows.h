// Geometry of a joint at one moment and the rows made from it. Private to physics/.
#pragma once

#include "physics/joints/joint_data.h"

namespace ambf::physics::detail {

// Constraint frames in the world, levers from each COM to the child's pivot. Forces of a pair act at that one point,
// so that momentum is kept even when the pivots are apart.
struct JointGeometry {
  explicit JointGeometry(const JointData& joint);
  // With the COM frames at these poses instead.
  JointGeometry(const JointData& joint, const btTransform& com_a, const btTransform& com_b);
  btMatrix3x3 basis_a, basis_b;  // columns: x, y, z of the frames
  btVector3 pivot_gap;           // child pivot - parent pivot
  btVector3 lever_a, lever_b;    // to the child's pivot
  btVector3 axis() const { return basis_a.getColumn(2); }
  btMatrix3x3 relative() const { return basis_a.transposeTimes(basis_b); }
  double twist() const;  // about z, of relative()'s swing-twist split, in [-pi, pi]
  // Of the one free direction, of a turn in [-pi, pi]: rad or m.
  double coordinate(Freedom freedom) const { return freedom == Freedom::shift ? axis().dot(pivot_gap) : twist(); }
};

// How far the locked directions are from where they belong (m, rad), in the order of their rows, which are a joint's
// first: along the parent's axes, then about them.
struct LockErrors {
  LockErrors(Freedom freedom, const JointGeometry& geometry);
  double operator[](int i) const { return errors[static_cast<std::size_t>(i)]; }
  std::array<double, kMaxLocked> errors{};
  int shifts = 0, count = 0;  // of these along axes; in all
};

// Rotation in a step (rad) from which on a body turns fast: what rows make of it is looked at afterwards
// (fast_turns.cpp).
constexpr double kFastTurn = 0.02;

// Rotation vector of a rotation matrix, |.| <= pi.
btVector3 rotation_vector(const btMatrix3x3& rotation);

inline Row linear_row(const JointGeometry& geometry, const btVector3& direction) {
  Row row;
  row.linear_a = -direction;
  row.angular_a = -geometry.lever_a.cross(direction);
  row.linear_b = direction;
  row.angular_b = geometry.lever_b.cross(direction);
  return row;
}

inline Row angular_row(const btVector3& direction) {
  Row row;
  row.shifts = false;
  row.angular_a = -direction;
  row.angular_b = direction;
  return row;
}

double rate_of(const Row& row, const btRigidBody& a, const btRigidBody& b);
double inverse_mass_of(const Row& row, const btRigidBody& a, const btRigidBody& b);

}  // namespace ambf::physics::detail
