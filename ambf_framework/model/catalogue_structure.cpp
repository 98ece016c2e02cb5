// From the catalogue's entries to a new Structure and the swap that leads to it.
#include "model/detail/catalogue_impl.h"
#include "model/kinds/kind.h"
#include "model/kinds/registry.h"
#include "scene/lookup.h"
#include "state/columns.h"
#include "state/kind_rows.h"

namespace ambf::model {

Prepared Catalogue::Impl::refuse(const std::string& message, const std::string& hint) const {
  Prepared prepared;
  base::Diagnostic found;
  found.message = message;
  found.hint = hint;
  prepared.diagnostics.push_back(std::move(found));
  prepared.structure = newest;
  return prepared;
}

// By ObjectId::index of the body. Each list is part of a parent's where that has it in one piece, so that the lists of
// a chain take no more room than that of its first body.
std::vector<Relatives> Catalogue::Impl::list_relatives(const std::vector<Entry*>& by_index,
                                                       const std::vector<std::uint32_t>& object_of) const {
  std::vector<std::uint32_t> slot_of(by_index.size(), state::kNone);  // of joints that take commands
  for (std::size_t index = 0; index < by_index.size(); ++index) {
    const Entry* entry = by_index[index];
    if (entry == nullptr || !state::info_of(entry->info.kind).connects_bodies) continue;
    if (!entry->row_as<state::JointInfo>().passive) slot_of[index] = entry->info.slot;
  }
  std::vector<Relatives> relatives(by_index.size());
  const Descent descent(lineage);
  for (const Descent::Placed& placed : descent.from_the_roots()) {
    Descent::Below below = descent.below(placed.body);
    for (std::uint32_t& body : below.bodies) body = object_of[body];
    for (std::uint32_t& link : below.joints) link = slot_of[link];
    std::erase(below.joints, state::kNone);
    const Relatives& parent = relatives[placed.parent];
    relatives[placed.body] = {state::IndexList::within(parent.children, std::move(below.bodies)),
                              state::IndexList::within(parent.joints, std::move(below.joints))};
  }
  return relatives;
}

// Slots of entries must be those of the new structure already.
std::shared_ptr<state::Structure> Catalogue::Impl::build_structure() {
  auto structure = std::make_shared<state::Structure>();
  structure->version = newest->version + 1;
  structure->world_name = newest->world_name;
  structure->look = look;
  structure->gravity_world = gravity;
  for (const auto& model : models) structure->models.push_back(model->info);

  std::vector<Entry*> by_index(generations.size(), nullptr);
  std::vector<std::uint32_t> object_of(generations.size(), state::kNone);
  for (const auto& entry : entries) {
    by_index[entry->info.id.index] = entry.get();
    object_of[entry->info.id.index] = static_cast<std::uint32_t>(structure->objects.size());
    structure->objects.push_back(entry->info);
  }
  state::make_tables(*structure);
  const std::vector<Relatives> relatives = list_relatives(by_index, object_of);
  const StructureDraft draft{relatives, object_of};
  // Other kinds may look up joints by name, of files that came later than theirs, too.
  const auto is_first = [](const auto& entry) {
    const state::KindInfo& kind = state::info_of(entry->info.kind);
    return kind.has_mass || kind.connects_bodies;
  };
  for (const bool first : {true, false}) {
    for (const auto& entry : entries) {
      if (is_first(entry) == first) kind_of(entry->info.kind).add_row(*entry, draft, *structure);
    }
  }
  return structure;
}

Prepared Catalogue::Impl::finish(std::string model, base::Diagnostics diagnostics) {
  Prepared prepared;
  prepared.success = true;
  prepared.model = std::move(model);
  prepared.diagnostics = std::move(diagnostics);
  prepared.swap = std::make_unique<Swap>();
  Swap& swap = *prepared.swap;
  swap.base_version = newest->version;

  for (const auto& [kind, slot] : removed_slots) swap.of(kind).removed.push_back(slot);
  removed_slots.clear();

  // Each object in its slot when new, else moved there from its old one.
  swap.tables.by_index.resize(generations.size());
  for (const auto& entry : entries) {
    const state::ObjectKind kind = entry->info.kind;
    LiveTable& table = swap.tables.of(kind);
    KindMoves& moves = swap.of(kind);
    moves.from.push_back(entry->info.slot);
    moves.reparenting.push_back(entry->reparenting);
    moves.T_world.emplace_back();
    entry->reparenting = Reparenting::none;
    entry->info.slot = static_cast<std::uint32_t>(table.size());
    table.push_back(std::move(entry->live));
    if (state::info_of(kind).has_topics) swap.tables.by_index[entry->info.id.index] = {kind, entry->info.slot};
  }
  swap.tables.commanded.reserve(entries.size());
  swap.tables.noted.reserve(entries.size());

  swap.structure = build_structure();
  newest = prepared.structure = swap.structure;
  prepared.frames.reserve(options.frames);
  for (std::size_t i = 0; i < options.frames; ++i) {
    prepared.frames.push_back(state::make_frame(newest));
#ifndef NDEBUG
    state::fill_nan(*prepared.frames.back());
#endif
  }
  return prepared;
}

}  // namespace ambf::model
