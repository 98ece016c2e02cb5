#include "adf/detail/exact_rpy.h"

#include <cmath>

#include "math/rotation.h"

namespace ambf::adf {

// Roll and pitch are those of what is left when the yaw is taken off.
math::Vec3 exact_rpy(const math::Quat& q) {
  double m[9];
  math::to_matrix(q, m);
  const double yaw = std::hypot(m[0], m[3]) > 1e-15 ? std::atan2(m[3], m[0]) : 0.0, c = std::cos(yaw),
               s = std::sin(yaw);
  const double pitch = std::atan2(-m[6], c * m[0] + s * m[3]);
  const double roll = std::atan2(s * m[2] - c * m[5], c * m[4] - s * m[1]);
  return {roll, pitch, yaw};
}

}  // namespace ambf::adf
