// Writes a file whole or not at all: beside its place, flushed to the disk, then renamed. A full disk, a missing
// permission or a power cut leaves the file of before as it was. Blocks for the disk: never on a real-time thread.
#pragma once

#include <string>
#include <string_view>

namespace ambf::base {

enum class IfExists { refuse, replace };

// Empty, or "cannot write 'PATH': REASON". What is at `path` and no ordinary file (a pipe, a folder) is never replaced;
// a symbolic link stays, and the file behind it is replaced. A replaced file keeps its permissions.
std::string write_whole_file(const std::string& path, std::string_view bytes, IfExists if_exists);

}  // namespace ambf::base
