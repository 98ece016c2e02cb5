// What an object is, by the table of kinds: drawing code asks these instead of naming kinds. Any thread.
#pragma once

#include "state/kinds.h"
#include "state/structure.h"

namespace ambf::render {

// A row of Structure::bodies, or of Structure::joints.
inline bool is_body(const state::ObjectInfo& object) { return state::info_of(object.kind).has_mass; }
inline bool is_joint(const state::ObjectInfo& object) { return state::info_of(object.kind).connects_bodies; }

}  // namespace ambf::render
