// Sessions that are recorded, and replayed to the bit (docs/input_recordings.md).
#pragma once

#include <memory>
#include <string>

#include "base/log.h"
#include "command_line.h"
#include "inputs/recorder.h"
#include "launch.h"
#include "runtime/options.h"
#include "scene/description.h"
#include "signals.h"

namespace ambf::simulator {

runtime::SimulationOptions simulation_options(const CommandLine& options, const scene::World& world);

// Null, with `problem`: the file of --record_input cannot be made. `log` must outlive it.
std::unique_ptr<inputs::Recorder> start_recording(const CommandLine& options, const LaunchPlan& plan, base::Log& log,
                                                  std::string& problem);

// Up to the end of --replay_input's file, or to the first difference.
enum class ReplayEnd { equal, different, unusable };
ReplayEnd replay(const CommandLine& options, const Signals& signals, base::Log& log);

}  // namespace ambf::simulator
