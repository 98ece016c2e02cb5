#include "model/effectors/effector_law.h"

#include <algorithm>

#include "math/rotation.h"

namespace ambf::model {
namespace {

constexpr math::Vec3 zeroed(const math::Vec3& v, const EffectorLaw::AxisFlags& axes) {
  return {axes[0] ? 0.0 : v.x, axes[1] ? 0.0 : v.y, axes[2] ? 0.0 : v.z};
}

}  // namespace

void EffectorLaw::start(const math::Pose& T_world_ref) {
  const state::EffectorGains gains = state_.gains;
  state_ = State{};
  state_.gains = gains;
  state_.T_world_ref.position = T_world_ref.position;
  state_.T_world_ref.orientation = math::normalized(T_world_ref.orientation);
  state_.T_world_from = state_.T_world_to = state_.T_world_ref;
  state_.since_sample = 0;
}

void EffectorLaw::move_to(const math::Pose& T_world_ref, std::uint64_t steps, std::uint64_t sampled_steps, double h_s,
                          bool at_rest) {
  State& s = state_;
  const math::Pose T_world_to{T_world_ref.position, math::normalized(T_world_ref.orientation)};
  if (T_world_to == s.T_world_to && !at_rest) return;
  // While no step runs (a pause) samples add up.
  s.sampled_steps = sampled_steps + (s.since_sample == 0 ? s.sampled_steps : 0);
  s.steps = std::max<std::uint64_t>(steps, 1);
  s.done = 0;
  s.T_world_from = s.T_world_ref;
  s.T_world_to = T_world_to;
  s.twist_ref_world = {};
  if (!at_rest) {
    const double rate = 1.0 / (static_cast<double>(std::max({s.steps, s.since_sample, s.sampled_steps})) * h_s);
    s.twist_ref_world.linear = (s.T_world_to.position - s.T_world_from.position) * rate;
    s.twist_ref_world.angular = math::log(s.T_world_to.orientation * math::inverse(s.T_world_from.orientation)) * rate;
  }
  s.since_sample = 0;
}

void EffectorLaw::advance(bool lasts) {
  State& s = state_;
  s.since_sample = std::min(s.since_sample + 1, kLongAgo_steps);
  if (s.done < s.steps) {
    ++s.done;
    if (s.done == s.steps) {
      s.T_world_ref = s.T_world_to;
      return;
    }
    const double way = static_cast<double>(s.done) / static_cast<double>(s.steps);
    s.T_world_ref.position = s.T_world_from.position + (s.T_world_to.position - s.T_world_from.position) * way;
    const math::Vec3 turn = math::log(math::inverse(s.T_world_from.orientation) * s.T_world_to.orientation);
    s.T_world_ref.orientation = math::normalized(s.T_world_from.orientation * math::exp(turn * way));
  } else if (!lasts || s.since_sample > 2 * s.steps) {
    s.twist_ref_world = {};
  }
}

void EffectorLaw::follow(const physics::Body& body, const AxisFlags& linear, const AxisFlags& angular) {
  State& s = state_;
  const math::Pose T_world_body = body.pose();
  const math::Quat R_body_ref = math::inverse(T_world_body.orientation) * s.T_world_ref.orientation;
  s.T_world_ref.position = T_world_body.position + zeroed(s.T_world_ref.position - T_world_body.position, linear);
  s.T_world_ref.orientation =
      math::normalized(T_world_body.orientation * math::exp(zeroed(math::log(R_body_ref), angular)));
  s.T_world_from = s.T_world_to = s.T_world_ref;
  s.done = s.steps;
  s.twist_ref_world = {};
}

math::Wrench EffectorLaw::act(const physics::Body& body, double) {
  const math::Pose T_world_body = body.pose();
  const math::Quat R_body_world = math::inverse(T_world_body.orientation);
  const math::Vec3 e_p = state_.T_world_ref.position - T_world_body.position;
  const math::Vec3 e_R_body = math::log(R_body_world * state_.T_world_ref.orientation);
  const math::Vec3 linear_rate = state_.twist_ref_world.linear - body.velocity_at(T_world_body.position);
  const math::Vec3 angular_rate_body =
      math::rotate(R_body_world, state_.twist_ref_world.angular - body.twist().angular);

  const state::EffectorGains& gains = state_.gains;
  const math::Vec3 force = math::scaled(gains.linear_stiffness, e_p) + math::scaled(gains.linear_damping, linear_rate);
  const math::Vec3 torque_body =
      math::scaled(gains.angular_stiffness, e_R_body) + math::scaled(gains.angular_damping, angular_rate_body);
  math::Wrench wrench = wrench_of(body, force, T_world_body.position);
  wrench.torque += math::rotate(T_world_body.orientation, torque_body);
  return wrench;
}

}  // namespace ambf::model
