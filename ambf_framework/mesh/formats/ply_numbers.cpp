#include "mesh/formats/detail/ply_numbers.h"

#include <cstdint>

namespace ambf::mesh {

PlyType ply_type_named(std::string_view name) {
  if (name == "char" || name == "int8") return PlyType::int8;
  if (name == "uchar" || name == "uint8") return PlyType::uint8;
  if (name == "short" || name == "int16") return PlyType::int16;
  if (name == "ushort" || name == "uint16") return PlyType::uint16;
  if (name == "int" || name == "int32") return PlyType::int32;
  if (name == "uint" || name == "uint32") return PlyType::uint32;
  if (name == "float" || name == "float32") return PlyType::float32;
  if (name == "double" || name == "float64") return PlyType::float64;
  return PlyType::none;
}

std::size_t ply_size_of(PlyType type) {
  switch (type) {
    case PlyType::none: return 0;
    case PlyType::int8:
    case PlyType::uint8: return 1;
    case PlyType::int16:
    case PlyType::uint16: return 2;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32: return 4;
    case PlyType::float64: return 8;
  }
  return 0;
}

bool PlyNumbers::read(PlyType type, double& out) {
  if (ascii_) return parse_double(words_.next(), out);
  switch (type) {
    case PlyType::none: return false;
    case PlyType::int8: out = static_cast<std::int8_t>(reader_.u8()); break;
    case PlyType::uint8: out = reader_.u8(); break;
    case PlyType::int16: out = static_cast<std::int16_t>(reader_.u16()); break;
    case PlyType::uint16: out = reader_.u16(); break;
    case PlyType::int32: out = static_cast<std::int32_t>(reader_.u32()); break;
    case PlyType::uint32: out = reader_.u32(); break;
    case PlyType::float32: out = static_cast<double>(reader_.f32()); break;
    case PlyType::float64: out = reader_.f64(); break;
  }
  return reader_.ok();
}

bool PlyNumbers::skip(std::size_t bytes) {
  reader_.take(bytes);
  return reader_.ok();
}

}  // namespace ambf::mesh
