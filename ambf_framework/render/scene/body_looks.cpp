#include "render/scene/body_looks.h"

#include "state/soft_bodies.h"

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
  const auto add = [&](std::uint32_t object) {
    list.push_back(of(structure.objects[object].id));
    list.back().hidden = list.back().hidden || no_visuals;
  };
  for (const state::BodyInfo& body : structure.bodies) add(body.object);
  for (const state::SoftBodyInfo& body : state::soft_bodies(structure)) add(body.object);
  return list;
}

}  // namespace ambf::render
