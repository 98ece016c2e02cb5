#include "model/cartesian_controller.h"

#include <algorithm>
#include <cmath>

#include "math/rotation.h"
#include "model/detail/command_bounds.h"
#include "model/detail/stable_gains.h"
#include "model/law.h"

namespace ambf::model {
namespace {

constexpr double kIntegralReach = 0.5;  // m or rad of proportional share that the integral may match

// Cuts one axis' gains to what an explicit law can bear.
bool limit_axis(double& p, double& d, double effective_mass, double h_s) {
  const double p_max = max_stiffness(effective_mass, h_s);
  const double d_max = max_damping(effective_mass, h_s);
  const bool cut = p > p_max || d > d_max;
  p = std::min(p, p_max);
  d = std::min(d, d_max);
  return cut;
}

double bound(double value, double limit) { return std::clamp(value, -limit, limit); }

// Trapezoidal, its share I * integral bounded by P * kIntegralReach (by kIntegralReach itself where P is zero).
double integrate(double integral, double mean_error, double h_s, double p, double i) {
  if (i == 0.0) return 0.0;
  const double share = p != 0.0 ? std::abs(p) * kIntegralReach : kIntegralReach;
  return bound(integral + mean_error * h_s, share / std::abs(i));
}

math::Vec3 integrate(const math::Vec3& integral, const math::Vec3& mean_error, double h_s,
                     const scene::ChannelGains& gains) {
  return {integrate(integral.x, mean_error.x, h_s, gains.p.x, gains.i.x),
          integrate(integral.y, mean_error.y, h_s, gains.p.y, gains.i.y),
          integrate(integral.z, mean_error.z, h_s, gains.p.z, gains.i.z)};
}

scene::ChannelGains scaled(scene::ChannelGains gains, const math::Vec3& stiffness, const math::Vec3& damping) {
  gains.p = math::scaled(gains.p, stiffness);
  gains.i = math::scaled(gains.i, stiffness);
  gains.d = math::scaled(gains.d, damping);
  return gains;
}

// Force or torque of one channel.
math::Vec3 effort(const scene::ChannelGains& gains, const math::Vec3& error, const math::Vec3& integral,
                  const math::Vec3& rate_error) {
  return math::scaled(gains.p, error) + math::scaled(gains.i, integral) + math::scaled(gains.d, rate_error);
}

// Velocity of one channel: the law solved for the velocity at the end of the step.
math::Vec3 velocity(const scene::ChannelGains& gains, const math::Vec3& error, const math::Vec3& integral,
                    const math::Vec3& reference_rate, double h_s) {
  const math::Vec3 asked = effort(gains, error, integral, reference_rate);
  const auto damped = [h_s](double p, double d) { return std::max(1e-3, 1.0 + d + p * h_s); };
  return {asked.x / damped(gains.p.x, gains.d.x), asked.y / damped(gains.p.y, gains.d.y),
          asked.z / damped(gains.p.z, gains.d.z)};
}

}  // namespace

CartesianController::CartesianController(const scene::ChannelGains& linear, const scene::ChannelGains& angular,
                                         const physics::Body& body, double h_s)
    : linear_(linear), angular_(angular) {
  limit(body, h_s);
}

bool CartesianController::set_gains(const scene::ChannelGains& linear, const scene::ChannelGains& angular,
                                    const physics::Body& body, double h_s) {
  const auto linear_output = linear_.output, angular_output = angular_.output;
  linear_ = linear;
  angular_ = angular;
  linear_.output = linear_output;
  angular_.output = angular_output;
  limit(body, h_s);
  return limited_;
}

void CartesianController::limit(const physics::Body& body, double h_s) {
  limited_ = false;
  if (body.is_static()) return;
  const EffectiveMass effective = effective_mass(body);
  for (auto axis : {&math::Vec3::x, &math::Vec3::y, &math::Vec3::z}) {
    if (linear_.output == scene::ControllerOutput::force)
      limited_ |= limit_axis(linear_.p.*axis, linear_.d.*axis, effective.linear, h_s);
    if (angular_.output == scene::ControllerOutput::force)
      limited_ |= limit_axis(angular_.p.*axis, angular_.d.*axis, effective.angular.*axis, h_s);
  }
}

math::Wrench CartesianController::drive_to(physics::Body& body, const math::Pose& T_world_target, double h_s,
                                           CommandBound& bound, const GainScale& scale) {
  const math::Pose T_world_body = body.pose();
  const math::Quat R_body_world = math::inverse(T_world_body.orientation);
  const math::Vec3 com_world = body.com_pose().position;
  const math::Vec3 origin_from_com = T_world_body.position - com_world;

  const math::Vec3 linear_error = T_world_target.position - T_world_body.position;
  const math::Vec3 angular_error = math::log(R_body_world * T_world_target.orientation);
  // Rates of the commanded pose, both in world axes.
  const math::Twist reference =
      state_.reference.update(T_world_target, h_s, [](const math::Pose& from, const math::Pose& to) {
        struct Change {
          math::Vec3 linear, angular;
          math::Twist operator*(double s) const { return {linear * s, angular * s}; }
        };
        return Change{to.position - from.position, math::log(to.orientation * math::inverse(from.orientation))};
      });

  if (!state_.running) {
    state_.running = true;
    state_.last_linear_error = linear_error;
    state_.last_angular_error = angular_error;
  }
  state_.linear_integral =
      integrate(state_.linear_integral, 0.5 * (state_.last_linear_error + linear_error), h_s, linear_);
  state_.angular_integral =
      integrate(state_.angular_integral, 0.5 * (state_.last_angular_error + angular_error), h_s, angular_);
  state_.last_linear_error = linear_error;
  state_.last_angular_error = angular_error;

  // Angular first: the linear velocity of the COM depends on the rotation that is set.
  math::Wrench share;
  math::Twist twist = body.twist();
  const math::Vec3 origin_velocity = body.velocity_at(T_world_body.position);
  const bool set_angular = angular_.output != scene::ControllerOutput::force;
  const bool set_linear = linear_.output != scene::ControllerOutput::force;
  if (set_angular) {
    const math::Vec3 rate_body = math::rotate(R_body_world, reference.angular);
    twist.angular = bound.velocity(math::rotate(
        T_world_body.orientation, velocity(angular_, angular_error, state_.angular_integral, rate_body, h_s)));
  } else {
    const math::Vec3 rate_error_body = math::rotate(R_body_world, reference.angular - twist.angular);
    const math::Vec3 torque =
        math::rotate(T_world_body.orientation, effort(scaled(angular_, scale.angular_stiffness, scale.angular_damping),
                                                      angular_error, state_.angular_integral, rate_error_body));
    share.torque = bound.wrench({{}, torque}).torque;
    body.apply_torque(share.torque);
  }
  if (set_linear) {
    // v_com = v_origin + omega x (com - origin); what gravity adds in this step is taken off beforehand.
    const math::Vec3 of_origin = velocity(linear_, linear_error, state_.linear_integral, reference.linear, h_s);
    twist.linear =
        bound.velocity(of_origin - math::cross(twist.angular, origin_from_com) - body.gravity_on_set_twist());
  } else {
    const math::Vec3 force = effort(scaled(linear_, scale.linear_stiffness, scale.linear_damping), linear_error,
                                    state_.linear_integral, reference.linear - origin_velocity);
    const math::Wrench at_com = bound.wrench(wrench_of(body, force, T_world_body.position));
    body.apply_wrench(at_com);
    share.force += at_com.force;
    share.torque += at_com.torque;
  }
  if (!set_linear && !set_angular) return share;
  const math::Wrench set = set_twist(body, twist);
  return {share.force + set.force, share.torque + set.torque};
}

}  // namespace ambf::model
