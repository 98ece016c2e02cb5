// Ghost object blocks (ADF 13). Parents are looked up later, by the loader. One thread.
#pragma once

#include <optional>

#include "adf/detail/file_context.h"
#include "scene/description.h"

namespace ambf::adf {

// Holds a scene::Ghost; none when something in it is wrong beyond what the table of keys knows.
std::optional<scene::KindBlock> parse_ghost(const Block& block, const FileContext& file, NameBook& names);

}  // namespace ambf::adf
