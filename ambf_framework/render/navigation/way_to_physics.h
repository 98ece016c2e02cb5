// A pose sent to the physics thread that no frame shows yet: whether a frame shows it, and how long to wait for that.
// The user's view moves at once; a pose that never appears was overridden by another controller. Pure functions.
#pragma once

#include <cmath>
#include <cstdint>

#include "math/types.h"

namespace ambf::render {

// Maximum time until a frame shows a move.
inline constexpr std::int64_t kLongestWay_ns = 250'000'000;

// Whether `shown` equals `sent`, except for rounding.
inline bool has_come(const math::Pose& shown, const math::Pose& sent) {
  constexpr double kSame = 1e-9;
  const math::Quat &p = shown.orientation, &q = sent.orientation;
  return math::norm(shown.position - sent.position) < kSame &&
         1.0 - std::abs(p.x * q.x + p.y * q.y + p.z * q.z + p.w * q.w) < kSame;
}

}  // namespace ambf::render
