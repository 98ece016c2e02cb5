// What the solvers of this folder know of a body while they work: how much its velocity changes in this step.
// Plain data, one thread at a time.
#pragma once

namespace ambf::physics {

// World axes, at the centre of mass. The fourth entries are padding. A body that does not move has zero inverse mass.
struct alignas(32) BodyDelta {
  double linear[4] = {0.0, 0.0, 0.0, 0.0};        // m/s
  double angular[4] = {0.0, 0.0, 0.0, 0.0};       // rad/s
  double inverse_mass[4] = {0.0, 0.0, 0.0, 0.0};  // 1/kg along each axis (0 where the body is locked)
};

}  // namespace ambf::physics
