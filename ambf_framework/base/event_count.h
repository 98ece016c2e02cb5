// Event count: "something has happened since you looked". notify_all() is one atomic addition when nobody sleeps, and
// never blocks, so real-time threads may call it in each iteration. Sleepers pass the count that they have seen; a
// notification between looking and sleeping is therefore never missed:
//   const auto seen = event.count();
//   if (nothing to do) event.wait_beyond(seen, timeout);
// Any thread, any function; C++17.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>

#include "base/clock.h"
#include "base/futex.h"

namespace ambf::base {

class EventCount {
 public:
  EventCount() = default;
  EventCount(const EventCount&) = delete;
  EventCount& operator=(const EventCount&) = delete;

  // Number of notifications so far, modulo 2^32.
  std::uint32_t count() const { return count_.load(std::memory_order_seq_cst); }

  void notify_all() {
    count_.fetch_add(1, std::memory_order_seq_cst);
    if (sleepers_.load(std::memory_order_seq_cst) != 0) futex_wake_all(count_);
  }

  // Sleeps until count() differs from `seen` or the timeout is over; returns whether it differs.
  bool wait_beyond(std::uint32_t seen, std::chrono::nanoseconds timeout) {
    if (count() != seen) return true;
    return timeout.count() > 0 && wait_until(seen, steady_ns() + timeout.count());
  }

  // The same with an absolute time of the steady clock (kNoDeadline: for ever).
  bool wait_until(std::uint32_t seen, std::int64_t deadline_ns) {
    if (count() != seen) return true;
    sleepers_.fetch_add(1, std::memory_order_seq_cst);
    bool in_time = true;
    while (count() == seen && in_time) in_time = futex_wait(count_, seen, deadline_ns);
    sleepers_.fetch_sub(1, std::memory_order_seq_cst);
    return count() != seen;
  }

 private:
  std::atomic<std::uint32_t> count_{0};
  std::atomic<std::uint32_t> sleepers_{0};
};

}  // namespace ambf::base
