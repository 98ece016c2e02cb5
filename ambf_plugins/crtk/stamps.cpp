#include "crtk/stamps.h"

#include <algorithm>

#include "base/clock.h"

namespace ambf::crtk {

std::int64_t Stamps::of(const state::Frame& frame) {
  if (!simulated_) return frame.system_ns;
  const std::int64_t time_ns = base::to_ns(frame.sim_time);
  const std::int64_t newest = newest_ns_.load(std::memory_order_relaxed);
  if (frame.epoch != epoch_) {
    epoch_ = frame.epoch;
    offset_ns_ = std::max<std::int64_t>(0, newest - time_ns);
  }
  const std::int64_t now = std::max(newest, time_ns + offset_ns_);
  newest_ns_.store(now, std::memory_order_relaxed);
  return now;
}

std::int64_t Stamps::now() const { return simulated_ ? newest_ns_.load(std::memory_order_relaxed) : base::system_ns(); }

}  // namespace ambf::crtk
