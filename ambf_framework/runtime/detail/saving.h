// What saving a model and saving a scene share. Loader thread.
#pragma once

#include <string>

#include "adf/save.h"
#include "base/whole_file.h"
#include "model/catalogue.h"
#include "runtime/detail/kept_texts.h"
#include "state/frame.h"

namespace ambf::runtime {

// Of a model, what a frame of the structure in force says; bodies, and what hangs nowhere, seen from `T_world_model`.
adf::Present present_of(const model::Catalogue& catalogue, state::ModelId model, const state::Frame& now,
                        const math::Pose& T_world_model = {});
// What a model is saved from: its text, or, where none is kept, its description as text.
struct SavedFrom {
  std::string text, file;         // the file that it was read from; empty: paths start at the working folder
  base::Diagnostics diagnostics;  // errors: it cannot be written
};
SavedFrom saved_from(const KeptText* kept, const scene::Model& description, const std::string& file);

// What is written as it was read, also at the current pose: "2 sensor(s), velocities"; empty: nothing.
std::string kept_as_read(const scene::Model& model, const state::Frame& now);

// Empty, or why the file that a model was read from must not be replaced by what is made of the text that was read.
// `written`: what Save wrote there before; may be null.
std::string why_not_over_its_own(const std::string& path, const std::string& text, const std::string* written);
bool is_same_file(const std::string& a, const std::string& b);

// Of a path, a file name without what no name may hold: "a.yaml" of "/x/a.yaml", "arm.yaml" of "/x/arm.urdf".
std::string adf_name_of(const std::string& path, const std::string& otherwise);

// A mesh with what it refers to (material libraries, textures, buffers), which goes to the same place from it, or
// beside it where that would leave the bundle. Empty, or why not.
std::string copy_mesh(const adf::Copy& copy, base::IfExists if_exists);

}  // namespace ambf::runtime
