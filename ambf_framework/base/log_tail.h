// The last lines of a log, for windows that show them: a sink beside the usual one. It keeps a fixed number and never
// prints.
// Threads: add: one (the log drain's); the rest: any. C++17.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <vector>

#include "base/log_drain.h"

namespace ambf::base {

class LogTail {
 public:
  explicit LogTail(std::size_t lines = 1000) : most_(lines) {}

  void add(const LogLine& line);
  std::uint64_t count() const { return count_.load(std::memory_order_acquire); }  // of all that were added
  std::vector<LogLine> lines() const;                                             // oldest first

 private:
  const std::size_t most_;
  std::atomic<std::uint64_t> count_{0};
  mutable std::mutex mutex_;
  std::deque<LogLine> lines_;
};

// Gives each line to both.
LogSink both(LogSink first, LogSink second);

}  // namespace ambf::base
