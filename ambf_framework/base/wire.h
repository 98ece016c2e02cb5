// Values as bytes between two processes of one build on one machine, in native order. The reader believes nothing:
// lengths are checked against what is left before memory is reserved, and after the first one that does not fit ok() is
// false and everything reads as empty. A type is written and read by one function: both classes have the same calls.
// Any thread; C++17.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace ambf::base {

class WireWriter {
 public:
  static constexpr bool kReads = false;
  bool ok() const { return true; }

  template <typename T>
  void value(const T& v) {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_same_v<T, bool>);
    bytes_.append(reinterpret_cast<const char*>(&v), sizeof v);
  }
  void flag(const bool& v) { value(static_cast<std::uint8_t>(v)); }
  void text(std::string_view v) {
    value(static_cast<std::uint64_t>(v.size()));
    bytes_.append(v);
  }
  template <typename T>
  void values(const std::vector<T>& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    value(static_cast<std::uint64_t>(v.size()));
    bytes_.append(reinterpret_cast<const char*>(v.data()), v.size() * sizeof(T));
  }
  template <typename T, typename Each>
  void list(std::vector<T>& v, const Each& each) {
    value(static_cast<std::uint64_t>(v.size()));
    for (T& item : v) each(item);
  }

  std::string bytes() && { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class WireReader {
 public:
  static constexpr bool kReads = true;
  explicit WireReader(std::string_view bytes) : rest_(bytes) {}
  bool ok() const { return ok_; }
  bool at_end() const { return ok_ && rest_.empty(); }

  template <typename T>
  void value(T& v) {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_same_v<T, bool>);
    if (take(sizeof v)) std::memcpy(&v, taken_.data(), sizeof v);
  }
  void flag(bool& v) {
    std::uint8_t byte = 0;
    value(byte);
    v = byte != 0;
  }
  void text(std::string& v) {
    if (take(length())) v.assign(taken_);
  }
  template <typename T>
  void values(std::vector<T>& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::uint64_t count = length();
    ok_ = ok_ && count <= rest_.size() / sizeof(T);
    if (!ok_ || !take(count * sizeof(T))) return;
    v.resize(count);
    if (count > 0) std::memcpy(v.data(), taken_.data(), taken_.size());
  }
  // An item costs a byte or more, so that a count cannot reserve more than its own message is long.
  template <typename T, typename Each>
  void list(std::vector<T>& v, const Each& each) {
    const std::uint64_t count = length();
    for (std::uint64_t i = 0; ok_ && i < count; ++i) {
      ok_ = !rest_.empty();
      if (ok_) each(v.emplace_back());
    }
  }

 private:
  std::uint64_t length() {
    std::uint64_t v = 0;
    value(v);
    return v;
  }
  bool take(std::uint64_t size) {
    ok_ = ok_ && size <= rest_.size();
    if (!ok_) return false;
    taken_ = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return true;
  }

  std::string_view rest_, taken_;
  bool ok_ = true;
};

}  // namespace ambf::base
