// What belongs together in a structure, for the panel: parents, mechanisms, pulls of pointers. Pure functions, any
// thread.
#pragma once

#include <vector>

#include "state/frame.h"

namespace ambf::render {

// Of a body the one above it by the joint that holds it, of a joint its parent body, of a camera or light what it hangs
// on. Invalid: none.
state::ObjectId parent_of(const state::Structure& structure, state::ObjectId object);
// A body and all that is jointed to it, except for what is static.
std::vector<state::ObjectId> mechanism_of(const state::Structure& structure, state::ObjectId body);
// Force (N) by which all pointers pull at the body.
double pulled_by(const state::Frame& frame, state::ObjectId body);

}  // namespace ambf::render
