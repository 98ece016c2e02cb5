#include "model/joint_controller.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/detail/command_bounds.h"

namespace ambf::model {
namespace {

// How near to a limit counts as being at it: the limit row lets a joint rest a little before or beyond it.
constexpr double kAtLimit = 1e-3;  // rad or m

double shortest(double angle_rad) { return std::remainder(angle_rad, 2.0 * std::numbers::pi); }

}  // namespace

JointController::JointController(const scene::JointGains& gains, bool continuous)
    : gains_(gains), continuous_(continuous) {}

void JointController::set_gains(const scene::JointGains& gains) {
  const scene::ControllerOutput output = gains_.output;
  gains_ = gains;
  gains_.output = output;
}

void JointController::integrate(const physics::Joint& joint, double error, double h_s) {
  if (!state_.running) {
    state_.running = true;
    state_.last_error = error;
  }
  const double mean_error = 0.5 * (state_.last_error + error);
  state_.last_error = error;
  if (gains_.i == 0.0) return;

  if (const auto& limits = joint.limits()) {
    const double q = joint.position();
    if (q <= (*limits)[0] + kAtLimit && mean_error < 0.0) return;
    if (q >= (*limits)[1] - kAtLimit && mean_error > 0.0) return;
  }
  state_.integral += mean_error * h_s;
  // Velocity output: the share may not ask for more than 1 rad/s or m/s beyond what the error asks for.
  const double share = gains_.output == scene::ControllerOutput::force ? joint.max_motor_impulse() / h_s : 1.0;
  const double bound = share / std::abs(gains_.i);
  state_.integral = std::clamp(state_.integral, -bound, bound);
}

void JointController::drive_to(physics::Joint& joint, double target, double h_s, CommandBound& bound) {
  const double q = joint.position();
  const double error = continuous_ ? shortest(target - q) : target - q;
  const double rate = state_.reference.update(
      target, h_s, [this](double from, double to) { return continuous_ ? shortest(to - from) : to - from; });
  integrate(joint, error, h_s);
  const double integral_share = gains_.i * state_.integral;

  if (gains_.output == scene::ControllerOutput::force) {
    physics::Joint::Servo servo;
    const double servo_gain = h_s * gains_.p + gains_.d;
    servo.position = q + bound.servo_input(joint, error, gains_.p, servo_gain);
    servo.velocity = bound.servo_input(joint, rate, gains_.d, servo_gain);
    servo.stiffness = gains_.p;
    servo.damping = gains_.d;
    servo.feedforward = integral_share;
    joint.set_servo(servo);
    return;
  }
  // Joints have no position output of their own; velocity does it.
  const double damped = std::max(1e-3, 1.0 + gains_.d + gains_.p * h_s);
  joint.set_motor_velocity(bound.rate((gains_.p * error + integral_share + gains_.d * rate) / damped));
}

}  // namespace ambf::model
