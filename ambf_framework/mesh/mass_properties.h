// Volume, centre and inertia of closed triangle meshes, and the vertex mean that stands for the centre of mass where an
// ADF gives none. Pure functions; any thread but the physics thread.
#pragma once

#include <array>

#include "mesh/mesh.h"

namespace ambf::mesh {

struct MassProperties {
  double volume = 0.0;  // m^3; negative when the triangles face inwards
  double area = 0.0;    // m^2
  math::Vec3 centre;    // m, centre of volume; of area when |volume| is negligible (open or flat meshes)
  // Inertia about `centre`, mesh axes, divided by mass (m^2): xx, yy, zz, xy, xz, yz with xy = -integral(x y).
  std::array<double, 6> inertia_per_mass{};
  bool closed = false;  // is_closed()
};

// Every edge is shared by two triangles that run along it in opposite directions.
bool is_closed(const CollisionMesh& mesh);

// Uniform density inside the surface; a thin uniform shell where the surface encloses no volume.
MassProperties mass_properties(const CollisionMesh& mesh);

// Mean of the triangle corners, every corner counted: for STL this is the mean over the file's vertices.
math::Vec3 corner_mean(const Mesh& mesh);

}  // namespace ambf::mesh
