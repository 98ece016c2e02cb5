// Four devices, two of 1 kHz with forces and two of 300 Hz without, lift the multi-link puzzle of the original's
// puzzle1 by its handles with grippers of the original, carry it aside and put it down (dissertation Fig. 3.21):
// friction alone holds it. Needs the original's models (tests/support/compat_models.h). One thread.
#pragma once

#include <string>

namespace ambf::devices::testing {

struct LiftResult {
  std::string problem;       // what went wrong; empty: the puzzle lies where it should
  double seconds = 0.0;      // simulated
  double max_force_N = 0.0;  // that a hand was given
  double limit_N = 0.0;      // of the device file
  double off_m = 0.0;        // its middle from where it should lie, at the end
};

// Differs by its seed: the operators' tremor, what they aim at, and where their arms and fingers are at the start.
LiftResult lift_puzzle(unsigned seed);

}  // namespace ambf::devices::testing
