// Sensor blocks (ADF 7, 15). One thread.
#pragma once

#include "adf/detail/file_context.h"
#include "scene/description.h"

namespace ambf::adf {

// A description of type scene::Sensor. The block has passed the table of keys; none when something in it is wrong
// beyond that.
std::optional<scene::KindBlock> parse_sensor(const Block& block, const FileContext& file, NameBook& names);

// The sensor that a body's `resistive surface` is; none when it has no mesh, which is reported.
std::optional<scene::KindBlock> parse_resistive_surface(const Block& body_block, const scene::Body& body,
                                                        const FileContext& file);

}  // namespace ambf::adf
