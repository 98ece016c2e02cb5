// Checks the lengths of the lists in a serialized message against the bytes that arrived, before anything is allocated
// for it: roscpp resizes a list to the length that the message claims before it reads one entry, so that 184 bytes can
// cost 2 GB. Generic: it visits the fields that the generated Serializer of the message visits. Pure functions. Private
// to ros_comm. C++17.
#pragma once

#include <ros/serialization.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "base/bounds.h"

namespace ambf::ros_comm {

// Takes the place of roscpp's streams for Serializer::allInOne. After the first problem it reads nothing more.
class LengthCheck {
 public:
  LengthCheck(const std::uint8_t* bytes, std::size_t size) : at_(bytes), left_(size), size_(size) {}

  // Empty, or why the message must not be deserialized.
  const std::string& problem() const { return problem_; }

  // One field. `value` only says its type (it is not written).
  template <class T>
  void next(T& value) {
    if (!problem_.empty()) return;
    if constexpr (ros::message_traits::IsFixedSize<T>::value) {
      skip(ros::serialization::serializationLength(value));
    } else {
      ros::serialization::Serializer<T>::template allInOne<LengthCheck, T&>(*this, value);
    }
  }
  void next(std::string&) {
    if (!problem_.empty()) return;
    const std::uint32_t length = read_length();
    if (!problem_.empty()) return;
    if (length > left_) return refuse("text", length, length);
    allocate(length);
    skip(length);
  }
  template <class T>
  void next(std::vector<T>&) {
    if (!problem_.empty()) return;
    const std::uint64_t length = read_length();
    if (!problem_.empty()) return;
    T entry{};
    // Of an entry without texts or lists its size, of any other the smallest that it can have.
    const std::uint64_t min_size = ros::serialization::serializationLength(entry);
    if (length > left_ || length * min_size > left_) return refuse("list", length, length * min_size);
    allocate(length * sizeof(T));
    if constexpr (ros::message_traits::IsFixedSize<T>::value) {
      skip(length * min_size);
    } else {
      for (std::uint64_t i = 0; i < length && problem_.empty(); ++i) next(entry);
    }
  }

 private:
  std::uint32_t read_length() {
    std::uint32_t length = 0;
    const std::uint8_t* from = at_;
    skip(sizeof length);
    if (problem_.empty()) std::memcpy(&length, from, sizeof length);
    return length;
  }
  void skip(std::uint64_t count) {
    if (count > left_) {
      problem_ = "its " + std::to_string(size_) + " bytes end within a field";
      return;
    }
    at_ += count;
    left_ -= count;
  }
  // Many short texts take more memory than bytes in the message.
  void allocate(std::uint64_t bytes) {
    allocated_ += bytes;
    if (allocated_ <= size_ + base::kMaxMessageExpansion) return;
    problem_ = "its " + std::to_string(size_) + " bytes would take over " +
               std::to_string((size_ + base::kMaxMessageExpansion) >> 20) + " MB of memory";
  }
  void refuse(const char* what, std::uint64_t length, std::uint64_t bytes) {
    problem_ = std::string("a ") + what + " in it claims a length of " + std::to_string(length) + ", which takes " +
               std::to_string(bytes) + " bytes or more, and " + std::to_string(left_) + " came";
  }

  const std::uint8_t* at_;
  std::uint64_t left_;
  const std::uint64_t size_;
  std::uint64_t allocated_ = 0;
  std::string problem_;
};

// Empty, or why these bytes must not be deserialized as a `Message`.
template <class Message>
std::string problem_of_lengths(const std::uint8_t* bytes, std::size_t size) {
  LengthCheck check(bytes, size);
  Message fields;
  check.next(fields);
  return check.problem();
}

}  // namespace ambf::ros_comm
