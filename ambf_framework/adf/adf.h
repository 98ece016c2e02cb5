// Reads ADF files (models, worlds, launch, colours, input devices) into scene descriptions. Reports every finding with
// file, line, column, block and key; drops what is wrong and keeps the rest (severities: docs/adf.md). Never throws,
// never touches the simulation. Reads the file system: the text itself, and whether mesh, shader and texture files
// exist. Any thread; calls share nothing.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "adf/document.h"
#include "base/diagnostic.h"
#include "math/types.h"
#include "scene/colors.h"
#include "scene/defaults.h"
#include "scene/description.h"

namespace ambf::adf {

// How robots written as URDF are read (adf/urdf_import.h).
struct UrdfOptions {
  bool free_base = false;    // the root link moves; else it is static
  bool merge_fixed = false;  // links that fixed joints connect become one body
  std::string adf_path;      // where the ADF text will be: meshes are named from there; empty: as they were found
};

struct Options {
  const scene::ColorTable* colors =
      nullptr;               // names for `color`; null: such names are reported, the mesh keeps its own colours
  scene::Defaults defaults;  // what blocks are before they are read
  UrdfOptions urdf;
  bool look_for_files = true;  // false: paths are resolved, but nobody looks whether meshes and shaders exist
};

// A result without its value means that the file is refused; its diagnostics then hold at least one error.
struct ModelResult {
  std::optional<scene::Model> model;
  base::Diagnostics diagnostics;
  // The file as it was written, with a mark for every value: which keys were given, and what a writer edits. Null where
  // the file is no YAML or has the wrong kind of top level.
  std::shared_ptr<const Document> document = nullptr;
  // What `document` was read from: of a robot written as URDF, the ADF text that it was converted to.
  std::shared_ptr<const std::string> text = nullptr;
  // `conflict numbers`: by block, the numbers that a saved scene had behind its names.
  std::map<std::string, std::string> conflict_numbers = {};
};
struct WorldResult {
  std::optional<scene::World> world;
  base::Diagnostics diagnostics;
  std::shared_ptr<const std::string> text = nullptr;  // what it was read from
};
// Where a launch file puts a model.
struct Placement {
  std::string name_prefix;  // put before the model's namespaces
  math::Pose T_world_model;
};
struct LaunchResult {
  std::optional<scene::Launch> launch;
  base::Diagnostics diagnostics;
  std::vector<Placement> placements = {};  // for each of the model files, or none
};
struct ColorsResult {
  std::optional<scene::ColorTable> colors;
  base::Diagnostics diagnostics;
};
struct InputDevicesResult {
  std::optional<scene::InputDevices> devices;
  base::Diagnostics diagnostics;
};

// Also of URDF.
ModelResult load_model(const std::string& path, const Options& options = {});
WorldResult load_world(const std::string& path, const Options& options = {});
LaunchResult load_launch(const std::string& path);
// A file that cannot be read is a warning and a table without names.
ColorsResult load_colors(const std::string& path);
// A device that is wrong is left out, the others are there.
InputDevicesResult load_input_devices(const std::string& path);

// The same for text at hand. `path` is used in messages, and its folder is where relative paths start.
ModelResult parse_model(const std::string& text, const std::string& path, const Options& options = {});
WorldResult parse_world(const std::string& text, const std::string& path, const Options& options = {});
LaunchResult parse_launch(const std::string& text, const std::string& path);
ColorsResult parse_colors(const std::string& text, const std::string& path);
InputDevicesResult parse_input_devices(const std::string& text, const std::string& path);

}  // namespace ambf::adf
