#include "physics/joint.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/rotation.h"
#include "physics/detail/world_data.h"
#include "physics/joints/joint_data.h"
#include "physics/joints/joint_rows.h"
#include "physics/joints/mimic_constraint.h"

namespace ambf::physics {

using detail::Drive;
using detail::Freedom;
using detail::from_bullet;
using detail::JointData;
using state::JointType;

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

Freedom freedom_of(JointType type) {
  switch (type) {
    case JointType::fixed: return Freedom::none;
    case JointType::revolute:
    case JointType::torsion_spring: return Freedom::turn;
    case JointType::prismatic:
    case JointType::linear_spring: return Freedom::shift;
    case JointType::p2p: return Freedom::ball;
    case JointType::cone_twist: return Freedom::cone;
    case JointType::six_dof:
    case JointType::six_dof_spring: break;
  }
  return Freedom::six;
}

// R_parent_child at q = 0.
math::Quat zero_rotation(const scene::Joint& joint) {
  return math::from_axis_angle(joint.parent_axis, joint.child_offset - joint.joint_offset) *
         math::rotation_between(joint.child_axis, joint.parent_axis);
}

math::Pose parent_frame(const scene::Joint& joint) {
  return {joint.parent_pivot, math::rotation_between({0.0, 0.0, 1.0}, joint.parent_axis)};
}

math::Pose child_frame(const scene::Joint& joint) {
  return {joint.child_pivot, math::inverse(zero_rotation(joint)) * parent_frame(joint).orientation};
}

bool is_spring(JointType type) { return type == JointType::linear_spring || type == JointType::torsion_spring; }

double rest_of(const scene::Joint& joint) {
  if (joint.equilibrium) return *joint.equilibrium;
  return joint.limits ? 0.5 * ((*joint.limits)[0] + (*joint.limits)[1]) : 0.0;
}

scene::Joint prepared(const scene::Joint& given, const JointOptions& options) {
  scene::Joint joint = given;
  joint.parent_pivot = given.parent_pivot * options.parent_scale;
  joint.child_pivot = given.child_pivot * options.child_scale;
  joint.parent_axis = math::normalized(given.parent_axis);
  joint.child_axis = math::normalized(given.child_axis);
  if (joint.limits && (*joint.limits)[0] > (*joint.limits)[1]) joint.limits.reset();  // reversed: free
  return joint;
}

// Smallest changes of a command that wake a sleeper: their effect in ten seconds stays below a tenth of a millimetre.
constexpr double kWakeAcceleration = 1e-6;  // rad/s^2 or m/s^2
constexpr double kWakeVelocity = 5e-6;      // rad/s or m/s
constexpr double kSettlingShare = 1e-3;     // of a command, as velocities go to zero at the moment of falling asleep

}  // namespace

namespace detail {

JointData::JointData(const scene::Joint& given, Body& parent_body, Body& child_body, const JointOptions& options)
    : description(prepared(given, options)),
      freedom(freedom_of(given.type)),
      parent(parent_body.data()),
      child(child_body.data()),
      frame_a(to_bullet(math::inverse(parent.initial.T_body_com) * parent_frame(description))),
      frame_b(to_bullet(math::inverse(child.initial.T_body_com) * child_frame(description))),
      constraint(parent.rigid, child.rigid),
      limits(description.limits),
      damping(std::max(0.0, description.damping)),
      stiffness(is_spring(description.type) ? std::max(0.0, description.stiffness) : 0.0),
      equilibrium(rest_of(description)),
      erp(std::clamp(description.erp.value_or(options.erp), 0.0, 1.0)),
      cfm(std::max(0.0, description.cfm.value_or(options.cfm))) {
  constraint.setJointFeedback(&feedback);
  constraint.setUserConstraintPtr(this);
  clear_feedback();
}

// Bullet's vectors have no value of their own: assigning {} would copy whatever the memory held.
void JointData::clear_feedback() {
  for (btVector3* part : {&feedback.m_appliedForceBodyA, &feedback.m_appliedTorqueBodyA, &feedback.m_appliedForceBodyB,
                          &feedback.m_appliedTorqueBodyB}) {
    part->setZero();
  }
}

void JointData::reset() {
  drive = Drive::none;
  motor_velocity = drive_effort = 0.0;
  servo = {};
  turns_reference = step_effort = 0.0;
  prepared_step = 0;
  clear_feedback();
  step_force.setZero();
  step_torque_a.setZero();
  step_torque_b.setZero();
  wake();
}

double JointData::wrapped_coordinate() const { return JointGeometry(*this).coordinate(freedom); }

double JointData::coordinate() const { return coordinate(JointGeometry(*this)); }

double JointData::coordinate(const JointGeometry& geometry) const {
  const double wrapped = geometry.coordinate(freedom);
  return freedom == Freedom::shift ? wrapped : wrapped + kTurn * std::round((turns_reference - wrapped) / kTurn);
}

JointData::~JointData() = default;

Row JointData::coordinate_row() const {
  const JointGeometry geometry(*this);
  return freedom == Freedom::shift ? linear_row(geometry, geometry.axis()) : angular_row(geometry.axis());
}

double JointData::rate() const { return rate_of(coordinate_row(), parent.rigid, child.rigid); }

double JointData::inverse_inertia() const { return inverse_mass_of(coordinate_row(), parent.rigid, child.rigid); }

bool JointData::asleep() const {
  return (parent.is_static() || parent.asleep()) && (child.is_static() || child.asleep()) &&
         !(parent.is_static() && child.is_static());
}

void JointData::wake() {
  sleep_reference_settled = false;
  parent.wake();
  child.wake();
}

void JointData::commanded(double value, double before, double tolerance) {
  if (!world || !asleep()) {
    sleep_reference_settled = false;
    return;
  }
  if (!sleep_reference_settled) {
    // The first command after falling asleep sees velocities that have become exactly zero.
    if (std::abs(value - before) > std::max(tolerance, kSettlingShare * std::abs(before))) return wake();
    sleep_reference = value;
    sleep_reference_settled = true;
  } else if (std::abs(value - sleep_reference) > tolerance) {
    wake();
  }
}

}  // namespace detail

Joint::Joint(const scene::Joint& description, Body& parent, Body& child, const JointOptions& options)
    : data_(std::make_unique<JointData>(description, parent, child, options)) {}

Joint::~Joint() {
  if (data_->world) data_->world->remove(*data_);
}

JointType Joint::type() const { return data_->description.type; }
Body& Joint::parent() const { return data_->parent.owner; }
Body& Joint::child() const { return data_->child.owner; }
bool Joint::has_coordinate() const { return data_->freedom == Freedom::turn || data_->freedom == Freedom::shift; }

double Joint::position() const { return data_->coordinate(); }
double Joint::wrapped_position() const { return data_->wrapped_coordinate(); }
double Joint::velocity() const { return data_->rate(); }

double Joint::effort() const {
  const JointData& joint = *data_;
  const btVector3 &force = joint.feedback.m_appliedForceBodyB, &torque = joint.feedback.m_appliedTorqueBodyB;
  const double rows = joint.freedom == Freedom::shift ? joint.step_axis.dot(force)
                                                      : joint.step_axis.dot(torque - joint.step_lever.cross(force));
  return rows + joint.step_effort;
}

math::Wrench Joint::reaction_on_parent() const {
  return {from_bullet(data_->feedback.m_appliedForceBodyA - data_->step_force),
          from_bullet(data_->feedback.m_appliedTorqueBodyA + data_->step_torque_a)};
}

math::Wrench Joint::reaction_on_child() const {
  return {from_bullet(data_->feedback.m_appliedForceBodyB + data_->step_force),
          from_bullet(data_->feedback.m_appliedTorqueBodyB + data_->step_torque_b)};
}

JointGap Joint::gap() const {
  const detail::JointGeometry geometry(*data_);
  const btVector3 axis = geometry.axis(), gap = geometry.pivot_gap;
  JointGap result;
  if (data_->freedom == Freedom::six) return result;
  result.position = (data_->freedom == Freedom::shift ? gap - axis * axis.dot(gap) : gap).length();
  if (data_->freedom == Freedom::turn) {
    const btVector3 other = geometry.basis_b.getColumn(2);
    result.angle = std::atan2(axis.cross(other).length(), axis.dot(other));
  } else if (data_->freedom == Freedom::none || data_->freedom == Freedom::shift) {
    result.angle = detail::rotation_vector(geometry.relative()).length();
  }
  return result;
}

math::Pose Joint::child_pose_in_parent(double q) const {
  const scene::Joint& joint = data_->description;
  const bool turns = data_->freedom == Freedom::turn, shifts = data_->freedom == Freedom::shift;
  const math::Quat rotation =
      turns ? math::from_axis_angle(joint.parent_axis, q) * zero_rotation(joint) : zero_rotation(joint);
  const math::Vec3 shift = shifts ? joint.parent_axis * q : math::Vec3{};
  return {joint.parent_pivot + shift - math::rotate(rotation, joint.child_pivot), rotation};
}

math::Pose Joint::frame_in_parent() const { return parent_frame(data_->description); }
math::Pose Joint::frame_in_child() const { return child_frame(data_->description); }

void Joint::follow(Joint& leader, double multiplier, double offset) {
  data_->mimic = std::make_unique<detail::MimicConstraint>(*data_, leader.data(), multiplier, offset);
}

void Joint::set_free() {
  if (data_->drive != Drive::none) data_->wake();
  data_->drive = Drive::none;
}

void Joint::set_motor_velocity(double velocity, double max_impulse) {
  JointData& joint = *data_;
  const double bound = max_impulse < 0.0 ? joint.description.max_motor_impulse : max_impulse;
  if (joint.drive != Drive::velocity || bound != joint.motor_max_impulse)
    joint.wake();
  else
    joint.commanded(velocity, joint.motor_velocity, kWakeVelocity);
  joint.drive = Drive::velocity;
  joint.motor_velocity = velocity;
  joint.motor_max_impulse = bound;
}

void Joint::set_effort(double effort) {
  JointData& joint = *data_;
  if (joint.drive != Drive::effort)
    joint.wake();
  else if (effort != joint.drive_effort)
    joint.commanded(effort, joint.drive_effort, kWakeAcceleration / std::max(joint.inverse_inertia(), 1e-9));
  joint.drive = Drive::effort;
  joint.drive_effort = effort;
}

void Joint::set_servo(const Servo& servo) {
  JointData& joint = *data_;
  const auto wanted = [](const Servo& s) { return s.stiffness * s.position + s.damping * s.velocity + s.feedforward; };
  const Servo& old = joint.servo;
  if (joint.drive != Drive::servo || servo.stiffness != old.stiffness || servo.damping != old.damping ||
      servo.max_effort != old.max_effort)
    joint.wake();
  else if (wanted(servo) != wanted(old))
    joint.commanded(wanted(servo), wanted(old), kWakeAcceleration / std::max(joint.inverse_inertia(), 1e-9));
  joint.drive = Drive::servo;
  joint.servo = servo;
}

double Joint::max_motor_impulse() const { return data_->description.max_motor_impulse; }

void Joint::set_damping(double damping) {
  data_->damping = std::max(0.0, damping);
  data_->wake();
}
double Joint::damping() const { return data_->damping; }

void Joint::set_limits(const std::optional<std::array<double, 2>>& limits) {
  data_->limits = limits && (*limits)[0] > (*limits)[1] ? std::nullopt : limits;
  data_->wake();
}
const std::optional<std::array<double, 2>>& Joint::limits() const { return data_->limits; }

void Joint::set_softness(double erp, double cfm) {
  data_->erp = std::clamp(erp, 0.0, 1.0);
  data_->cfm = std::max(0.0, cfm);
  data_->wake();
}
double Joint::erp() const { return data_->erp; }
double Joint::cfm() const { return data_->cfm; }
double Joint::effective_inertia() const { return 1.0 / std::max(data_->inverse_inertia(), 1e-12); }

bool Joint::frozen() const { return data_->frozen(); }

void Joint::set_enabled(bool enabled) {
  if (enabled == data_->constraint.isEnabled()) return;
  data_->constraint.setEnabled(enabled);
  data_->wake();
}
bool Joint::enabled() const { return data_->constraint.isEnabled(); }

void Joint::reset() { data_->reset(); }

}  // namespace ambf::physics
