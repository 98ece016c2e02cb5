// On what cameras and lights hang (ADF 1.6): any object but joints and what hangs on themselves.
#include <algorithm>
#include <unordered_map>

#include "model/detail/catalogue_impl.h"
#include "scene/lookup.h"

namespace ambf::model {

using state::ObjectKind;

namespace {

// What a name means to a camera or a light: its own file's objects come first.
struct FoundParents {
  std::vector<Entry*> entries;  // none, the one, or those that it may mean
  bool is_one = false;
};

template <class Allowed>
FoundParents look_up(const std::vector<std::unique_ptr<Entry>>& entries, const Entry& placed, const std::string& wanted,
                     Allowed allowed) {
  std::vector<std::string> own, world;
  std::vector<Entry*> own_objects, world_objects;
  for (const auto& other : entries) {
    if (other->info.kind == ObjectKind::joint || !allowed(other.get())) continue;
    world.push_back(other->info.identifier);
    world_objects.push_back(other.get());
    if (other->info.model != placed.info.model) continue;
    own.push_back(other->own_identifier);
    own_objects.push_back(other.get());
  }
  const scene::Lookup found = scene::find_joint_body(own, world, wanted, placed.name_space, placed.conflict_number);
  const std::vector<Entry*>& objects = found.in_world ? world_objects : own_objects;
  if (found.index) return {{objects[*found.index]}, true};
  FoundParents several;
  for (const std::size_t i : found.candidates) several.entries.push_back(objects[i]);
  return several;
}

}  // namespace

bool Catalogue::Impl::hangs_on(const Entry* entry, const Entry* ancestor) const {
  for (; entry != nullptr && entry->info.kind != ObjectKind::rigid_body; entry = entry->parent)
    if (entry == ancestor) return true;
  return entry == ancestor;
}

Entry* Catalogue::Impl::find_parent(const Entry& placed, const std::string& wanted) const {
  const FoundParents found =
      look_up(entries, placed, wanted, [&](const Entry* other) { return !hangs_on(other, &placed); });
  return found.is_one ? found.entries.front() : nullptr;
}

void Catalogue::Impl::tell_no_parent(const Entry& placed, const scene::Identity& at, AbsentParents absent,
                                     Findings& findings) const {
  const std::string name = "\"" + placed.wanted_parent + "\"";
  const FoundParents found = look_up(entries, placed, placed.wanted_parent, [](const Entry*) { return true; });
  if (found.entries.empty()) {
    if (absent == AbsentParents::told)
      findings.warning(at, "parent", "there is no object " + name + " yet", "it hangs in the world until one comes");
    return;
  }
  std::string list;
  for (const Entry* candidate : found.entries) list += (list.empty() ? "" : ", ") + candidate->info.identifier;
  const std::string why = !found.is_one ? name + " may mean several objects: " + list
                          : found.entries.front() == &placed
                              ? "it cannot hang on itself"
                              : name + " hangs on this one: they cannot hang on each other";
  findings.warning(at, "parent", why,
                   found.is_one ? "it hangs in the world" : "write the whole name; it hangs in the world");
}

// Who finds none is tried again at every load.
void Catalogue::Impl::find_missing_parents() {
  for (const auto& placed : entries) {
    if (placed->wanted_parent.empty() || placed->parent != nullptr) continue;
    placed->parent = find_parent(*placed, placed->wanted_parent);
    if (placed->parent != nullptr) placed->reparenting = Reparenting::parent_found;
  }
}

void Catalogue::Impl::tell_missing_parents(const scene::Model& described, state::ModelId model, AbsentParents absent,
                                           Findings& findings) const {
  std::unordered_map<std::string, const Entry*> lost;
  for (const auto& entry : entries) {
    if (entry->info.model == model && !entry->wanted_parent.empty() && entry->parent == nullptr)
      lost.emplace(entry->identifier, entry.get());
  }
  const auto tell = [&](const auto& blocks) {
    for (const auto& block : blocks) {
      const auto entry = lost.find(block.identity.identifier);
      if (entry == lost.end() || entry->second->wanted_parent != block.parent) continue;
      tell_no_parent(*entry->second, block.identity, absent, findings);
    }
  };
  tell(described.cameras);
  tell(described.lights);
}

}  // namespace ambf::model
