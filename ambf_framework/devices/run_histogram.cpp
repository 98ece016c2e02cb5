#include "devices/detail/run_histogram.h"

#include <algorithm>
#include <bit>

namespace ambf::devices {

std::size_t RunHistogram::bucket_of(std::int64_t value_ns) {
  const auto value = static_cast<std::uint64_t>(value_ns);
  const int octave = std::max(0, static_cast<int>(std::bit_width(value)) - 1 - kSubBits);
  const std::size_t bucket = (static_cast<std::size_t>(octave) << kSubBits) + static_cast<std::size_t>(value >> octave);
  return std::min(bucket, kBuckets - 1);
}

double RunHistogram::middle_of(std::size_t bucket) {
  constexpr std::size_t kSub = std::size_t{1} << kSubBits;
  if (bucket < 2 * kSub) return static_cast<double>(bucket);
  const std::size_t octave = (bucket >> kSubBits) - 1;
  const auto low = static_cast<double>((bucket - (octave << kSubBits)) << octave);
  return low + 0.5 * static_cast<double>(std::size_t{1} << octave);
}

void RunHistogram::add(std::int64_t value_ns) {
  const std::int64_t value = std::max<std::int64_t>(0, value_ns);
  ++buckets_[bucket_of(value)];
  ++count_;
  max_ns_ = std::max(max_ns_, value);
}

state::RunPercentiles RunHistogram::percentiles() const {
  state::RunPercentiles out;
  out.count = count_;
  out.max_s = static_cast<double>(max_ns_) * 1e-9;
  const double shares[] = {0.5, 0.99, 0.999};
  double* const values[] = {&out.p50_s, &out.p99_s, &out.p999_s};
  std::uint64_t below = 0;
  std::size_t next = 0;
  for (std::size_t bucket = 0; bucket < kBuckets && next < 3; ++bucket) {
    below += buckets_[bucket];
    while (next < 3 && below > 0 && static_cast<double>(below) >= shares[next] * static_cast<double>(count_)) {
      *values[next++] = std::min(middle_of(bucket) * 1e-9, out.max_s);
    }
  }
  return out;
}

}  // namespace ambf::devices
