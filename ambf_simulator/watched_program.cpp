#include "watched_program.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>

extern char** environ;

namespace ambf::simulator {

namespace {

// Of util-linux, which every Debian system has. It has the kernel interrupt the program when the thread that started it is gone, then becomes
// the program. posix_spawn cannot ask for that, and fork would copy the page tables of a process whose physics thread must not fault.
constexpr const char* kLifeline = "/usr/bin/setpriv";

}  // namespace

WatchedProgram::~WatchedProgram() {
  if (pid_ < 0) return;
  kill();
  while (!watch(100)) {
  }
}

bool WatchedProgram::start(const std::vector<std::string>& command, std::string& problem) {
  if (access(kLifeline, X_OK) != 0) {
    problem = std::string("there is no ") + kLifeline + " (Debian: util-linux)";
    return false;
  }
  if (access(command.front().c_str(), X_OK) != 0) {
    problem = command.front() + " cannot be run: " + std::strerror(errno);
    return false;
  }
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) {
    problem = std::string("cannot make a pipe: ") + std::strerror(errno);
    return false;
  }
  std::vector<const char*> arguments = {kLifeline, "--pdeathsig", "INT", "--"};
  for (const std::string& word : command) arguments.push_back(word.c_str());
  arguments.push_back(nullptr);

  // A session of its own, so that Ctrl-C in our terminal reaches us alone; signals as a fresh program expects them.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none, defaults;
  sigemptyset(&none);
  sigemptyset(&defaults);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) sigaddset(&defaults, signal);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &defaults);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  const int error = posix_spawn(&pid_, kLifeline, &actions, &attributes, const_cast<char**>(arguments.data()), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  close(ends[1]);
  if (error != 0) {
    close(ends[0]);
    pid_ = -1;
    problem = "cannot start " + command.front() + ": " + std::strerror(error);
    return false;
  }
  output_ = ends[0];
  fcntl(output_, F_SETFL, O_NONBLOCK);
  lines_.clear();
  line_.clear();
  return true;
}

void WatchedProgram::interrupt() {
  if (pid_ > 0) ::kill(pid_, SIGINT);
}
void WatchedProgram::kill() {
  if (pid_ > 0) ::kill(pid_, SIGKILL);
}

std::optional<int> WatchedProgram::watch(int milliseconds) {
  if (output_ >= 0) {
    pollfd words{output_, POLLIN, 0};
    poll(&words, 1, milliseconds);
    if (!read()) {
      close(output_);
      output_ = -1;
    }
  } else {  // it has closed its output and runs on
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
  }
  int status = 0;
  if (pid_ < 0 || waitpid(pid_, &status, WNOHANG) != pid_) return std::nullopt;
  pid_ = -1;
  if (output_ >= 0) {
    read();  // its last words
    close(output_);
    output_ = -1;
  }
  if (!line_.empty()) take("\n", 1);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

bool WatchedProgram::read() {
  char text[4096];
  for (;;) {
    const ssize_t size = ::read(output_, text, sizeof text);
    if (size == 0) return false;
    if (size < 0) return errno == EAGAIN || errno == EINTR;
    take(text, static_cast<std::size_t>(size));
  }
}

void WatchedProgram::take(const char* text, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) {
    if (text[i] != '\n') {
      if (line_.size() < kLongestLine) line_ += text[i];
      continue;
    }
    if (lines_.size() == kMostLines) lines_.erase(lines_.begin());
    if (!line_.empty()) lines_.push_back(line_);
    line_.clear();
  }
}

}  // namespace ambf::simulator
