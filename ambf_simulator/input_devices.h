// The input devices that the command line names (-n, -i), out of the launch file's list, running with one simulation.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/log.h"
#include "command_line.h"
#include "devices/hub.h"
#include "launch.h"
#include "state/abilities/abilities.h"

namespace ambf::simulator {

// Which devices of the file: -i has numbers and names, -n takes the first ones. None with `problem` when one of -i is
// not in the file.
struct ChosenDevices {
  std::optional<std::vector<scene::InputDevice>> devices;
  std::string problem;
};
ChosenDevices choose_devices(const CommandLine& options, const scene::InputDevices& file);

// What the command line names of the file; null hub: no device. `usage`: it names what is not there.
struct StartedDevices {
  std::unique_ptr<devices::Hub> hub;
  bool usage = false;
};
// Whether one of them is moved in the windows, by keyboard and mouse.
bool moved_in_windows(const StartedDevices& devices);

StartedDevices start_devices(const CommandLine& options, const LaunchPlan& plan, const state::Abilities& abilities,
                             base::Log& log);

}  // namespace ambf::simulator
