// Which way the triangles of a surface face. Pure functions; any thread but the physics thread.
#pragma once

#include "mesh/mesh.h"

namespace ambf::mesh {

// outwards (inwards): every connected part is closed, and its triangles run counter-clockwise (clockwise) seen from
// outside it, so that from outside only one side of them is ever visible. mixed: everything else.
enum class Facing { mixed, outwards, inwards };

Facing facing_of(const Submesh& part);

}  // namespace ambf::mesh
