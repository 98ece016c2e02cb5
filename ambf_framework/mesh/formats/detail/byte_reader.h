// Private to mesh/: numbers out of bytes, in either byte order, never beyond the end: after the first read beyond it
// ok() is false and everything reads as zero.
#pragma once

#include <bit>
#include <cstdint>
#include <string_view>

namespace ambf::mesh {

class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes, bool big_endian = false) : bytes_(bytes), big_endian_(big_endian) {}

  bool ok() const { return ok_; }
  std::size_t remaining() const { return bytes_.size() - at_; }
  std::size_t position() const { return at_; }

  // An unsigned integer of 1 to 8 bytes.
  std::uint64_t unsigned_of(std::size_t size) {
    if (!ok_ || remaining() < size) {
      ok_ = false;
      return 0;
    }
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const auto byte = static_cast<unsigned char>(bytes_[at_ + (big_endian_ ? i : size - 1 - i)]);
      value = value << 8 | byte;
    }
    at_ += size;
    return value;
  }
  std::uint8_t u8() { return static_cast<std::uint8_t>(unsigned_of(1)); }
  std::uint16_t u16() { return static_cast<std::uint16_t>(unsigned_of(2)); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(unsigned_of(4)); }
  float f32() { return std::bit_cast<float>(u32()); }
  double f64() { return std::bit_cast<double>(unsigned_of(8)); }

  // The next `size` bytes as they are.
  std::string_view take(std::size_t size) {
    if (!ok_ || remaining() < size) {
      ok_ = false;
      return {};
    }
    const std::string_view part = bytes_.substr(at_, size);
    at_ += size;
    return part;
  }
  // Text up to a zero byte, which is skipped.
  std::string_view text() {
    const std::size_t end = bytes_.find('\0', at_);
    if (!ok_ || end == std::string_view::npos) {
      ok_ = false;
      return {};
    }
    const std::string_view part = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    return part;
  }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
  bool big_endian_ = false;
  bool ok_ = true;
};

}  // namespace ambf::mesh
