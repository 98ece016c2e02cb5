// Actuator blocks. For use inside adf/ only.
#pragma once

#include <optional>

#include "adf/detail/file_context.h"
#include "scene/description.h"

namespace ambf::adf {

std::optional<scene::KindBlock> parse_actuator(const Block& block, const FileContext& file, NameBook& names);

// Reports triggers whose jaw is a body of this file without a joint with limits below it. Once all blocks are read.
void check_actuators(const scene::Model& model, Report& report);

}  // namespace ambf::adf
