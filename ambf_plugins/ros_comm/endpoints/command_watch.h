// Says that an object's command was given up because its sender fell silent. The physics thread alone judges that; this looks at its
// verdict in the frames. Private to ros_comm. C++17.
#pragma once

#include <atomic>
#include <string>

#include "ros_comm/traffic.h"

namespace ambf::ros_comm {

class CommandWatch {
 public:
  CommandWatch(Traffic& traffic, const std::string& name) : traffic_(traffic), name_(name) {}

  // A command was posted. Command thread.
  void commanded() {
    commanded_.store(true, std::memory_order_relaxed);
    traffic_.accepted.fetch_add(1, std::memory_order_relaxed);
  }
  // Whether commands are in force in this frame. Publisher thread.
  void see(bool active) {
    if (was_active_ && !active && commanded_.exchange(false, std::memory_order_relaxed)) traffic_.expired(name_);
    was_active_ = active;
  }

 private:
  Traffic& traffic_;
  const std::string name_;
  std::atomic<bool> commanded_{false};
  bool was_active_ = false;  // publisher thread
};

}  // namespace ambf::ros_comm
