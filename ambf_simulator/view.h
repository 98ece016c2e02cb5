// The windows of the simulation, if there can be any.
#pragma once

#include <cstdint>

#include "base/log.h"
#include "render/window/viewer.h"
#include "signals.h"
#include "state/abilities/abilities.h"

namespace ambf::simulator {

enum class ViewEnd {
  none,     // there can be no window (said why): run headless
  over,     // by the user, a signal or because the time is over
  display,  // the display server died (said so)
};

// Shows the simulation until its last window is closed, a stop is requested or the steady clock reaches `end_ns`. Main
// thread.
ViewEnd run_view(const state::Abilities& simulation, Signals& signals, std::int64_t end_ns,
                 const render::ViewerOptions& options, base::Log& log);

}  // namespace ambf::simulator
