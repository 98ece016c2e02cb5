// Statistics of a SpreadMeter, merged over the last half minute. Main thread.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <utility>

#include "state/frame.h"

namespace ambf::render {

class SpreadHistory {
 public:
  static constexpr std::int64_t kSpan_ns = 30'000'000'000;

  // Whenever there is a frame: takes what is new in it and forgets what is old.
  void take(const state::Spread& spread, std::int64_t now_ns) {
    if (spread.number != 0 && spread.number != last_) seconds_.emplace_back(now_ns, spread);
    last_ = spread.number;
    while (!seconds_.empty() && now_ns - seconds_.front().first > kSpan_ns) seconds_.pop_front();
  }
  void clear() {
    seconds_.clear();
    last_ = 0;
  }

  // Over all spans of these seconds; count 0: there were none.
  state::Spread all() const {
    state::Spread sum;
    double total = 0.0, squares = 0.0;
    for (const auto& [when_ns, second] : seconds_) {
      const double n = second.count, mean = second.mean_s, deviation = second.deviation_s;
      sum.min_s = sum.count == 0 ? second.min_s : std::min(sum.min_s, second.min_s);
      sum.max_s = std::max(sum.max_s, second.max_s);
      sum.count += second.count;
      total += n * mean;
      squares += n * (mean * mean + deviation * deviation);
    }
    if (sum.count == 0) return sum;
    const double mean = total / sum.count;
    sum.number = last_;
    sum.mean_s = static_cast<float>(mean);
    sum.deviation_s = static_cast<float>(std::sqrt(std::max(0.0, squares / sum.count - mean * mean)));
    return sum;
  }

 private:
  std::deque<std::pair<std::int64_t, state::Spread>> seconds_;
  std::uint32_t last_ = 0;
};

}  // namespace ambf::render
