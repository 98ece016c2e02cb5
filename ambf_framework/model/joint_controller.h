// Turns a joint's position command into a drive of its physics joint, in every internal step (ADF joint block:
// `controller`). Physics thread only; allocates nothing.
//
// Law: u = P e + I int(e) + D de/dt, e = command - q, on continuous joints the shorter way round. The integral is
// trapezoidal. Evaluated at the END of the step, so that no gain makes it unstable (dissertation Eq. 3.9 corrected; an
// explicit D needs D h < 2 I_axis, which wrist links with the usual gains break):
//   force output     an implicit PD row in the solver, with the integral fed forward;
//   velocity output  v = (P e + I int(e) + D v_ref) / (1 + D + P h): what u = P e - D v settles at, reached at once.
// v_ref is the rate of the commanded value (reference_rate.h), not its jump: a set-point far away does not kick.
// Wind-up: the integral's share is bounded by what the joint's motor can do, and it stands still while the joint pushes
// against one of its limits.
#pragma once

#include "model/reference_rate.h"
#include "physics/joint.h"
#include "scene/description.h"

namespace ambf::model {

class CommandBound;  // model/detail/command_bounds.h

class JointController {
 public:
  // `continuous`: revolute without limits.
  JointController(const scene::JointGains& gains, bool continuous);

  void drive_to(physics::Joint& joint, double target, double h_s, CommandBound& bound);

  // Sets P, I and D; the output stays.
  void set_gains(const scene::JointGains& gains);
  const scene::JointGains& gains() const { return gains_; }

  // Forgets integral and set-point: the next command starts afresh.
  void reset() { state_ = State{}; }

  // All that it remembers; plain data for snapshots.
  struct State {
    double integral = 0.0;    // rad s or m s
    double last_error = 0.0;  // rad or m
    bool running = false;
    ReferenceRate<double, double> reference;
  };
  const State& state() const { return state_; }
  void set_state(const State& state) { state_ = state; }

 private:
  void integrate(const physics::Joint& joint, double error, double h_s);

  scene::JointGains gains_;
  bool continuous_;
  State state_;
};

}  // namespace ambf::model
