// Measures how spans of time vary, one second after the other: adding costs a few nanoseconds, nothing allocates. One
// thread at a time; times are handed in, steady nanoseconds. For use inside model/ only.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/clock.h"
#include "state/frame.h"

namespace ambf::model {

class SpreadMeter {
 public:
  // A span that ended now; what comes first after a second begins the next one.
  void add(double span_s, std::int64_t now_ns) {
    if (count_ > 0 && now_ns - begun_ns_ >= base::kNanosecondsPerSecond) finish();
    if (count_ == 0) {
      begun_ns_ = now_ns;
      min_s_ = max_s_ = first_s_ = span_s;
      sum_ = squares_ = 0.0;
    }
    ++count_;
    min_s_ = std::min(min_s_, span_s);
    max_s_ = std::max(max_s_, span_s);
    sum_ += span_s - first_s_;  // from the first one, so that little is lost in the difference of squares
    squares_ += (span_s - first_s_) * (span_s - first_s_);
  }
  // Of the last second that is over.
  const state::Spread& last() const { return last_; }

 private:
  void finish() {
    const double mean = sum_ / count_;
    ++last_.number;
    last_.count = count_;
    last_.min_s = static_cast<float>(min_s_);
    last_.mean_s = static_cast<float>(first_s_ + mean);
    last_.max_s = static_cast<float>(max_s_);
    last_.deviation_s = static_cast<float>(std::sqrt(std::max(0.0, squares_ / count_ - mean * mean)));
    count_ = 0;
  }

  state::Spread last_;
  std::int64_t begun_ns_ = 0;
  std::uint32_t count_ = 0;
  double min_s_ = 0.0, max_s_ = 0.0, first_s_ = 0.0, sum_ = 0.0, squares_ = 0.0;
};

}  // namespace ambf::model
