// Kept states by name, and their files. Loader thread, except names().
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

namespace ambf::runtime {

class Snapshots {
 public:
  // Empty, or why no state may be kept under this name now (base/bounds.h: names, number, memory).
  std::string refusal(const std::string& name) const;
  // Keeps `bytes` where nothing was refused; an empty name becomes "snapshot<n>". Returns the name.
  std::string keep(std::string name, std::vector<std::uint8_t> bytes);
  // False: there is none of that name.
  bool forget(const std::string& name);
  // Null when there is none of that name.
  const std::vector<std::uint8_t>* find(const std::string& name) const;
  std::vector<std::string> names() const;

 private:
  mutable std::mutex mutex_;
  std::map<std::string, std::vector<std::uint8_t>> states_;
  std::size_t bytes_ = 0;  // of all
  unsigned next_ = 1;
};

// A name as it is repeated in messages: shortened, control characters shown as '?'.
std::string shown_name(const std::string& name);

// All return why they failed, or nothing. A file is written beside, under a name that nobody else has, and renamed, so
// that it is never half there; only ordinary files are replaced or read.
std::string check_state_path(const std::string& path);
std::string write_state_file(const std::string& path, const std::vector<std::uint8_t>& bytes);
// `fits` judges the first bytes (model::kStateHeadBytes, or fewer) before the rest is read: empty, or why not.
using HeadCheck = std::function<std::string(const std::vector<std::uint8_t>& head)>;
std::string read_state_file(const std::string& path, const HeadCheck& fits, std::vector<std::uint8_t>& bytes);

}  // namespace ambf::runtime
