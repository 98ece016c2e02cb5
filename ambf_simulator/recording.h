// --screenshot and --video: pictures of cameras to files, with and without a display.
#pragma once

#include "base/log.h"
#include "command_line.h"
#include "signals.h"
#include "state/abilities/observe.h"
#include "state/abilities/run.h"

namespace ambf::simulator {

bool records(const CommandLine& options);

// Whether the program runs on beside it as users see fit (--run_for, or a window they asked for): then the simulation is watched. Else it is
// stepped, and the program ends afterwards.
bool runs_beside(const CommandLine& options);

// Takes all pictures and the video; returns whether all of them were made. The simulation must have begun. Any thread but the one that
// handles windows.
bool record(const CommandLine& options, state::RunAbility& run, state::ObserveAbility& observe, Signals& signals,
            base::Log& log);

}  // namespace ambf::simulator
