// Soft body blocks (ADF 6). One thread.
#pragma once

#include <optional>

#include "adf/detail/file_context.h"
#include "scene/description.h"

namespace ambf::adf {

// Holds a scene::SoftBody; none when something in it is wrong beyond what the table of keys knows.
std::optional<scene::KindBlock> parse_soft_body(const Block& block, const FileContext& file, NameBook& names);

}  // namespace ambf::adf
