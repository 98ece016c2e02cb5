// The ability of input devices to hold bodies. Any thread; nothing waits for the physics thread. C++17.
#pragma once

#include <memory>

#include "state/ids.h"
#include "state/set_point.h"

namespace ambf::state {

// Where one device writes what it wants of one body; one writer thread at a time. Does nothing once the body is
// removed. Destroying it lets go.
class EffectorPort {
 public:
  virtual ~EffectorPort() = default;
  // In force from the next iteration of the physics thread on until replaced; neither blocks nor allocates. A port that
  // falls silent for longer than the watchdog's time (by its clock) lets go. A set-point that is not finite, has no
  // unit quaternion, or a negative gain or period, counts as silence.
  virtual void post(const SetPoint& set_point) = 0;
  virtual void let_go() = 0;
};

class EffectorAbility {
 public:
  virtual ~EffectorAbility() = default;
  // Null when there is no such moving body, or base::kMaxEffectors ports exist. One for each (body, source): the newest
  // one counts. It must end before the simulation.
  virtual std::unique_ptr<EffectorPort> hold(ObjectId body, Source source) = 0;
};

}  // namespace ambf::state
