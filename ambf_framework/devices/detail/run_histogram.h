// Percentiles of durations over a whole run, exact to 1/32 of the value, on fixed storage. One thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "state/devices.h"

namespace ambf::devices {

class RunHistogram {
 public:
  void add(std::int64_t value_ns);  // negative values count as 0
  // Walks all buckets: now and then.
  state::RunPercentiles percentiles() const;

 private:
  static constexpr int kSubBits = 5;                                   // 32 buckets an octave
  static constexpr int kOctaves = 40 - kSubBits;                       // up to 2^40 ns = 18 minutes
  static constexpr std::size_t kBuckets = (kOctaves + 1) << kSubBits;  // below 32 ns: one each

  static std::size_t bucket_of(std::int64_t value_ns);
  static double middle_of(std::size_t bucket);  // ns

  std::array<std::uint32_t, kBuckets> buckets_{};
  std::uint64_t count_ = 0;
  std::int64_t max_ns_ = 0;
};

}  // namespace ambf::devices
