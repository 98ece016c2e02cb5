// The input devices of one simulation: those that the command line names (-n, -i), out of the launch file's list; when
// it names none, keyboard and mouse, where the shipped launch file is shown in windows.
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

// Nothing names a device, and there can be a window: a person may want to take a tool in hand.
bool offers_keyboard(const CommandLine& options);
// The first one that is moved by keyboard and mouse, or none.
std::vector<scene::InputDevice> keyboard_of(const scene::InputDevices& file);

// What runs; null hub: no device. `usage`: it names what is not there.
struct StartedDevices {
  std::unique_ptr<devices::Hub> hub;
  bool usage = false;
};
// Whether one of them is moved in the windows, by keyboard and mouse.
bool moved_in_windows(const StartedDevices& devices);

StartedDevices start_devices(const CommandLine& options, const LaunchPlan& plan, const state::Abilities& abilities,
                             base::Log& log, inputs::Recorder* recorder);

}  // namespace ambf::simulator
