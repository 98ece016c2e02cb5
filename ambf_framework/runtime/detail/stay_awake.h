// Whether the physics thread stays awake for the next Step request. Who steps in a loop asks again some 0.2 ms after
// each answer; to be woken for that costs the thread 30 us and what its caches held, a tenth of a call of 50 steps. So
// where requests keep coming quickly, it looks for the next one without sleeping, for a millisecond at most; where that
// was in vain it sleeps again until they have come quickly for a while. Pure: times are handed in (steady clock). Owned
// by the physics thread.
#pragma once

#include <cstdint>

namespace ambf::runtime {

class StayAwake {
 public:
  // A Step request came while none was being run.
  void asked(std::int64_t now_ns) {
    const bool quick = answered_ns_ != kNever && now_ns - answered_ns_ <= kLimitNs;
    quick_in_a_row_ = quick ? quick_in_a_row_ + 1 : 0;
  }

  // The last one that was there got its answer.
  void answered(std::int64_t now_ns) { answered_ns_ = now_ns; }

  // The time up to which to look for the next one; kNever: sleep.
  std::int64_t until_ns() const { return quick_in_a_row_ >= kHabit ? answered_ns_ + kLimitNs : kNever; }

  static constexpr std::int64_t kNever = INT64_MIN;
  static constexpr std::int64_t kLimitNs = 1'000'000;
  // Quick requests in a row. Where staying awake itself holds up who asks (they share a processor), it happens once in
  // so many calls.
  static constexpr std::uint32_t kHabit = 16;

 private:
  std::int64_t answered_ns_ = kNever;
  std::uint32_t quick_in_a_row_ = 0;
};

}  // namespace ambf::runtime
