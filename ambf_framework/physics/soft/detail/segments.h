// Line segments, and where two are nearest each other. Private to physics/soft/. Any thread.
#pragma once

#include "math/types.h"

namespace ambf::physics::detail {

struct Segment {
  math::Vec3 from, to;
  math::Vec3 at(double share) const { return from * (1.0 - share) + to * share; }
};

struct NearestShares {
  double a = 0.0, b = 0.0;  // of the second ends
  math::Vec3 gap;           // from b to a
};

// Of segments that lie beside each other, the middle of what they share.
NearestShares nearest_shares(const Segment& a, const Segment& b);

}  // namespace ambf::physics::detail
