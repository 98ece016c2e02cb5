#include "assimp_files.h"

#include <assimp/MemoryIOWrapper.h>

#include <cstring>

#include "channel.h"
#include "file_names.h"

namespace ambf::file_reader {

const std::string* AssimpFiles::find(const char* name) const {
  std::string wanted(name);
  while (wanted.compare(0, 2, "./") == 0) wanted.erase(0, 2);
  if (wanted == main_name_) return &main_bytes_;
  auto known = others_.find(wanted);
  if (known == others_.end()) {
    std::optional<std::string> bytes = request_file(wanted);
    if (!bytes && decoded_uri(wanted) != wanted) bytes = request_file(decoded_uri(wanted));
    known = others_.emplace(wanted, std::move(bytes)).first;
  }
  return known->second ? &*known->second : nullptr;
}

bool AssimpFiles::Exists(const char* name) const { return find(name) != nullptr; }

Assimp::IOStream* AssimpFiles::Open(const char* name, const char* mode) {
  if (std::strpbrk(mode, "wa+") != nullptr) return nullptr;
  const std::string* bytes = find(name);
  if (bytes == nullptr) return nullptr;
  return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes->data()), bytes->size());
}

void AssimpFiles::Close(Assimp::IOStream* stream) { delete stream; }

}  // namespace ambf::file_reader
