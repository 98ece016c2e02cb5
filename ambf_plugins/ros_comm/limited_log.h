// Lines that thousands of messages a second may cause: at most a few a second reach the log, and how many were left out
// is reported. One thread at a time. C++17.
#pragma once

#include <cstdint>
#include <string>

#include "base/log.h"

namespace ambf::ros_comm {

class LimitedLog {
 public:
  LimitedLog(base::Log& log, base::Severity severity, std::string what, unsigned lines_per_second = 5)
      : log_(log), severity_(severity), what_(std::move(what)), limit_(lines_per_second) {}

  void add(const std::string& text, std::int64_t now_ns);

 private:
  void write(const std::string& text);

  base::Log& log_;
  const base::Severity severity_;
  const std::string what_;  // of the lines, in the plural: "refused commands"
  const unsigned limit_;
  std::int64_t window_started_ns_ = 0;
  unsigned said_ = 0;
  std::uint64_t left_out_ = 0;
};

}  // namespace ambf::ros_comm
