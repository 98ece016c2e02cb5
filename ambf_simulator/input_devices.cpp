#include "input_devices.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <utility>

#include "adf/adf.h"
#include "devices/drivers/keyboard_mouse.h"
#include "recording.h"

namespace ambf::simulator {

namespace {

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string::npos ? std::string() : text.substr(first, last - first + 1);
}

std::string listed(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  return all;
}

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

}  // namespace

ChosenDevices choose_devices(const CommandLine& options, const scene::InputDevices& file) {
  std::vector<std::string> names;
  if (options.device_indices.empty()) {
    const std::size_t count = std::min(static_cast<std::size_t>(options.device_count), file.listed.size());
    names.assign(file.listed.begin(), file.listed.begin() + static_cast<std::ptrdiff_t>(count));
  } else {
    std::istringstream list(options.device_indices);
    for (std::string item; std::getline(list, item, ',');) {
      item = trimmed(item);
      const bool number = !item.empty() && item.find_first_not_of("0123456789") == std::string::npos;
      const bool is_name = std::find(file.listed.begin(), file.listed.end(), item) != file.listed.end();
      if (number && !is_name && item.size() < 6 && std::stoul(item) < file.listed.size()) {
        item = file.listed[std::stoul(item)];
      } else if (!is_name) {
        return {std::nullopt, "-i " + item + ": '" + file.file + "' lists " +
                                  (file.listed.empty() ? "no devices" : listed(file.listed))};
      }
      if (std::find(names.begin(), names.end(), item) == names.end()) names.push_back(item);
    }
  }
  ChosenDevices chosen;
  chosen.devices.emplace();
  for (const std::string& name : names) {
    const auto found = std::find_if(file.devices.begin(), file.devices.end(),
                                    [&](const scene::InputDevice& device) { return device.name == name; });
    if (found != file.devices.end()) chosen.devices->push_back(*found);  // else its mistakes are reported
  }
  return chosen;
}

bool offers_keyboard(const CommandLine& options) {
  const bool shows = options.show_gui && (!records(options) || runs_beside(options));
  return options.device_count == 0 && options.device_indices.empty() && options.launch_file.empty() && shows &&
         (is_set("DISPLAY") || is_set("WAYLAND_DISPLAY"));
}

std::vector<scene::InputDevice> keyboard_of(const scene::InputDevices& file) {
  const auto& kinds = devices::driver_kinds();
  const auto kind = std::find_if(kinds.begin(), kinds.end(),
                                 [](const devices::DriverKind& each) { return each.type == devices::kKeyboardMouse; });
  if (kind == kinds.end()) return {};
  const auto is_keyboard = [&](const scene::InputDevice& device) {
    if (!device.driver.type.empty()) return device.driver.type == kind->type;
    const auto& names = kind->hardware_names;
    return std::find(names.begin(), names.end(), device.hardware_name) != names.end();
  };
  const auto found = std::find_if(file.devices.begin(), file.devices.end(), is_keyboard);
  return found == file.devices.end() ? std::vector<scene::InputDevice>{} : std::vector{*found};
}

bool moved_in_windows(const StartedDevices& devices) {
  for (unsigned i = 0; devices.hub != nullptr && i < devices.hub->count(); ++i) {
    if (devices.hub->info(i)->driver == devices::kKeyboardMouse) return true;
  }
  return false;
}

StartedDevices start_devices(const CommandLine& options, const LaunchPlan& plan, const state::Abilities& abilities,
                             base::Log& log, inputs::Recorder* recorder) {
  const bool unasked = options.device_count == 0 && options.device_indices.empty();
  if (unasked && (!offers_keyboard(options) || plan.input_devices_file.empty())) return {};
  if (plan.input_devices_file.empty()) {
    log.error("-n and -i have nothing to choose from: the launch file has no `input devices config`");
    return {nullptr, true};
  }
  const adf::InputDevicesResult file = adf::load_input_devices(plan.input_devices_file);
  log.report(file.diagnostics);
  if (!file.devices) return {};
  ChosenDevices chosen =
      unasked ? ChosenDevices{keyboard_of(*file.devices), {}} : choose_devices(options, *file.devices);
  if (!chosen.devices) {
    log.error("%s", chosen.problem.c_str());
    return {nullptr, true};
  }
  if (unasked && chosen.devices->empty()) return {};
  devices::HubOptions hub;
  hub.rate_hz = options.haptics_frequency_hz;
  hub.forces = options.enable_forces;
  hub.fixed_dt = options.fixed_haptics_timestep;
  hub.real_time = !options.fixed_physics_timestep;
  hub.log = !unasked;
  hub.colors = plan.colors;
  hub.recorder = recorder;
  const devices::HubAbilities used{abilities.observe, abilities.edit, abilities.command, abilities.effector};
  return {std::make_unique<devices::Hub>(std::move(*chosen.devices), file.devices->file, std::move(hub), used, log),
          false};
}

}  // namespace ambf::simulator
