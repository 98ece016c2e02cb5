#include "legacy_states/other_generations.h"

#include <ambf_msgs/ActuatorState.h>
#include <ambf_msgs/CameraState.h>
#include <ambf_msgs/LightState.h>
#include <ambf_msgs/ObjectState.h>
#include <ambf_msgs/RigidBodyState.h>
#include <ambf_msgs/SensorState.h>
#include <ambf_msgs/VehicleState.h>
#include <ambf_msgs/WorldState.h>

#include <cstring>

namespace ambf::legacy_states {

namespace {

constexpr std::size_t kSequenceAndStamp = 12;  // of a header, before its frame_id
constexpr std::size_t kLength = 4;             // of a string, before its characters
constexpr std::size_t kSimStep = 4, kGraphicsRate = 8;

template <class Message>
OtherType changed(const char* other_md5, Change change, std::size_t strings_before_identifier = 0) {
  return {ros::message_traits::DataType<Message>::value(),
          ros::message_traits::MD5Sum<Message>::value(),
          other_md5,
          ros::message_traits::Definition<Message>::value(),
          change,
          strings_before_identifier};
}

// Where the string at `at` ends; beyond `size` when it is cut short.
std::size_t end_of_string(const std::vector<std::uint8_t>& bytes, std::size_t at) {
  if (at + kLength > bytes.size()) return bytes.size() + 1;
  std::uint32_t length = 0;  // ROS is little-endian, as is every machine it runs on
  std::memcpy(&length, bytes.data() + at, sizeof length);
  return at + kLength + length;
}

const std::vector<OtherType>& types_of(Generation generation) {
  namespace m = ambf_msgs;
  constexpr Change kUnnamed = Change::no_identifier, kRenamed = Change::p_inertia;
  // Sensors and actuators have their type and parent before their identifier, cameras and lights their parent.
  static const std::vector<OtherType> second = {
      changed<m::ActuatorState>("99b56804e89ef8d6b166b7861c291694", kUnnamed, 2),
      changed<m::CameraState>("7716746e31e5fa6ac8060b7aeb14a0d6", kUnnamed, 1),
      changed<m::LightState>("7716746e31e5fa6ac8060b7aeb14a0d6", kUnnamed, 1),
      changed<m::ObjectState>("5c41957ade5befe08be9e8f0ca23c5c4", kUnnamed),
      changed<m::RigidBodyState>("938fed649678cd6a0eb81e5478b1f5e2", kUnnamed),
      changed<m::SensorState>("82fb33535a7311b9256cac9ac5115e67", kUnnamed, 2),
      changed<m::VehicleState>("6e44991cffd599ccc408523398b06f19", kUnnamed),
      changed<m::WorldState>("19e71cae5899074bfba211b483c66a1f", Change::no_graphics_rate),
  };
  static const std::vector<OtherType> fourth = {
      changed<m::ObjectState>("23e189870c53d83f2a6cf784d0f8e725", kRenamed),
      changed<m::RigidBodyState>("201be33698a79d982715e2a5a3814805", kRenamed),
      changed<m::VehicleState>("3205c6ecd574d6e39a494dd7cd659695", kRenamed),
  };
  return generation == Generation::second ? second : fourth;
}

// `text` without the line that begins with `start`.
std::string without_line(const std::string& text, const std::string& start) {
  const std::size_t from = text.find(start);
  if (from == std::string::npos) return text;
  const std::size_t to = text.find('\n', from);
  return text.substr(0, from) + (to == std::string::npos ? "" : text.substr(to + 1));
}

}  // namespace

bool parse(const std::string& word, Generation& generation) {
  if (word != "g2" && word != "g4") return false;
  generation = word == "g2" ? Generation::second : Generation::fourth;
  return true;
}

const OtherType* find_other_type(Generation generation, const std::string& type) {
  for (const OtherType& known : types_of(generation)) {
    if (type == known.name) return &known;
  }
  return nullptr;
}

std::string OtherType::other_definition() const {
  std::string text = own_definition;
  switch (change) {
    case Change::no_identifier: return without_line(text, "std_msgs/String identifier");
    case Change::no_graphics_rate: return without_line(text, "uint64 graphics_loop_freq");
    case Change::p_inertia: break;
  }
  const std::string own = "pInertia";
  const std::size_t at = text.find(own);
  return at == std::string::npos ? text : text.replace(at, own.size(), "p_inertia");
}

bool convert(const OtherType& type, const std::vector<std::uint8_t>& message, std::vector<std::uint8_t>& other) {
  std::size_t from = end_of_string(message, kSequenceAndStamp), to = from;  // of what is left out
  switch (type.change) {
    case Change::no_identifier:
      from += kSimStep;
      for (std::size_t i = 0; i < type.strings_before_identifier; ++i) from = end_of_string(message, from);
      to = end_of_string(message, from);
      break;
    case Change::no_graphics_rate: to = from + kGraphicsRate; break;
    case Change::p_inertia:  // names are no part of a message
      break;
  }
  if (to > message.size()) return false;
  other.resize(message.size() - (to - from));
  std::memcpy(other.data(), message.data(), from);
  std::memcpy(other.data() + from, message.data() + to, message.size() - to);
  return true;
}

}  // namespace ambf::legacy_states
