// Tangents for normal maps. Any thread but the physics thread.
#pragma once

#include "mesh/mesh.h"

namespace ambf::mesh {

// Fills Submesh::tangents from positions, normals and texture coordinates (all present): the direction in which u
// grows, square to the normal, and the handedness.
void compute_tangents(Submesh& submesh);

}  // namespace ambf::mesh
