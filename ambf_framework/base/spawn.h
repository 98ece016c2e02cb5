// Starts another program beside this one. It gets a session of its own, so that Ctrl-C in our terminal reaches us
// alone, and signals as a fresh program expects them. Never waits for it and never ends it: who starts it does. Any
// thread; the program inherits its priority.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace ambf::base {

// Instead of a file descriptor: the stream leads nowhere, or where ours does.
inline constexpr int kNowhere = -1, kAsOurs = -2;

// What a program's standard streams are: descriptors of ours that stay open here.
struct Streams {
  int input = kNowhere, output = kNowhere, errors = kNowhere;
};

// `command`: a program by its path, then its arguments. Its process id, which must be waited for; -1, with `problem`,
// when it cannot be started.
pid_t spawn(const std::vector<std::string>& command, const Streams& streams, std::string& problem);

// Where a program of that name may be, by the PATH; and the first of such places that has a program which can be run.
// Empty: none.
std::vector<std::string> places_on_path(const std::string& name);
std::string first_program(const std::vector<std::string>& places);

// The path of a program that can be run: itself where `name` is a path, else from the PATH. Empty: there is none.
std::string find_program(const std::string& name);

}  // namespace ambf::base
