// A child program whose output is kept as lines and whose exit code is reported. It also receives SIGINT when the
// thread that started it ends, for whatever reason. Never leaves a zombie. One thread.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace ambf::simulator {

class WatchedProgram {
 public:
  WatchedProgram() = default;
  ~WatchedProgram();  // kills it
  WatchedProgram(const WatchedProgram&) = delete;
  WatchedProgram& operator=(const WatchedProgram&) = delete;

  // `command`: a program by its path, then its arguments; it gets no input. False, with `problem`, when it cannot be
  // started. One program at a time.
  bool start(const std::vector<std::string>& command, std::string& problem);

  // Waits up to `milliseconds` for output or its end. Its exit code once it has ended (128 + the signal that ended it).
  std::optional<int> watch(int milliseconds);
  const std::vector<std::string>& lines() const { return lines_; }  // its last output and errors, whole lines

  void interrupt();  // SIGINT: asks it to end
  void kill();       // SIGKILL

 private:
  static constexpr std::size_t kMaxLines = 100, kMaxLineLength = 4096;

  void read();

  pid_t pid_ = -1;
  int output_ = -1;   // our end of its output and errors; -1: closed
  std::string line_;  // begun, not ended yet
  std::vector<std::string> lines_;
};

}  // namespace ambf::simulator
