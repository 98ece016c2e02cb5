// Where the commands of one object's topic go: to the simulation, or into the counts of refused ones. Logs when the
// sender fell silent and the watchdog ended its command; the physics thread alone judges that, this reads its verdict
// in the frames. Private to ros_comm. C++17.
#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "ros_comm/traffic.h"
#include "state/abilities/command.h"
#include "state/structure.h"

namespace ambf::ros_comm {

class CommandInput {
 public:
  CommandInput(Traffic& traffic, state::CommandAbility& ability, const state::ObjectInfo& object)
      : traffic_(traffic),
        ability_(ability),
        name_(object.name),
        object_(object.id),
        port_(ability.bind(object.id, state::Source::ros)) {}

  // Posts a checked command. Command thread.
  void post(const state::Command& command) {
    if (!port_) return;  // the object was removed, its topics close soon
    port_->post(command);
    commanded_.store(true, std::memory_order_relaxed);
    traffic_.accepted.fetch_add(1, std::memory_order_relaxed);
  }
  // Command thread.
  void refuse(const std::string& reason) {
    ability_.count_refused_command(object_);
    traffic_.refuse(name_, reason);
  }
  // Whether commands are in force in the newest frame. Publisher thread.
  void watch(bool active) {
    if (was_active_ && !active && commanded_.exchange(false, std::memory_order_relaxed)) traffic_.expired(name_);
    was_active_ = active;
  }

 private:
  Traffic& traffic_;
  state::CommandAbility& ability_;
  const std::string name_;
  const state::ObjectId object_;
  const std::unique_ptr<state::CommandPort> port_;
  std::atomic<bool> commanded_{false};
  bool was_active_ = false;  // publisher thread
};

}  // namespace ambf::ros_comm
