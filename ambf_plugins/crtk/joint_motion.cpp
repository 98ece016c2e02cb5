#include "crtk/joint_motion.h"

#include <algorithm>
#include <cmath>

namespace ambf::crtk {

bool advance(JointMotion& motion, double goal, const MotionLimits& limits, double h_s) {
  const double left = goal - motion.position;
  const double change = limits.acceleration * h_s;  // of the velocity, in a step
  constexpr double kRounding = 1.0 + 1e-9;
  if (std::abs(left) <= change * h_s && std::abs(motion.velocity) <= change * kRounding) {
    motion = {goal, 0.0};
    return true;
  }
  // The largest velocity from which equal changes a step end at the goal: n steps cover change x h_s x n (n + 1) / 2.
  const double steps = std::sqrt(0.25 + 2.0 * std::abs(left) / (change * h_s)) - 0.5;
  const double wanted = std::copysign(std::min(limits.velocity, steps * change), left);
  motion.velocity = std::clamp(wanted, motion.velocity - change, motion.velocity + change);
  motion.position += motion.velocity * h_s;
  return false;
}

}  // namespace ambf::crtk
