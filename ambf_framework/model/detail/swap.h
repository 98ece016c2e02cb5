// A structural change as LiveWorld::apply carries it out: the new tables with the new objects in place, and where each object that
// stays comes from. After it, the same struct holds what was replaced. For use inside model/ only.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "model/detail/live_objects.h"
#include "state/structure.h"

namespace ambf::model {

// What happens to the pose of a camera or light whose parent came or went, or that was hung on another one.
enum class Reparenting : std::uint8_t { none, orphaned, parent_found, moved, as_loaded };

// One kind of objects: where each new slot's object comes from, and which old slots' objects go.
struct SlotMoves {
  std::vector<std::uint32_t> from;     // per new slot: the object's old slot, or state::kNone when it is new
  std::vector<std::uint32_t> removed;  // old slots
};

// Cameras or lights: and what their poses go through.
struct PlacedMoves : SlotMoves {
  std::vector<Reparenting> reparenting;  // per new slot
  std::vector<math::Pose> T_world;       // per new slot: room for the poses before the swap
};

struct Swap {
  std::uint64_t base_version = 0;  // of the structure this one follows
  std::shared_ptr<const state::Structure> structure;
  LiveTables tables;  // new objects in their slots, null where an old one is moved in
  SlotMoves bodies, joints;
  PlacedMoves cameras, lights;
};

}  // namespace ambf::model
