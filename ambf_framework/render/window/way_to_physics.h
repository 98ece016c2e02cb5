// A pose that was sent to the physics thread and has not shown in a frame yet: how to tell that it has come, and how long to wait for it.
// What a user moves counts as moved at once; a pose that never comes back lost against another controller's. Pure.
#pragma once

#include <cmath>
#include <cstdint>

#include "math/types.h"

namespace ambf::render {

// A move takes at most so long to the physics thread and back.
inline constexpr std::int64_t kLongestWay_ns = 250'000'000;

// Whether a frame shows what was sent, but for rounding.
inline bool has_come(const math::Pose& shown, const math::Pose& sent) {
  constexpr double kSame = 1e-9;
  const math::Quat &p = shown.orientation, &q = sent.orientation;
  return math::norm(shown.position - sent.position) < kSame &&
         1.0 - std::abs(p.x * q.x + p.y * q.y + p.z * q.z + p.w * q.w) < kSame;
}

}  // namespace ambf::render
