// Brings a moving body to a commanded pose in every internal step (ADF body block: `controller`; EQUATIONS as
// dissertation Eq. 3.2-3.7 with their signs mended). Physics thread only; allocates nothing.
//
//   e_p = P_ref - P_body                 world axes, body (mesh) frame origin
//   e_R = Log(R_body^T R_ref)            body axes
//   force output     f = K_L .* e_p + I_L .* int + B_L .* (v_ref - v)            at the mesh origin, with its lever arm
//                    tau = R_body (K_A .* e_R + I_A .* int + B_A .* R_body^T (w_ref - w))
//   velocity output  v = (P e + I int + D v_ref) / (1 + D + P h), likewise w: set, less gravity's share of the step
// Each channel (linear, angular) goes by its own output; `position` output is done by velocity, as in the original.
//
// Stability: force is explicit, so gains beyond B h <= m_e / 2 and K h^2 <= m_e / 4 are cut there (m_e: the body's own
// mass at its mesh origin, its own inertia per body axis); Catalogue warns once, at loading. Within the bounds forces
// are exactly the law's. Wind-up: the integral's share is bounded by the proportional share at 0.5 m or 0.5 rad.
#pragma once

#include "math/types.h"
#include "model/reference_rate.h"
#include "physics/body.h"
#include "scene/description.h"

namespace ambf::model {

class CommandBound;  // model/detail/command_bounds.h
struct GainScale;    // model/detail/stable_gains.h

class CartesianController {
 public:
  // Gains are cut to what is stable for this body in steps of h_s.
  CartesianController(const scene::ChannelGains& linear, const scene::ChannelGains& angular, const physics::Body& body,
                      double h_s);

  // Sets P, I and D, cut likewise; the outputs stay. Returns whether any was cut.
  bool set_gains(const scene::ChannelGains& linear, const scene::ChannelGains& angular, const physics::Body& body,
                 double h_s);
  const scene::ChannelGains& linear() const { return linear_; }
  const scene::ChannelGains& angular() const { return angular_; }

  // Acts on the body, within the bound; returns its share (state::LawShare). `scale`: of outputs by force, what input
  // devices on the body leave of the gains.
  math::Wrench drive_to(physics::Body& body, const math::Pose& T_world_target, double h_s, CommandBound& bound,
                        const GainScale& scale);
  void reset() { state_ = State{}; }

  // Whether gains were cut.
  bool limited() const { return limited_; }

  struct State {
    math::Vec3 linear_integral, angular_integral;      // m s (world), rad s (body)
    math::Vec3 last_linear_error, last_angular_error;  // m (world), rad (body)
    bool running = false;
    ReferenceRate<math::Pose, math::Twist> reference;
  };
  const State& state() const { return state_; }
  void set_state(const State& state) { state_ = state; }

 private:
  void limit(const physics::Body& body, double h_s);

  scene::ChannelGains linear_, angular_;
  bool limited_ = false;
  State state_;
};

}  // namespace ambf::model
