#include "ros_comm/child_program.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>
#include <cstring>

#include <chrono>
#include <thread>

#include "base/spawn.h"

namespace ambf::ros_comm {

namespace {

constexpr int kStopAttempts = 150;  // of 10 ms, before it is killed

// The shell reads from a pipe that we never write to: when we end, however that comes about, the kernel closes our end,
// the shell goes on and takes the program with it. When the program ends by itself the shell stays until we close the
// pipe.
constexpr const char* kWatch = "\"$0\" \"$@\" & program=$!; read -r _; kill $program 2>/dev/null; wait $program";

}  // namespace

ChildProgram::~ChildProgram() { stop(); }

bool ChildProgram::start(const std::vector<std::string>& command, std::string& problem, bool errors_shown) {
  const std::string program = base::find_program(command.front());
  if (program.empty()) {
    problem = "there is no program '" + command.front() + (command.front()[0] == '/' ? "'" : "' on the PATH");
    return false;
  }
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) {
    problem = std::string("cannot make a pipe: ") + std::strerror(errno);
    return false;
  }
  std::vector<std::string> watched = {"/bin/sh", "-c", kWatch, program};
  watched.insert(watched.end(), command.begin() + 1, command.end());
  base::Streams streams;
  streams.input = ends[0];
  if (errors_shown) streams.errors = base::kAsOurs;
  pid_ = base::spawn(watched, streams, problem);
  close(ends[0]);
  if (pid_ > 0) {
    lifeline_ = ends[1];
    return true;
  }
  close(ends[1]);
  return false;
}

void ChildProgram::stop() {
  if (pid_ < 0) return;
  close(lifeline_);
  lifeline_ = -1;
  for (int i = 0; i < kStopAttempts && pid_ > 0; ++i) {
    if (waitpid(pid_, nullptr, WNOHANG) != 0) {
      pid_ = -1;
    } else {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }
  if (pid_ < 0) return;
  kill(-pid_, SIGKILL);  // the shell leads its session's group: the program, too
  waitpid(pid_, nullptr, 0);
  pid_ = -1;
}

}  // namespace ambf::ros_comm
