// What objects of kinds with a parent hang on (ADF 1.6): any object but joints and their own descendants.
#include <algorithm>
#include <unordered_map>

#include "model/detail/catalogue_impl.h"
#include "model/kinds/kind.h"
#include "model/kinds/registry.h"
#include "scene/lookup.h"

namespace ambf::model {

namespace {

// What a name means to an object: those of its own file come first.
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
    if (state::info_of(other->info.kind).connects_bodies || !allowed(other.get())) continue;
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
  for (; entry != nullptr && state::info_of(entry->info.kind).has_parent; entry = entry->parent)
    if (entry == ancestor) return true;
  return entry == ancestor;
}

Entry* Catalogue::Impl::find_parent(const Entry& placed, const std::string& wanted) const {
  const FoundParents found =
      look_up(entries, placed, wanted, [&](const Entry* other) { return !hangs_on(other, &placed); });
  return found.is_one ? found.entries.front() : nullptr;
}

void Catalogue::Impl::report_parent(const Entry& placed, const scene::Identity& at, Findings& findings) const {
  const std::string name = "\"" + placed.wanted_parent + "\"";
  const FoundParents found = look_up(entries, placed, placed.wanted_parent, [](const Entry*) { return true; });
  if (found.entries.empty()) {
    findings.information(at, "parent", "there is no object " + name + " yet", "it hangs in the world until one comes");
    return;
  }
  if (placed.parent != nullptr && found.is_one) return;
  std::string list;
  for (const Entry* candidate : found.entries) list += (list.empty() ? "" : ", ") + candidate->info.identifier;
  const std::string why = !found.is_one ? name + " may mean several objects: " + list
                          : found.entries.front() == &placed
                              ? "it cannot hang on itself"
                              : name + " hangs on this one: they cannot hang on each other";
  const std::string parent = placed.parent == nullptr ? "in the world" : "on " + placed.parent->info.identifier;
  findings.warning(at, "parent", why, (found.is_one ? "it hangs " : "write the whole name; it hangs ") + parent);
}

// Tried again at every load. Of several that a file's text may mean, the first counts, as in the original.
void Catalogue::Impl::find_missing_parents() {
  for (const auto& placed : entries) {
    if (placed->wanted_parent.empty() || placed->parent != nullptr) continue;
    const auto allowed = [&](const Entry* other) { return !hangs_on(other, placed.get()); };
    const FoundParents found = look_up(entries, *placed, placed->wanted_parent, allowed);
    if (found.entries.empty()) continue;
    placed->parent = found.entries.front();
    placed->reparenting = Reparenting::parent_found;
  }
}

void Catalogue::Impl::report_parents(const scene::Model& described, state::ModelId model, Findings& findings) const {
  std::unordered_map<std::string, const Entry*> placed;
  for (const auto& entry : entries) {
    if (entry->info.model == model && !entry->wanted_parent.empty()) placed.emplace(entry->identifier, entry.get());
  }
  for (const auto& kind : kinds()) {
    kind->each_parent(described, [&](const scene::Identity& block, const std::string& parent) {
      const auto entry = placed.find(block.identifier);
      if (entry == placed.end() || entry->second->wanted_parent != parent) return;
      report_parent(*entry->second, block, findings);
    });
  }
}

}  // namespace ambf::model
