#include "state/ghosts.h"

#include <algorithm>

#include "base/limits.h"
#include "state/detail/built_in_kinds.h"

namespace ambf::state {
namespace {

PlacedKind<GhostState> registered_kind;
ColumnId<GhostTouch> registered_touches;

// Each ghost may feel every body and every other ghost.
std::size_t max_touches(const Structure& structure) {
  const std::size_t all = ghosts(structure).size();
  return all == 0 ? 0 : std::min(all * (structure.bodies.size() + all - 1), base::kMaxGhostTouches);
}

}  // namespace

void register_ghost_kind() {
  KindInfo info;
  info.name = "ghost_object";
  info.label = "ghost object";
  info.plural = "ghost objects";
  registered_kind = register_placed_kind<GhostInfo, GhostState>(std::move(info));
  ColumnTraits traits;
  traits.name = "ghost_touches";
  traits.while_diverged = WhileDiverged::last_good_structure;
  traits.rows_of = max_touches;
  registered_touches = register_column<GhostTouch>(std::move(traits));
}

const PlacedKind<GhostState>& ghost_kind() {
  register_built_in_kinds();
  return registered_kind;
}

const std::vector<GhostInfo>& ghosts(const Structure& structure) {
  static const std::vector<GhostInfo> none;
  const auto number = static_cast<std::size_t>(ghost_kind().kind);
  const bool has_table = number < structure.registered.size() && structure.registered[number].has_value();
  return has_table ? table<GhostInfo>(structure, ghost_kind().kind) : none;
}

TouchRange touches_of(const Frame& frame, std::uint32_t ghost_slot) {
  const GhostState& ghost = rows(frame, registered_kind.column)[ghost_slot];
  const std::vector<GhostTouch>& all = rows(frame, registered_touches);
  if (std::size_t{ghost.first_touch} + ghost.touches > all.size()) return {};
  return {all.data() + ghost.first_touch, all.data() + ghost.first_touch + ghost.touches};
}

std::vector<GhostTouch>& ghost_touches(Frame& frame) { return rows(frame, registered_touches); }

}  // namespace ambf::state
