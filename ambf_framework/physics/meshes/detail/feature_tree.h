// The tree of boxes over a mesh's triangles, and what its branches hold. Off the physics thread. Private to physics/.
#pragma once

#include "physics/meshes/detail/feature_mesh.h"

namespace ambf::physics::detail {

// Of a mesh whose vertices and triangles are complete.
void make_tree(FeatureMesh& mesh);

}  // namespace ambf::physics::detail
