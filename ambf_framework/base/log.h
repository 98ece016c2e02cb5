// Where every thread says what happened. Messages go into a lock-free ring of fixed-size records that LogDrain
// (log_drain.h) empties elsewhere; a real-time thread therefore never waits for a stream, a lock or memory. When the
// ring is full, messages are lost and counted. There is no global log: a Log is handed to those who need one and
// outlives them.
// Threads: write, info, warning, error: any, also real-time. report: any but real-time ones. take: one. C++17.
#pragma once

#include <atomic>
#include <cstdarg>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "base/diagnostic.h"
#include "base/event_count.h"

namespace ambf::base {

inline constexpr std::size_t kLogTextSize = 480;  // with the closing 0; longer real-time messages end in "..."

struct LogRecord {
  Severity severity = Severity::information;
  bool complete = false;       // the text says file, line and severity itself (a Diagnostic)
  std::int64_t steady_ns = 0;  // when it was said
  std::string text;
};

class Log {
 public:
  explicit Log(std::size_t records = 1024);  // rounded up to a power of two
  ~Log();
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;

  // As printf. Neither blocks nor allocates. (Do not print a %f of absurd magnitude: libc may allocate for it; %g is
  // fine.)
  void write(Severity severity, const char* format, ...) __attribute__((format(printf, 3, 4)));
  void info(const char* format, ...) __attribute__((format(printf, 2, 3)));
  void warning(const char* format, ...) __attribute__((format(printf, 2, 3)));
  void error(const char* format, ...) __attribute__((format(printf, 2, 3)));

  // A finding about a file, of any length. Waits a little when the ring is full and somebody drains it.
  void report(const Diagnostic& diagnostic);
  void report(const Diagnostics& diagnostics);

  // Takes the oldest message out; false when there is none.
  bool take(LogRecord& record);

  std::uint64_t lost() const { return lost_.load(std::memory_order_relaxed); }
  EventCount& event() { return event_; }  // notified with each message

  // Said by LogDrain: somebody empties the ring.
  void set_drained(bool drained) { drained_.store(drained, std::memory_order_release); }

 private:
  struct Cell;
  void write_list(Severity severity, const char* format, va_list arguments);
  // Takes `text` or, when that is null, `long_text` over; false when full.
  bool push(Severity severity, const char* text, std::size_t length, std::string* long_text);

  std::unique_ptr<Cell[]> cells_;
  std::size_t mask_;
  std::atomic<bool> drained_{false};
  std::atomic<std::uint64_t> lost_{0};
  alignas(64) std::atomic<std::size_t> tail_{0};
  alignas(64) std::atomic<std::size_t> head_{0};
  EventCount event_;
};

}  // namespace ambf::base
