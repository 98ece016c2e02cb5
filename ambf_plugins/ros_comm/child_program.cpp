#include "ros_comm/child_program.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include <chrono>
#include <sstream>
#include <thread>

extern char** environ;

namespace ambf::ros_comm {

namespace {

constexpr int kStopAttempts = 150;  // of 10 ms, before it is killed

// The shell reads from a pipe that we never write to: when we end, however that comes about, the kernel closes our end, the shell goes
// on and takes the program with it. When the program ends by itself the shell stays until we close the pipe.
constexpr const char* kWatch = "\"$0\" \"$@\" & program=$!; read -r _; kill $program 2>/dev/null; wait $program";

bool can_run(const std::string& program) {
  if (program.find('/') != std::string::npos) return access(program.c_str(), X_OK) == 0;
  const char* path = std::getenv("PATH");
  std::stringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (access((folder + "/" + program).c_str(), X_OK) == 0) return true;
  }
  return false;
}

}  // namespace

ChildProgram::~ChildProgram() { stop(); }

bool ChildProgram::start(const std::vector<std::string>& command, std::string& problem, bool errors_shown) {
  if (!can_run(command.front())) {
    problem = "there is no program '" + command.front() + (command.front()[0] == '/' ? "'" : "' on the PATH");
    return false;
  }
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) {
    problem = std::string("cannot make a pipe: ") + std::strerror(errno);
    return false;
  }
  std::vector<const char*> arguments = {"sh", "-c", kWatch};
  for (const std::string& word : command) arguments.push_back(word.c_str());
  arguments.push_back(nullptr);

  // A session of its own, so that Ctrl-C in our terminal reaches us alone; signals as a fresh program expects them.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none, defaults;
  sigemptyset(&none);
  sigemptyset(&defaults);
  for (const int signal : {SIGINT, SIGTERM, SIGPIPE}) sigaddset(&defaults, signal);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &defaults);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  if (!errors_shown) posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  const int error = posix_spawn(&pid_, "/bin/sh", &actions, &attributes, const_cast<char**>(arguments.data()), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  close(ends[0]);
  if (error == 0) {
    lifeline_ = ends[1];
    return true;
  }
  close(ends[1]);
  pid_ = -1;
  problem = std::string("cannot start /bin/sh: ") + std::strerror(error);
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
