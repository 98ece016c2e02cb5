// The rows of every joint kind. A row reads J v = target: with the error C of a locked direction, target = -erp C / h.
#include "physics/joints/joint_rows.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "physics/detail/world_data.h"
#include "physics/joints/limit_rows.h"

namespace ambf::physics::detail {
namespace {

// Rotations in a step (rad) between which the curvature of paths is put in the targets: below, it is less than 5 nm at
// a lever of a metre; above, an expected motion is too uncertain. Found by trial: at 0.15 a falling gripper of hinges
// gains energy until it diverges, a ball joint does not.
constexpr double kMinCurvedAngle = 1e-4;
constexpr double kMaxCurvedAngle = kFastTurn;
constexpr double kMaxCurvedAngleOfBall = 0.15;
// Explicit springs are exact in energy but need K h^2 / m << 4; beyond this they are made implicit.
constexpr double kExplicitSpringBound = 0.25;

struct RowMaker {
  JointData& joint;
  double h;  // s
  JointGeometry geometry;
  btRigidBody& a = joint.parent.rigid;
  btRigidBody& b = joint.child.rigid;
  std::optional<JointGeometry> next{};  // at the step's end, as expected; only where bodies turn noticeably

  Row& push(const Row& row) { return joint.constraint.push(row); }

  // Force along a row's direction on both bodies, for one step.
  void apply_effort(const Row& row, double effort) {
    if (effort == 0.0) return;
    joint.parent.pushed_by_joint = joint.child.pushed_by_joint = true;
    a.applyCentralForce(row.linear_a * effort);
    a.applyTorque(row.angular_a * effort);
    b.applyCentralForce(row.linear_b * effort);
    b.applyTorque(row.angular_b * effort);
    joint.step_force += row.linear_b * effort;
    joint.step_torque_a += row.angular_a * effort;
    joint.step_torque_b += row.angular_b * effort;
    if (row.linear_b.dot(joint.step_axis) + row.angular_b.dot(joint.step_axis) > 0.5) joint.step_effort += effort;
  }

  // Speed at which a locked row, whose impulse may be bounded, takes its error back: no faster than that can stop, or
  // it would swing.
  double lock_correction(const Row& row, double error) const {
    const double speed = correction(error, row.shifts, joint.erp, h);
    if (joint.lock_bound == SIMD_INFINITY) return speed;
    const double deceleration = joint.lock_bound * inverse_mass_of(row, a, b) / h;
    const double most = std::sqrt(deceleration * std::abs(error));
    return std::clamp(speed, -most, most);
  }

  void lock(const Row& direction, double error) {
    Row& row = push(direction);
    row.target = -lock_correction(row, error);
    bound_lock(row);
  }
  // `next_error`: what the expected motion makes of the error. Rows are straight, the paths of points on a turning body
  // are not: what the row does not see of it (second order in h) goes into its target.
  void lock(const Row& direction, double error, double next_error) {
    Row& row = push(direction);
    row.target = -lock_correction(row, error);
    if (next) row.target -= (next_error - error) / h - expected_rate(row);
    bound_lock(row);
  }
  void bound_lock(Row& row) const {
    row.softness = joint.cfm;
    row.upper = joint.lock_bound * joint.world->part;
    row.lower = -row.upper;
  }

  double expected_rate(const Row& row) const {
    return row.linear_a.dot(joint.parent.mean_linear) + row.angular_a.dot(joint.parent.mean_turn) +
           row.linear_b.dot(joint.child.mean_linear) + row.angular_b.dot(joint.child.mean_turn);
  }

  void expect_motion() {
    if (!joint.world->dynamics->own_motion()) return;
    double fastest = 0.0;
    for (const BodyData* body : {&joint.parent, &joint.child}) {
      if (!body->is_static() && (!body->begun || body->stiffened)) return;
      fastest = std::max(fastest, h * body->mean_turn.length());
    }
    const double most = joint.freedom == Freedom::ball ? kMaxCurvedAngleOfBall : kMaxCurvedAngle;
    if (fastest > kMinCurvedAngle && fastest < most) next.emplace(joint, joint.parent.next_pose, joint.child.next_pose);
  }

  // v + impulse / (h gain) = target, |impulse| <= bound: a damper or an implicit spring-damper.
  void soft(const Row& direction, double target, double gain, double bound) {
    if (gain <= 0.0) return;
    const double own = inverse_mass_of(direction, a, b);
    if (own <= 0.0) return;
    Row& row = push(direction);
    row.target = target;
    row.softness = 1.0 / (h * gain * own);
    row.lower = -bound;
    row.upper = bound;
  }

  // Spring towards `rest` with a damper; explicit or implicit as its stiffness asks for.
  void spring(const Row& row, double q, double rest, double k, double d) {
    if (k <= 0.0) return soft(row, 0.0, d, SIMD_INFINITY);
    if (k * h * h * inverse_mass_of(row, a, b) < kExplicitSpringBound) {
      const bool begins =
          joint.world->dynamics->own_motion() && joint.parent.begins_motion() && joint.child.begins_motion();
      apply_effort(row, (begins ? 0.5 : 1.0) * k * (rest - q));
      soft(row, 0.0, d, SIMD_INFINITY);
    } else {
      soft(row, k * (rest - q) / (h * k + d), h * k + d, SIMD_INFINITY);
    }
  }

  // q within [low, high]: free the wrong way round, locked where both are the same.
  void limit(const Row& row, double q, double rate, double low, double high) {
    if (low > high) return;
    if (low == high) return lock(row, q - low);
    add_limits(joint, row, q, rate, low, high, h);
  }

  // Everything along the one free direction.
  void coordinate(const Row& row) {
    const double q = joint.coordinate(geometry), rate = rate_of(row, a, b);
    joint.turns_reference = q;
    const Joint::Servo& servo = joint.servo;
    const double servo_gain = h * servo.stiffness + servo.damping;
    // A soft unbounded drive and the viscous damper are one row.
    const bool servo_row = joint.drive == Drive::servo && servo_gain > 0.0;
    const bool merge = servo_row && servo.max_effort <= 0.0;
    const double damping = merge ? 0.0 : joint.damping;
    spring(row, q, joint.equilibrium, joint.stiffness, damping);
    if (servo_row) {
      const double gain = servo_gain + (merge ? joint.damping : 0.0);
      const double pull = servo.stiffness * (servo.position - q) + servo.damping * servo.velocity + servo.feedforward;
      soft(row, pull / gain, gain, servo.max_effort > 0.0 ? servo.max_effort * h : SIMD_INFINITY);
    } else if (joint.drive == Drive::servo) {
      const double bound = servo.max_effort > 0.0 ? servo.max_effort : SIMD_INFINITY;
      apply_effort(row, std::clamp(servo.feedforward, -bound, bound));
    } else if (joint.drive == Drive::effort) {
      apply_effort(row, joint.drive_effort);
    } else if (joint.drive == Drive::velocity && joint.motor_max_impulse > 0.0) {
      Row& motor = push(row);
      motor.target = within_limits(joint, joint.motor_velocity, q, row.shifts, h);
      motor.softness = joint.cfm;
      motor.upper = joint.motor_max_impulse * joint.world->part;
      motor.lower = -motor.upper;
    }
    joint.constraint.first_limit = joint.constraint.row_count;
    if (joint.limits) limit(row, q, rate, (*joint.limits)[0], (*joint.limits)[1]);
  }

  // All locked directions, before all other rows.
  void lock_all() {
    const LockErrors errors(joint.freedom, geometry), next_errors = next ? LockErrors(joint.freedom, *next) : errors;
    for (int i = 0; i < errors.shifts; ++i)
      lock(linear_row(geometry, geometry.basis_a.getColumn(i)), errors[i], next_errors[i]);
    for (int i = errors.shifts; i < errors.count; ++i)
      lock(angular_row(geometry.basis_a.getColumn(i - errors.shifts)), errors[i], next_errors[i]);
  }

  void ball_damping() {
    for (int i = 0; i < 3; ++i) soft(angular_row(geometry.basis_a.getColumn(i)), 0.0, joint.damping, SIMD_INFINITY);
  }

  // Swing within an elliptic cone about the parent's axis, twist about it.
  void cone() {
    const math::Vec3& span = joint.description.cone_limits;
    btQuaternion relative;
    geometry.relative().getRotation(relative);
    const double twist = geometry.twist();
    const btQuaternion swing = relative * btQuaternion(btVector3(0, 0, 1), -twist);
    const btVector3 part(swing.x(), swing.y(), swing.z());
    const double sine = part.length();
    const double angle = 2.0 * std::atan2(sine, std::abs(swing.w()));
    if (sine > 1e-9) {
      const btVector3 local = part / (swing.w() < 0.0 ? -sine : sine);
      const double x = local.x() / std::max(span.x, 1e-6), y = local.y() / std::max(span.y, 1e-6);
      const Row row = angular_row(geometry.basis_a * local);
      limit(row, angle, rate_of(row, a, b), -SIMD_INFINITY, 1.0 / std::sqrt(x * x + y * y));
    }
    const btVector3 sum = geometry.axis() + geometry.basis_b.getColumn(2);
    const double scale = 1.0 + geometry.axis().dot(geometry.basis_b.getColumn(2));
    if (scale < 1e-3) return;  // turned right over: twist means nothing
    const Row row = angular_row(sum / scale);
    limit(row, twist, rate_of(row, a, b), -span.z, span.z);
  }

  // Six coordinates: shifts along the parent frame, and R = Rx Ry Rz of the child frame in it.
  void six() {
    const scene::SixDofLimits& range = joint.description.six_dof;
    const scene::SixDofSpring& spring_of = joint.description.spring;
    const bool sprung = joint.description.type == state::JointType::six_dof_spring;
    const auto at = [](const math::Vec3& v, int i) { return i == 0 ? v.x : (i == 1 ? v.y : v.z); };
    const auto direction = [&](const Row& row, double q, double low, double high, double k, double rest, double d) {
      if (low != high) spring(row, q, rest, sprung ? k : 0.0, joint.damping + (sprung ? d : 0.0));
      limit(row, q, rate_of(row, a, b), low, high);
    };
    for (int i = 0; i < 3; ++i) {
      const btVector3 axis = geometry.basis_a.getColumn(i);
      direction(linear_row(geometry, axis), axis.dot(geometry.pivot_gap), at(range.linear_low, i),
                at(range.linear_high, i), at(spring_of.linear_stiffness, i), at(spring_of.linear_equilibrium, i),
                at(spring_of.linear_damping, i));
    }
    const btMatrix3x3 r = geometry.relative();
    const double sine = std::clamp(r[0][2], -1.0, 1.0);
    const std::array<double, 3> angles{std::atan2(-r[1][2], r[2][2]), std::asin(sine), std::atan2(-r[0][1], r[0][0])};
    // Angle rates are rows of the inverse of [e1 e2 e3]: parent's x, the turned y, child's z.
    const btVector3 e1 = geometry.basis_a.getColumn(0), e3 = geometry.basis_b.getColumn(2);
    btVector3 e2 = e3.cross(e1);
    const double determinant = e2.length();  // cosine of the middle angle
    e2 = determinant > 1e-6 ? e2 / determinant : geometry.basis_a.getColumn(1);
    const double scale = 1.0 / std::max(determinant, 0.05);
    const std::array<btVector3, 3> duals{e2.cross(e3) * scale, e2, e1.cross(e2) * scale};
    for (int i = 0; i < 3; ++i)
      direction(angular_row(duals[static_cast<std::size_t>(i)]), angles[static_cast<std::size_t>(i)],
                at(range.angular_low, i), at(range.angular_high, i), at(spring_of.angular_stiffness, i),
                at(spring_of.angular_equilibrium, i), at(spring_of.angular_damping, i));
  }

  void make() {
    joint.constraint.clear();
    expect_motion();
    joint.step_effort = 0.0;
    joint.step_force.setZero();
    joint.step_torque_a.setZero();
    joint.step_torque_b.setZero();
    joint.step_axis = geometry.axis();
    joint.step_lever = geometry.lever_b;
    lock_all();
    switch (joint.freedom) {
      case Freedom::none: break;
      case Freedom::turn: coordinate(angular_row(geometry.axis())); break;
      case Freedom::shift: coordinate(linear_row(geometry, geometry.axis())); break;
      case Freedom::ball: ball_damping(); break;
      case Freedom::cone:
        ball_damping();
        cone();
        break;
      case Freedom::six: six(); break;
    }
  }
};

}  // namespace

// A joint between sleepers is not prepared at the start of a step; another body may wake its island after that. Rows of
// an earlier step must not be solved: they depend on when the joint fell asleep, or on what was before a restore.
void JointConstraint::getInfo1(btConstraintInfo1* info) {
  auto& joint = *static_cast<JointData*>(getUserConstraintPtr());
  if (joint.prepared_step != joint.world->steps) joint.prepare(joint.world->h);
  info->m_numConstraintRows = row_count;
  info->nub = 0;
}

void JointConstraint::getInfo2(btConstraintInfo2* info) {
  const auto put = [](btScalar* to, const btVector3& from) {
    to[0] = from.x();
    to[1] = from.y();
    to[2] = from.z();
  };
  for (int i = 0; i < row_count; ++i) {
    const Row& row = rows[static_cast<std::size_t>(i)];
    const int at = i * info->rowskip;
    put(info->m_J1linearAxis + at, row.linear_a);
    put(info->m_J1angularAxis + at, row.angular_a);
    put(info->m_J2linearAxis + at, row.linear_b);
    put(info->m_J2angularAxis + at, row.angular_b);
    info->m_constraintError[at] = row.target;
    info->cfm[at] = row.softness;
    info->m_lowerLimit[at] = row.lower;
    info->m_upperLimit[at] = row.upper;
  }
}

int JointData::missing_rates(const JointGeometry& next, double h, LockRates& rates) {
  const RowMaker maker{*this, h, JointGeometry(*this)};
  const LockErrors errors(freedom, maker.geometry), next_errors(freedom, next);
  for (int i = 0; i < errors.count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    rates[at] = -maker.lock_correction(constraint.rows[at], errors[i]) - (next_errors[i] - errors[i]) / h;
  }
  return errors.count;
}

void JointData::prepare(double h) {
  prepared_step = world->steps;
  RowMaker{*this, h, JointGeometry(*this)}.make();
}

}  // namespace ambf::physics::detail
