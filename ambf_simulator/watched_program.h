// A program of ours whose words and end matter: its output comes in lines, its end as an exit code. It is asked to end (SIGINT) also when
// the thread that started it ends, however that comes about. Never leaves a zombie. One thread.
#pragma once

#include <sys/types.h>

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

  // `command`: a program by its path, then its arguments. False, with `problem`, when it cannot be started. One at a time.
  bool start(const std::vector<std::string>& command, std::string& problem);

  // Waits at most so long for words or its end. Its exit code once it has ended (128 + the signal that ended it), then it is gone.
  std::optional<int> watch(int milliseconds);
  const std::vector<std::string>& lines() const { return lines_; }  // the last of what it said, whole lines

  void interrupt();  // asks it to end
  void kill();       // makes it end

 private:
  static constexpr std::size_t kMostLines = 100, kLongestLine = 4096;

  bool read();  // what is there; false: nothing more comes
  void take(const char* text, std::size_t size);

  pid_t pid_ = -1;
  int output_ = -1;  // our end of a pipe
  std::vector<std::string> lines_;
  std::string line_;
};

}  // namespace ambf::simulator
