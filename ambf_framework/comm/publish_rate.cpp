#include "comm/publish_rate.h"

#include <algorithm>
#include <cmath>

namespace ambf::comm {

namespace {
constexpr double kLowestRateHz = 0.01;  // a rate of zero would mean never; once in 100 s still shows a living object
constexpr double kNsPerSecond = 1e9;

std::int64_t period_ns(double rate_hz) {
  return static_cast<std::int64_t>(std::llround(kNsPerSecond / std::max(rate_hz, kLowestRateHz)));
}
}  // namespace

PublishRate::PublishRate(double low_hz, double high_hz, const RateOverride& override_rates) {
  const double low = override_rates.low_hz.value_or(low_hz);
  const double high = override_rates.high_hz.value_or(high_hz);
  low_period_ns_ = period_ns(low);
  high_period_ns_ = period_ns(std::max(low, high));
}

bool PublishRate::due(std::int64_t now_ns, bool active, bool newer) {
  const std::int64_t period = active ? high_period_ns_ : low_period_ns_;
  if (active != was_active_) {
    // A first command shows at once; on going idle the next state is one slow period away at most.
    was_active_ = active;
    next_ns_ = active ? now_ns : std::min(next_ns_, now_ns + period);
  }
  if (!newer && now_ns < last_ns_ + low_period_ns_) return false;
  if (now_ns + period / 2 < next_ns_) return false;
  next_ns_ = now_ns - next_ns_ > period ? now_ns + period : next_ns_ + period;
  last_ns_ = now_ns;
  return true;
}

double PublishRate::rate_hz(bool active) const {
  return kNsPerSecond / static_cast<double>(active ? high_period_ns_ : low_period_ns_);
}

}  // namespace ambf::comm
