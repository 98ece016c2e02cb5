// Plain values to bytes and back, in the order in which they are written. Reading beyond the end gives zeros and marks the reader
// bad, so damaged bytes are found out once, at the end. For use inside model/ only.
#pragma once

#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

namespace ambf::model {

class StateWriter {
 public:
  explicit StateWriter(std::vector<std::uint8_t>& bytes) : bytes_(bytes) {}

  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    put_bytes(&value, sizeof value);
  }
  void put_bytes(const void* data, std::size_t size) {
    if (size == 0) return;
    const std::size_t at = bytes_.size();
    bytes_.resize(at + size);
    std::memcpy(bytes_.data() + at, data, size);
  }

 private:
  std::vector<std::uint8_t>& bytes_;
};

class StateReader {
 public:
  StateReader(const std::uint8_t* data, std::size_t size) : at_(data), left_(size) {}

  template <class T>
  T get() {
    static_assert(std::is_trivially_copyable_v<T>);
    T value{};
    if (const std::uint8_t* from = take(sizeof value)) std::memcpy(&value, from, sizeof value);
    return value;
  }
  // Null when there are not that many left.
  const std::uint8_t* take(std::size_t size) {
    if (size > left_) {
      good_ = false;
      left_ = 0;
      return nullptr;
    }
    const std::uint8_t* from = at_;
    at_ += size;
    left_ -= size;
    return from;
  }
  bool good() const { return good_; }
  std::size_t left() const { return left_; }

 private:
  const std::uint8_t* at_;
  std::size_t left_;
  bool good_ = true;
};

}  // namespace ambf::model
