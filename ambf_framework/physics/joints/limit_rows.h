// Rows that keep a coordinate within limits, and speeds at which errors are taken back. Private to physics/.
#pragma once

#include "physics/joints/joint_data.h"

namespace ambf::physics::detail {

// Speed (m/s or rad/s) at which an error (m or rad) is taken back within a step of h seconds.
double correction(double error, bool linear, double erp, double h);

// A motor's velocity, no faster than the joint's limits let the coordinate q move in a step.
double within_limits(const JointData& joint, double velocity, double q, bool linear, double h);

// q within [low, high], low < high; reached exactly, not beyond, and pushed back by erp when beyond. `row` measures the
// rate of q. A limit that could be reached within a few steps at the present rate gets a row; of a joint with one
// coordinate the solver knows the others (JointConstraint::far_limits), and looks for them when it has solved.
void add_limits(JointData& joint, const Row& row, double q, double rate, double low, double high, double h);

}  // namespace ambf::physics::detail
