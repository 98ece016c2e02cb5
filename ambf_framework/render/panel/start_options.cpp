#include "render/panel/start_options.h"

#include <cstdio>

namespace ambf::render {

std::vector<StartOption> start_options(const state::RunState& run) {
  char step[64], most[32];
  std::snprintf(step, sizeof step, "%.4g ms", run.step_s * 1e3);
  std::snprintf(most, sizeof most, "at most %u", run.max_steps_per_turn);
  return {
      {"Step", step, "--phx_frequency",
       "Set when the program starts, by -p (--phx_frequency) in iterations a second. Controllers, contacts and "
       "recordings "
       "count on steps "
       "of one length, so it does not change while they run. To see more of less time, lower the speed."},
      {"Time", run.fixed_step ? "fixed steps" : "bound to the clock", "--fixed_phx_timestep",
       "Set when the program starts, by -t (--fixed_phx_timestep): with fixed steps a run repeats bit for bit."},
      {"Steps an iteration", most, "max iterations",
       "What real time asks for beyond that is given up, and counted above. Set by 'max iterations' of the world file, "
       "else adapted to the machine."},
      {"Solver", run.solver, "--solver",
       "Set when the program starts, by --solver, and its iterations by --solver-iterations or by 'solver iterations' "
       "of the world "
       "file."},
  };
}

}  // namespace ambf::render
