// What a Joint is made of: its description, its drive, and the constraint that turns both into solver rows once a step.
// Private to physics/. Physics thread once in a world.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "physics/detail/body_data.h"
#include "physics/joint.h"

namespace ambf::physics::detail {

// One row: wants J v = target within the bounds of the impulse. `softness` is relative to the row's own J M^-1 J^T.
struct Row {
  btVector3 linear_a{0, 0, 0}, angular_a{0, 0, 0}, linear_b{0, 0, 0}, angular_b{0, 0, 0};
  double target = 0.0;  // m/s or rad/s
  double softness = 0.0;
  double lower = -SIMD_INFINITY, upper = SIMD_INFINITY;  // Ns or Nms
  bool shifts = true;                                    // false: its linear parts are zero
};

// Limits of the one coordinate that are too far away for a row of their own: a joint may reach them within a step all
// the same, where its motor is strong for it or something hits it. The solver looks when it has solved, and solves
// again.
struct FarLimits {
  Row row;  // of a limit; with neither target nor bounds
  // Rates of the coordinate (m/s or rad/s) that end the step at one. Infinite: not far, or none.
  double slowest = -SIMD_INFINITY, fastest = SIMD_INFINITY;
  bool any() const { return slowest > -SIMD_INFINITY || fastest < SIMD_INFINITY; }
};

// Most rows a joint can have: six dof, each with limit or lock, spring and damper.
constexpr int kMaxRows = 18;
constexpr int kMaxLocked = 6;                      // of them that lock what is not free
using LockRates = std::array<double, kMaxLocked>;  // m/s or rad/s

struct JointGeometry;  // joint_rows.h

class JointConstraint final : public btTypedConstraint {
 public:
  static constexpr int kUserType = 0x4A4E54;  // btTypedConstraint::getUserConstraintType() of these

  JointConstraint(btRigidBody& parent, btRigidBody& child) : btTypedConstraint(D6_CONSTRAINT_TYPE, parent, child) {
    setUserConstraintType(kUserType);
  }
  void getInfo1(btConstraintInfo1* info) override;
  void getInfo2(btConstraintInfo2* info) override;
  void setParam(int, btScalar, int) override {}
  btScalar getParam(int, int) const override { return 0.0; }

  Row& push(const Row& row) { return rows[static_cast<std::size_t>(row_count++)] = row; }
  void clear() {
    row_count = first_limit = 0;
    far_limits.slowest = -SIMD_INFINITY;
    far_limits.fastest = SIMD_INFINITY;
  }

  std::array<Row, kMaxRows> rows;
  int row_count = 0;
  int first_limit = 0;  // of a joint with one coordinate; the rows from there on are those of its limits
  FarLimits far_limits;
};

enum class Drive { none, velocity, effort, servo };

// Kinds by what is free; everything else is locked.
enum class Freedom { none, turn, shift, ball, cone, six };

class MimicConstraint;  // mimic_constraint.h

struct JointData {
  JointData(const scene::Joint& description, Body& parent, Body& child, const JointOptions& options);
  ~JointData();

  scene::Joint description;  // pivots scaled
  Freedom freedom;
  BodyData &parent, &child;
  btTransform frame_a, frame_b;  // constraint frame in the COM frames of parent and child; z is the axis
  JointConstraint constraint;
  btJointFeedback feedback;
  WorldData* world = nullptr;

  std::optional<std::array<double, 2>> limits;
  double damping, stiffness, equilibrium;
  double erp, cfm;
  double lock_bound = SIMD_INFINITY;  // Ns or Nms a step, of each locked row

  Drive drive = Drive::none;
  double motor_velocity = 0.0, motor_max_impulse = 0.0;
  double drive_effort = 0.0;
  Joint::Servo servo;
  // What the drive asked for when the joint fell asleep; a command that differs wakes it.
  bool sleep_reference_settled = false;
  double sleep_reference = 0.0;

  std::unique_ptr<MimicConstraint> mimic;  // as the follower; null: it follows no joint

  double turns_reference = 0.0;  // rad, the unwrapped angle last seen

  // Of the last step, for effort(): axis and lever of the child's pivot as they were when the rows were made.
  btVector3 step_axis{0, 0, 1}, step_lever{0, 0, 0};
  double step_effort = 0.0;  // what acted as a force rather than a row
  btVector3 step_force{0, 0, 0}, step_torque_a{0, 0, 0},
      step_torque_b{0, 0, 0};  // that, on the child and its counterpart

  // Makes the rows of this step and applies what acts as forces. Both bodies at their poses of the step's start.
  void prepare(double h);
  // After it, where the bodies will end the step at `next`: what is missing in the rates of the locked directions for
  // them to end it where they belong. How many there are; their rows are the first.
  int missing_rates(const JointGeometry& next, double h, LockRates& rates);
  std::uint64_t prepared_step = 0;  // WorldData::steps when it was last prepared; 0: not since a restart

  double coordinate() const;  // unwrapped with the help of turns_reference
  double coordinate(const JointGeometry& geometry) const;
  double wrapped_coordinate() const;  // rad in [-pi, pi]; m
  void clear_feedback();
  void reset();                // no drive, no turns counted, no reactions
  Row coordinate_row() const;  // of the free direction, as poses are now
  double rate() const;
  double inverse_inertia() const;  // of the free direction: J M^-1 J^T
  // A drive command asks for `value`: wakes the bodies if that is news. `before`: what was asked for until now.
  void commanded(double value, double before, double tolerance);
  void wake();
  bool asleep() const;
  // Frozen with its bodies: no row of it can act.
  bool frozen() const { return (parent.frozen || child.frozen) && parent.is_static() && child.is_static(); }
};

}  // namespace ambf::physics::detail
