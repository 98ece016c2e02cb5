// The numbers of a PLY file, ascii or binary, one after another. Private to mesh/. Any thread, one reader a thread.
#pragma once

#include <cstddef>
#include <string_view>

#include "mesh/formats/detail/byte_reader.h"
#include "mesh/formats/text.h"

namespace ambf::mesh {

enum class PlyType { none, int8, uint8, int16, uint16, int32, uint32, float32, float64 };

PlyType ply_type_named(std::string_view name);  // none: there is no such type
std::size_t ply_size_of(PlyType type);          // bytes, in binary files

class PlyNumbers {
 public:
  PlyNumbers(std::string_view bytes, bool ascii, bool big_endian, int first_line)
      : words_(bytes), reader_(bytes, big_endian), ascii_(ascii), first_line_(first_line) {}

  bool read(PlyType type, double& out);  // false: the file ends, or there is no number
  bool skip(std::size_t bytes);          // of a binary file
  bool ascii() const { return ascii_; }
  int line() const { return ascii_ ? first_line_ + words_.line() - 1 : 0; }

 private:
  WordScanner words_;
  ByteReader reader_;
  bool ascii_ = true;
  int first_line_ = 1;
};

}  // namespace ambf::mesh
