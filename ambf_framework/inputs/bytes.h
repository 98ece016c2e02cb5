// How records become bytes and bytes become records: numbers as in the memory of a little-endian machine, texts and
// lists with their count (32 bits) before them, an optional part with a byte that says whether it is there. A record
// lists its members once, in visit(); Writer and Reader both call it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "math/types.h"
#include "state/command.h"
#include "state/ids.h"
#include "state/set_point.h"
#include "state/view.h"

namespace ambf::inputs {

using Bytes = std::vector<std::uint8_t>;

template <class T>
constexpr bool kIsNumber = std::is_arithmetic_v<T> || std::is_enum_v<T>;

// The parts of a compound value, in either direction: records list theirs in members().
template <class Archive, class T>
void visit_parts(Archive& archive, T& value) {
  using Plain = std::remove_const_t<T>;
  if constexpr (std::is_same_v<Plain, math::Vec3>) {
    archive(value.x), archive(value.y), archive(value.z);
  } else if constexpr (std::is_same_v<Plain, math::Quat>) {
    archive(value.x), archive(value.y), archive(value.z), archive(value.w);
  } else if constexpr (std::is_same_v<Plain, math::Pose>) {
    archive(value.position), archive(value.orientation);
  } else if constexpr (std::is_same_v<Plain, math::Wrench>) {
    archive(value.force), archive(value.torque);
  } else if constexpr (std::is_same_v<Plain, math::Twist>) {
    archive(value.linear), archive(value.angular);
  } else if constexpr (std::is_same_v<Plain, state::ObjectId>) {
    archive(value.index), archive(value.generation);
  } else if constexpr (std::is_same_v<Plain, state::EffectorGains>) {
    archive(value.linear_stiffness), archive(value.linear_damping);
    archive(value.angular_stiffness), archive(value.angular_damping);
  } else if constexpr (std::is_same_v<Plain, state::SetPoint>) {
    archive(value.T_world_ref), archive(value.gains), archive(value.period_s), archive(value.epoch);
    archive(value.pulls), archive(value.engaged), archive(value.moves_jaw), archive(value.jaw);
    archive(value.sample), archive(value.sampled_ns);
  } else if constexpr (std::is_same_v<Plain, state::JointCommand>) {
    archive(value.type), archive(value.value);
  } else if constexpr (std::is_same_v<Plain, state::RigidBodyCommand>) {
    archive(value.type), archive(value.wrench_world), archive(value.T_world_body), archive(value.twist_world);
    archive(value.joints);
  } else if constexpr (std::is_same_v<Plain, state::PoseCommand>) {
    archive(value.enabled), archive(value.T_parent_object);
  } else {
    Plain::members(value, archive);
  }
}

// Whether a number from a file is one of an enumeration's.
template <class T>
constexpr bool is_valid(T value) {
  if constexpr (std::is_same_v<T, state::Source>) {
    return static_cast<int>(value) < base::kMaxSources;
  } else if constexpr (std::is_same_v<T, state::CartesianCommandType>) {
    return value <= state::CartesianCommandType::velocity;
  } else if constexpr (std::is_same_v<T, state::JointCommandType>) {
    return value >= state::JointCommandType::none && value <= state::JointCommandType::velocity;
  } else if constexpr (std::is_same_v<T, state::LightType>) {
    return value <= state::LightType::directional;
  } else {
    return value < T::count;
  }
}

// Appends to a buffer. A real-time thread has one that does not grow: what exceeds its capacity is refused as a whole.
class Writer {
 public:
  Writer(Bytes& buffer, bool grows) : buffer_(buffer), grows_(grows) {}

  bool good() const { return good_; }

  template <class T>
  void operator()(const T& value) {
    if constexpr (kIsNumber<T>) {
      append(&value, sizeof value);
    } else {
      visit_parts(*this, value);
    }
  }
  void operator()(const std::string& text) { counted(text.data(), text.size()); }
  void operator()(const Bytes& bytes) { counted(bytes.data(), bytes.size()); }
  template <class T>
  void operator()(const std::vector<T>& list) {
    (*this)(static_cast<std::uint32_t>(list.size()));
    for (const T& each : list) (*this)(each);
  }
  // Commands of registered kinds have types that nobody here knows: such a record is refused.
  void operator()(const state::Command& command) {
    (*this)(static_cast<std::uint8_t>(command.index()));
    if (const auto* body = std::get_if<state::RigidBodyCommand>(&command)) {
      (*this)(*body);
    } else if (const auto* pose = std::get_if<state::PoseCommand>(&command)) {
      (*this)(*pose);
    } else {
      good_ = false;
    }
  }
  template <class T>
  void operator()(const std::optional<T>& part) {
    (*this)(static_cast<std::uint8_t>(part.has_value()));
    if (part) (*this)(*part);
  }

 private:
  void counted(const void* data, std::size_t size) {
    (*this)(static_cast<std::uint32_t>(size));
    append(data, size);
  }
  void append(const void* data, std::size_t size) {
    good_ = good_ && (grows_ || buffer_.size() + size <= buffer_.capacity());
    if (!good_ || size == 0) return;
    const std::size_t at = buffer_.size();
    buffer_.resize(at + size);
    std::memcpy(buffer_.data() + at, data, size);
  }

  Bytes& buffer_;
  const bool grows_;
  bool good_ = true;
};

// Reads what anybody may have written: never beyond the end, and no list that is longer than what is left.
class Reader {
 public:
  Reader(const std::uint8_t* data, std::size_t size) : at_(data), left_(size) {}

  bool good() const { return good_; }
  bool at_end() const { return left_ == 0; }

  template <class T>
  void operator()(T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      std::uint8_t byte = 0;
      take(&byte, 1);
      good_ = good_ && byte <= 1;
      value = byte == 1;
    } else if constexpr (std::is_enum_v<T>) {
      std::underlying_type_t<T> number{};
      take(&number, sizeof number);
      good_ = good_ && is_valid(static_cast<T>(number));
      if (good_) value = static_cast<T>(number);
    } else if constexpr (std::is_arithmetic_v<T>) {
      take(&value, sizeof value);
    } else {
      visit_parts(*this, value);
    }
  }
  void operator()(std::string& text) {
    text.resize(count(1));
    take(text.data(), text.size());
  }
  void operator()(Bytes& bytes) {
    bytes.resize(count(1));
    take(bytes.data(), bytes.size());
  }
  template <class T>
  void operator()(std::vector<T>& list) {
    list.clear();
    for (std::size_t left = count(1); good_ && left > 0; --left) (*this)(list.emplace_back());
  }
  void operator()(state::Command& command) {
    std::uint8_t index = 0;
    (*this)(index);
    good_ = good_ && index <= 1;
    if (index == 0) {
      (*this)(command.emplace<state::RigidBodyCommand>());
    } else {
      (*this)(command.emplace<state::PoseCommand>());
    }
  }
  template <class T>
  void operator()(std::optional<T>& part) {
    bool there = false;
    (*this)(there);
    part.reset();
    if (there && good_) (*this)(part.emplace());
  }

 private:
  std::size_t count(std::size_t min_size) {
    std::uint32_t number = 0;
    (*this)(number);
    good_ = good_ && number <= left_ / min_size;
    return good_ ? number : 0;
  }
  void take(void* to, std::size_t size) {
    good_ = good_ && size <= left_;
    if (!good_ || size == 0) return;
    std::memcpy(to, at_, size);
    at_ += size;
    left_ -= size;
  }

  const std::uint8_t* at_;
  std::size_t left_;
  bool good_ = true;
};

}  // namespace ambf::inputs
