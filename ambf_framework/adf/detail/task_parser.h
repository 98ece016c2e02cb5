// Task blocks. One thread.
#pragma once

#include <optional>

#include "adf/detail/file_context.h"
#include "scene/description.h"

namespace ambf::adf {

// A description of type scene::Task. The block has passed the table of keys; none when something in it is wrong beyond
// that.
std::optional<scene::KindBlock> parse_task(const Block& block, const FileContext& file, NameBook& names);

}  // namespace ambf::adf
