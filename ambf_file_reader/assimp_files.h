// The files that assimp sees: the one being read, from memory, and those that it refers to, by request to the process
// that asked (which opens regular files beside the mesh only). Nothing is opened here. One thread.
#pragma once

#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <map>
#include <optional>
#include <string>

namespace ambf::file_reader {

class AssimpFiles : public Assimp::IOSystem {
 public:
  AssimpFiles(std::string main_name, const std::string& main_bytes)
      : main_name_(std::move(main_name)), main_bytes_(main_bytes) {}

  bool Exists(const char* name) const override;
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* name, const char* mode) override;
  void Close(Assimp::IOStream* stream) override;

 private:
  const std::string* find(const char* name) const;

  std::string main_name_;
  const std::string& main_bytes_;
  mutable std::map<std::string, std::optional<std::string>> others_;
};

}  // namespace ambf::file_reader
