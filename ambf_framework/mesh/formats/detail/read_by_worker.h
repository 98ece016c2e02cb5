// Private to mesh/: formats that assimp reads, in the process ambf_file_reader, which is started for one file and may
// die of it (docs/decisions/0039-file-reader.md). One thread; blocks until the answer is there or given up.
#pragma once

#include <string>
#include <string_view>

#include "mesh/formats/read_context.h"

namespace ambf::mesh {

// `ending`: without the dot, in lower case; chooses the importer. Reports warnings, but no error: on failure the reason
// is in out_problem and what to do in out_hint.
bool read_by_worker(std::string_view bytes, const std::string& ending, ReadContext& context, RawMesh& out,
                    std::string& out_problem, std::string& out_hint);

}  // namespace ambf::mesh
