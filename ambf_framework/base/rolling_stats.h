// Percentiles of durations (lateness, step cost) over the last second, exact to 1/32 of the value, on fixed storage:
// adding costs a few nanoseconds, nothing allocates. And rates (steps a second, real-time factor) over the same time.
// One thread at a time; times are handed in, steady nanoseconds that never go back. C++17.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace ambf::base {

struct Percentiles {
  std::uint64_t count = 0;
  std::int64_t p50_ns = 0, p99_ns = 0, p999_ns = 0;
  std::int64_t max_ns = 0;  // exact
};

// A histogram with 32 buckets an octave, kept for ten parts of the window; the oldest part is forgotten as a whole.
class RollingStats {
 public:
  explicit RollingStats(std::int64_t window_ns = 1000000000)
      : part_ns_(window_ns / kParts > 0 ? window_ns / kParts : 1) {}

  void add(std::int64_t value_ns, std::int64_t now_ns);  // negative values count as 0
  Percentiles percentiles(std::int64_t now_ns);
  void clear();

 private:
  static constexpr int kParts = 10;
  static constexpr int kSubBits = 5;                                   // 32 buckets an octave
  static constexpr int kOctaves = 40 - kSubBits;                       // up to 2^40 ns = 18 minutes
  static constexpr std::size_t kBuckets = (kOctaves + 1) << kSubBits;  // below 32 ns: one each

  static std::size_t bucket_of(std::int64_t value_ns);
  static std::int64_t middle_of(std::size_t bucket);
  void forget_until(std::int64_t now_ns);

  struct Part {
    std::array<std::uint16_t, kBuckets> buckets{};
    std::uint64_t count = 0;
    std::int64_t max_ns = 0;
  };

  std::int64_t part_ns_;
  std::int64_t current_ = 0;  // number of the part that time is in
  std::array<Part, kParts> parts_{};
  std::array<std::uint32_t, kBuckets> total_{};
  std::uint64_t count_ = 0;
};

// How fast a counter has grown over the last second (less, when it was started later). The counter never goes back.
class RollingRate {
 public:
  void start(std::int64_t now_ns, double counter = 0.0);
  void update(std::int64_t now_ns, double counter);
  double per_second() const;  // as of the last update

 private:
  static constexpr int kMarks = 21;
  static constexpr std::int64_t kMarkNs = 50000000;  // 20 marks are one second
  struct Mark {
    std::int64_t ns = 0;
    double counter = 0.0;
  };
  std::array<Mark, kMarks> marks_{};
  int first_ = 0, count_ = 0;
  Mark last_;
};

}  // namespace ambf::base
