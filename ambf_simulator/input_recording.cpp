#include "input_recording.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "adf/adf.h"
#include "base/clock.h"
#include "devices/hub.h"
#include "devices/replayed_device.h"
#include "inputs/recording.h"
#include "runtime/input_replay.h"

namespace ambf::simulator {

namespace fs = std::filesystem;

namespace {

std::string absolute(const std::string& path) { return path.empty() ? path : fs::absolute(path).string(); }

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

CommandLine command_line_of(const inputs::SessionRecord& session) {
  CommandLine options;
  options.launch_file = session.launch_file;
  options.model_indices.assign(session.model_indices.begin(), session.model_indices.end());
  options.model_files = session.model_files;
  options.ns = session.ns;
  options.solver = session.solver;
  options.physics_frequency_hz = session.physics_frequency_hz;
  options.solver_iterations = session.solver_iterations;
  options.friction_directions = session.friction_directions;
  options.fixed_physics_timestep = session.fixed_step;
  options.fixed_haptics_timestep = session.fixed_device_dt;
  options.sleeping = session.sleeping;
  options.speed_factor = session.speed_factor;
  return options;
}

// The devices that ran, out of a first pass over the file; none, with `problem`: one is not as it says.
std::optional<std::vector<devices::ReplayedDevice::Setup>> devices_of(const std::string& path, std::string& problem) {
  const std::unique_ptr<inputs::Recording> recording = inputs::Recording::open(path, problem);
  if (recording == nullptr) return std::nullopt;
  const inputs::SessionRecord& session = recording->session();
  const adf::InputDevicesResult file = adf::parse_input_devices(session.device_text, session.device_file);
  std::vector<devices::ReplayedDevice::Setup> setups;
  inputs::RawRecord raw;
  inputs::Stream stream = 0;
  while (recording->next_of_any(raw, stream)) {
    if (raw.type != inputs::Type::device) continue;
    const auto record = raw.as<inputs::DeviceRecord>();
    const scene::InputDevice* block = nullptr;
    for (std::size_t i = 0; record && file.devices && i < file.devices->devices.size(); ++i)
      if (file.devices->devices[i].name == record->name) block = &file.devices->devices[i];
    if (block == nullptr || record->number >= base::kMaxSources || !(record->period_s > 0.0)) {
      problem =
          "'" + path + "': device '" + (record ? record->name : "?") + "' is not in the device file recorded there";
      return std::nullopt;
    }
    devices::ReplayedDevice::Setup& setup = setups.emplace_back();
    setup.number = record->number;
    setup.name = record->name;
    setup.settings = devices::settings_of(*block);
    setup.settings.fixed_dt = session.fixed_device_dt;
    setup.period_s = record->period_s;
    setup.traits = {.orientation = record->orientation,
                    .force = record->force,
                    .torque = record->torque,
                    .gripper = record->gripper,
                    .buttons = record->buttons,
                    .rate_hz = record->rate_hz,
                    .event_driven = record->event_driven,
                    .on_demand = record->on_demand,
                    .max_force_N = record->max_force_N,
                    .max_torque_Nm = record->max_torque_Nm,
                    .max_stiffness_N_m = record->max_stiffness_N_m,
                    .hold_at_start_s = record->hold_at_start_s};
  }
  return setups;
}

}  // namespace

runtime::SimulationOptions simulation_options(const CommandLine& options, const scene::World& world) {
  runtime::SimulationOptions out;
  out.physics_rate_hz = options.physics_frequency_hz;
  out.fixed_step = options.fixed_physics_timestep;
  out.speed_factor = options.speed_factor;
  const std::string& solver = options.solver.empty() ? world.solver : options.solver;
  if (solver == "si") out.solver = runtime::Solver::sequential_impulse;
  if (solver == "mlcp") out.solver = runtime::Solver::mlcp;
  out.solver_iterations =
      options.solver_iterations > 0 ? static_cast<unsigned>(options.solver_iterations) : world.solver_iterations;
  out.friction_directions = options.friction_directions;
  out.sleeping = options.sleeping;
  out.release_silent_throttle = options.release_silent_throttle;
  out.name_prefix = options.ns;
  return out;
}

std::unique_ptr<inputs::Recorder> start_recording(const CommandLine& options, const LaunchPlan& plan, base::Log& log,
                                                  std::string& problem) {
  inputs::SessionRecord session;
  session.launch_file = absolute(options.launch_file.empty() ? default_launch_file() : options.launch_file);
  session.model_indices.assign(options.model_indices.begin(), options.model_indices.end());
  for (const std::string& file : options.model_files) session.model_files.push_back(absolute(file));
  session.ns = options.ns;
  session.solver = options.solver;
  if (!plan.input_devices_file.empty()) {
    session.device_file = absolute(plan.input_devices_file);
    session.device_text = text_of(session.device_file);
  }
  session.physics_frequency_hz = options.physics_frequency_hz;
  session.solver_iterations = options.solver_iterations;
  session.friction_directions = options.friction_directions;
  session.fixed_step = options.fixed_physics_timestep;
  session.sleeping = options.sleeping;
  session.fixed_device_dt = options.fixed_haptics_timestep;
  session.speed_factor = options.speed_factor;
  session.start_ns = base::steady_ns();
  session.start_system_ns = base::system_ns();
  std::unique_ptr<inputs::Recorder> recorder = inputs::Recorder::create(options.record_input, session, log, problem);
  if (recorder != nullptr) log.info("inputs are recorded in '%s'", options.record_input.c_str());
  return recorder;
}

ReplayEnd replay(const CommandLine& options, const Signals& signals, base::Log& log) {
  const char* file = options.replay_input.c_str();
  const auto refuse = [&](const std::string& why) {
    log.error("nothing is replayed: %s", why.c_str());
    return ReplayEnd::unusable;
  };
  std::string problem;
  std::optional<std::vector<devices::ReplayedDevice::Setup>> devices = devices_of(options.replay_input, problem);
  if (!devices) return refuse(problem);
  const std::unique_ptr<inputs::Recording> recording = inputs::Recording::open(options.replay_input, problem);
  if (recording == nullptr) return refuse(problem);
  const CommandLine recorded = command_line_of(recording->session());
  if (std::string wrong = check_values(recorded); !wrong.empty()) return refuse("it is damaged: " + wrong);
  const LaunchOutcome launch = read_launch(recorded);
  log.report(launch.diagnostics);
  if (!launch.plan) return refuse("'" + recorded.launch_file + "' or its world cannot be used any more");

  const std::size_t device_count = devices->size();
  const scene::World& world = launch.plan->world;
  runtime::InputReplay replay(simulation_options(recorded, world), world, launch.plan->colors, std::move(*devices),
                              *recording, log);
  const std::int64_t start_ns = base::steady_ns();
  const runtime::ReplayOutcome outcome = replay.run([&] { return signals.stop_requested(); });
  const double wall_s = base::to_seconds(base::steady_ns() - start_ns);
  if (outcome.other_scene) return refuse(outcome.problem);
  log.info("replayed %.3f s in %.1f s: %llu steps, %llu frames, %llu cycles and %llu set-points of %zu devices",
           outcome.sim_time_s, wall_s, static_cast<unsigned long long>(outcome.steps),
           static_cast<unsigned long long>(outcome.frames), static_cast<unsigned long long>(outcome.cycles),
           static_cast<unsigned long long>(outcome.set_points), device_count);
  if (recording->ignored_bytes() > 0) {
    log.warning("'%s': its last %llu bytes are no whole record and are ignored", file,
                static_cast<unsigned long long>(recording->ignored_bytes()));
  }
  if (outcome.problem.empty() && signals.stop_requested()) {
    log.warning("the replay was stopped before its end; up to there all was equal");
    return ReplayEnd::different;
  }
  if (outcome.problem.empty() && recording->damaged()) {
    problem = "the recording is damaged there; what comes after it cannot be replayed";
  } else if (outcome.problem.empty() && recording->gap()) {
    problem = "the recording has a gap there; what came after it cannot be replayed";
  } else {
    problem = outcome.problem;
  }
  if (!problem.empty()) {
    log.error("%s", problem.c_str());
    return ReplayEnd::different;
  }
  log.info("all of it was equal to the recording");
  return ReplayEnd::equal;
}

}  // namespace ambf::simulator
