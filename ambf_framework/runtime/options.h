// How a simulation runs; decided before its threads start. Plain data.
#pragma once

#include <memory>
#include <string>

#include "base/limits.h"

namespace ambf::runtime {

enum class Solver { direct, sequential_impulse, mlcp };

// What a saved scene refers to; a simulation without files has none.
struct SceneFiles {
  std::shared_ptr<const std::string> world_text;  // what the world was read from; null: from nothing
  std::string colors, input_devices;              // paths; empty: none
};

struct SimulationOptions {
  double physics_rate_hz = 1000.0;  // iterations of the physics loop per second
  bool fixed_step = false;          // steps of speed_factor / physics_rate_hz, not bound to the wall clock
  double speed_factor = 1.0;        // only with fixed_step
  Solver solver = Solver::direct;
  unsigned solver_iterations = 0;  // 0: the solver's default
  int friction_directions = 2;     // 1 or 2; 2 keeps what is held or rests from creeping
  bool sleeping = true;
  int pooled_pairs = 4096;  // physics::WorldOptions: fewer save memory, and cost an allocation for each pair beyond
  bool release_silent_throttle =
      false;  // a throttling client that falls silent lets the simulation run on, as the original did
  int readers = base::kMaxReaders;  // of frames, at a time
  std::string name_prefix;          // --ns: put before every namespace
  SceneFiles files = {};
};

}  // namespace ambf::runtime
