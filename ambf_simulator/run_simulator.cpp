#include "run_simulator.h"

#include <malloc.h>

#include <csignal>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "adf/check.h"
#include "ambf_cli.h"
#include "bag_recording.h"
#include "base/clock.h"
#include "base/log.h"
#include "base/log_drain.h"
#include "base/log_tail.h"
#include "base/realtime.h"
#include "command_line.h"
#include "communication.h"
#include "convert.h"
#include "devices/drivers/keyboard_mouse.h"
#include "input_devices.h"
#include "input_recording.h"
#include "launch.h"
#include "limits_page.h"
#include "model/dry_load.h"
#include "recording.h"
#include "render/pictures/picture_streamer.h"
#include "runtime/simulation.h"
#include "signals.h"
#include "summary.h"
#include "uncaught.h"
#include "view.h"

namespace ambf::simulator {
namespace {

// Exit codes; promised in docs/cli.md.
constexpr int kExitDone = 0, kExitFailed = 1, kExitUsage = 2, kExitHungUp = 129, kExitTerminated = 143;

int check_files(const CommandLine& options) {
  bool errors = false, warnings = false;
  // Files without bodies, as those of tasks alone and of CRTK arms, name those of files before them.
  std::vector<scene::Model> scenes;
  const auto dry_load = [&scenes](const scene::Model& model) {
    if (model.bodies.empty() && !model.blocks.empty()) return model::dry_load_after(scenes, model);
    scenes.push_back(model);
    return model::dry_load(model);
  };
  for (const std::string& file : options.check_files) {
    const base::Diagnostics diagnostics = adf::check_file(file, dry_load, scenes);
    for (const base::Diagnostic& diagnostic : diagnostics) std::printf("%s\n", base::to_string(diagnostic).c_str());
    errors |= base::has_errors(diagnostics);
    warnings |= base::has_warnings(diagnostics);
    if (!base::has_errors(diagnostics) && !base::has_warnings(diagnostics)) std::printf("%s: good\n", file.c_str());
  }
  return errors || (options.strict && warnings) ? kExitFailed : kExitDone;
}

void mention_what_is_not_there_yet(const CommandLine& options, base::Log& log) {
  if (!options.plugins.empty()) log.warning("plugins are not loaded yet: --plugins has no effect");
  for (const std::string& argument : options.ros_arguments) {
    log.warning("'%s' has no effect: topics are not remapped; --ns PREFIX puts one before all names", argument.c_str());
  }
  if (options.speed_factor != 1.0 && !options.fixed_physics_timestep) {
    log.warning("-s (--sim_speed_factor) only has an effect with -t true");
  }
}

// False when a file that the command line names (-a) is refused: the scene would be another one than that asked for.
// What a launch file lists and is refused is reported; the rest runs.
bool load_models(const CommandLine& options, const LaunchPlan& plan, runtime::Simulation& simulation,
                 const Signals& signals, base::Log& log) {
  bool good = true;
  for (std::size_t i = 0; i < plan.model_files.size() && !signals.stop_requested(); ++i) {
    state::LoadRequest request;
    request.path = plan.model_files[i];
    request.free_base = options.free_base;
    request.merge_fixed = options.merge_fixed;
    request.name_prefix = plan.placements[i].name_prefix;
    request.T_world_model = plan.placements[i].T_world_model;
    const state::Outcome outcome = simulation.load_and_wait(std::move(request));
    if (outcome.success) {
      log.info("%s", outcome.message.c_str());
    } else {
      log.error("%s", outcome.message.c_str());
      good &= i >= options.model_files.size();  // these come first
    }
  }
  return good;
}

// With windows where there can be any, until the user, a signal or the time ends it.
void run_on(const CommandLine& options, const state::Abilities& simulation, Signals& signals, base::Log& log,
            const render::ViewerOptions& view) {
  const std::int64_t end_ns =
      options.run_for_seconds > 0.0 ? base::steady_ns() + base::to_ns(options.run_for_seconds) : INT64_MAX;
  const ViewEnd view_end = options.show_gui ? run_view(simulation, signals, end_ns, view, log) : ViewEnd::none;
  const bool goes_on_headless =
      view_end == ViewEnd::none || (view_end == ViewEnd::display && options.keep_running_without_display);
  if (view_end == ViewEnd::display && goes_on_headless) log.info("running on without windows");
  if (goes_on_headless) signals.wait(base::to_seconds(end_ns - base::steady_ns()));
}

int simulate(const CommandLine& options, Signals& signals, base::Log& log, const base::LogTail& tail) {
  mention_what_is_not_there_yet(options, log);
  Communication::register_drivers(log);
  const LaunchOutcome launch = read_launch(options);
  log.report(launch.diagnostics);
  if (launch.bad_command_line) return kExitUsage;
  if (!launch.plan) return kExitFailed;
  const LaunchPlan& plan = *launch.plan;

  std::unique_ptr<inputs::Recorder> input_recorder;  // outlives all whose inputs it records
  if (!options.record_input.empty()) {
    std::string problem;
    input_recorder = start_recording(options, plan, log, problem);
    if (input_recorder == nullptr) {
      log.error("%s", problem.c_str());
      return kExitUsage;
    }
  }
  runtime::SimulationOptions running = simulation_options(options, plan.world);
  running.files = {plan.world_text, plan.color_file, plan.input_devices_file};
  runtime::Simulation simulation(running, plan.world, plan.colors, log, input_recorder.get());
  exchange::Broadcast<state::WindowInput> hand;  // windows write it, the driver keyboard_mouse reads it
  devices::register_driver(devices::keyboard_mouse_kind(hand));
  const StartedDevices devices = start_devices(options, plan, simulation.abilities(), log, input_recorder.get());
  if (devices.usage) return kExitUsage;
  state::Abilities abilities = simulation.abilities();
  abilities.devices = devices.hub.get();
  // Starting a master takes longer than loading: both at once.
  const std::unique_ptr<Communication> communication = Communication::start(options, abilities, log);
  if (!load_models(options, plan, simulation, signals, log)) return kExitFailed;
  if (devices.hub != nullptr) devices.hub->scene_loaded();
  std::optional<render::PictureStreamer> streamer;
  if (communication->pictures() != nullptr) {
    streamer.emplace(simulation, *communication->pictures(), log, options.offscreen);
  }
  Summary summary(simulation);
  simulation.begin();

  bool recorded = true;
  if (records(options) && !runs_beside(options)) {
    recorded = record(options, simulation, simulation, signals, log);
  } else {
    std::thread recorder;
    if (records(options))
      recorder = std::thread([&] { recorded = record(options, simulation, simulation, signals, log); });
    render::ViewerOptions view;
    view.check_graphics = options.check_graphics;
    view.messages = &tail;
    view.scene = scene_files(options, plan);
    view.frame_loaded = options.launch_file.empty() && !options.model_files.empty() && options.model_indices.empty();
    if (moved_in_windows(devices)) view.hand = &hand;
    std::optional<BagRecording> bags;  // its bag is complete before topics close
    if (options.show_gui) {            // for the panel
      view.recording = &bags.emplace(BagRecorderOptions{communication->nothing_published(), ambf_cli_places()}, log);
    }
    run_on(options, abilities, signals, log, view);
    signals.request_stop();
    if (recorder.joinable()) recorder.join();
  }
  if (options.run_for_seconds > 0.0) std::printf("%s", summary.text().c_str());
  if (signals.signal() == SIGTERM) return kExitTerminated;
  if (signals.signal() == SIGHUP) return kExitHungUp;
  return recorded ? kExitDone : kExitFailed;
}

// Blocks above this go back to the system when they are freed. glibc would raise the bound to the largest block that it
// ever freed, up to 32 MB: the messages of strangers then tear each thread's heap into pieces that nothing fits.
void keep_heaps_small() {
  constexpr int kOwnMapping = 128 << 10;  // bytes
  mallopt(M_MMAP_THRESHOLD, kOwnMapping);
  mallopt(M_TRIM_THRESHOLD, kOwnMapping);
}

}  // namespace

int run_simulator(int argc, char** argv) {
  report_uncaught_exceptions();
  keep_heaps_small();
  const ParsedCommandLine parsed = parse_command_line(argc, argv);
  if (!parsed.options) {
    std::fprintf(stderr, "ambf_simulator: %s\nSee ambf_simulator --help.\n", parsed.error.c_str());
    return kExitUsage;
  }
  const CommandLine& options = *parsed.options;
  if (options.help) {
    std::printf("%s", help_text().c_str());
    return kExitDone;
  }
  if (options.version) {
    std::printf("ambf_simulator %s\n", AMBF_VERSION);
    return kExitDone;
  }
  if (options.limits) {
    std::printf("%s", limits_as_text().c_str());
    return kExitDone;
  }
  if (!options.check_files.empty()) return check_files(options);
  if (!options.convert_files.empty()) return convert(options) ? kExitDone : kExitFailed;
  if (const std::string problem = Communication::problem_of_environment(options); !problem.empty()) {
    std::fprintf(stderr, "ambf_simulator: %s (--no-ros runs it without topics)\n", problem.c_str());
    return kExitUsage;
  }

  Signals signals;  // first: every thread started later leaves signals to it
  base::Log log;
  std::string problem;
  base::LogTail tail;  // for the panel
  base::LogDrain drain(log, base::both(base::make_stream_sink(options.log_file, &problem),
                                       [&tail](const base::LogLine& line) { tail.add(line); }));
  if (!problem.empty()) log.warning("%s", problem.c_str());
  // Objects of these kinds are in no file: who has none of them has the world of a program without.
  if (!options.crtk_files.empty() || !options.replay_input.empty()) Communication::register_kinds();
  if (!options.replay_input.empty()) {
    const ReplayEnd end = replay(options, signals, log);
    return end == ReplayEnd::equal ? kExitDone : end == ReplayEnd::different ? kExitFailed : kExitUsage;
  }
  if (!base::lock_memory()) log.info("memory is not locked (no permission): page faults may delay steps");
  return simulate(options, signals, log, tail);
}

}  // namespace ambf::simulator
