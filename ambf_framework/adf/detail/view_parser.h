// Camera and light blocks (ADF 11, 12), of models and worlds. Parents are looked up later. One thread.
#pragma once

#include "adf/detail/file_context.h"
#include "scene/description.h"

namespace ambf::adf {

std::optional<scene::Camera> parse_camera(const Block& block, const FileContext& file, NameBook& names);
std::optional<scene::Light> parse_light(const Block& block, const FileContext& file, NameBook& names);

}  // namespace ambf::adf
