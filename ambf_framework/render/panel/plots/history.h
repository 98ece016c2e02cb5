// Rates and times of the simulation over the last half minute, ten samples a second of wall time. Main thread.
#pragma once

#include <array>
#include <cstdint>
#include <deque>

#include "state/frame.h"

namespace ambf::render {

class History {
 public:
  static constexpr std::int64_t kEvery_ns = 100'000'000;
  static constexpr std::size_t kMost = 300;  // 30 s
  struct Sample {
    float real_time_factor = 0.0F, pictures_per_second = 0.0F;
    std::array<float, state::kPhaseCount> phases_s{};  // of a step
  };

  // Cheap; takes a sample when it is time for one.
  void take(const state::Frame& frame, std::int64_t now_ns) {
    if (now_ns < next_ns_) return;
    next_ns_ = now_ns + kEvery_ns;
    Sample sample;
    sample.real_time_factor = static_cast<float>(frame.run.paused ? 0.0 : frame.run.real_time_factor);
    sample.pictures_per_second = static_cast<float>(frame.run.graphics_rate);
    for (std::size_t i = 0; i < sample.phases_s.size(); ++i) {
      sample.phases_s[i] = static_cast<float>(frame.run.seconds_per_phase[i]);
    }
    samples_.push_back(sample);
    if (samples_.size() > kMost) samples_.pop_front();
  }
  const std::deque<Sample>& samples() const { return samples_; }

 private:
  std::deque<Sample> samples_;
  std::int64_t next_ns_ = 0;
};

}  // namespace ambf::render
