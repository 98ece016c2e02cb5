// What pointers want of the bodies they hold: a slot each, written by its port, read by the physics thread, which never
// waits for them. A press has a number, so that neither a target nor an end that comes late is taken for another
// press's.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "exchange/latest_slot.h"
#include "math/types.h"
#include "state/frame.h"

namespace ambf::model {

struct PickTarget {
  std::uint64_t press = 0;
  math::Vec3 point_world;
};

struct PickSlot {
  std::atomic<bool> taken{false};           // by a port
  std::uint64_t presses = 0;                // the port's
  std::atomic<std::uint64_t> ended{0};      // presses up to this one are over
  exchange::LatestSlot<PickTarget> target;  // the port writes, the physics thread reads
};

class PickTable {
 public:
  // A slot's number, or -1 when all are taken. Any thread but the physics thread; so for give_back(), after which the
  // slot is another's.
  int take() {
    for (std::size_t i = 0; i < slots_.size(); ++i)
      if (!slots_[i].taken.exchange(true, std::memory_order_acquire)) return static_cast<int>(i);
    return -1;
  }
  void give_back(int slot) {
    slots_[slot].ended.store(slots_[slot].presses, std::memory_order_release);
    slots_[slot].taken.store(false, std::memory_order_release);
  }
  PickSlot& operator[](std::size_t slot) { return slots_[slot]; }
  const PickSlot& operator[](std::size_t slot) const { return slots_[slot]; }

 private:
  std::array<PickSlot, base::kMaxPicks> slots_;
};

}  // namespace ambf::model
