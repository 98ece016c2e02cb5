// The model that an input device brings into the scene. Pure functions, any thread.
#pragma once

#include <string>

#include "math/types.h"
#include "scene/description.h"

namespace ambf::scene {

// What the root link of the device's model is called: its topics are there.
std::string name_of_root_link(const std::string& device);

// Makes the model one that only the device's root link represents: the other bodies become passive, without topics of
// their own. `root_link`: a name or an identifier; empty: the body with the fewest parents, the first of these. Returns
// T_world_root as the file says, nothing when there is no such body; then the model stays as it is.
std::optional<math::Pose> make_device_model(Model& model, const std::string& device, const std::string& root_link);

}  // namespace ambf::scene
