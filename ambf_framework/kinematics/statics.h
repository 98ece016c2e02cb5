// Forces and velocities at a tip, from the joints' and for them. Jacobians are 6 x n, row-major (kinematics/chain.h).
// Pure functions, any thread; results are always finite for finite input.
#pragma once

#include <array>
#include <vector>

#include "kinematics/answer.h"

namespace ambf::kinematics {

using SixVector = std::array<double, 6>;  // linear part (m/s, N), then angular part (rad/s, Nm)

// The wrench w whose efforts, transposed Jacobian x w, are nearest to these: its pseudo-inverse. What the arm cannot
// feel, because no joint moves that way, is 0.
SixVector wrench_of(const std::vector<double>& jacobian, const Joints& efforts);

// Joint velocities for a velocity of the tip, by damped least squares: slow rather than fast near singular positions.
Joints rates_for(const std::vector<double>& jacobian, const SixVector& twist);

// Jacobian x rates.
SixVector twist_of(const std::vector<double>& jacobian, const Joints& rates);

// Transposed Jacobian x wrench.
Joints efforts_for(const std::vector<double>& jacobian, const SixVector& wrench);

}  // namespace ambf::kinematics
