#include "devices/hand_force.h"

#include <algorithm>

#include "math/rotation.h"

namespace ambf::devices {

using math::inverse;
using math::rotate;
using math::Vec3;
using math::Wrench;

namespace {

Vec3 without_deadband(const Vec3& force, double deadband) {
  const double size = norm(force);
  return size <= deadband ? Vec3{} : force * (1.0 - deadband / size);
}

// 0: no limit.
Vec3 cut_to(const Vec3& vector, double limit, bool& cut) {
  const double size = norm(vector);
  if (limit <= 0.0 || size <= limit) return vector;
  cut = true;
  return vector * (limit / size);
}

Vec3 approached(const Vec3& from, const Vec3& to, double max_step, bool& cut) {
  return max_step <= 0.0 ? to : from + cut_to(to - from, max_step, cut);
}

double smaller(double file, double device) {
  if (file <= 0.0) return device;
  return device <= 0.0 ? file : std::min(file, device);
}

}  // namespace

Wrench HandForce::law(const HandForceInput& in) const {
  const math::Quat& R_world_sde = in.T_world_sde.orientation;
  // Rows 12-14.
  const Vec3 dP = in.T_world_ref.position - in.T_world_sde.position;
  const Vec3 dV = in.twist_world_ref.linear - in.twist_world_sde.linear;
  const Vec3 force = -(scaled(in.gains.linear_stiffness, dP) + scaled(in.gains.linear_damping, dV));
  // Rows 15, 16: per-axis gains act in the body's axes, as the effector's own do, and the sum is turned to W.
  const Vec3 dRot_body = math::log(inverse(R_world_sde) * in.T_world_ref.orientation);
  const Vec3 dW_body = rotate(inverse(R_world_sde), in.twist_world_ref.angular - in.twist_world_sde.angular);
  const Vec3 torque_body = -(scaled(in.gains.angular_stiffness, dRot_body) + scaled(in.gains.angular_damping, dW_body));
  const Vec3 torque = rotate(R_world_sde, torque_body);
  return {rotate(inverse(in.R_world_u), force + in.external_world.force),
          rotate(inverse(in.R_world_u_torque), torque + in.external_world.torque)};
}

HandForceOutput HandForce::step(const HandForceInput& in) {
  HandForceOutput out;
  out.wanted_u = law(in);
  if (!in.torque) out.wanted_u.torque = {};

  if (in.fault) {
    if (!fault_) {
      at_fault_u_ = written_u_;
      since_fault_s_ = 0.0;
    }
    since_fault_s_ += in.dt;
    const double left = std::max(0.0, 1.0 - since_fault_s_ / state::kDeviceReleaseS);
    written_u_ = {at_fault_u_.force * left, at_fault_u_.torque * left};
    ramp_ = 0.0;
  } else {
    ramp_ = in.allowed ? std::min(1.0, in.ramp_s > 0.0 ? ramp_ + in.dt / in.ramp_s : 1.0) : 0.0;
    const state::HandLimits& limits = in.limits;
    const Vec3 force =
        cut_to(without_deadband(out.wanted_u.force * ramp_, limits.deadband_N), limits.max_force_N, out.at_limit);
    const Vec3 torque = cut_to(out.wanted_u.torque * ramp_, limits.max_torque_Nm, out.at_limit);
    const double max_step = limits.max_jerk_N_per_ms * in.dt * 1e3;
    written_u_.force = approached(written_u_.force, force, max_step, out.at_limit);
    written_u_.torque = approached(written_u_.torque, torque, max_step, out.at_limit);
  }
  fault_ = in.fault;
  out.written_u = written_u_;
  return out;
}

state::EffectorGains bounded(const state::EffectorGains& hand_gains, double max_stiffness_N_m,
                             double workspace_scaling) {
  state::EffectorGains out = hand_gains;
  if (max_stiffness_N_m <= 0.0) return out;
  const double limit = max_stiffness_N_m / workspace_scaling;
  const auto bound = [limit](double& stiffness, double& damping) {
    if (stiffness <= limit) return;
    damping *= limit / stiffness;
    stiffness = limit;
  };
  bound(out.linear_stiffness.x, out.linear_damping.x);
  bound(out.linear_stiffness.y, out.linear_damping.y);
  bound(out.linear_stiffness.z, out.linear_damping.z);
  return out;
}

state::HandLimits combined(const state::HandLimits& file, double device_max_force_N, double device_max_torque_Nm) {
  state::HandLimits out = file;
  out.max_force_N = smaller(file.max_force_N, device_max_force_N);
  out.max_torque_Nm = smaller(file.max_torque_Nm, device_max_torque_Nm);
  return out;
}

}  // namespace ambf::devices
