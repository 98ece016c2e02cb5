#include "launch.h"

#include <cstdlib>
#include <filesystem>

#include "adf/adf.h"

namespace ambf::simulator {

namespace fs = std::filesystem;

namespace {

constexpr const char* kLaunchInTree = "ambf_models/descriptions/launch.yaml";
constexpr const char* kLaunchInstalled = "share/ambf/models/descriptions/launch.yaml";

constexpr int kDefaultIndex = 1;  // of a command line that names no model: command_line.cpp

void append(base::Diagnostics& to, base::Diagnostics from) {
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

base::Diagnostic error(std::string message, std::string hint) {
  base::Diagnostic d;
  d.severity = base::Severity::error;
  d.message = std::move(message);
  d.hint = std::move(hint);
  return d;
}

// The first model of -l brings its world; files given by name come into the common one.
std::string world_of(const scene::Launch& launch, const CommandLine& options) {
  if (options.model_files.empty() && !options.model_indices.empty()) {
    const auto first = static_cast<std::size_t>(options.model_indices.front());
    if (first < launch.world_files.size()) return launch.world_files[first];
  }
  return launch.world_file;
}

}  // namespace

std::string default_launch_file() {
  std::error_code ignored;
  if (const char* root = std::getenv("AMBF_ROOT_PATH")) return (fs::path(root) / kLaunchInTree).string();
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  // <prefix>/bin/ambf_simulator when installed, <tree>/build*/bin/ambf_simulator when built.
  const fs::path prefix = program.parent_path().parent_path();
  if (fs::exists(prefix / kLaunchInstalled, ignored)) return (prefix / kLaunchInstalled).string();
  return (prefix.parent_path() / kLaunchInTree).string();
}

std::string scene_files(const CommandLine& options, const LaunchPlan& plan) {
  std::vector<std::string> files = plan.model_files;
  if (files.empty()) files = {options.launch_file.empty() ? default_launch_file() : options.launch_file};
  std::string all;
  std::error_code ignored;
  for (const std::string& file : files) {
    const fs::path full = fs::weakly_canonical(file, ignored);
    all += (all.empty() ? "" : "\n") + (full.empty() ? file : full.string());
  }
  return all;
}

LaunchOutcome read_launch(const CommandLine& options) {
  LaunchOutcome outcome;
  const std::string file = options.launch_file.empty() ? default_launch_file() : options.launch_file;
  adf::LaunchResult launch = adf::load_launch(file);
  append(outcome.diagnostics, std::move(launch.diagnostics));
  if (!launch.launch) return outcome;

  LaunchPlan plan;
  if (!launch.launch->color_file.empty()) {
    adf::ColorsResult colors = adf::load_colors(launch.launch->color_file);
    append(outcome.diagnostics, std::move(colors.diagnostics));
    if (colors.colors) plan.colors = std::move(*colors.colors);
    plan.color_file = launch.launch->color_file;
  }
  adf::Options adf_options;
  adf_options.colors = &plan.colors;
  // No world file: ground and gravity as where a world file says nothing.
  const std::string world_file = world_of(*launch.launch, options);
  if (!world_file.empty()) {
    adf::WorldResult world = adf::load_world(world_file, adf_options);
    append(outcome.diagnostics, std::move(world.diagnostics));
    if (!world.world) return outcome;
    plan.world = std::move(*world.world);
    plan.world_text = std::move(world.text);
  }
  plan.input_devices_file = launch.launch->input_devices_file;

  plan.model_files = options.model_files;
  plan.placements.resize(plan.model_files.size());
  const std::vector<std::string>& models = launch.launch->model_files;
  const bool nothing_there = models.empty() && options.model_indices == std::vector<int>{kDefaultIndex};
  if (nothing_there && options.model_files.empty()) {
    outcome.diagnostics.push_back(error("'" + file + "' lists no models", "nothing is loaded"));
    outcome.diagnostics.back().severity = base::Severity::information;
  }
  for (const int index : nothing_there ? std::vector<int>{} : options.model_indices) {
    const auto place = static_cast<std::size_t>(index);
    if (place < models.size() && !models[place].empty()) {
      plan.model_files.push_back(models[place]);
      plan.placements.push_back(place < launch.placements.size() ? launch.placements[place] : adf::Placement{});
    } else if (place < models.size()) {
      outcome.bad_command_line = true;
      outcome.diagnostics.push_back(error("-l " + std::to_string(index) + ": that place of '" + file + "' is empty",
                                          "choose another; the file may say what belongs there"));
    } else {
      outcome.bad_command_line = true;
      outcome.diagnostics.push_back(error(
          "-l " + std::to_string(index) + ": '" + file + "' lists only " + std::to_string(models.size()) + " models",
          "indices go from 0 to " + std::to_string(models.empty() ? 0 : models.size() - 1)));
    }
  }
  outcome.plan = std::move(plan);
  return outcome;
}

}  // namespace ambf::simulator
