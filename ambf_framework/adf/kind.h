// Tells kinds of ADF file apart by their top-level keys. Looks at nothing but the text. Any thread; never throws.
#pragma once

#include <string>

#include "adf/report.h"

namespace ambf::adf {

enum class FileKind { model, world, launch, colors, input_devices, crtk_arms };

// What kind of file a text is; a file that fits nothing else is a model.
FileKind kind_of(const std::string& text);
FileKind kind_of(const Value& root);

// False, with an error that says how to use it, for files that hold no model but another kind of description: read as a
// model they would be one with nothing in it. Files of nothing but cameras and lights are worlds and models alike.
bool may_be_model(const Value& root, Report& report);

}  // namespace ambf::adf
