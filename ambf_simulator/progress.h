// How far something has come that takes longer than a person likes to wait, and how long it will still take: a line
// that is rewritten on a terminal, else a message now and then. One thread.
#pragma once

#include <cstdint>
#include <string>

#include "base/log.h"

namespace ambf::simulator {

// "[######--------------]  30 %, 0:42 left". `elapsed_s` for `done` of `total` (both above zero).
std::string progress_text(unsigned done, unsigned total, double elapsed_s);

class Progress {
 public:
  // Silent for its first two seconds.
  Progress(base::Log& log, std::string what, unsigned total);
  ~Progress();  // leaves no half line behind
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void done(unsigned count);  // of the total

 private:
  base::Log& log_;
  const std::string what_;
  const unsigned total_;
  const bool terminal_;
  const std::int64_t begun_ns_;
  std::int64_t shown_ns_;
  std::size_t shown_length_ = 0;  // of the line on the terminal
};

}  // namespace ambf::simulator
