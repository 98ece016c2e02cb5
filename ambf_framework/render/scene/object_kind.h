// What an object is, by the table of kinds: drawing code asks these instead of naming kinds. Any thread.
#pragma once

#include <algorithm>

#include "state/kinds.h"
#include "state/structure.h"

namespace ambf::render {

// A row of Structure::bodies, or of Structure::joints.
inline bool is_body(const state::ObjectInfo& object) { return state::info_of(object.kind).has_mass; }
// Room, ground and walls: static, and part of the world's environment.
inline bool is_room(const state::Structure& structure, const state::ObjectInfo& object) {
  if (!is_body(object) || structure.bodies[object.slot].mass > 0.0) return false;
  return std::any_of(structure.models.begin(), structure.models.end(),
                     [&](const state::ModelInfo& model) { return model.id == object.model && model.environment; });
}
inline bool is_joint(const state::ObjectInfo& object) { return state::info_of(object.kind).connects_bodies; }

}  // namespace ambf::render
