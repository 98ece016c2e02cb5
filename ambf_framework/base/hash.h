// FNV-1a hashes: the same value for the same data on every machine and in every run. They recognise data of our own;
// data of others can be made to collide on purpose. Any thread; C++17.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace ambf::base {

class Fnv1a {
 public:
  void add_byte(unsigned char byte) { value_ = (value_ ^ byte) * kPrime; }
  void add_bytes(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) add_byte(bytes[i]);
  }
  void add_text(std::string_view text) { add_bytes(text.data(), text.size()); }

  // A word at once: eight times as fast as its bytes, and another hash. Its upper bits are folded in, which the product
  // alone would leave without effect on the lower ones.
  void add_word(std::uint64_t word) {
    value_ = (value_ ^ word) * kPrime;
    value_ ^= value_ >> 29;
  }
  void add_word(double value) {
    std::uint64_t word = 0;
    std::memcpy(&word, &value, sizeof word);
    add_word(word);
  }

  std::uint64_t value() const { return value_; }

 private:
  static constexpr std::uint64_t kPrime = 0x100000001b3ULL;
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

// Of 32 bits.
inline std::uint32_t fnv1a_32(std::string_view text) {
  std::uint32_t value = 2166136261U;
  for (const char c : text) value = (value ^ static_cast<unsigned char>(c)) * 16777619U;
  return value;
}

}  // namespace ambf::base
