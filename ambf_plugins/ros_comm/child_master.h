// A ROS master of our own, as a child process: started when the user has none, stopped at the end.
#pragma once

#include <sys/types.h>
#include <cstdint>
#include <string>

namespace ambf::ros_comm {

class ChildMaster {
 public:
  ~ChildMaster();  // stops it
  // Starts `rosmaster --core` on `port`; false, with `problem`, when that program cannot be started.
  bool start(std::uint32_t port, std::string& problem);
  bool running();
  void stop();

 private:
  pid_t pid_ = -1;
};

}  // namespace ambf::ros_comm
