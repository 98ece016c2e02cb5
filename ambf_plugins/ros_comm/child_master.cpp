#include "ros_comm/child_master.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cerrno>
#include <csignal>
#include <cstring>

#include <chrono>
#include <thread>

extern char** environ;

namespace ambf::ros_comm {

namespace {
constexpr int kStopAttempts = 100;  // of 10 ms, before it is killed
}

ChildMaster::~ChildMaster() { stop(); }

bool ChildMaster::start(std::uint32_t port, std::string& problem) {
  const std::string port_text = std::to_string(port);
  const char* arguments[] = {"rosmaster", "--core", "-p", port_text.c_str(), nullptr};

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
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  const int error = posix_spawnp(&pid_, arguments[0], &actions, &attributes, const_cast<char**>(arguments), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  if (error == 0) return true;
  pid_ = -1;
  problem = std::string("cannot start 'rosmaster': ") + std::strerror(error);
  return false;
}

bool ChildMaster::running() {
  if (pid_ < 0) return false;
  if (waitpid(pid_, nullptr, WNOHANG) == 0) return true;
  pid_ = -1;
  return false;
}

void ChildMaster::stop() {
  if (!running()) return;
  kill(pid_, SIGTERM);
  for (int i = 0; i < kStopAttempts && running(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  if (!running()) return;
  kill(pid_, SIGKILL);
  waitpid(pid_, nullptr, 0);
  pid_ = -1;
}

}  // namespace ambf::ros_comm
