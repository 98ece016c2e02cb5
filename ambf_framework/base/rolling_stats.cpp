#include "base/rolling_stats.h"

#include <algorithm>
#include <limits>

namespace ambf::base {

std::size_t RollingStats::bucket_of(std::int64_t value_ns) {
  const auto value = static_cast<std::uint64_t>(std::max<std::int64_t>(value_ns, 0));
  if (value < (std::uint64_t{1} << kSubBits)) return static_cast<std::size_t>(value);
  const int top = 63 - __builtin_clzll(value);  // 2^top <= value
  const int octave = top - kSubBits + 1;
  if (octave > kOctaves) return kBuckets - 1;
  const std::uint64_t within = (value >> (top - kSubBits)) - (std::uint64_t{1} << kSubBits);
  return (static_cast<std::size_t>(octave) << kSubBits) + static_cast<std::size_t>(within);
}

std::int64_t RollingStats::middle_of(std::size_t bucket) {
  const auto octave = static_cast<int>(bucket >> kSubBits);
  const auto within = static_cast<std::int64_t>(bucket & ((std::size_t{1} << kSubBits) - 1));
  if (octave == 0) return within;
  const int shift = octave - 1;
  return ((((std::int64_t{1} << kSubBits) + within) << shift) + ((std::int64_t{1} << shift) >> 1));
}

void RollingStats::forget_until(std::int64_t now_ns) {
  const std::int64_t part = now_ns / part_ns_;
  if (part <= current_) return;
  const std::int64_t steps = std::min<std::int64_t>(part - current_, kParts);
  for (std::int64_t i = 1; i <= steps; ++i) {
    Part& old = parts_[static_cast<std::size_t>((part - steps + i) % kParts)];
    if (old.count == 0) continue;
    for (std::size_t b = 0; b < kBuckets; ++b) total_[b] -= old.buckets[b];
    count_ -= old.count;
    old = Part{};
  }
  current_ = part;
}

void RollingStats::add(std::int64_t value_ns, std::int64_t now_ns) {
  forget_until(now_ns);
  Part& part = parts_[static_cast<std::size_t>(current_ % kParts)];
  const std::size_t bucket = bucket_of(value_ns);
  if (part.buckets[bucket] == std::numeric_limits<std::uint16_t>::max())
    return;  // more than 65535 alike in one part: enough
  ++part.buckets[bucket];
  ++part.count;
  part.max_ns = std::max(part.max_ns, value_ns);
  ++total_[bucket];
  ++count_;
}

Percentiles RollingStats::percentiles(std::int64_t now_ns) {
  forget_until(now_ns);
  Percentiles result;
  result.count = count_;
  if (count_ == 0) return result;
  for (const Part& part : parts_) result.max_ns = std::max(result.max_ns, part.max_ns);
  // The smallest value that at least the given share of all values does not exceed.
  const auto rank = [this](std::uint64_t thousandths) { return (count_ * thousandths + 999) / 1000; };
  struct {
    std::uint64_t rank;
    std::int64_t* out;
  } wanted[] = {{rank(500), &result.p50_ns}, {rank(990), &result.p99_ns}, {rank(999), &result.p999_ns}};
  std::uint64_t below = 0;
  std::size_t next = 0;
  for (std::size_t b = 0; b < kBuckets && next < 3; ++b) {
    below += total_[b];
    while (next < 3 && below >= wanted[next].rank) *wanted[next++].out = std::min(middle_of(b), result.max_ns);
  }
  return result;
}

void RollingStats::clear() {
  parts_ = {};
  total_ = {};
  count_ = 0;
}

void RollingRate::start(std::int64_t now_ns, double counter) {
  first_ = 0;
  count_ = 1;
  marks_[0] = last_ = {now_ns, counter};
}

void RollingRate::update(std::int64_t now_ns, double counter) {
  if (count_ == 0) start(now_ns, counter);
  last_ = {now_ns, counter};
  const Mark& newest = marks_[static_cast<std::size_t>((first_ + count_ - 1) % kMarks)];
  if (now_ns - newest.ns >= kMarkNs) {
    if (count_ == kMarks) {
      first_ = (first_ + 1) % kMarks;
      --count_;
    }
    marks_[static_cast<std::size_t>((first_ + count_) % kMarks)] = last_;
    ++count_;
  }
  // After a long stall the older marks lie far back: keep only one that is older than a second.
  while (count_ > 2 && now_ns - marks_[static_cast<std::size_t>((first_ + 1) % kMarks)].ns >= (kMarks - 1) * kMarkNs) {
    first_ = (first_ + 1) % kMarks;
    --count_;
  }
}

double RollingRate::per_second() const {
  if (count_ == 0) return 0.0;
  const Mark& oldest = marks_[static_cast<std::size_t>(first_)];
  const std::int64_t ns = last_.ns - oldest.ns;
  return ns > 0 ? (last_.counter - oldest.counter) / (static_cast<double>(ns) * 1e-9) : 0.0;
}

}  // namespace ambf::base
