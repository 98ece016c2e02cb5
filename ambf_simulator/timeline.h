// Frames at chosen simulation times, for pictures and videos. The simulation is either stepped to each time, exactly
// and as fast as possible, or runs in its own time and is observed. One thread.
#pragma once

#include <memory>

#include "signals.h"
#include "state/abilities/observe.h"
#include "state/abilities/run.h"

namespace ambf::simulator {

class Timeline {
 public:
  virtual ~Timeline() = default;
  // Pauses the simulation; between calls it stands still.
  static std::unique_ptr<Timeline> stepped(state::RunAbility& run, state::ObserveAbility& observe, Signals& signals);
  static std::unique_ptr<Timeline> watched(state::ObserveAbility& observe, Signals& signals);

  // The frame at `sim_time_s`: exact to a step when stepped, else the first one not before it. Null when a stop is
  // requested or the simulation has halted. Valid until the call after next.
  virtual const state::Frame* at(double sim_time_s) = 0;
  // The newest, at once.
  virtual const state::Frame* now() = 0;
};

}  // namespace ambf::simulator
