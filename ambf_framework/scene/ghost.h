// The description of a ghost object: a shape at its parent that feels what overlaps it and pushes nothing. Beside
// description.h, because few files read it.
#pragma once

#include <string>

#include "math/types.h"
#include "scene/block_kinds.h"
#include "scene/description.h"

namespace ambf::scene {

struct Ghost {
  Visual visual;
  Collision collision;
  std::string parent;         // empty: the world
  math::Pose T_parent_ghost;  // in the frame of the parent's centre of mass, where the parent is a body
  // Not 0: bodies inside are carried along. Each millisecond v = v_p + drag (v - its part along v_p), w = drag w, with
  // v_p the parent's linear velocity (its COM's), v and w those of the body, world axes; their gravity is off inside
  // (ADF_REFERENCE 13: AMBF 2.0 did that with 0.9).
  double drag = 0.0;
};

namespace group {
extern const Group kGhostObject;
}

namespace kind {
extern const BlockKind kGhostObject;
}

}  // namespace ambf::scene
