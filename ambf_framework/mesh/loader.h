// Reads mesh files: STL (binary, ascii), OBJ with MTL, PLY, 3DS, COLLADA (DAE) by readers of our own, which are fuzzed
// (docs/decisions/0003-mesh-reading.md); other formats by assimp, in a process that is started for the file and may die
// of it (0039-file-reader.md). Any byte sequence gives a mesh or one error. Never throws, never prints, never keeps
// state. Any thread but the physics thread; several calls may run at once. For shared, cached loading see mesh/cache.h.
//
// Coordinates are those of the file: axes are never swapped (COLLADA's up_axis and the usual "3DS is z-up" turn are not
// applied, since ADF poses refer to the file's own axes). COLLADA node transforms and its unit (to metres) are applied.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "mesh/mesh.h"

namespace ambf::mesh {

enum class Format { unknown, stl, obj, ply, threeds, collada, imported };  // imported: by assimp
const char* to_string(Format format);

// Limits hold one load well below 1 GiB and 5 s; a file beyond one is refused with a message that names the limit.
struct LoadOptions {
  std::size_t max_file_bytes = std::size_t{128} << 20;
  std::size_t max_triangles = 2'000'000;
  std::size_t max_vertices = 2'000'000;  // distinct ones; a closed surface has half as many as triangles
  double crease_angle_rad = 0.7;         // edges sharper than this (40 degrees) stay hard where the file has no normals
  double weld_epsilon_relative = 1e-6;   // of the bounding box diagonal: joins vertices before normals are computed
  bool second_reader = true;             // a file that our reader refuses for its syntax is given to assimp, too
  double worker_silence_s = 5.0;         // after which the process that reads other formats is given up
  std::string worker_program;            // that process; empty: ambf_file_reader beside our library
};

struct LoadResult {
  bool ok = false;  // false: mesh is empty and diagnostics hold exactly one error
  Mesh mesh;
  base::Diagnostics diagnostics;  // Diagnostic::file is the path as given
  Format format = Format::unknown;
  // Files the result depends on besides the mesh file (material libraries, textures, a glTF's buffers), found or not.
  std::vector<std::string> depends_on;
};

// The format is chosen by content where that is certain, else by the ending (any case).
LoadResult load(const std::string& path, const LoadOptions& options = {});

// As load, of bytes already in memory (moved in, they are freed before the mesh is built). `path` names the source in
// messages; files it mentions are looked up beside it.
LoadResult load_bytes(std::string bytes, const std::string& path, const LoadOptions& options = {});

}  // namespace ambf::mesh
