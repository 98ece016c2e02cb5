// Writes a model that was read from ADF text again: the same text, edited where something has changed. Never throws.
// Reads the file system (where meshes are), writes nothing. Any thread; calls share nothing.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adf/adf.h"

namespace ambf::adf {

struct BodyPlace {
  std::string block;  // identifier of the body's block
  math::Pose T_world_body;
};

struct SaveOrder {
  std::string text;                       // ModelResult::text
  std::string from, to;                   // the file that it was read from, and the one that it is written for
  const scene::Model* present = nullptr;  // what is left of the model: other blocks leave the header lists; null: all
  std::vector<BodyPlace> places;          // of bodies that may have moved
  bool bundle = false;                    // meshes lie beside the new file, in a folder with its name
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

// Without a change, the text of the order, byte for byte. Relative paths are written as they lead from the new folder.
SavedModel save_model(const SaveOrder& order, const Options& options = {});

// A body that has moved less (m; rad) is written as it was.
inline constexpr double kUnmoved = 1e-10;

}  // namespace ambf::adf
