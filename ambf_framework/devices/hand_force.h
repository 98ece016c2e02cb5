// The force on a hand: Table 3.5, rows 12-16, of the dissertation as corrected in the design notes (EQUATIONS 6). It
// pulls the hand to where its effector is, within limits that hold in every cycle. One HandForce a device, used by the
// device's thread: no allocation, no time of its own.
#pragma once

#include "math/types.h"
#include "state/devices.h"

namespace ambf::devices {

struct HandForceInput {
  math::Pose T_world_ref, T_world_sde;
  math::Twist twist_world_ref, twist_world_sde;  // of the body (mesh) frame's origin
  state::EffectorGains gains;                    // linear by axis of W, angular by axis of the body frame
  math::Quat R_world_u;                          // forces: of the device's camera
  math::Quat R_world_u_torque;                   // the same; in mode w that of SDE-BO
  math::Wrench external_world;                   // added before the limits
  state::HandLimits limits;                      // with the hardware's own; 0: none
  bool torque = false;                           // the device can exert torques
  bool allowed = false;  // forces are on, and the hand is neither clutched nor held at the start; else 0
  bool fault = false;    // force falls to 0 within state::kDeviceReleaseS; max jerk does not apply
  double ramp_s = 1.0;   // from nothing to all of it, once it is allowed
  double dt = 1e-3;      // s since the last cycle
};

struct HandForceOutput {
  math::Wrench wanted_u;   // the law and the external wrench
  math::Wrench written_u;  // within limits
  bool at_limit = false;
};

class HandForce {
 public:
  // In this order: clutch or fault; ramp; deadband; max force and torque; max jerk.
  HandForceOutput step(const HandForceInput& in);

 private:
  math::Wrench law(const HandForceInput& in) const;

  math::Wrench written_u_;
  double ramp_ = 0.0;  // 0 .. 1
  bool fault_ = false;
  math::Wrench at_fault_u_;
  double since_fault_s_ = 0.0;
};

// K_h <= K_max / S: felt stiffness at the hand is S K_h. max_stiffness 0: unbounded. Damping shrinks as much.
state::EffectorGains bounded(const state::EffectorGains& hand_gains, double max_stiffness_N_m,
                             double workspace_scaling);
// The device file's limits and the hardware's: the smaller one counts; a file without one leaves the hardware's.
state::HandLimits combined(const state::HandLimits& file, double device_max_force_N, double device_max_torque_Nm);

}  // namespace ambf::devices
