// After a structural change in a diverged world: each object that stays keeps the values of the last good frame. Pure;
// physics thread.
#pragma once

#include "state/frame.h"

namespace ambf::runtime {

// Overwrites in `frame`, filled for the new structure, what `good` knows of the same objects, and its time.
void keep_good(const state::Frame& good, state::Frame& frame);

}  // namespace ambf::runtime
