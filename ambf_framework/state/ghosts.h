// Ghost objects as all threads see them: shapes that feel what overlaps them and push nothing. What each feels is a row
// of the column of touches, in the order of the ghosts; those beyond base::kMaxGhostTouches are left out. Plain data,
// read by any thread. C++17.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "state/kind_rows.h"

namespace ambf::state {

struct GhostInfo : PlacedInfo {
  std::shared_ptr<const mesh::Appearance> appearance;            // drawn; null: none
  std::shared_ptr<const mesh::Appearance> collision_appearance;  // what feels; null: it feels nothing
  double drag = 0.0;                                             // 0: none; see scene::Ghost
};

// Poses in the parent are in the frame of its centre of mass (AMBF3 1.5).
struct GhostState : PlacedState {
  std::uint32_t first_touch = 0, touches = 0;  // rows of the column of touches
};

// A body or another ghost whose shape overlaps a ghost's.
struct GhostTouch {
  std::uint32_t object = kNone;  // index into Structure::objects
};

template <class Visit>
void visit_computed(GhostState& row, Visit& visit) {
  visit(row.T_parent_object), visit(row.T_world_object);
}

const PlacedKind<GhostState>& ghost_kind();

const std::vector<GhostInfo>& ghosts(const Structure& structure);

// What the ghost of this slot feels, begin and end; empty where the frame's list belongs to another structure (a
// diverged world).
struct TouchRange {
  const GhostTouch* first = nullptr;
  const GhostTouch* last = nullptr;
  const GhostTouch* begin() const { return first; }
  const GhostTouch* end() const { return last; }
  std::size_t size() const { return static_cast<std::size_t>(last - first); }
};
TouchRange touches_of(const Frame& frame, std::uint32_t ghost_slot);

// All rows, for the physics thread to fill: at most their vector's capacity.
std::vector<GhostTouch>& ghost_touches(Frame& frame);

}  // namespace ambf::state
