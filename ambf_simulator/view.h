// The windows of the simulation, if there can be any.
#pragma once

#include "base/log.h"
#include "runtime/simulation.h"
#include "signals.h"

namespace ambf::simulator {

// Shows the simulation until its last window is closed, a stop is requested or the time is over. Returns false at once, having said why,
// when there is no display: the program then runs headless. Main thread.
bool run_view(runtime::Simulation& simulation, Signals& signals, double limit_seconds, base::Log& log);

}  // namespace ambf::simulator
