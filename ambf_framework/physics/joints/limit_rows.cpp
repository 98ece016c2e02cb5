#include "physics/joints/limit_rows.h"

#include <algorithm>
#include <cmath>

#include "physics/detail/world_data.h"

namespace ambf::physics::detail {
namespace {

// A limit joins the solution when it could be reached within a few steps.
constexpr double kLimitNearness = 0.02;  // rad or m
constexpr double kLimitLookahead = 4.0;  // steps at the present rate
// A joint that is far apart (models are seldom assembled to the micrometre) is brought together no faster than this:
// at erp 0.8 and 1 ms gaps of up to 2.5 mm are not affected.
constexpr double kFastestCorrection = 2.0;  // m/s
constexpr double kFastestTurn = 20.0;       // rad/s

}  // namespace

double correction(double error, bool linear, double erp, double h) {
  const double fastest = linear ? kFastestCorrection : kFastestTurn;
  return std::clamp(erp * error / h, -fastest, fastest);
}

double within_limits(const JointData& joint, double velocity, double q, bool linear, double h) {
  if (!joint.limits) return velocity;
  const auto [low, high] = *joint.limits;
  const double at_least = q < low ? correction(low - q, linear, joint.erp, h) : (low - q) / h;
  const double at_most = q > high ? correction(high - q, linear, joint.erp, h) : (high - q) / h;
  return at_least <= at_most ? std::clamp(velocity, at_least, at_most) : velocity;
}

void add_limits(JointData& joint, const Row& row, double q, double rate, double low, double high, double h) {
  const double near = std::max(kLimitNearness, kLimitLookahead * std::abs(rate) * h);
  const auto target = [&](double distance) {
    return distance > 0.0 ? -distance / h : -correction(distance, row.shifts, joint.erp, h);
  };
  const bool near_low = q - low < near, near_high = high - q < near;
  if (near_low) {
    Row& at_low = joint.constraint.push(row);
    at_low.softness = joint.cfm;
    at_low.target = target(q - low);
    at_low.lower = 0.0;
  }
  if (near_high) {
    Row& at_high = joint.constraint.push(row);
    at_high.softness = joint.cfm;
    at_high.target = -target(high - q);
    at_high.upper = 0.0;
  }
  const bool one_coordinate = joint.freedom == Freedom::turn || joint.freedom == Freedom::shift;
  if (!one_coordinate || (near_low && near_high)) return;
  FarLimits& far = joint.constraint.far_limits;
  far.row = row;
  far.row.softness = joint.cfm;
  far.slowest = near_low ? -SIMD_INFINITY : target(q - low);
  far.fastest = near_high ? SIMD_INFINITY : -target(high - q);
}

}  // namespace ambf::physics::detail
