// One object's command slots, one a source, created when a source first binds. Written by ports, read by the physics
// thread, freed by the last owner among the loader, the ports and the garbage: never by the physics thread. For use
// inside model/ only.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>

#include "exchange/latest_slot.h"
#include "model/detail/spread_meter.h"
#include "state/command.h"
#include "state/ids.h"

namespace ambf::model {

// What a port hands over.
struct PostedCommand {
  state::Command command;
  std::int64_t received_ns = 0;  // from its sender
  state::Spread period;          // between those of its stream, as measured when this one came
};

// One (object, source) pair.
class CommandSlot {
 public:
  explicit CommandSlot(int number) : source(static_cast<state::Source>(number)) {}

  // Writer (the port) and reader (the physics thread).
  exchange::LatestSlot<PostedCommand> latest;
  std::atomic<bool> lasting{false};  // the watchdog does not end it

  // ---- the writer's own ----
  SpreadMeter periods;
  std::int64_t received_ns = 0;

  // ---- the physics thread's own ----
  const state::Source source;
  bool in_force = false;
  bool held = false;                // in force although it has expired: its pose is held
  std::uint64_t order = 0;          // greater: taken later, over all slots
  double since_s = 0.0;             // watchdog clock at the last sign of life
  std::int64_t seen_ns = 0;         // latest.time_ns() when last read
  std::uint64_t seen_releases = 0;  // latest.releases() when last read
  bool seen_lasting = false;        // `lasting` when last read
  bool from_snapshot = false;       // until the next post, what a snapshot said is in force
  state::Command restored;
  std::uint64_t seen_sequence = 0;
  bool waiting = false;  // in force, and no step has obeyed it yet
  std::int64_t applied_ns = 0;
  SpreadMeter delays;
  std::uint64_t received = 0, applied = 0, coalesced = 0, expired = 0, beyond = 0, bounded = 0;  // as in CommandState
  bool bound_logged = false;

  const state::Command& command() const { return from_snapshot ? restored : latest.value().command; }
  std::int64_t command_received_ns() const { return from_snapshot ? 0 : latest.value().received_ns; }

  // What waits will not be obeyed any more.
  void give_up_waiting() {
    coalesced += waiting ? 1 : 0;
    waiting = false;
  }
  // A step obeys what waits.
  void obeyed(std::int64_t now_ns) {
    if (!waiting) return;
    waiting = false;
    ++applied;
    applied_ns = now_ns;
    delays.add(base::to_seconds(now_ns - command_received_ns()), now_ns);
  }
};

class CommandSlots {
 public:
  CommandSlots(state::ObjectId object, state::ObjectKind kind) : object_(object), kind_(kind) {}
  ~CommandSlots() {
    for (auto& slot : slots_) delete slot.load(std::memory_order_relaxed);
  }
  CommandSlots(const CommandSlots&) = delete;
  CommandSlots& operator=(const CommandSlots&) = delete;

  state::ObjectId object() const { return object_; }
  state::ObjectKind kind() const { return kind_; }

  // Any thread.
  void count_refused() { refused_.fetch_add(1, std::memory_order_relaxed); }
  std::uint64_t refused() const { return refused_.load(std::memory_order_relaxed); }

  // Any thread; null when no such source has bound.
  CommandSlot* find(int source) const { return slots_[source].load(std::memory_order_acquire); }

  // Not the physics thread, restoring a snapshot excepted (allocates).
  CommandSlot& find_or_make(int source) {
    if (CommandSlot* existing = find(source)) return *existing;
    auto made = std::make_unique<CommandSlot>(source);
    CommandSlot* expected = nullptr;
    if (!slots_[source].compare_exchange_strong(expected, made.get(), std::memory_order_acq_rel)) return *expected;
    bound_.fetch_or(state::SourceSet{1} << source, std::memory_order_release);
    return *made.release();
  }

  // visit(source, slot) for each slot there is, by source. Physics thread.
  template <class Visit>
  void each(Visit&& visit) const {
    for (state::SourceSet left = bound_.load(std::memory_order_acquire); left != 0; left &= left - 1) {
      const int source = __builtin_ctzll(left);
      visit(source, *slots_[source].load(std::memory_order_relaxed));
    }
  }

  bool noted = false;  // something came, obeyed or not: frames report it. Physics thread

 private:
  state::ObjectId object_;
  state::ObjectKind kind_;
  std::atomic<CommandSlot*> slots_[base::kMaxSources] = {};
  std::atomic<state::SourceSet> bound_{0};  // slots_ that are there
  std::atomic<std::uint64_t> refused_{0};
};

}  // namespace ambf::model
