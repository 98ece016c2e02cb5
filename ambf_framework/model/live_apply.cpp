// LiveWorld::apply: structural changes.
#include <cassert>

#include "model/detail/live_impl.h"
#include "model/detail/swap.h"
#include "model/live_world.h"

namespace ambf::model {
namespace {

using state::ObjectKind;

template <class Live>
void move_kept(std::vector<std::unique_ptr<Live>>& to, std::vector<std::unique_ptr<Live>>& from,
               const SlotMoves& moves) {
  for (std::size_t slot = 0; slot < to.size(); ++slot)
    if (moves.from[slot] != state::kNone) to[slot] = std::move(from[moves.from[slot]]);
}

void list_commanded(LiveTables& tables) {
  const auto list = [&](const auto& table, ObjectKind kind) {
    for (std::uint32_t slot = 0; slot < table.size(); ++slot) {
      if (table[slot]->active) tables.commanded.push_back({kind, slot});
      if (table[slot]->slots->noted) tables.noted.push_back({kind, slot});
    }
  };
  list(tables.bodies, ObjectKind::rigid_body);
  list(tables.cameras, ObjectKind::camera);
  list(tables.lights, ObjectKind::light);
}

}  // namespace

// A camera or light that lost its parent or was hung on another one stays where it is in the world; one that found its own goes to
// its place in it; one that hangs as its file says again is where that puts it.
template <class Info>
void LiveWorld::Impl::reparent(std::vector<std::unique_ptr<LivePlaced>>& placed, const std::vector<Info>& infos,
                               const PlacedMoves& moves) const {
  for (std::size_t slot = 0; slot < placed.size(); ++slot) {
    if (moves.from[slot] == state::kNone || moves.reparenting[slot] == Reparenting::none) continue;
    LivePlaced& live = *placed[slot];
    live.orphaned = moves.reparenting[slot] == Reparenting::orphaned;
    switch (moves.reparenting[slot]) {
      case Reparenting::orphaned: live.T_parent = moves.T_world[slot]; break;
      case Reparenting::moved: {
        const std::uint32_t parent = infos[slot].parent_object;
        const math::Pose T_world_parent = parent == state::kNone ? math::Pose{} : pose_of(parent);
        live.T_parent = live.T_parent_initial = math::inverse(T_world_parent) * moves.T_world[slot];
        break;
      }
      case Reparenting::as_loaded: live.T_parent = live.T_parent_initial = live.T_parent_loaded; break;
      default: live.T_parent = live.T_parent_initial;
    }
  }
}

Garbage LiveWorld::apply(Prepared&& prepared) {
  Garbage garbage;
  if (!prepared.success || prepared.swap == nullptr) return garbage;
  Impl& live = *impl_;
  Swap& swap = *prepared.swap;
  assert(swap.base_version == live.structure->version);

  // 1. With the old structure: world poses of what may lose its parent, ends of commands to what goes.
  const auto note_poses = [&](const auto& table, const auto& infos, PlacedMoves& moves) {
    for (std::size_t slot = 0; slot < moves.from.size(); ++slot) {
      const std::uint32_t from = moves.from[slot];
      if (from != state::kNone) moves.T_world[slot] = live.pose_of(*table[from], infos[from].parent_object);
    }
  };
  note_poses(live.tables.cameras, live.structure->cameras, swap.cameras);
  note_poses(live.tables.lights, live.structure->lights, swap.lights);
  const auto end_commands = [&](const SlotMoves& moves, ObjectKind kind) {
    for (const std::uint32_t slot : moves.removed) live.commands.end_object(*live.structure, {kind, slot});
  };
  end_commands(swap.bodies, ObjectKind::rigid_body);
  end_commands(swap.cameras, ObjectKind::camera);
  end_commands(swap.lights, ObjectKind::light);

  // 2. Physics lets go: joints before bodies.
  for (const std::uint32_t slot : swap.joints.removed) live.physics->remove(*live.tables.joints[slot]->joint);
  for (const std::uint32_t slot : swap.bodies.removed) {
    physics::Body& body = *live.tables.bodies[slot]->body;
    live.picks.end_of(body);
    live.physics->remove(body);
  }

  // 3. What stays moves over; the old tables, with what goes, become the garbage.
  move_kept(swap.tables.bodies, live.tables.bodies, swap.bodies);
  move_kept(swap.tables.joints, live.tables.joints, swap.joints);
  move_kept(swap.tables.cameras, live.tables.cameras, swap.cameras);
  move_kept(swap.tables.lights, live.tables.lights, swap.lights);
  std::swap(live.tables, swap.tables);
  std::swap(live.structure, swap.structure);
  live.reparent(live.tables.cameras, live.structure->cameras, swap.cameras);
  live.reparent(live.tables.lights, live.structure->lights, swap.lights);
  list_commanded(live.tables);
  live.commands.reserve(live.structure->objects.size());
  live.picks.reserve(live.structure->bodies.size());
  live.pushed.reserve(live.tables.bodies.size());
  live.list_pushed();
  ++live.parameters_version;

  // 4. Physics takes up the new, in load order: bodies before joints.
  for (std::uint32_t slot = 0; slot < live.tables.bodies.size(); ++slot) {
    physics::Body& body = *live.tables.bodies[slot]->body;
    body.set_user_index(slot);
    if (swap.bodies.from[slot] == state::kNone) live.physics->add(body);
  }
  for (std::uint32_t slot = 0; slot < live.tables.joints.size(); ++slot)
    if (swap.joints.from[slot] == state::kNone) live.physics->add(*live.tables.joints[slot]->joint);

  // 5. Commands that came for new objects before they were here.
  live.commands.look_at_all(*live.structure);
  live.changed = true;
  garbage.replaced = std::move(prepared.swap);
  return garbage;
}

}  // namespace ambf::model
