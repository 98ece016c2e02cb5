// Private to mesh/: material libraries of OBJ files.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mesh/formats/read_context.h"

namespace ambf::mesh {

// Appends the materials of one library; a name defined before is replaced. What cannot be understood is a warning: a
// wrong colour must not take a body away. Always true.
bool read_mtl(std::string_view bytes, const std::string& path, ReadContext& context, std::vector<Material>& materials);

}  // namespace ambf::mesh
