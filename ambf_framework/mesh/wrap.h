// Lays a patch onto a surface, as a skin (Alg. 13). Pure function; any thread but the physics thread.
#pragma once

#include "mesh/mesh.h"

namespace ambf::mesh {

// Moves each vertex of `patch` along its normal to `offset_m` before the first triangle of `surface` that it meets.
// Left out, with their triangles, are vertices that meet nothing, meet the back of a triangle, or are nearer than that
// already. Normals of the patch look at the surface; those of what is returned look away from it. Vertex normals are
// the means of the triangles there, by their angles.
CollisionMesh wrapped(const CollisionMesh& patch, const CollisionMesh& surface, double offset_m);

}  // namespace ambf::mesh
