// State messages as AMBF 1.0 knew them (the second generation of the interface): the bytes of ours without the fields
// that came later. Pure functions, any thread, C++17.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace ambf::legacy_states {

struct OldType {
  const char* name;     // "ambf_msgs/RigidBodyState": the same in both generations
  const char* new_md5;  // of what the simulator publishes
  const char* old_md5;  // of what old programs ask for
  const char* definition;
  // What is cut out: `cut_string`, else as many bytes, after the header, `skipped_bytes` more, and `skipped_strings`
  // strings.
  std::size_t skipped_bytes, skipped_strings, cut_bytes;
  bool cut_string;
  std::string old_definition() const;  // `definition` without the line of what is cut
};

// Null when `type` is none of the simulator's states.
const OldType* find_old_type(const std::string& type);
const std::vector<OldType>& old_types();

// False when `message` is too short to be what it should be.
bool to_old(const OldType& type, const std::vector<std::uint8_t>& message, std::vector<std::uint8_t>& old);

}  // namespace ambf::legacy_states
