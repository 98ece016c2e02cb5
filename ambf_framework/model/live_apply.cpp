// LiveWorld::apply: structural changes.
#include <cassert>

#include "model/detail/command_bounds.h"
#include "model/detail/live_impl.h"
#include "model/detail/swap.h"
#include "model/kinds/kind.h"
#include "model/kinds/registry.h"
#include "model/live_world.h"
#include "state/kind_rows.h"

namespace ambf::model {
namespace {

void list_commanded(LiveTables& tables) {
  for (const auto& kind : kinds()) {
    const LiveTable& table = tables.of(kind->number());
    for (std::uint32_t slot = 0; slot < table.size(); ++slot) {
      if (table[slot]->active) tables.commanded.push_back({kind->number(), slot});
      if (table[slot]->slots != nullptr && table[slot]->slots->noted) tables.noted.push_back({kind->number(), slot});
    }
  }
}

}  // namespace

// An object that lost its parent or was given another one stays where it is in the world; one whose parent was found
// goes to its place in it; one that hangs as its file says again is where that puts it.
void LiveWorld::Impl::reparent(state::ObjectKind kind, const KindMoves& moves) const {
  const LiveTable& table = tables.of(kind);
  for (std::uint32_t slot = 0; slot < table.size(); ++slot) {
    if (moves.from[slot] == state::kNone || moves.reparenting[slot] == Reparenting::none) continue;
    auto& live = static_cast<LivePlaced&>(*table[slot]);
    live.orphaned = moves.reparenting[slot] == Reparenting::orphaned;
    switch (moves.reparenting[slot]) {
      case Reparenting::orphaned: live.T_parent = moves.T_world[slot]; break;
      case Reparenting::moved: {
        const std::uint32_t parent = state::rows_of(kind).placed(*structure, slot)->parent_object;
        live.T_parent = live.T_parent_initial =
            math::inverse(kind_of(kind).parent_frame(*this, parent)) * moves.T_world[slot];
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
  for (const auto& kind : kinds()) {
    KindMoves& moves = swap.of(kind->number());
    for (std::size_t slot = 0; kind->info().has_parent && slot < moves.from.size(); ++slot)
      if (moves.from[slot] != state::kNone) moves.T_world[slot] = kind->pose(live, moves.from[slot]);
    if (!kind->info().has_topics) continue;
    for (const std::uint32_t slot : moves.removed) live.commands.end_object(*live.structure, {kind->number(), slot});
  }

  // 2. Physics unlinks: joints before bodies.
  for (std::size_t i = kinds().size(); i-- > 0;)
    for (const std::uint32_t slot : swap.of(kinds()[i]->number()).removed) kinds()[i]->unlink(live, slot);

  // 3. What stays moves over; the old tables, with what goes, become the garbage.
  for (const auto& kind : kinds()) {
    const KindMoves& moves = swap.of(kind->number());
    LiveTable &to = swap.tables.of(kind->number()), &from = live.tables.of(kind->number());
    for (std::size_t slot = 0; slot < to.size(); ++slot)
      if (moves.from[slot] != state::kNone) to[slot] = std::move(from[moves.from[slot]]);
  }
  std::swap(live.tables, swap.tables);
  std::swap(live.structure, swap.structure);
  for (const auto& kind : kinds())
    if (kind->info().has_parent) live.reparent(kind->number(), swap.of(kind->number()));
  list_commanded(live.tables);
  live.commands.reserve(live.structure->objects.size());
  live.laws.reserve(live.structure->bodies.size());
  live.picks.reserve(live.structure->bodies.size());
  live.pushed.reserve(live.structure->bodies.size());
  live.list_pushed();
  ++live.parameters_version;

  // 4. Physics links the new, in load order: bodies before joints.
  for (const auto& kind : kinds()) {
    const KindMoves& moves = swap.of(kind->number());
    for (std::uint32_t slot = 0; slot < moves.from.size(); ++slot)
      kind->link(live, slot, moves.from[slot] == state::kNone);
  }
  live.each_object(&Kind::all_placed);
  weigh_mechanisms(live.tables.bodies(), *live.structure);

  // 5. Commands that came for new objects before they were here.
  live.commands.look_at_all(*live.structure);
  live.changed = true;
  garbage.replaced = std::move(prepared.swap);
  return garbage;
}

}  // namespace ambf::model
