// Kept states by name, and their files. Loader thread, except names().
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <vector>

namespace ambf::runtime {

class Snapshots {
 public:
  // Keeps `bytes`; an empty name becomes "snapshot<n>". Returns the name.
  std::string keep(std::string name, std::vector<std::uint8_t> bytes);
  // Null when there is none of that name.
  const std::vector<std::uint8_t>* find(const std::string& name) const;
  std::vector<std::string> names() const;

 private:
  mutable std::mutex mutex_;
  std::map<std::string, std::vector<std::uint8_t>> states_;
  unsigned next_ = 1;
};

// Both return why they failed, or nothing. A file is written beside and renamed, so that it is never half there.
std::string write_state_file(const std::string& path, const std::vector<std::uint8_t>& bytes);
std::string read_state_file(const std::string& path, std::vector<std::uint8_t>& bytes);

}  // namespace ambf::runtime
