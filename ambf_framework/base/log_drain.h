// Empties a Log: counts repetitions instead of repeating them, and gives the rest to a sink (standard error and a file,
// or a test's own). Never needed by anybody: a closed pipe, a full disk or a stopped terminal costs lines, not the
// simulation.
// Threads: construct, flush and destroy from any one thread that is not real-time; the sink is called on the drain's
// own thread.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "base/log.h"

namespace ambf::base {

struct LogLine {
  Severity severity = Severity::information;
  std::int64_t steady_ns = 0;
  bool complete = false;  // the text says file, line and severity itself
  std::string text;       // as said, with "(repeated 120 times)" behind where it stands for several
};
using LogSink = std::function<void(const LogLine&)>;

// Lets a message through when it is new, and then holds what repeats it back for a second, two, four ... a minute; at
// the end of each such pause one line reports their number. Pure: time is handed in.
class RepeatFilter {
 public:
  static constexpr std::int64_t kFirstPauseNs = 1000000000;
  static constexpr std::int64_t kLongestPauseNs = 60 * kFirstPauseNs;
  static constexpr std::size_t kRemembered = 64;  // different messages at a time

  using Emit = std::function<void(const LogLine&)>;
  void accept(const LogRecord& record, std::int64_t now_ns, const Emit& emit);
  void tick(std::int64_t now_ns, const Emit& emit);  // pauses that are over
  void flush(const Emit& emit);                      // all counts, now
  std::int64_t next_due_ns() const;                  // when tick() has something to do; kNoDeadline: never

 private:
  struct Entry {
    Severity severity;
    bool complete;
    std::string text;
    std::int64_t paused_since_ns;
    std::int64_t pause_ns;
    std::uint64_t held_back;
  };
  static void emit_count(Entry& entry, std::int64_t now_ns, const Emit& emit);
  std::vector<Entry> entries_;
};

class LogDrain {
 public:
  LogDrain(Log& log, LogSink sink);
  ~LogDrain();  // everything said before is given to the sink
  LogDrain(const LogDrain&) = delete;
  LogDrain& operator=(const LogDrain&) = delete;

  // Returns when everything said before, repetitions included, was given to the sink.
  void flush();

 private:
  void run();
  void pass(bool with_counts);

  Log& log_;
  const LogSink sink_;
  RepeatFilter filter_;
  std::uint64_t lost_told_ = 0;
  std::atomic<bool> stop_{false};
  std::atomic<std::uint32_t> flush_wanted_{0}, flush_done_{0};
  EventCount flushed_;
  std::thread thread_;
};

// The usual sink: lines to standard error, and to a file as well unless `file` is empty. `problem` receives why the
// file cannot be written.
LogSink make_stream_sink(const std::string& file, std::string* problem = nullptr);

}  // namespace ambf::base
