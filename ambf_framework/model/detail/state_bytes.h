// Plain values to bytes and back. Both archives offer the same calls, so that one function says for each struct what is
// written, what is read and what must hold of it: the writer writes, the reader reads and checks. After its first
// complaint the reader gives zeros and keeps that complaint. For use inside model/ only.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "math/rotation.h"
#include "math/types.h"

namespace ambf::model {

// What one function a struct writes through or reads through.
class StateArchive {
 public:
  virtual ~StateArchive() = default;
  virtual bool reads() const = 0;

  // A reader complains about values that are not within [min, max]; `what` names the value.
  virtual void number(double& value, double min, double max, const char* what) = 0;
  virtual void count(std::uint64_t& value, std::uint64_t min, std::uint64_t max, const char* what) = 0;
  virtual void bytes(void* data, std::size_t size) = 0;
  virtual void require(bool holds, const std::string& what) = 0;
  // Whose values come now.
  virtual void at(const std::string& whose) = 0;

  void flag(bool& value, const char* what) { choice(value, 0, 1, what); }
  // An enumerator, as one byte.
  template <class T>
  void choice(T& value, int min, int max, const char* what) {
    value = static_cast<T>(small(static_cast<std::int8_t>(value), min, max, what));
  }
  // Of what follows, each of it at least `bytes_each` long.
  template <class Vector>
  void size(Vector& values, std::size_t max, std::size_t bytes_each, const char* what) {
    values.resize(length(values.size(), max, bytes_each, what));
  }

 protected:
  virtual std::int8_t small(std::int8_t value, int min, int max, const char* what) = 0;
  virtual std::size_t length(std::size_t length, std::size_t max, std::size_t bytes_each, const char* what) = 0;
};

class StateWriter final : public StateArchive {
 public:
  explicit StateWriter(std::vector<std::uint8_t>& bytes) : bytes_(bytes) {}
  bool reads() const override { return false; }

  void number(double& value, double, double, const char*) override { bytes(&value, sizeof value); }
  void count(std::uint64_t& value, std::uint64_t, std::uint64_t, const char*) override { bytes(&value, sizeof value); }
  void bytes(void* data, std::size_t size) override {
    if (size == 0) return;
    const std::size_t end = bytes_.size();
    bytes_.resize(end + size);  // not insert(): gcc 12 takes that for an overflow where it inlines it
    std::memcpy(bytes_.data() + end, data, size);
  }
  void require(bool, const std::string&) override {}
  void at(const std::string&) override {}

 private:
  std::int8_t small(std::int8_t value, int, int, const char*) override {
    bytes(&value, sizeof value);
    return value;
  }
  std::size_t length(std::size_t length, std::size_t, std::size_t, const char*) override {
    std::uint64_t written = length;
    bytes(&written, sizeof written);
    return length;
  }
  std::vector<std::uint8_t>& bytes_;
};

class StateReader final : public StateArchive {
 public:
  StateReader(const std::uint8_t* data, std::size_t size) : start_(data), at_(data), left_(size) {}
  bool reads() const override { return true; }

  void number(double& value, double min, double max, const char* what) override {
    bytes(&value, sizeof value);
    if (value >= min && value <= max) return;  // false for NaN
    char range[80];
    std::snprintf(range, sizeof range, " must lie between %g and %g", min, max);
    complain(what + std::string(range), sizeof value);
    value = 0.0;
  }
  void count(std::uint64_t& value, std::uint64_t min, std::uint64_t max, const char* what) override {
    bytes(&value, sizeof value);
    if (value >= min && value <= max) return;
    complain(what + (" must lie between " + std::to_string(min)) + " and " + std::to_string(max), sizeof value);
    value = 0;
  }
  void bytes(void* data, std::size_t size) override {
    if (size > left_) {
      complain("the file ends too early", 0);
      std::memset(data, 0, size);
      return;
    }
    if (size > 0) std::memcpy(data, at_, size);
    at_ += size;
    left_ -= size;
  }
  void require(bool holds, const std::string& what) override {
    if (!holds) complain(what, 0);
  }
  void at(const std::string& whose) override { whose_ = whose; }

  bool good() const { return complaint_.empty(); }
  const std::string& complaint() const { return complaint_; }
  std::size_t left() const { return left_; }

 private:
  std::int8_t small(std::int8_t, int min, int max, const char* what) override {
    std::int8_t plain = 0;
    bytes(&plain, sizeof plain);
    if (plain >= min && plain <= max) return plain;
    complain(what + (" must be one of " + std::to_string(min)) + " to " + std::to_string(max), 1);
    return 0;
  }
  std::size_t length(std::size_t, std::size_t max, std::size_t bytes_each, const char* what) override {
    std::uint64_t size = 0;
    count(size, 0, max, what);
    if (size > left_ / bytes_each) {
      complain(what + std::string(" is more than the rest of the file holds"), sizeof size);
      size = 0;
    }
    return static_cast<std::size_t>(size);
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

inline constexpr double kMaxSaved = 1e12;  // beyond what any world of ours does: damage

inline void transfer_vector(StateArchive& archive, math::Vec3& v, double limit, const char* what) {
  archive.number(v.x, -limit, limit, what);
  archive.number(v.y, -limit, limit, what);
  archive.number(v.z, -limit, limit, what);
}

// A quaternion need not be exactly one long: commands need not normalise. What is far from it is damage.
inline void transfer_pose(StateArchive& archive, math::Pose& p, double limit, const char* what) {
  transfer_vector(archive, p.position, limit, what);
  for (double* part : {&p.orientation.x, &p.orientation.y, &p.orientation.z, &p.orientation.w})
    archive.number(*part, -1.1, 1.1, what);
  const double length = math::norm(p.orientation);
  archive.require(length >= 0.9 && length <= 1.1, what + std::string(" must have a unit quaternion"));
  if (archive.reads() && std::abs(length - 1.0) > 1e-9 && length > 0.0) p.orientation = math::normalized(p.orientation);
}

}  // namespace ambf::model
