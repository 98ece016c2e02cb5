#include "runtime/detail/snapshots.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace ambf::runtime {

namespace {
constexpr std::uintmax_t kMaxFileBytes = std::uintmax_t{1} << 30;
}

std::string Snapshots::keep(std::string name, std::vector<std::uint8_t> bytes) {
  const std::lock_guard lock(mutex_);
  if (name.empty()) {
    do name = "snapshot" + std::to_string(next_++);
    while (states_.count(name) != 0);
  }
  states_[name] = std::move(bytes);
  return name;
}

const std::vector<std::uint8_t>* Snapshots::find(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const auto found = states_.find(name);
  return found == states_.end() ? nullptr : &found->second;
}

std::vector<std::string> Snapshots::names() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> names;
  for (const auto& [name, bytes] : states_) names.push_back(name);
  return names;
}

std::string write_state_file(const std::string& path, const std::vector<std::uint8_t>& bytes) {
  const std::string part = path + ".part";
  {
    std::ofstream file(part, std::ios::binary | std::ios::trunc);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    file.flush();
    if (!file) {
      const std::string why = std::strerror(errno);
      std::remove(part.c_str());
      return "cannot write '" + part + "': " + why;
    }
  }
  std::error_code error;
  std::filesystem::rename(part, path, error);
  return error ? "cannot write '" + path + "': " + error.message() : std::string();
}

std::string read_state_file(const std::string& path, std::vector<std::uint8_t>& bytes) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) return "cannot read '" + path + "': " + error.message();
  if (size > kMaxFileBytes) return "'" + path + "' is larger than 1 GiB: not a state file";
  bytes.resize(size);
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  return file ? std::string() : "cannot read '" + path + "'";
}

}  // namespace ambf::runtime
