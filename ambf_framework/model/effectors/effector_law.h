// Pulls a body's mesh frame to a reference that moves, with a spring and a damper on each axis (EQUATIONS 5; the
// dissertation's Eq. 3.2-3.7 with their signs mended):
//
//   e_p = P_ref - P_body, e_R = Log(R_body^T R_ref)                             m, world axes; rad, body axes
//   f   = K_L .* e_p + B_L .* (v_ref - v_body)                                  N, at the mesh origin
//   tau = R_body (K_A .* e_R + B_A .* R_body^T (w_ref - w_body))                N m
//
// References come in samples. Between two of them the reference moves in a straight line and about one axis, in as many
// steps as the source's samples (or the steps of one iteration, where those are more) are apart: a held reference would
// be hit by v_ref in pulses. Where the next sample is late, v_ref lasts for as long again; after a pause it is small,
// and where late samples come at once it is that of the hand.
// Physics thread only; allocates nothing.
#pragma once

#include <array>
#include <cstdint>

#include "model/law.h"
#include "state/set_point.h"

namespace ambf::model {

class EffectorLaw final : public Law {
 public:
  using AxisFlags = std::array<bool, 3>;

  // The reference is at `T_world_ref`, at rest.
  void start(const math::Pose& T_world_ref);
  // From the next step on it moves there, in `steps` steps of h_s. `sampled_steps`: between this sample and the one
  // before, by the source's clock; v_ref is no faster than that. `at_rest`: without a velocity of its own. Does nothing
  // where it goes there already.
  void move_to(const math::Pose& T_world_ref, std::uint64_t steps, std::uint64_t sampled_steps, double h_s,
               bool at_rest);
  // A step begins. `lasts`: v_ref outlives the end of the way.
  void advance(bool lasts);
  // On these axes (linear: of the world, angular: of the body) the reference is where the body is, at rest.
  void follow(const physics::Body& body, const AxisFlags& linear, const AxisFlags& angular);
  // In force from now on.
  void set_gains(const state::EffectorGains& gains) { state_.gains = gains; }

  math::Wrench act(const physics::Body& body, double h_s) override;

  // All that it remembers; plain data for snapshots.
  struct State {
    math::Pose T_world_from, T_world_to, T_world_ref;
    math::Twist twist_ref_world;  // of the mesh frame's origin
    state::EffectorGains gains;
    std::uint64_t steps = 1, done = 1;            // of the way
    std::uint64_t since_sample = kLongAgo_steps;  // steps
    std::uint64_t sampled_steps = 0;              // by the source's clock, since the reference moved last
  };
  const State& state() const { return state_; }
  void set_state(const State& state) { state_ = state; }

  static constexpr std::uint64_t kLongAgo_steps = 1'000'000;

 private:
  State state_;
};

}  // namespace ambf::model
