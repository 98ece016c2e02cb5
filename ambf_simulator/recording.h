// --screenshot and --video: pictures of cameras to files, with and without a display.
#pragma once

#include "base/log.h"
#include "command_line.h"
#include "signals.h"
#include "state/abilities/observe.h"
#include "state/abilities/run.h"

namespace ambf::simulator {

bool records(const CommandLine& options);

// Whether the program continues after the pictures (--run_for, or a window was requested). Then the simulation runs in
// its own time; otherwise it is stepped, and the program ends after the last picture.
bool runs_beside(const CommandLine& options);

// Makes all pictures and the video; returns whether all of them were written. The simulation must have begun. Any
// thread except the one that handles windows.
bool record(const CommandLine& options, state::RunAbility& run, state::ObserveAbility& observe, Signals& signals,
            base::Log& log);

}  // namespace ambf::simulator
