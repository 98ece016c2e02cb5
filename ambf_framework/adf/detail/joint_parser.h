// Joint blocks (ADF 5). Bodies are looked up later, by the loader. One thread.
#pragma once

#include "adf/detail/file_context.h"
#include "scene/description.h"

namespace ambf::adf {

std::optional<scene::Joint> parse_joint(const Block& block, const FileContext& file, NameBook& names);

}  // namespace ambf::adf
