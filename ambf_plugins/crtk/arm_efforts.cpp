// ArmControl: speeds of the tip, efforts, wrenches, impedance, locked orientations.
#include <algorithm>
#include <cmath>

#include "crtk/arm_control.h"
#include "math/rotation.h"

namespace ambf::crtk {

namespace {

constexpr double kTwistLasts_s = 0.5;  // simulated: a sender that is silent for longer is gone
constexpr std::size_t kPlaces = 3;     // joints of a master that place its wrist; the others turn it

// Force (Nm) along one axis at `away` (m, rad) from the centre.
double side_force(const math::Vec3& p, const math::Vec3& d, const math::Vec3& bias, const math::Vec3& deadband,
                  double math::Vec3::*axis, double away, double speed) {
  const double within = std::abs(deadband.*axis);
  if (std::abs(away) < within) return 0.0;
  return p.*axis * (away - std::copysign(within, away)) + d.*axis * speed + bias.*axis;
}

math::Vec3 forces(const Impedance::Side& positive, const Impedance::Side& negative, const math::Vec3& away,
                  const math::Vec3& speed) {
  math::Vec3 made;
  for (double math::Vec3::*axis : {&math::Vec3::x, &math::Vec3::y, &math::Vec3::z}) {
    const Impedance::Side& side = away.*axis >= 0.0 ? positive : negative;
    made.*axis = side_force(side.p, side.d, side.bias, side.deadband, axis, away.*axis, speed.*axis);
  }
  return made;
}

bool is_finite(const Impedance::Side& side) {
  return math::is_finite(side.p) && math::is_finite(side.d) && math::is_finite(side.bias) &&
         math::is_finite(side.deadband);
}

bool is_unit(const math::Quat& q) { return std::abs(math::norm(q) - 1.0) < 0.1; }

kinematics::SixVector six(const math::Wrench& wrench) {
  return {wrench.force.x, wrench.force.y, wrench.force.z, wrench.torque.x, wrench.torque.y, wrench.torque.z};
}

}  // namespace

std::vector<double> ArmControl::jacobian(WrenchFrame frame, const Joints& joints) const {
  const auto kind = frame == WrenchFrame::body ? kinematics::JacobianFrame::body : kinematics::JacobianFrame::spatial;
  std::vector<double> matrix = kinematics::jacobian(arm_.kinematics, joints, kind);
  if (frame == WrenchFrame::body) return matrix;
  const std::size_t n = size();
  for (std::size_t half = 0; half < 2; ++half) {
    for (std::size_t i = 0; i < n; ++i) {
      double* const column = matrix.data() + half * 3 * n + i;
      const math::Vec3 turned = math::rotate(T_frame_base_.orientation, {column[0], column[n], column[2 * n]});
      column[0] = turned.x, column[n] = turned.y, column[2 * n] = turned.z;
    }
  }
  return matrix;
}

kinematics::SixVector ArmControl::measured_wrench(WrenchFrame frame) const {
  return kinematics::wrench_of(jacobian(frame), measured_efforts());
}

std::string ArmControl::servo_jf(const Joints& effort) {
  if (std::string why = check("servo_jf", effort, false); !why.empty()) return why;
  end_arm_move();
  way_ = Way::effort;
  effort_ = effort;
  exert();
  return {};
}

std::string ArmControl::servo_cf(WrenchFrame frame, const math::Wrench& wrench) {
  std::string why = not_ready();
  if (why.empty() && !math::is_finite(wrench)) why = "a value is not finite";
  if (!why.empty()) return refuse("servo_cf", why);
  end_arm_move();
  way_ = Way::wrench;
  wrench_frame_ = frame;
  wrench_ = wrench;
  exert();
  return {};
}

std::string ArmControl::servo_ci(const Impedance& impedance) {
  std::string why = not_ready();
  for (const Impedance::Side* side : {&impedance.position_positive, &impedance.position_negative,
                                      &impedance.orientation_positive, &impedance.orientation_negative}) {
    if (why.empty() && !is_finite(*side)) why = "a gain is not finite";
  }
  if (why.empty() && !math::is_finite(impedance.force_position)) why = "a value is not finite";
  if (why.empty() && !(is_unit(impedance.force_orientation) && is_unit(impedance.torque_orientation))) {
    why = "an orientation is no unit quaternion";
  }
  if (!why.empty()) return refuse("servo_ci", why);
  end_arm_move();
  way_ = Way::impedance;
  impedance_ = impedance;
  impedance_.force_orientation = math::normalized(impedance.force_orientation);
  impedance_.torque_orientation = math::normalized(impedance.torque_orientation);
  exert();
  return {};
}

std::string ArmControl::servo_cv(const math::Twist& twist) {
  std::string why = not_ready();
  if (why.empty() && !(math::is_finite(twist.linear) && math::is_finite(twist.angular))) why = "a value is not finite";
  if (why.empty() && view_lost_) why = kNoView;
  if (!why.empty()) return refuse("servo_cv", why);
  end_arm_move();
  way_ = Way::velocity;
  goal_follows_ = true;
  twist_ = twist;
  twist_left_s_ = kTwistLasts_s;
  exert();
  return {};
}

math::Wrench ArmControl::impedance_wrench() const {
  const Joints joints = measured_joints();
  const math::Pose tip = T_frame_base_ * local_pose(joints);
  const kinematics::SixVector moving =
      kinematics::twist_of(jacobian(WrenchFrame::spatial, joints), measured_velocities());
  const math::Quat& R_f = impedance_.force_orientation;
  const math::Quat& R_t = impedance_.torque_orientation;
  const math::Vec3 away = math::rotate(math::inverse(R_f), tip.position - impedance_.force_position);
  const math::Vec3 speed = math::rotate(math::inverse(R_f), {moving[0], moving[1], moving[2]});
  const math::Vec3 turned = math::log(math::inverse(R_t) * tip.orientation);
  const math::Vec3 turning = math::rotate(math::inverse(R_t), {moving[3], moving[4], moving[5]});
  return {math::rotate(R_f, forces(impedance_.position_positive, impedance_.position_negative, away, speed)),
          math::rotate(R_t, forces(impedance_.orientation_positive, impedance_.orientation_negative, turned, turning))};
}

Joints ArmControl::set_effort() const {
  if (way_ == Way::impedance) {
    return kinematics::efforts_for(jacobian(WrenchFrame::spatial), six(impedance_wrench()));
  }
  if (way_ != Way::wrench) return effort_;
  return kinematics::efforts_for(jacobian(wrench_absolute_ ? WrenchFrame::spatial : wrench_frame_), six(wrench_));
}

// The wrist's joints that keep the orientation where the arm is.
Joints ArmControl::locked_joints() const {
  const Joints joints = measured_joints();
  const math::Pose wanted{local_pose(joints).position, math::inverse(T_frame_base_.orientation) * *locked_};
  return kinematics::inverse(arm_.kinematics, wanted, joints).joints;
}

void ArmControl::exert() {
  set_point_ns_ = measured_.stamp_ns;
  if (way_ == Way::velocity) {
    Joints rates = kinematics::rates_for(
        jacobian(WrenchFrame::spatial, set_position()),
        {twist_.linear.x, twist_.linear.y, twist_.linear.z, twist_.angular.x, twist_.angular.y, twist_.angular.z});
    // None faster than it may be, and all in their proportion.
    double scale = 1.0;
    for (std::size_t i = 0; i < size(); ++i) {
      const double most = arm_.max_velocity[i] * command_.ratio_velocity;
      if (std::abs(rates[i]) * scale > most) scale = most / std::abs(rates[i]);
    }
    for (std::size_t i = 0; i < size(); ++i) command_.values[i] = scale * rates[i];
    order_arm(Mode::velocity);
    return;
  }
  const Joints efforts = set_effort();
  std::copy(efforts.begin(), efforts.end(), command_.values.begin());
  command_.efforts = ~0u;
  if (locked_) {
    const Joints kept = locked_joints();
    for (std::size_t i = kPlaces; i < size() && i < kept.size(); ++i) {
      command_.values[i] = kept[i];
      command_.efforts &= ~(1u << i);
    }
  }
  order_arm(Mode::effort);
}

std::string ArmControl::lock_orientation(const math::Quat& orientation) {
  std::string why = not_ready();
  if (why.empty() && (!math::is_finite(orientation) || !is_unit(orientation))) why = "it is no unit quaternion";
  if (!why.empty()) return refuse("lock_orientation", why);
  locked_ = math::normalized(orientation);
  report(Event::Kind::orientation_locked, {}, true);
  return {};
}

std::string ArmControl::unlock_orientation() {
  const bool was = locked_.has_value();
  locked_.reset();
  if (was) report(Event::Kind::orientation_locked, {}, false);
  if (was && way_ == Way::effort && state_ == OperatingState::enabled) exert();
  return {};
}

}  // namespace ambf::crtk
