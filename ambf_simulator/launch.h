// From the command line to descriptions: finds and reads the launch file, the world and the colours, and lists the
// models to load. Prints nothing.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "adf/adf.h"
#include "base/diagnostic.h"
#include "command_line.h"
#include "scene/colors.h"
#include "scene/description.h"

namespace ambf::simulator {

struct LaunchPlan {
  scene::World world;
  scene::ColorTable colors;
  std::vector<std::string> model_files;    // -a files first, then -l models
  std::vector<adf::Placement> placements;  // of each of these
  std::shared_ptr<const std::string> world_text;
  std::string color_file, input_devices_file;
};

// The files that make the scene what it is, one a line: the models, or the launch file where there are none.
std::string scene_files(const CommandLine& options, const LaunchPlan& plan);

struct LaunchOutcome {
  std::optional<LaunchPlan> plan;  // none: the launch or world file is unusable
  base::Diagnostics diagnostics;
  bool bad_command_line = false;  // no fault of the files: -l asks for what the launch file does not list
};

LaunchOutcome read_launch(const CommandLine& options);

// The shipped launch file: $AMBF_ROOT_PATH/ambf_models/..., else beside the installed program, else of the source tree.
std::string default_launch_file();

}  // namespace ambf::simulator
