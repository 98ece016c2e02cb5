// What the cases of accuracy_benchmark.cpp should do, integrated by the classical method of fourth order in long
// double, in steps so small that its error is below 1e-9 of the motion. SI units.
#pragma once

#include <array>
#include <vector>

#include "math/types.h"

namespace ambf::accuracy {

// Attitude after `seconds` of a free rigid body: principal inertia (kg m^2) and angular velocity at the start (rad/s),
// both in the body's axes, which are the world's at the start.
math::Quat tumbled(const math::Vec3& inertia, const math::Vec3& omega, double seconds);

// A symmetric top held at its tip. At the start it leans by `tilt` (rad), spins about its axis at `spin` (rad/s), and
// nothing else moves.
struct Top {
  double mass, lever;    // kg; m, from the tip to the centre of mass
  double across, along;  // kg m^2, at the centre of mass, across and along its axis
  double tilt, spin, g;
};
struct TopAngles {
  double tilt = 0.0, precession = 0.0;  // rad
};
// At 0, every, 2 every, ... s: `samples` of them.
std::vector<TopAngles> top_angles(const Top& top, double every, int samples);

// One angle (rad) that moves as inertia angle'' = -weight cos(angle): a pendulum measured from the horizontal, a ladder
// of parallelograms. At 0, every, 2 every, ... s.
std::vector<double> swing(double inertia, double weight, double angle, double rate, double every, int samples);

}  // namespace ambf::accuracy
