// Commands from many sources to live objects. Each (object, source) pair has a slot of its own in which the newest command wins;
// the physics thread takes what changed, merges the sources and judges by its own clock which commands have expired.
//
// Across sources: wrenches add; pose, twist and each joint follow the source that wrote last, until its slot expires. Expiry and
// release end a source's share: its wrench, pose and twist vanish, joints that it led fall back to the source that wrote before it,
// else to effort 0 (motor off), cameras and lights stay where they are.
//
// Threads: bind() and the ports it returns belong to any thread but the physics thread (ports that the physics thread posts to for
// the Step service are bound beforehand); add() and remove() to the loader; the rest to the physics thread, which never waits for
// the others and allocates nothing.
#pragma once

#include <cstdint>
#include <memory>

#include "state/command.h"
#include "state/control.h"
#include "state/ids.h"

namespace ambf::model {

// One object's slots, one a source; made by the loader, shared by the live object and its ports.
class CommandSlots;

class CommandTable {
 public:
  explicit CommandTable(double watchdog_s = 0.5);
  ~CommandTable();
  CommandTable(const CommandTable&) = delete;
  CommandTable& operator=(const CommandTable&) = delete;

  // Null when the object is gone or takes no commands (joints). One writer thread at a time per (object, source).
  std::unique_ptr<state::CommandPort> bind(state::ObjectId object, state::Source source);

  // Loader: an object with `joint_count` commandable joints now; both may change later.
  std::shared_ptr<CommandSlots> add(state::ObjectId object, state::ObjectKind kind, std::size_t joint_count);
  void remove(state::ObjectId object);

  double watchdog_s() const { return watchdog_s_; }

 private:
  friend class CommandMerge;
  struct Impl;
  std::unique_ptr<Impl> impl_;
  double watchdog_s_;
};

}  // namespace ambf::model
