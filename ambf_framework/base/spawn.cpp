#include "base/spawn.h"

#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <system_error>

extern char** environ;

namespace ambf::base {

// posix_spawn and not fork: a process whose physics thread must not fault may not have its page tables copied.
pid_t spawn(const std::vector<std::string>& command, const Streams& streams, std::string& problem) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);

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
  const auto connect = [&](int from, int to, int mode) {
    if (from == kNowhere) posix_spawn_file_actions_addopen(&actions, to, "/dev/null", mode, 0);
    if (from >= 0) posix_spawn_file_actions_adddup2(&actions, from, to);
  };
  connect(streams.input, STDIN_FILENO, O_RDONLY);
  connect(streams.output, STDOUT_FILENO, O_WRONLY);
  connect(streams.errors, STDERR_FILENO, O_WRONLY);

  pid_t process = -1;
  const int error = posix_spawn(&process, arguments.front(), &actions, &attributes, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  if (error == 0) return process;
  problem = "cannot start " + command.front() + ": " + std::strerror(error);
  return -1;
}

std::vector<std::string> places_on_path(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::stringstream folders(path != nullptr ? path : "");
  std::vector<std::string> places;
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (!folder.empty()) places.push_back(folder + "/" + name);
  }
  return places;
}

std::string first_program(const std::vector<std::string>& places) {
  for (const std::string& place : places) {
    std::error_code ignored;  // folders may be "executable", too
    if (std::filesystem::is_regular_file(place, ignored) && access(place.c_str(), X_OK) == 0) return place;
  }
  return {};
}

std::string find_program(const std::string& name) {
  return first_program(name.find('/') != std::string::npos ? std::vector{name} : places_on_path(name));
}

}  // namespace ambf::base
