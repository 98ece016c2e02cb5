// From the catalogue's entries to a new Structure and the swap that leads to it.
#include "model/detail/catalogue_impl.h"
#include "scene/lookup.h"
#include "state/columns.h"

namespace ambf::model {
namespace {

using state::ObjectKind;

// One object's place in the swap: in its own slot when new, else moved there from its old one.
template <class Live>
void place(std::vector<std::unique_ptr<Live>>& table, SlotMoves& moves, std::uint32_t old_slot,
           std::unique_ptr<Live>& live) {
  table.push_back(std::move(live));
  moves.from.push_back(old_slot);
}

}  // namespace

Prepared Catalogue::Impl::refuse(const std::string& message, const std::string& hint) const {
  Prepared prepared;
  base::Diagnostic found;
  found.message = message;
  found.hint = hint;
  prepared.diagnostics.push_back(std::move(found));
  prepared.structure = newest;
  return prepared;
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
  const auto object = [&](const Entry* entry) {
    return entry == nullptr ? state::kNone : object_of[entry->info.id.index];
  };
  for (const auto& entry : entries) {
    switch (entry->info.kind) {
      case ObjectKind::rigid_body: {
        state::BodyInfo body = entry->body;
        body.object = object(entry.get());
        for (const std::uint32_t index : lineage.descendants(entry->info.id.index))
          body.children_names.push_back(by_index[index]->info.name);
        for (const std::uint32_t index : lineage.joints(entry->info.id.index))
          if (!by_index[index]->joint.passive) body.joints.push_back(by_index[index]->info.slot);
        structure->bodies.push_back(std::move(body));
        break;
      }
      case ObjectKind::joint: {
        state::JointInfo joint = entry->joint;
        joint.object = object(entry.get());
        joint.parent_body = entry->parent->info.slot;
        joint.child_body = entry->child->info.slot;
        structure->joints.push_back(std::move(joint));
        break;
      }
      case ObjectKind::camera: {
        state::CameraInfo camera = entry->camera;
        camera.object = object(entry.get());
        camera.parent_object = object(entry->parent);
        structure->cameras.push_back(std::move(camera));
        break;
      }
      case ObjectKind::light: {
        state::LightInfo light = entry->light;
        light.object = object(entry.get());
        light.parent_object = object(entry->parent);
        structure->lights.push_back(std::move(light));
        break;
      }
      case ObjectKind::world: break;
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

  for (const auto& [kind, slot] : removed_slots) {
    SlotMoves& moves = kind == ObjectKind::rigid_body ? swap.bodies
                       : kind == ObjectKind::joint    ? swap.joints
                       : kind == ObjectKind::camera   ? static_cast<SlotMoves&>(swap.cameras)
                                                      : swap.lights;
    moves.removed.push_back(slot);
  }
  removed_slots.clear();

  swap.tables.by_index.resize(generations.size());
  for (const auto& entry : entries) {
    const std::uint32_t old_slot = entry->info.slot;
    const auto next_slot = [&](const auto& table) { return static_cast<std::uint32_t>(table.size()); };
    switch (entry->info.kind) {
      case ObjectKind::rigid_body:
        entry->info.slot = next_slot(swap.tables.bodies);
        place(swap.tables.bodies, swap.bodies, old_slot, entry->live_body);
        break;
      case ObjectKind::joint:
        entry->info.slot = next_slot(swap.tables.joints);
        place(swap.tables.joints, swap.joints, old_slot, entry->live_joint);
        break;
      default: {
        const bool camera = entry->info.kind == ObjectKind::camera;
        auto& table = camera ? swap.tables.cameras : swap.tables.lights;
        PlacedMoves& moves = camera ? swap.cameras : swap.lights;
        entry->info.slot = next_slot(table);
        place(table, moves, old_slot, entry->live_placed);
        moves.reparenting.push_back(entry->reparenting);
        moves.T_world.emplace_back();
        entry->reparenting = Reparenting::none;
        break;
      }
    }
    if (entry->info.kind != ObjectKind::joint)
      swap.tables.by_index[entry->info.id.index] = {entry->info.kind, entry->info.slot};
  }
  swap.tables.commanded.reserve(entries.size());
  swap.tables.noted.reserve(entries.size());

  swap.structure = build_structure();
  newest = prepared.structure = swap.structure;
  prepared.frames.reserve(kFramesPerPool);
  for (std::size_t i = 0; i < kFramesPerPool; ++i) {
    prepared.frames.push_back(state::make_frame(newest));
#ifndef NDEBUG
    state::fill_nan(*prepared.frames.back());
#endif
  }
  return prepared;
}

}  // namespace ambf::model
