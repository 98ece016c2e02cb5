// A helping program of ours as a child process (a ROS master where the user has none, the relay for old clients): ended
// with this object, also when this program is killed. One thread at a time. No ROS header is needed to use it.
#pragma once

#include <sys/types.h>
#include <string>
#include <vector>

namespace ambf::ros_comm {

class ChildProgram {
 public:
  ChildProgram() = default;
  ~ChildProgram();  // stops it
  ChildProgram(const ChildProgram&) = delete;
  ChildProgram& operator=(const ChildProgram&) = delete;

  // Starts `command` (a program on the PATH or by its path, then its arguments). False, with `problem`, when it cannot
  // be started. What it writes to its output is dropped; its errors, too, unless `errors_shown`.
  bool start(const std::vector<std::string>& command, std::string& problem, bool errors_shown = false);
  bool started() const { return pid_ > 0; }
  void stop();

 private:
  pid_t pid_ = -1;     // of the shell that watches over it
  int lifeline_ = -1;  // our end of the pipe whose closing ends it
};

}  // namespace ambf::ros_comm
