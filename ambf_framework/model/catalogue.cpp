#include "model/catalogue.h"

#include <algorithm>
#include <unordered_set>

#include "model/detail/catalogue_impl.h"
#include "model/detail/view_builder.h"
#include "model/kinds/kind.h"
#include "model/kinds/registry.h"
#include "model/saved_state.h"
#include "scene/lookup.h"
#include "state/kinds.h"

namespace ambf::model {
namespace {

// "a camera or a light"
std::string kinds_with_parent() {
  std::vector<std::string> labels;
  for (const auto& kind : kinds())
    if (kind->info().has_parent) labels.push_back("a " + kind->info().label);
  std::string list;
  for (std::size_t i = 0; i < labels.size(); ++i)
    list += (i == 0 ? "" : i + 1 == labels.size() ? " or " : ", ") + labels[i];
  return list;
}

}  // namespace

Catalogue::Impl::Impl(CatalogueOptions given, CommandTable& table, mesh::MeshCache& mesh_cache)
    : options(std::move(given)), commands(table), meshes(mesh_cache), bodies(mesh_cache) {
  state::close_registration();
  auto structure = std::make_shared<state::Structure>();
  structure->world_name = scene::join_namespace({}, options.namespace_prefix + options.world_namespace) + "World";
  // The world's own topics are taken from the start.
  names.reserve(state::ObjectKind{}, structure->world_name, structure->world_name);
  newest = std::move(structure);
}

Catalogue::Catalogue(CatalogueOptions options, CommandTable& commands, mesh::MeshCache& meshes)
    : impl_(std::make_unique<Impl>(std::move(options), commands, meshes)) {}

Catalogue::~Catalogue() = default;

std::shared_ptr<const state::Structure> Catalogue::structure() const { return impl_->newest; }

const scene::Model* Catalogue::description(state::ModelId id) const {
  for (const auto& model : impl_->models)
    if (model->info.id == id) return &model->description;
  return nullptr;
}

std::vector<Catalogue::Made> Catalogue::made_from(state::ModelId id) const {
  std::vector<Made> made;
  for (std::size_t i = 0; i < impl_->entries.size(); ++i) {
    const Entry& entry = *impl_->entries[i];
    if (entry.info.model == id) made.push_back({static_cast<std::uint32_t>(i), entry.identifier});
  }
  return made;
}

Prepared Catalogue::prepare_world(const scene::World& world) {
  Impl& all = *impl_;
  auto model = std::make_unique<LoadedModel>();
  model->info = {state::kWorldModel, "World", world.file};
  model->description.file = world.file;
  model->description.name = "World";
  for (const auto& kind : kinds()) kind->describe_world(world, *model);
  all.gravity = world.gravity;
  all.look = std::make_shared<const state::WorldLook>(world_look(world));
  Findings findings(world.file);
  for (const auto& kind : kinds()) kind->load(all, *model, {}, findings);
  all.models.push_back(std::move(model));
  all.find_missing_parents();
  all.report_parents(all.models.back()->description, state::kWorldModel, findings);
  return all.finish("World", findings.take());
}

Prepared Catalogue::prepare_load(const scene::Model& description, const LoadOptions& options) {
  Findings findings(description.file);
  const std::string name = impl_->load(description, options, findings).name;
  return impl_->finish(name, findings.take());
}

Prepared Catalogue::prepare_unload(const std::string& name) {
  Impl& all = *impl_;
  const auto model = std::find_if(all.models.begin(), all.models.end(), [&](const auto& loaded) {
    return loaded->info.name == name && loaded->info.id != state::kWorldModel;
  });
  if (model == all.models.end()) {
    std::string loaded;
    for (const auto& other : all.models)
      if (other->info.id != state::kWorldModel) loaded += (loaded.empty() ? "loaded: " : ", ") + other->info.name;
    return all.refuse("there is no model \"" + name + "\"", loaded.empty() ? "none is loaded" : loaded);
  }
  std::vector<Entry*> leaving;
  for (const auto& entry : all.entries)
    if (entry->info.model == (*model)->info.id) leaving.push_back(entry.get());
  all.remove(leaving);
  all.models.erase(model);
  all.bodies.trim();
  return all.finish(name, {});
}

Prepared Catalogue::prepare_remove(const std::string& object) {
  Impl& all = *impl_;
  // Exact names first, whatever the kind; then the first kind in which the name means one object.
  Entry* leaving = nullptr;
  for (const auto& entry : all.entries)
    if (leaving == nullptr && (entry->info.name == object || entry->info.identifier == object)) leaving = entry.get();
  for (const auto& kind : kinds()) {
    if (leaving != nullptr || object.empty()) break;
    const std::uint32_t found = state::find(*all.newest, object, kind->number());
    if (found != state::kNone) leaving = all.entries[found].get();
  }
  if (leaving == nullptr)
    return all.refuse("\"" + object + "\" names no object, or several",
                      "give the full name, e.g. /ambf/env/psm/baselink");
  std::vector<Entry*> with_belongings{leaving};
  for (const state::ObjectId id : kind_of(leaving->info.kind).belongings(*leaving))
    for (const auto& entry : all.entries)
      if (entry->info.id == id) with_belongings.push_back(entry.get());
  all.remove(with_belongings);
  all.bodies.trim();
  return all.finish("", {});
}

Prepared Catalogue::prepare_set_parent(state::ObjectId object, const std::string& parent) {
  Impl& all = *impl_;
  const auto found =
      std::find_if(all.entries.begin(), all.entries.end(), [&](const auto& entry) { return entry->info.id == object; });
  if (found == all.entries.end() || !state::info_of((*found)->info.kind).has_parent)
    return all.refuse("only " + kinds_with_parent() + " that is there can be hung on something else");
  Entry& entry = **found;
  Entry* to = parent.empty() ? nullptr : all.find_parent(entry, parent);
  for (const auto& other : all.entries) {  // a full name, as topics have it, will do, too
    if (state::info_of(other->info.kind).connects_bodies || all.hangs_on(other.get(), &entry)) continue;
    if (to == nullptr && other->info.name == parent) to = other.get();
  }
  if (to == nullptr && !parent.empty()) {
    return all.refuse("\"" + entry.info.name + "\" stays where it hangs: \"" + parent +
                          "\" names nothing that it can hang on, or several things",
                      "give the full name of an object that does not hang on it");
  }
  Impl::hang(entry, to, parent, Reparenting::moved);
  return all.finish("", {});
}

Prepared Catalogue::prepare_parents(const std::vector<ParentChange>& changes) {
  Impl& all = *impl_;
  const auto find = [&](state::ObjectId id) -> Entry* {
    for (const auto& entry : all.entries)
      if (id.valid() && entry->info.id == id) return entry.get();
    return nullptr;
  };
  for (const ParentChange& change : changes) {
    if (Entry* placed = find(change.object))
      Impl::hang(*placed, find(change.parent), change.parent_name, Reparenting::moved);
  }
  return all.finish("", {});
}

Prepared Catalogue::prepare_parents_as_loaded() {
  Impl& all = *impl_;
  std::vector<Entry*> elsewhere;
  for (const auto& entry : all.entries)
    if (entry->wanted_parent != entry->loaded_parent) elsewhere.push_back(entry.get());
  if (elsewhere.empty()) return all.refuse("all hang as they were loaded");
  // First none on any other, so that what was turned round can be turned back.
  for (Entry* entry : elsewhere) entry->parent = nullptr;
  for (Entry* entry : elsewhere) {
    Entry* parent = entry->loaded_parent.empty() ? nullptr : all.find_parent(*entry, entry->loaded_parent);
    const bool there = parent != nullptr || entry->loaded_parent.empty();
    Impl::hang(*entry, parent, entry->loaded_parent, there ? Reparenting::as_loaded : Reparenting::orphaned);
  }
  return all.finish("", {});
}

void Catalogue::Impl::hang(Entry& placed, Entry* parent, const std::string& as_written, Reparenting change) {
  placed.wanted_parent = as_written;
  placed.parent = parent;
  placed.reparenting = change;
}

void Catalogue::Impl::remove(const std::vector<Entry*>& leaving) {
  std::unordered_set<const Entry*> gone(leaving.begin(), leaving.end());
  for (const auto& entry : entries)
    if (state::info_of(entry->info.kind).connects_bodies &&
        (gone.contains(entry->parent) || gone.contains(entry->child)))
      gone.insert(entry.get());

  // In load order, so that equal histories leave equal worlds.
  std::vector<std::uint32_t> joints, bodies_gone;
  for (const auto& entry : entries) {
    if (!gone.contains(entry.get())) continue;
    const state::ObjectInfo& info = entry->info;
    const state::KindInfo& kind = state::info_of(info.kind);
    if (kind.connects_bodies) joints.push_back(info.id.index);
    if (kind.has_mass) bodies_gone.push_back(info.id.index);
    if (kind.has_topics) commands.remove(info.id);
    names.release(info.kind, info.identifier, info.name);
    removed_slots.emplace_back(info.kind, info.slot);
    ++generations[info.id.index];
    free_indices.push_back(info.id.index);
    for (const auto& model : models)
      if (model->info.id == info.model) kind_of(info.kind).erase_block(model->description, entry->identifier);
  }
  lineage.remove(joints, bodies_gone);
  for (const auto& entry : entries) {
    if (!state::info_of(entry->info.kind).has_parent || gone.contains(entry.get()) || !gone.contains(entry->parent))
      continue;
    entry->parent = nullptr;  // it stays where it is, and waits for another parent of that name
    entry->reparenting = Reparenting::orphaned;
  }
  for (const auto& entry : entries)
    if (gone.contains(entry->followed)) entry->followed = nullptr;
  std::erase_if(entries, [&](const auto& entry) { return gone.contains(entry.get()); });
}

}  // namespace ambf::model
