#include "base/log_drain.h"

#include <pthread.h>
#include <signal.h>

#include <algorithm>
#include <utility>

#include "base/realtime.h"

namespace ambf::base {

void RepeatFilter::emit_count(Entry& entry, std::int64_t now_ns, const Emit& emit) {
  if (entry.held_back == 0) return;
  const std::string times =
      entry.held_back == 1 ? " (repeated once)" : " (repeated " + std::to_string(entry.held_back) + " times)";
  emit({entry.severity, now_ns, entry.complete, entry.text + times});
  entry.held_back = 0;
}

void RepeatFilter::accept(const LogRecord& record, std::int64_t now_ns, const Emit& emit) {
  tick(now_ns, emit);
  for (Entry& entry : entries_) {
    if (entry.severity == record.severity && entry.text == record.text) {
      ++entry.held_back;
      return;
    }
  }
  if (entries_.size() == kRemembered) {  // forget the one that pauses longest
    const auto oldest = std::min_element(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
      return a.paused_since_ns < b.paused_since_ns;
    });
    emit_count(*oldest, now_ns, emit);
    entries_.erase(oldest);
  }
  emit({record.severity, record.steady_ns, record.complete, record.text});
  entries_.push_back({record.severity, record.complete, record.text, now_ns, kFirstPauseNs, 0});
}

void RepeatFilter::tick(std::int64_t now_ns, const Emit& emit) {
  for (std::size_t i = 0; i < entries_.size();) {
    Entry& entry = entries_[i];
    if (now_ns - entry.paused_since_ns < entry.pause_ns) {
      ++i;
    } else if (entry.held_back == 0) {  // silent for a whole pause: the next one is news again
      entries_.erase(entries_.begin() + static_cast<std::ptrdiff_t>(i));
    } else {
      emit_count(entry, now_ns, emit);
      entry.paused_since_ns = now_ns;
      entry.pause_ns = std::min(2 * entry.pause_ns, kLongestPauseNs);
      ++i;
    }
  }
}

void RepeatFilter::flush(const Emit& emit) {
  for (Entry& entry : entries_) emit_count(entry, steady_ns(), emit);
}

std::int64_t RepeatFilter::next_due_ns() const {
  std::int64_t due = kNoDeadline;
  for (const Entry& entry : entries_) {
    if (entry.held_back == 0) continue;
    const std::int64_t at = entry.paused_since_ns + entry.pause_ns;
    if (due == kNoDeadline || at < due) due = at;
  }
  return due;
}

LogDrain::LogDrain(Log& log, LogSink sink) : log_(log), sink_(std::move(sink)) {
  log_.set_drained(true);
  thread_ = std::thread([this] { run(); });
}

LogDrain::~LogDrain() {
  stop_.store(true, std::memory_order_release);
  log_.event().notify_all();
  thread_.join();
  log_.set_drained(false);
}

void LogDrain::flush() {
  const std::uint32_t ticket = flush_wanted_.fetch_add(1, std::memory_order_acq_rel) + 1;
  log_.event().notify_all();
  for (;;) {
    const auto seen = flushed_.count();
    if (static_cast<std::int32_t>(flush_done_.load(std::memory_order_acquire) - ticket) >= 0) return;
    flushed_.wait_until(seen, kNoDeadline);
  }
}

void LogDrain::pass(bool with_counts) {
  LogRecord record;
  while (log_.take(record)) filter_.accept(record, steady_ns(), sink_);
  filter_.tick(steady_ns(), sink_);
  if (with_counts) filter_.flush(sink_);
  const std::uint64_t lost = log_.lost();
  if (lost != lost_told_) {
    sink_({Severity::warning, steady_ns(), false,
           std::to_string(lost - lost_told_) + " messages were lost: too many at once"});
    lost_told_ = lost;
  }
}

void LogDrain::run() {
  set_thread_name("ambf-log");
  // A closed pipe then is an error of write() instead of the end of the program. All signals belong to other threads
  // anyway.
  sigset_t all;
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, nullptr);
  for (;;) {
    const auto seen = log_.event().count();
    const bool last = stop_.load(std::memory_order_acquire);
    const std::uint32_t ticket = flush_wanted_.load(std::memory_order_acquire);
    const bool wanted = ticket != flush_done_.load(std::memory_order_relaxed);
    pass(wanted || last);
    if (wanted) {
      flush_done_.store(ticket, std::memory_order_release);
      flushed_.notify_all();
    }
    if (last) return;
    log_.event().wait_until(seen, filter_.next_due_ns());
  }
}

}  // namespace ambf::base
