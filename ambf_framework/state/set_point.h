// What an input device wants of the body that it moves (its effector), and what became of it in the last step. The
// device's thread posts set-points (state/abilities/effector.h); a law of the physics thread pulls the body there in
// every step (EQUATIONS 5, 7). Plain data, C++17.
#pragma once

#include <cstdint>

#include "math/types.h"
#include "state/ids.h"

namespace ambf::state {

// Spring and damper between a reference and a body.
struct EffectorGains {
  math::Vec3 linear_stiffness, linear_damping;    // N/m and N s/m, by axis of the world
  math::Vec3 angular_stiffness, angular_damping;  // N m/rad and N m s/rad, by axis of the body (mesh) frame
};

struct SetPoint {
  math::Pose T_world_ref;   // of the body (mesh) frame
  EffectorGains gains;      // the device's dominance is in them already
  double period_s = 1e-3;   // of the device's samples: the reference moves over it, in steps of physics
  std::uint64_t epoch = 0;  // Frame::epoch in which the device anchored; ignored in any other one
  bool pulls = false;       // false: exerts nothing (let go, a fault, not started yet)
  // False while clutched: the reference stays where it is, whatever T_world_ref, and nothing is exerted along axes on
  // which another device is engaged or a pose or twist command acts: there the reference follows the body. A device
  // that engages again starts from EffectorState::T_world_ref.
  bool engaged = false;
  bool moves_jaw = false;       // the device has a gripper that drives the joints below the body, once it meets them
  double jaw = 0.0;             // 0 closed .. 1 open
  std::uint64_t sample = 0;     // number of the device's sample that it comes from
  std::int64_t sampled_ns = 0;  // steady clock: when that sample was read
};

// One row of a frame for each effector that a source holds.
struct EffectorState {
  std::uint32_t body = kNone;  // slot
  Source source = Source::device_0;
  bool pulls = false, engaged = false;
  bool leads_jaw = false;       // the jaw follows this one
  bool bounded = false;         // gains were cut to what is stable for the sum of all on the body
  math::Pose T_world_ref;       // in force in the last step, interpolated
  math::Twist twist_ref_world;  // of the mesh frame's origin
  EffectorGains gains;          // in force, after bounds
  double jaw = 0.0;
  std::uint64_t sample = 0;  // newest one in force
  std::int64_t sampled_ns = 0;
  std::int64_t applied_ns = 0;   // steady clock: when a step first obeyed that sample; 0: not yet
  std::uint32_t first_step = 0;  // sim_step of that step
};

}  // namespace ambf::state
