#include "render/scene/body_looks.h"

namespace ambf::render {

namespace {
std::uint64_t key_of(state::ObjectId id) { return (std::uint64_t{id.generation} << 32) | id.index; }
}  // namespace

BodyLook BodyLooks::of(state::ObjectId body) const {
  const auto found = looks_.find(key_of(body));
  return found == looks_.end() ? BodyLook{} : found->second;
}

void BodyLooks::set(state::ObjectId body, const BodyLook& look) {
  if (look == BodyLook{}) {
    looks_.erase(key_of(body));
  } else {
    looks_[key_of(body)] = look;
  }
}

std::vector<BodyLook> BodyLooks::by_slot(const state::Structure& structure, bool no_visuals) const {
  std::vector<BodyLook> list;
  if (!any() && !no_visuals) return list;
  list.reserve(structure.bodies.size());
  for (const state::BodyInfo& body : structure.bodies) {
    list.push_back(of(structure.objects[body.object].id));
    list.back().hidden = list.back().hidden || no_visuals;
  }
  return list;
}

}  // namespace ambf::render
