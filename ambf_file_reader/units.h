// The unit of a mesh file, and which way is up, where its format says so. One thread.
#pragma once

#include <string>

#include "mesh/formats/reader_answer.h"

struct aiScene;

namespace ambf::file_reader {

struct Units {
  double metres = 1.0;  // one unit of the coordinates that assimp gives
  std::string note;     // for the user; empty: none
};

Units units_of(const mesh::ReaderQuestion& question, const aiScene& scene);

}  // namespace ambf::file_reader
