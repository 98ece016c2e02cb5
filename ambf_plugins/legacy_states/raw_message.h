// A ROS message of any type as its bytes, for subscribing and publishing without knowing its fields. C++17.
#pragma once

#include <ros/message_traits.h>
#include <ros/serialization.h>

#include <cstdint>
#include <cstring>
#include <memory>
#include <vector>

namespace ambf::legacy_states {

struct RawMessage {
  std::vector<std::uint8_t> bytes;
};

}  // namespace ambf::legacy_states

namespace ros {
namespace message_traits {

// "*" agrees with everything: which type it is, publisher and subscriber say in their options.
template <>
struct IsMessage<ambf::legacy_states::RawMessage> : TrueType {};
template <>
struct MD5Sum<ambf::legacy_states::RawMessage> {
  static const char* value() { return "*"; }
  static const char* value(const ambf::legacy_states::RawMessage&) { return value(); }
};
template <>
struct DataType<ambf::legacy_states::RawMessage> {
  static const char* value() { return "*"; }
  static const char* value(const ambf::legacy_states::RawMessage&) { return value(); }
};
template <>
struct Definition<ambf::legacy_states::RawMessage> {
  static const char* value() { return ""; }
  static const char* value(const ambf::legacy_states::RawMessage&) { return value(); }
};

}  // namespace message_traits

namespace serialization {

template <>
struct Serializer<ambf::legacy_states::RawMessage> {
  template <class Stream>
  static void write(Stream& stream, const ambf::legacy_states::RawMessage& message) {
    const auto size = static_cast<std::uint32_t>(message.bytes.size());
    if (size > 0) std::memcpy(stream.advance(size), message.bytes.data(), size);
  }
  template <class Stream>
  static void read(Stream& stream, ambf::legacy_states::RawMessage& message) {
    const std::uint32_t size = stream.getLength();
    message.bytes.resize(size);
    if (size > 0) std::memcpy(message.bytes.data(), stream.advance(size), size);
  }
  // NOLINTNEXTLINE(readability-identifier-naming): ROS's name
  static std::uint32_t serializedLength(const ambf::legacy_states::RawMessage& message) {
    return static_cast<std::uint32_t>(message.bytes.size());
  }
};

}  // namespace serialization
}  // namespace ros
