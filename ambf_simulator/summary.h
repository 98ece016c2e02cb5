// What a run achieved, measured from outside the physics thread: for --run_for and the benchmarks.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "state/abilities/observe.h"

namespace ambf::simulator {

class Summary {
 public:
  explicit Summary(state::ObserveAbility& observe);  // starts measuring
  // Steps a second, true real-time factor, CPU, memory, time per phase; one "name: value" a line.
  std::string text() const;

 private:
  std::unique_ptr<state::FrameReader> reader_;
  std::int64_t started_ns_ = 0, started_cpu_ns_ = 0;
  std::uint32_t first_step_ = 0;
  double first_time_s_ = 0.0;
};

}  // namespace ambf::simulator
