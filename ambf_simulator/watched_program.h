// A program of ours whose words and end matter: its output comes in lines, its end as an exit code. It is asked to end (SIGINT) also when
// the thread that started it ends, however that comes about. Never leaves a zombie. One thread.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace ambf::simulator {

class WatchedProgram {
 public:
  enum class Talk {
    no,   // it has no input; all it says is in lines()
    yes,  // it hears say(); its output is what take_words() gives, its errors are in lines()
  };

  WatchedProgram() = default;
  ~WatchedProgram();  // kills it
  WatchedProgram(const WatchedProgram&) = delete;
  WatchedProgram& operator=(const WatchedProgram&) = delete;

  // `command`: a program by its path, then its arguments. False, with `problem`, when it cannot be started. One at a time.
  bool start(const std::vector<std::string>& command, std::string& problem, Talk talk = Talk::no);

  // Waits at most so long for words or its end. Its exit code once it has ended (128 + the signal that ended it), then it is gone.
  std::optional<int> watch(int milliseconds);
  const std::vector<std::string>& lines() const { return lines_; }  // the last of what it said, whole lines

  std::vector<std::string> take_words();  // whole lines since the last call; what is too long is cut
  void say(const std::string& line);      // never waits: what it does not take yet goes with the next watch()
  void hang_up();                         // its input ends

  void interrupt();  // asks it to end
  void kill();       // makes it end

 private:
  static constexpr std::size_t kMostLines = 100, kLongestLine = 4096, kLongestWord = 16u << 20;

  struct Stream {
    int file = -1;  // our end; -1: closed
    std::string line;
    std::size_t longest = kLongestLine;
    bool read(std::vector<std::string>& to);  // what is there; false: nothing more comes
    void close();
  };
  void read();
  void write();

  pid_t pid_ = -1;
  Stream output_, errors_;  // without talk, output_ has both
  int input_ = -1;          // our end of a socket
  bool talks_ = false;
  std::string unsaid_;
  std::vector<std::string> lines_, words_;
};

}  // namespace ambf::simulator
