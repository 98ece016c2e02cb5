// State messages as AMBF 1.0 and 3.0 know them (the second and the fourth generation of the interface; ours is the
// third): ours without the fields that came later, or with one field renamed. Pure functions, any thread, C++17.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace ambf::legacy_states {

enum class Generation { second, fourth };  // AMBF 1.0; AMBF 3.0

// "g2" and "g4"; false when it is neither.
bool parse(const std::string& word, Generation& generation);

// What a message of ours loses or has under another name in the other generation.
enum class Change { no_identifier, no_graphics_rate, p_inertia };

struct OtherType {
  const char* name;       // "ambf_msgs/RigidBodyState": the same in all generations
  const char* own_md5;    // of what the simulator publishes
  const char* other_md5;  // of what programs of that generation ask for
  const char* own_definition;
  Change change;
  std::size_t strings_before_identifier;  // after sim_step
  std::string other_definition() const;   // text of the message as that generation has it
};

// Null when `type` is no state that differs in that generation.
const OtherType* find_other_type(Generation generation, const std::string& type);

// False when `message` is too short to be what it should be.
bool convert(const OtherType& type, const std::vector<std::uint8_t>& message, std::vector<std::uint8_t>& other);

}  // namespace ambf::legacy_states
