// Plays a recording of inputs: the same changes of the scene, requests, commands and device cycles in the same order,
// each device's mapping and laws included, as fast as it goes (decision 0032). Every frame must have the state_hash of
// the recording, and every set-point its numbers. On the caller's thread, with one more for the loader.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/log.h"
#include "devices/replayed_device.h"
#include "inputs/recording.h"
#include "runtime/options.h"
#include "scene/colors.h"
#include "scene/description.h"
#include "state/frame.h"

namespace ambf::runtime {

struct ReplayOutcome {
  // Empty: all was equal. Else, in one line, what was not, or why it could not go on.
  std::string problem;
  bool other_scene = false;  // the problem: files have changed, or are not there
  std::uint64_t steps = 0, frames = 0, cycles = 0, set_points = 0;
  double sim_time_s = 0.0;  // of the last frame
};

class InputReplay {
 public:
  // As the simulation was made that is recorded. `log` and `recording` must outlive it.
  InputReplay(const SimulationOptions& options, const scene::World& world, scene::ColorTable colors,
              std::vector<devices::ReplayedDevice::Setup> devices, inputs::Recording& recording, base::Log& log);
  ~InputReplay();
  InputReplay(const InputReplay&) = delete;
  InputReplay& operator=(const InputReplay&) = delete;

  // Up to the end, to the first difference, or until `stop` (asked now and then) says so. Once.
  ReplayOutcome run(const std::function<bool()>& stop);

  const state::Frame* frame() const;  // the newest; null: there is none yet

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ambf::runtime
