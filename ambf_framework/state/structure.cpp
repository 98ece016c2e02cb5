#include "state/structure.h"

namespace ambf::state {

std::uint32_t find(const Structure& structure, ObjectId id) {
  for (std::size_t i = 0; i < structure.objects.size(); ++i) {
    if (structure.objects[i].id == id) return static_cast<std::uint32_t>(i);
  }
  return kNone;
}

std::uint32_t find(const Structure& structure, const std::string& name, ObjectKind kind) {
  std::uint32_t match = kNone;
  bool ambiguous = false;
  for (std::size_t i = 0; i < structure.objects.size(); ++i) {
    const ObjectInfo& object = structure.objects[i];
    if (object.kind != kind) continue;
    if (object.name == name || object.identifier == name) return static_cast<std::uint32_t>(i);
    if (object.identifier.find(name) != std::string::npos || object.name.find(name) != std::string::npos) {
      ambiguous = match != kNone;
      match = static_cast<std::uint32_t>(i);
    }
  }
  return ambiguous ? kNone : match;
}

}  // namespace ambf::state
