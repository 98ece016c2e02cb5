// How much of a place each corner of a tetrahedron has: places within tissue are named by these. Private to
// physics/soft/. Any thread.
#pragma once

#include <array>

#include "math/types.h"

namespace ambf::physics::detail {

// They sum up to 1; one below 0: the place is beyond the side opposite to that corner.
inline std::array<double, 4> weights_in(const std::array<math::Vec3, 4>& t, const math::Vec3& at) {
  const math::Vec3 a = t[1] - t[0], b = t[2] - t[0], c = t[3] - t[0], p = at - t[0];
  const double six = math::dot(a, math::cross(b, c));
  const double wa = math::dot(p, math::cross(b, c)) / six, wb = math::dot(p, math::cross(c, a)) / six,
               wc = math::dot(p, math::cross(a, b)) / six;
  return {1.0 - wa - wb - wc, wa, wb, wc};
}

}  // namespace ambf::physics::detail
