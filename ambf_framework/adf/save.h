// Writes a model, a world or a launch file that was read from ADF text again: the same text, edited where something has
// changed. Never throws. Reads the file system (where meshes are), writes nothing. Any thread; calls share nothing.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "adf/adf.h"
#include "state/parameters.h"
#include "state/view.h"

namespace ambf::adf {

struct BodyPlace {
  std::string block;  // identifier of the body's block
  math::Pose T_world_body;
};

// What hangs on an object or in the world, as it is now.
struct ViewPlace {
  std::string block, parent;  // the parent as the key names it; empty: the world (or the model's origin)
  math::Pose T_parent_object;
};
struct CameraNow {
  ViewPlace place;
  state::Lens loaded, now;
};
struct LightNow {
  ViewPlace place;
  state::Beam loaded, now;
};

// Parameters that users change while the simulation runs.
template <class Parameters>
struct Tuned {
  std::string block;
  Parameters loaded, now;
};

// What is written of how a simulation is now.
struct Present {
  std::vector<BodyPlace> bodies;  // that may have moved
  std::vector<CameraNow> cameras;
  std::vector<LightNow> lights;
  std::vector<Tuned<state::BodyParameters>> tuned_bodies;
  std::vector<Tuned<state::JointParameters>> tuned_joints;
};

struct SaveOrder {
  std::string text;                    // ModelResult::text
  std::string from, to;                // the file that it was read from, and the one that it is written for
  const scene::Model* left = nullptr;  // what is left of the model: other blocks leave the header lists; null: all
  Present present;
  bool bundle = false;  // meshes lie beside the new file, in a folder with its name
  // Of a scene: the numbers that the key `conflict numbers` must give (model::Catalogue::numbers_to_keep).
  std::map<std::string, std::string> conflict_numbers = {};
};

// A file that a bundle needs, and the place where the new text looks for it.
struct Copy {
  std::string from, to;
};

// No text where it cannot be edited, or would not read back as what is wanted: errors say where and what to do.
struct SavedModel {
  std::optional<std::string> text;
  std::vector<Copy> copies;  // of a bundle: mesh files, without what those refer to; nothing has been copied
  base::Diagnostics diagnostics;
};

struct SaveWorldOrder {
  std::string text;  // WorldResult::text; empty: the simulation had no world file, and `world` is written
  std::string from, to;
  const scene::World* world = nullptr;
  const scene::Model* views = nullptr;  // the cameras and lights, those that no file describes among them
  std::string environment;              // the path that the new file names; empty: it names none, as the old one
  std::optional<math::Vec3> gravity;
  Present present;  // cameras and lights
};

// Without a change, the text of the order, byte for byte. Relative paths are written as they lead from the new folder.
SavedModel save_model(const SaveOrder& order, const Options& options = {});
SavedModel save_world(const SaveWorldOrder& order, const Options& options = {});

// Of a bundle: an input devices file whose devices bring models from beside it, in `devices/`. `models`: those files,
// and where the new text looks for each; they are saved as bundles themselves. Texts that cannot be edited: errors.
struct SavedDevices {
  std::optional<std::string> text;
  std::vector<Copy> models;
  base::Diagnostics diagnostics;
};
SavedDevices save_input_devices(const std::string& text, const std::string& from, const std::string& to);

// A launch file as new text. Paths as they lead from it.
std::string write_launch(const std::string& world, const std::string& colors, const std::string& input_devices,
                         const std::vector<std::string>& models, const std::vector<Placement>& placements);

// A body that has moved less (m; rad) is written as it was.
inline constexpr double kUnmoved = 1e-10;

}  // namespace ambf::adf
