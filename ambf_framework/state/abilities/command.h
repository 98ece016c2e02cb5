// The ability to command objects: ports for State/Command pairs, and single pushes. Any thread; nothing waits for the
// physics thread. C++17.
#pragma once

#include <cstdint>
#include <memory>

#include "state/abilities/outcome.h"
#include "state/command.h"
#include "state/ids.h"
#include "state/parameters.h"

namespace ambf::state {

// Where one source writes the commands of one object; one writer thread at a time. Does nothing once the object is
// removed.
class CommandPort {
 public:
  virtual ~CommandPort() = default;
  // Posts a checked command (state::check), effective at the beginning of the next step. Never blocks.
  virtual void post(const Command& command) = 0;
  // Same, with the time (steady clock) at which the command was received.
  virtual void post(const Command& command, std::int64_t received_ns) = 0;
  // Restarts the watchdog of the last posted command.
  virtual void keep_alive() = 0;
  // What is posted from now on, and the command in force, lasts until release(): the watchdog does not end it. For
  // writers within this program, whose silence means a slow thread and not a lost sender.
  virtual void hold() = 0;
  // Ends this source's command now, as its watchdog would.
  virtual void release() = 0;
};

class CommandAbility {
 public:
  virtual ~CommandAbility() = default;
  // Null when the object does not exist or accepts no commands.
  virtual std::unique_ptr<CommandPort> bind(ObjectId object, Source source) = 0;
  // Counts a rejected command. An invalid id stands for a command to an unknown object.
  virtual void count_refused_command(ObjectId object) = 0;
  // One push per body at a time: a new one replaces the old one.
  virtual void push(ObjectId body, const Push& push, Completion done) = 0;
};

}  // namespace ambf::state
