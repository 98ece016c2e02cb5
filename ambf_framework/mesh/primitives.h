// The ADF's primitive shapes as triangle meshes for drawing: closed, outward, with normals and texture coordinates.
// Lengths in metres, centred on the origin, as the keys of `geometry` say. Pure functions; any thread but the physics
// thread.
#pragma once

#include "mesh/mesh.h"

namespace ambf::mesh {

enum class Axis { x, y, z };

Mesh make_box(double x, double y, double z);  // full lengths
Mesh make_sphere(double radius, int slices = 32);
Mesh make_cylinder(double radius, double height, Axis axis = Axis::z, int slices = 32);
// Apex at +height/2 along the axis.
Mesh make_cone(double radius, double height, Axis axis = Axis::z, int slices = 32);
// `height` is total, caps included; at least 2 * radius (a sphere) is drawn.
Mesh make_capsule(double radius, double height, Axis axis = Axis::z, int slices = 32);
// A square of `side` metres at `offset` along the unit normal, facing along it; one texture tile per `tile` metres.
Mesh make_plane(const math::Vec3& normal, double offset, double side = 100.0, double tile = 1.0);

// The submeshes of `part` moved by `T_mesh_part` and appended to `mesh` (compound shapes).
void append(Mesh& mesh, const Mesh& part, const math::Pose& T_mesh_part);

// The mesh with each axis stretched by its factor, none of them 0. An odd number of factors below 0 mirrors it: its
// triangles are then wound the other way, so that they face where they faced.
Mesh stretched(Mesh mesh, const math::Vec3& factors);

}  // namespace ambf::mesh
