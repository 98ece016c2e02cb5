#include "base/log_tail.h"

#include <utility>

namespace ambf::base {

void LogTail::add(const LogLine& line) {
  const std::lock_guard lock(mutex_);
  lines_.push_back(line);
  if (lines_.size() > most_) lines_.pop_front();
  count_.fetch_add(1, std::memory_order_release);
}

std::vector<LogLine> LogTail::lines() const {
  const std::lock_guard lock(mutex_);
  return {lines_.begin(), lines_.end()};
}

LogSink both(LogSink first, LogSink second) {
  return [first = std::move(first), second = std::move(second)](const LogLine& line) {
    first(line);
    second(line);
  };
}

}  // namespace ambf::base
