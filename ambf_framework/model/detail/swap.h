// A structural change as LiveWorld::apply carries it out: the new tables with the new objects in place, and where each
// object that stays comes from. After it, the same struct holds what was replaced. For use inside model/ only.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "model/detail/live_objects.h"
#include "state/structure.h"

namespace ambf::model {

// What happens to the pose of an object whose parent came or went, or was exchanged.
enum class Reparenting : std::uint8_t { none, orphaned, parent_found, moved, as_loaded };

// The objects of one kind: where each new slot's object comes from, what its pose goes through, and which old slots'
// objects go.
struct KindMoves {
  std::vector<std::uint32_t> from;       // per new slot: the object's old slot, or state::kNone when it is new
  std::vector<Reparenting> reparenting;  // per new slot
  std::vector<math::Pose> T_world;       // per new slot: room for the poses before the swap
  std::vector<std::uint32_t> removed;    // old slots
};

struct Swap {
  Swap() : moves(state::kind_count()) {}

  KindMoves& of(state::ObjectKind kind) { return moves[static_cast<std::size_t>(kind)]; }

  std::uint64_t base_version = 0;  // of the structure this one follows
  std::shared_ptr<const state::Structure> structure;
  LiveTables tables;             // new objects in their slots, null where an old one is moved in
  std::vector<KindMoves> moves;  // by kind
};

}  // namespace ambf::model
