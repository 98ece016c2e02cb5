// Actuator blocks. For use inside adf/ only.
#pragma once

#include <optional>

#include "adf/detail/file_context.h"
#include "scene/description.h"

namespace ambf::adf {

std::optional<scene::KindBlock> parse_actuator(const Block& block, const FileContext& file, NameBook& names);

}  // namespace ambf::adf
