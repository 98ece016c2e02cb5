// Commands from many sources to live objects. Each (object, source) pair has a slot of its own in which the newest
// command wins; the physics thread takes what changed (live_commands.h), merges the sources and judges by its own clock
// which have expired.
//
// Across sources: wrenches add; pose, twist and each joint follow the source that wrote last, until its slot expires.
// Expiry and release end a source's share: its wrench, pose and twist vanish, joints that it led fall back to the
// source that wrote before it, else to effort 0 (motor off); cameras and lights stay where they are. A joint entry of
// type none leaves the joint as it is.
//
// Threads: bind() and the ports it returns belong to any thread but the physics thread (ports bound elsewhere may be
// posted to by the physics thread, as the Step service does; mind that a post with more joints than ever before
// allocates); add() and remove() to the loader; drain() to the physics thread, which never waits for the others.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "exchange/dirty_set.h"
#include "state/abilities/command.h"
#include "state/command.h"
#include "state/ids.h"

namespace ambf::model {

class CommandSlot;  // model/detail/command_slots.h
class CommandSlots;

class CommandTable {
 public:
  explicit CommandTable(double watchdog_s = 0.5);
  ~CommandTable();
  CommandTable(const CommandTable&) = delete;
  CommandTable& operator=(const CommandTable&) = delete;

  // Null when the object is gone or takes no commands (joints, the world). One writer thread at a time per (object,
  // source). The table must outlive the port.
  std::unique_ptr<state::CommandPort> bind(state::ObjectId object, state::Source source);

  // Loader: commandable objects come and go. Ports of removed objects fall silent.
  std::shared_ptr<CommandSlots> add(state::ObjectId object, state::ObjectKind kind);
  void remove(state::ObjectId object);

  // What a recording says that the physics thread found in the slot of (object, source) (inputs/physics_records.h).
  // False: there is no such object, or it takes no such command. Only where no ports post.
  struct Replayed {
    state::ObjectId object;
    state::Source source{};
    std::int64_t received_ns = 0, posted_ns = 0;
  };
  bool replay(const Replayed& posted, const state::Command& command);
  bool replay(const Replayed& posted, const std::vector<std::uint8_t>& kind_command);  // as saved states hold it
  bool replay_kept(const Replayed& kept);
  bool replay_ended(state::ObjectId object, state::Source source);
  bool replay_lasting(state::ObjectId object, state::Source source, bool lasting);

  // A command to it was not fit to act on. Not the physics thread.
  void count_refused(state::ObjectId object);

  // Physics thread: visit(index) for the ObjectId::index of each object whose slots have news.
  template <class Visit>
  void drain(Visit&& visit) {
    dirty_.drain(visit);
  }
  void mark(std::uint32_t object_index) { dirty_.mark(object_index); }  // any thread

  double watchdog_s() const { return watchdog_s_; }

 private:
  const double watchdog_s_;
  exchange::DirtySet dirty_{base::kMaxObjects};
  std::shared_ptr<CommandSlots> slots_of(state::ObjectId object);
  CommandSlot* slot_of(state::ObjectId object, state::Source source);

  std::mutex mutex_;  // never taken by the physics thread
  std::vector<std::shared_ptr<CommandSlots>> by_index_;
};

}  // namespace ambf::model
