#include "legacy_states/second_generation.h"

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
OldType identified(const char* old_md5, std::size_t skipped_strings) {
  return {ros::message_traits::DataType<Message>::value(),
          ros::message_traits::MD5Sum<Message>::value(),
          old_md5,
          ros::message_traits::Definition<Message>::value(),
          kSimStep,
          skipped_strings,
          0,
          true};
}

// Where the string at `at` ends; beyond `size` when it is cut short.
std::size_t end_of_string(const std::vector<std::uint8_t>& bytes, std::size_t at) {
  if (at + kLength > bytes.size()) return bytes.size() + 1;
  std::uint32_t length = 0;  // ROS is little-endian, as is every machine it runs on
  std::memcpy(&length, bytes.data() + at, sizeof length);
  return at + kLength + length;
}

}  // namespace

const std::vector<OldType>& old_types() {
  namespace m = ambf_msgs;
  // Sensors and actuators say their type and parent before their identifier, cameras and lights their parent.
  static const std::vector<OldType> types = {
      identified<m::ActuatorState>("99b56804e89ef8d6b166b7861c291694", 2),
      identified<m::CameraState>("7716746e31e5fa6ac8060b7aeb14a0d6", 1),
      identified<m::LightState>("7716746e31e5fa6ac8060b7aeb14a0d6", 1),
      identified<m::ObjectState>("5c41957ade5befe08be9e8f0ca23c5c4", 0),
      identified<m::RigidBodyState>("938fed649678cd6a0eb81e5478b1f5e2", 0),
      identified<m::SensorState>("82fb33535a7311b9256cac9ac5115e67", 2),
      identified<m::VehicleState>("6e44991cffd599ccc408523398b06f19", 0),
      {ros::message_traits::DataType<m::WorldState>::value(), ros::message_traits::MD5Sum<m::WorldState>::value(),
       "19e71cae5899074bfba211b483c66a1f", ros::message_traits::Definition<m::WorldState>::value(), 0, 0, kGraphicsRate,
       false},
  };
  return types;
}

const OldType* find_old_type(const std::string& type) {
  for (const OldType& known : old_types()) {
    if (type == known.name) return &known;
  }
  return nullptr;
}

std::string OldType::old_definition() const {
  const std::string text = definition,
                    line_start = cut_string ? "std_msgs/String identifier" : "uint64 graphics_loop_freq";
  const std::size_t from = text.find(line_start);
  if (from == std::string::npos) return text;
  const std::size_t to = text.find('\n', from);
  return text.substr(0, from) + (to == std::string::npos ? "" : text.substr(to + 1));
}

bool to_old(const OldType& type, const std::vector<std::uint8_t>& message, std::vector<std::uint8_t>& old) {
  std::size_t from = end_of_string(message, kSequenceAndStamp) + type.skipped_bytes;
  for (std::size_t i = 0; i < type.skipped_strings; ++i) from = end_of_string(message, from);
  const std::size_t to = type.cut_string ? end_of_string(message, from) : from + type.cut_bytes;
  if (to > message.size()) return false;
  old.resize(message.size() - (to - from));
  std::memcpy(old.data(), message.data(), from);
  std::memcpy(old.data() + from, message.data() + to, message.size() - to);
  return true;
}

}  // namespace ambf::legacy_states
