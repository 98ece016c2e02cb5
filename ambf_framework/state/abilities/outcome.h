// The result of a request to the simulation, and how it is delivered. Plain data, C++17.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include "base/diagnostic.h"

namespace ambf::state {

struct Outcome {
  bool success = false;
  std::string message;
  base::Diagnostics diagnostics;
  std::string model;  // of a load: the name under which the model is listed; of a snapshot: its name
  std::uint32_t sim_step = 0;
  double sim_time = 0.0;
  std::size_t bytes = 0;       // size of a snapshot
  double physics_cpu_s = 0.0;  // of a structure change: CPU time of the physics thread for the swap
};

// Called exactly once when a request has finished, on the loader, answering or requesting thread; never on the physics
// thread.
using Completion = std::function<void(const Outcome&)>;

}  // namespace ambf::state
