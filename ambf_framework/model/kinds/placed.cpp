#include "model/kinds/placed.h"

#include <variant>

#include "state/kind_rows.h"

namespace ambf::model {

namespace {

constexpr double kMaxSavedDistance_m = 1e12;  // more is damage
constexpr std::size_t kMaxNameLength = 4096;

const state::PlacedInfo& info_of(const LiveWorld::Impl& live, state::ObjectKind kind, std::uint32_t slot) {
  return *state::rows_of(kind).placed(*live.structure, slot);
}

void transfer_name(StateArchive& archive, std::string& name) {
  archive.size(name, kMaxNameLength, 1, "the length of the parent's name");
  archive.bytes(name.data(), name.size());
  bool plain = true;
  for (const char c : name) plain = plain && static_cast<unsigned char>(c) >= 0x20 && c != 0x7f;
  archive.require(plain, "the parent's name must be without control characters");
}

}  // namespace

Entry* PlacedKind::add(Catalogue::Impl& all, std::unique_ptr<LivePlaced> live, const scene::Identity& identity,
                       const std::string& parent, math::Pose T_parent, const LoadedModel& model,
                       const LoadOptions& options, Findings& findings) const {
  Entry* entry = all.add_entry(number(), identity, model.info.id, all.full_namespace(identity, options), findings);
  if (entry == nullptr) return nullptr;
  entry->wanted_parent = entry->loaded_parent = parent;
  if (parent.empty()) T_parent = options.T_world_model * T_parent;
  live->T_parent = live->T_parent_initial = live->T_parent_loaded = T_parent;
  live->slots = all.commands.add(entry->info.id, number());
  entry->live = std::move(live);
  return entry;
}

void PlacedKind::set_placed(state::PlacedInfo& row, const Entry& entry, const StructureDraft& draft) {
  row.object = draft.object(&entry);
  row.parent_object = draft.object(entry.parent);
  row.parent_name = entry.wanted_parent;
}

bool PlacedKind::accepts(const state::Command& command) const {
  return std::holds_alternative<state::PoseCommand>(command);
}

bool PlacedKind::merge(LiveWorld::Impl& live, std::uint32_t slot, const CommandSlots& slots) const {
  LivePlaced& object = placed(live, slot);
  const math::Pose before = object.T_parent;
  std::uint64_t newest = 0;
  slots.each([&](int, const CommandSlot& source) {
    if (!source.in_force || source.order < newest) return;
    const auto& command = std::get<state::PoseCommand>(source.command());
    if (!command.enabled) return;
    newest = source.order;
    object.T_parent = command.T_parent_object;
  });
  return object.T_parent != before;
}

// The catalogue lets no object be its own ancestor, so this ends.
math::Pose PlacedKind::pose(const LiveWorld::Impl& live, std::uint32_t slot) const {
  const std::uint32_t parent = info_of(live, number(), slot).parent_object;
  const math::Pose& T_parent = placed(live, slot).T_parent;
  return parent == state::kNone ? T_parent : parent_frame(live, parent) * T_parent;
}

void PlacedKind::reset(LiveWorld::Impl& live, std::uint32_t slot) const {
  LivePlaced& object = placed(live, slot);
  if (!object.orphaned) object.T_parent = object.T_parent_initial;
}

void PlacedKind::save(const LiveWorld::Impl& live, std::uint32_t slot, SavedObject& saved) const {
  auto& to = static_cast<SavedPlaced&>(saved);
  const LivePlaced& object = placed(live, slot);
  to.parent_object = info_of(live, number(), slot).parent_object;
  to.parent_name = info_of(live, number(), slot).parent_name;
  to.T_parent_initial = object.T_parent_initial;
  to.T_parent = object.T_parent;
  to.orphaned = object.orphaned;
}

void PlacedKind::transfer(StateArchive& archive, SavedObject& saved, const SavedContext& context) const {
  auto& object = static_cast<SavedPlaced&>(saved);
  const auto& objects = context.structure.objects;
  // The number of objects stands for the world.
  std::uint64_t parent = object.parent_object == state::kNone ? objects.size() : object.parent_object;
  archive.count(parent, 0, objects.size(), "the parent");
  object.parent_object = parent == objects.size() ? state::kNone : static_cast<std::uint32_t>(parent);
  archive.require(object.parent_object == state::kNone || !state::info_of(objects[parent].kind).connects_bodies,
                  "the parent must not be a joint");
  transfer_name(archive, object.parent_name);
  transfer_pose(archive, object.T_parent_initial, kMaxSavedDistance_m, "its first place");
  transfer_pose(archive, object.T_parent, kMaxSavedDistance_m, "its place");
  archive.flag(object.orphaned, "whether it lost its parent");
}

void PlacedKind::transfer(StateArchive& archive, state::Command& command) const {
  if (archive.reads()) command.emplace<state::PoseCommand>();
  auto& pose = std::get<state::PoseCommand>(command);
  archive.flag(pose.enabled, "whether a pose is commanded");
  if (pose.enabled) transfer_pose(archive, pose.T_parent_object, 1e6, "a commanded pose");
}

void PlacedKind::restore(LiveWorld::Impl& live, std::uint32_t slot, const SavedObject& saved) const {
  const auto& from = static_cast<const SavedPlaced&>(saved);
  LivePlaced& object = placed(live, slot);
  object.T_parent_initial = from.T_parent_initial;
  object.T_parent = from.T_parent;
  object.orphaned = from.orphaned;
}

}  // namespace ambf::model
