// Two operators at emulated MTMs carry a ring of the peg-transfer scene from a left peg to a right one: the left one
// picks it, hands it over in the air, the right one places it. Each sees through a camera of its own and corrects by
// what it sees; the ring is held by friction alone. One thread.
#pragma once

#include <string>

namespace ambf::devices::testing {

struct TransferResult {
  std::string problem;       // what went wrong; empty: the ring is on the peg
  double seconds = 0.0;      // simulated
  double max_force_N = 0.0;  // that a hand was given
  double max_torque_Nm = 0.0;
  double limit_N = 0.0;    // of the device file
  double off_peg_m = 0.0;  // ring from the middle of its peg, at the end
};

// Differs by its seed: the operators' tremor, where their arms and fingers are at the start, and the peg.
TransferResult transfer_ring(unsigned seed);

}  // namespace ambf::devices::testing
