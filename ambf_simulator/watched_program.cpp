#include "watched_program.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
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

// Of util-linux, which every Debian system has. It has the kernel interrupt the program when the thread that started it is gone, then becomes
// the program. base::spawn cannot ask for that.
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

bool WatchedProgram::start(const std::vector<std::string>& command, std::string& problem, Talk talk) {
  if (access(kLifeline, X_OK) != 0) {
    problem = std::string("there is no ") + kLifeline + " (Debian: util-linux)";
    return false;
  }
  if (access(command.front().c_str(), X_OK) != 0) {
    problem = command.front() + " cannot be run: " + std::strerror(errno);
    return false;
  }
  talks_ = talk == Talk::yes;
  int output[2] = {-1, -1}, errors[2] = {-1, -1}, input[2] = {-1, -1};
  bool made = pipe2(output, O_CLOEXEC) == 0;
  // A socket instead of a pipe: what is written when nobody hears any more is an error, not a signal.
  if (talks_) {
    made = made && pipe2(errors, O_CLOEXEC) == 0 && socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, input) == 0;
  }
  if (!made) problem = std::string("cannot make a pipe: ") + std::strerror(errno);
  if (made) {
    std::vector<std::string> watched = {kLifeline, "--pdeathsig", "INT", "--"};
    watched.insert(watched.end(), command.begin(), command.end());
    base::Streams streams;
    streams.output = output[1];
    streams.errors = talks_ ? errors[1] : output[1];
    if (talks_) streams.input = input[1];
    pid_ = base::spawn(watched, streams, problem);
  }
  close_file(output[1]);
  close_file(errors[1]);
  close_file(input[1]);
  if (pid_ < 0) {
    close_file(output[0]);
    close_file(errors[0]);
    close_file(input[0]);
    return false;
  }
  output_ = {output[0], "", talks_ ? kLongestWord : kLongestLine};
  errors_ = {errors[0], "", kLongestLine};
  input_ = input[0];
  for (const int file : {output_.file, errors_.file}) {
    if (file >= 0) fcntl(file, F_SETFL, O_NONBLOCK);
  }
  unsaid_.clear();
  lines_.clear();
  words_.clear();
  return true;
}

void WatchedProgram::interrupt() {
  if (pid_ > 0) ::kill(pid_, SIGINT);
}
void WatchedProgram::kill() {
  if (pid_ > 0) ::kill(pid_, SIGKILL);
}

std::vector<std::string> WatchedProgram::take_words() { return std::exchange(words_, {}); }

void WatchedProgram::say(const std::string& line) {
  if (input_ < 0) return;
  unsaid_ += line + "\n";
  write();
}

void WatchedProgram::hang_up() { close_file(input_); }

void WatchedProgram::write() {
  while (input_ >= 0 && !unsaid_.empty()) {
    const ssize_t size = send(input_, unsaid_.data(), unsaid_.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (size < 0 && errno == EINTR) continue;
    if (size < 0 && errno != EAGAIN) close_file(input_);  // its end tells the rest
    if (size <= 0) return;
    unsaid_.erase(0, static_cast<std::size_t>(size));
  }
}

std::optional<int> WatchedProgram::watch(int milliseconds) {
  write();
  if (output_.file >= 0 || errors_.file >= 0) {
    pollfd words[] = {{output_.file, POLLIN, 0}, {errors_.file, POLLIN, 0}};  // -1 is left out
    poll(words, 2, milliseconds);
    read();
  } else {  // it has closed its output and runs on
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
  }
  int status = 0;
  if (pid_ < 0 || waitpid(pid_, &status, WNOHANG) != pid_) return std::nullopt;
  pid_ = -1;
  read();  // its last words
  std::vector<std::string>& said = talks_ ? words_ : lines_;
  if (!output_.line.empty()) said.push_back(output_.line);
  if (!errors_.line.empty()) lines_.push_back(errors_.line);
  output_.close();
  errors_.close();
  close_file(input_);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

void WatchedProgram::read() {
  if (!output_.read(talks_ ? words_ : lines_)) output_.close();
  if (!errors_.read(lines_)) errors_.close();
  if (lines_.size() > kMostLines) lines_.erase(lines_.begin(), lines_.end() - kMostLines);
}

void WatchedProgram::Stream::close() { close_file(file); }

bool WatchedProgram::Stream::read(std::vector<std::string>& to) {
  char text[65536];
  for (int round = 0; file >= 0 && round < 64; ++round) {  // it may say more than anybody can hear
    const ssize_t size = ::read(file, text, sizeof text);
    if (size == 0) return false;
    if (size < 0) return errno == EAGAIN || errno == EINTR;
    for (const char* at = text; at != text + size;) {
      const auto left = static_cast<std::size_t>(text + size - at);
      const auto* end = static_cast<const char*>(std::memchr(at, '\n', left));
      const std::size_t part = end != nullptr ? static_cast<std::size_t>(end - at) : left;
      line.append(at, std::min(part, longest - std::min(longest, line.size())));
      at += part;
      if (end == nullptr) break;
      ++at;
      if (!line.empty()) to.push_back(std::exchange(line, {}));
    }
  }
  return true;
}

}  // namespace ambf::simulator
