// A ROS master of our own, as a child process: started when the user has none, stopped at the end, also when this program is killed.
// One thread at a time.
#pragma once

#include <sys/types.h>
#include <cstdint>
#include <string>

namespace ambf::ros_comm {

class ChildMaster {
 public:
  ChildMaster() = default;
  ~ChildMaster();  // stops it
  ChildMaster(const ChildMaster&) = delete;
  ChildMaster& operator=(const ChildMaster&) = delete;

  // Starts `rosmaster --core` on `port`; false, with `problem`, when that program cannot be started.
  bool start(std::uint32_t port, std::string& problem);
  bool started() const { return pid_ > 0; }
  void stop();

 private:
  pid_t pid_ = -1;     // of the shell that watches over it
  int lifeline_ = -1;  // our end of the pipe whose closing ends it
};

}  // namespace ambf::ros_comm
