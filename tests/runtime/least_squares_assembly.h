// How well a model's joints can be brought together at all: the body poses near those of a frame that minimise the sum
// of the squared pivot gaps and axis misalignments, active joints staying where they are. What a perfect solver would
// reach where rounded pivots let no loop close.
#pragma once

#include "state/frame.h"
#include "tests/runtime/model_rig.h"

namespace ambf::runtime::test {

struct Assembly {
  bool converged = false;
  double largest_gap = 0.0;    // m, of the pivots
  double largest_angle = 0.0;  // rad, of the axes
  int iterations = 0;
};

// `arm_m` weighs angles against gaps: an axis that is off by e rad counts as e * arm_m metres.
Assembly assemble(const std::vector<JointPlaces>& joints, const state::Structure& structure, const state::Frame& frame,
                  double arm_m = 1.0);

}  // namespace ambf::runtime::test
