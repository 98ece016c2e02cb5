// The `v` lines of an OBJ file: what other programs mean by a vertex's number, whatever of it our meshes keep. Reads
// the file; any thread but the physics thread.
#pragma once

#include <string>
#include <vector>

#include "math/types.h"

namespace ambf::mesh {

// Does the file's name end in .obj, in any case?
bool is_obj(const std::string& path);

// In the order of the file, as its readers round them. Empty when it cannot be read or is larger than LoadOptions
// allow.
std::vector<math::Vec3> obj_points(const std::string& path);

}  // namespace ambf::mesh
