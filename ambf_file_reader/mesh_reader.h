// A mesh file of any format that assimp reads, as plain data: node transforms and the file's unit applied, axes as in
// the file. One thread; may crash with assimp.
#pragma once

#include "mesh/formats/reader_answer.h"

namespace ambf::file_reader {

mesh::ReaderAnswer read_mesh(const mesh::ReaderQuestion& question);

}  // namespace ambf::file_reader
