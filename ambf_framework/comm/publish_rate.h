// When an object's state is due: at its high rate while commanded, at its low rate otherwise (dissertation §3.7). One
// thread. C++17.
#pragma once

#include <cstdint>
#include <optional>

namespace ambf::comm {

// Rates that replace those of every object (--override_min_comm_freq, --override_max_comm_freq), Hz.
struct RateOverride {
  std::optional<double> low_hz, high_hz;
};

class PublishRate {
 public:
  PublishRate(double low_hz, double high_hz, const RateOverride& override_rates = {});

  // Whether to publish now (steady clock, ns). Advances the schedule by one period when it says yes. The mean rate is
  // exact: a wake that comes up to half a period early is taken, and only after more than a period of delay the
  // schedule starts anew. Without anything `newer` to show (paused, throttled, or a step that takes long) the low rate
  // will do for repeating it; what is active stays so.
  bool due(std::int64_t now_ns, bool active, bool newer = true);

  // Time of the next publication at the present rate.
  std::int64_t next_ns() const { return next_ns_; }
  double rate_hz(bool active) const;

 private:
  std::int64_t low_period_ns_, high_period_ns_;
  std::int64_t next_ns_ = 0, last_ns_ = 0;
  bool was_active_ = false;
};

}  // namespace ambf::comm
