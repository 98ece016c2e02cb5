// What input devices want of the bodies that they hold: a slot for each port, written by its device's thread, read by
// the physics thread, which never waits for them. A slot is used again after its port has ended; the number of the hold
// distinguishes its values from late ones of the port before.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>

#include "exchange/latest_slot.h"
#include "state/abilities/effector.h"
#include "state/structure.h"

namespace ambf::model {

struct PostedSetPoint {
  std::uint64_t hold = 0;
  state::ObjectId body;
  state::Source source{};
  state::SetPoint set_point;
};

struct EffectorSlot {
  std::atomic<std::uint64_t> ended{0};          // holds up to this one are over
  exchange::LatestSlot<PostedSetPoint> posted;  // the port writes, the physics thread reads
  bool taken = false;                           // this and what follows: under the table's mutex
  std::uint64_t holds = 0;
  state::ObjectId body;
  state::Source source{};
};

class EffectorTable {
 public:
  // As EffectorAbility::hold, of the bodies of `structure`. Any thread but the physics thread. The table must outlive
  // the port.
  std::unique_ptr<state::EffectorPort> hold(const state::Structure& structure, state::ObjectId body,
                                            state::Source source);

  // What a recording says that the physics thread found in a slot (inputs/physics_records.h). False: it cannot be.
  // Only where no ports post.
  bool replay(std::uint32_t slot, const PostedSetPoint& posted);
  bool replay_ended(std::uint32_t slot, std::uint64_t hold, bool released);

  // Physics thread: slots below this number may have news.
  std::size_t used() const { return used_.load(std::memory_order_acquire); }
  EffectorSlot& operator[](std::size_t slot) { return slots_[slot]; }

 private:
  class Port;
  void give_back(EffectorSlot& slot, std::uint64_t hold);

  std::array<EffectorSlot, base::kMaxEffectors> slots_;
  std::atomic<std::size_t> used_{0};
  std::mutex mutex_;  // never taken by the physics thread
};

}  // namespace ambf::model
