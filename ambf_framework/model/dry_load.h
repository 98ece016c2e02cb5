// What loading a model would say beyond what its reader says (meshes, materials, gains, joints, parents), without a
// simulation. It is loading itself, into a catalogue that is thrown away: what is checked and what is loaded cannot
// part. Any thread but the physics thread; reads the model's files.
#pragma once

#include <vector>

#include "base/diagnostic.h"
#include "scene/description.h"

namespace ambf::model {

base::Diagnostics dry_load(const scene::Model& model);
// The same once `before` are loaded, whose own diagnostics are left out.
base::Diagnostics dry_load_after(const std::vector<scene::Model>& before, const scene::Model& model);

}  // namespace ambf::model
