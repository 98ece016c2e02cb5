// Whether a soft body of links or tissue sleeps (soft_sleep.cpp). Private to physics/soft/. Physics thread.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "math/types.h"

namespace ambf::physics::detail {

struct SoftSleep {
  // Still is what goes nowhere within half a second. What creeps more slowly is 0.1 mm away after four minutes at the
  // soonest, and what relaxes has done so by then.
  static constexpr double kStillTime_s = 0.5, kStillDistance_m = 2e-7;
  // Links on a floor tremble by a micrometre for ever. What goes further than kStillDistance_m takes as much longer to
  // be known not to creep faster.
  static constexpr double kTrembling_m = 2e-6;
  static constexpr int kLookEvery = 20;  // steps

  double may_tremble = kStillDistance_m;  // m, how far from `at` it may go and be still
  double relaxes_s = 0.0;                 // until hardly any stress is left to relax, which moves nothing that is held
  bool asleep = false;
  double still_s = 0.0;        // for so long nothing of it has gone further from `at` than that
  double furthest = 0.0;       // m, that something went since
  int steps = 0;               // since that was looked at
  std::vector<math::Vec3> at;  // of corners or nodes; none: not looked at yet
  std::uint64_t near = 0;      // of what is near, as the last step began; 0: unknown

  bool is_still() const { return still_s >= kStillTime_s * std::max(1.0, furthest / kStillDistance_m) + relaxes_s; }
  // After a step of `h` seconds, of that many places.
  template <class PlaceOf>
  void watch(std::size_t count, const PlaceOf& place_of, double h) {
    if (++steps < kLookEvery && !at.empty()) return;
    bool stays = at.size() == count;
    for (std::size_t i = 0; i < count && stays; ++i) {
      const double away = math::norm(place_of(i) - at[i]);
      furthest = std::max(furthest, away);
      stays = away <= may_tremble;
    }
    if (stays) {
      still_s += steps * h;
    } else {
      at.clear();
      for (std::size_t i = 0; i < count; ++i) at.push_back(place_of(i));
      still_s = furthest = 0.0;
    }
    steps = 0;
  }
  void restart() {
    asleep = false;
    still_s = furthest = 0.0;
    steps = 0;
    at.clear();
    near = 0;
  }
};

}  // namespace ambf::physics::detail
