// Vehicle blocks. For use inside adf/ only.
#pragma once

#include <optional>
#include <vector>

#include "adf/detail/file_context.h"
#include "scene/description.h"

namespace ambf::adf {

// Adds a body to `bodies` for each wheel that is given as a mesh: static, without topics, named after the vehicle.
std::optional<scene::KindBlock> parse_vehicle(const Block& block, const FileContext& file, NameBook& names,
                                              std::vector<scene::Body>& bodies);

}  // namespace ambf::adf
