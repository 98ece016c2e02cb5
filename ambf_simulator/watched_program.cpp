#include "watched_program.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>
#include <utility>

#include "base/spawn.h"

namespace ambf::simulator {

namespace {

// Of util-linux, which every Debian system has. It sets the parent-death signal of the thread that started it, then
// executes the program; base::spawn cannot set one.
constexpr const char* kLifeline = "/usr/bin/setpriv";

void close_file(int& file) {
  if (file >= 0) close(file);
  file = -1;
}

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
  int output[2] = {-1, -1};
  if (pipe2(output, O_CLOEXEC) != 0) {
    problem = std::string("cannot make a pipe: ") + std::strerror(errno);
    return false;
  }
  std::vector<std::string> watched = {kLifeline, "--pdeathsig", "INT", "--"};
  watched.insert(watched.end(), command.begin(), command.end());
  base::Streams streams;
  streams.output = streams.errors = output[1];
  pid_ = base::spawn(watched, streams, problem);
  close_file(output[1]);
  output_ = output[0];
  if (pid_ < 0) {
    close_file(output_);
    return false;
  }
  fcntl(output_, F_SETFL, O_NONBLOCK);
  line_.clear();
  lines_.clear();
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
    pollfd output = {output_, POLLIN, 0};
    poll(&output, 1, milliseconds);
    read();
  } else {  // it has closed its output and runs on
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
  }
  int status = 0;
  if (pid_ < 0 || waitpid(pid_, &status, WNOHANG) != pid_) return std::nullopt;
  pid_ = -1;
  read();  // what it wrote before its end
  if (!line_.empty()) lines_.push_back(std::exchange(line_, {}));
  close_file(output_);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

void WatchedProgram::read() {
  char text[65536];
  for (int round = 0; output_ >= 0 && round < 64; ++round) {  // it may write faster than we read
    const ssize_t size = ::read(output_, text, sizeof text);
    if (size == 0) close_file(output_);
    if (size < 0 && errno != EAGAIN && errno != EINTR) close_file(output_);
    if (size <= 0) break;
    for (const char* at = text; at != text + size;) {
      const auto left = static_cast<std::size_t>(text + size - at);
      const auto* end = static_cast<const char*>(std::memchr(at, '\n', left));
      const std::size_t part = end != nullptr ? static_cast<std::size_t>(end - at) : left;
      line_.append(at, std::min(part, kMaxLineLength - std::min(kMaxLineLength, line_.size())));
      at += part;
      if (end == nullptr) break;
      ++at;
      if (!line_.empty()) lines_.push_back(std::exchange(line_, {}));
    }
    if (lines_.size() > kMaxLines) lines_.erase(lines_.begin(), lines_.end() - kMaxLines);
  }
}

}  // namespace ambf::simulator
