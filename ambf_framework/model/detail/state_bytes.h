// Plain values to bytes and back. Both archives offer the same calls, so that one function says for each struct what is written, what
// is read and what must hold of it: the writer writes, the reader reads and checks. After its first complaint the reader gives
// zeros and keeps that complaint. For use inside model/ only.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "math/rotation.h"
#include "math/types.h"

namespace ambf::model {

class StateWriter {
 public:
  static constexpr bool kReads = false;
  explicit StateWriter(std::vector<std::uint8_t>& bytes) : bytes_(bytes) {}

  void number(double& value, double, double, const char*) { put(&value, sizeof value); }
  void count(std::uint64_t& value, std::uint64_t, std::uint64_t, const char*) { put(&value, sizeof value); }
  void flag(bool& value, const char*) { choice(value, 0, 1, nullptr); }
  template <class T>
  void choice(T& value, int, int, const char*) {
    const auto plain = static_cast<std::int8_t>(value);
    put(&plain, sizeof plain);
  }
  // Of what follows, each of it at least `bytes_each` long.
  template <class Vector>
  void size(Vector& values, std::size_t, std::size_t, const char*) {
    std::uint64_t size = values.size();
    put(&size, sizeof size);
  }
  void bytes(void* data, std::size_t size) { put(data, size); }
  void require(bool, const std::string&) {}
  void at(const std::string&) {}

 private:
  void put(const void* data, std::size_t size) {
    const auto* from = static_cast<const std::uint8_t*>(data);
    bytes_.insert(bytes_.end(), from, from + size);
  }
  std::vector<std::uint8_t>& bytes_;
};

class StateReader {
 public:
  static constexpr bool kReads = true;
  StateReader(const std::uint8_t* data, std::size_t size) : start_(data), at_(data), left_(size) {}

  void number(double& value, double least, double most, const char* what) {
    value = take<double>(what);
    if (value >= least && value <= most) return;  // false for NaN
    char range[80];
    std::snprintf(range, sizeof range, " must lie between %g and %g", least, most);
    complain(what + std::string(range), sizeof value);
    value = 0.0;
  }
  void count(std::uint64_t& value, std::uint64_t least, std::uint64_t most, const char* what) {
    value = take<std::uint64_t>(what);
    if (value >= least && value <= most) return;
    complain(what + (" must lie between " + std::to_string(least)) + " and " + std::to_string(most), sizeof value);
    value = 0;
  }
  void flag(bool& value, const char* what) { choice(value, 0, 1, what); }
  template <class T>
  void choice(T& value, int least, int most, const char* what) {
    const int plain = take<std::int8_t>(what);
    if (plain >= least && plain <= most) {
      value = static_cast<T>(plain);
      return;
    }
    complain(what + (" must be one of " + std::to_string(least)) + " to " + std::to_string(most), 1);
    value = T{};
  }
  template <class Vector>
  void size(Vector& values, std::size_t most, std::size_t bytes_each, const char* what) {
    std::uint64_t size = 0;
    count(size, 0, most, what);
    if (size > left_ / bytes_each) {
      complain(what + std::string(" is more than the rest of the file holds"), sizeof size);
      size = 0;
    }
    values.resize(static_cast<std::size_t>(size));
  }
  void bytes(void* data, std::size_t size) {
    if (size > left_) {
      complain("the file ends too early", 0);
      std::memset(data, 0, size);
      return;
    }
    if (size > 0) std::memcpy(data, at_, size);
    at_ += size;
    left_ -= size;
  }
  void require(bool holds, const std::string& what) {
    if (!holds) complain(what, 0);
  }
  // Whose values come now.
  void at(const std::string& whose) { whose_ = whose; }

  bool good() const { return complaint_.empty(); }
  const std::string& complaint() const { return complaint_; }
  std::size_t left() const { return left_; }

 private:
  template <class T>
  T take(const char*) {
    T value{};
    bytes(&value, sizeof value);
    return value;
  }
  void complain(const std::string& what, std::size_t just_read) {
    if (!good()) return;
    const auto offset = static_cast<std::size_t>(at_ - start_);
    complaint_ = (whose_.empty() ? "" : whose_ + ": ") + what + " (at byte " +
                 std::to_string(offset - (just_read <= offset ? just_read : 0)) + ")";
    left_ = 0;  // nothing that follows can be trusted
  }

  const std::uint8_t *start_, *at_;
  std::size_t left_;
  std::string whose_, complaint_;
};

template <class Archive>
void vector(Archive& archive, math::Vec3& v, double limit, const char* what) {
  archive.number(v.x, -limit, limit, what);
  archive.number(v.y, -limit, limit, what);
  archive.number(v.z, -limit, limit, what);
}

// A quaternion need not be exactly one long: who sets poses need not normalise. What is far from it is damage.
template <class Archive>
void pose(Archive& archive, math::Pose& p, double limit, const char* what) {
  vector(archive, p.position, limit, what);
  for (double* part : {&p.orientation.x, &p.orientation.y, &p.orientation.z, &p.orientation.w})
    archive.number(*part, -1.1, 1.1, what);
  const double length = math::norm(p.orientation);
  archive.require(length >= 0.9 && length <= 1.1, what + std::string(" must have a unit quaternion"));
  if (Archive::kReads && std::abs(length - 1.0) > 1e-9 && length > 0.0) p.orientation = math::normalized(p.orientation);
}

}  // namespace ambf::model
