// Everything that can be said of a file without simulating it: what loading says, and what would go wrong afterwards (joints whose bodies
// are nowhere in the file, gains that cannot be stable). `ambf_simulator --check` prints it. Reads files; any thread; never throws.
#pragma once

#include <string>

#include "base/diagnostic.h"

namespace ambf::adf {

enum class FileKind { model, world, launch, colors, input_devices };

// What kind of file a text is, by its top-level keys; a file that fits nothing else is a model.
FileKind kind_of(const std::string& text);

// A launch file is followed: its world, colours, devices and models are checked too.
base::Diagnostics check_file(const std::string& path);

}  // namespace ambf::adf
