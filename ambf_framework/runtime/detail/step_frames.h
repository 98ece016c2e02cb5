// Frames of every step, in order, for one reader beside the frame pool, whose readers see the newest frame only. A ring
// of frames goes round between two bounded queues: the physics thread takes an empty one, fills it and puts it behind
// the others; the reader gives it back when it has read it. Costs one atomic load a step while nobody reads.
#pragma once

#include <atomic>
#include <memory>

#include "base/bounds.h"
#include "exchange/bounded_queue.h"
#include "state/abilities/observe.h"

namespace ambf::runtime {

class StepFrames {
 public:
  static constexpr std::size_t kCapacity = base::kMaxUnpublishedSteps;

  // Any thread. Null: there is a reader already. It must not outlive this object.
  std::unique_ptr<state::StepReader> read(const std::shared_ptr<const state::Structure>& structure);

  // --- Physics thread.

  bool wanted() const { return wanted_.load(std::memory_order_acquire); }
  // Whether the reader has not given back a frame for the next step.
  bool full() const { return wanted() && !empty_.ready(); }
  // A frame to fill; null when the reader is behind: this step is left out. Allocates one, as an exception, in the
  // steps that follow a change of the structure, while those of the former one come back.
  std::unique_ptr<state::Frame> take_empty(const std::shared_ptr<const state::Structure>& structure);
  void put(std::unique_ptr<state::Frame> frame) { filled_.try_push(std::move(frame)); }

 private:
  class Reader;
  void end();

  // Twice the capacity: a frame that the physics thread held when a reader ended comes in addition to the next one's.
  exchange::BoundedQueue<std::unique_ptr<state::Frame>> empty_{2 * kCapacity}, filled_{2 * kCapacity};
  std::atomic<bool> taken_{false}, wanted_{false};
};

}  // namespace ambf::runtime
