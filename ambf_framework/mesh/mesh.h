// A triangle mesh as plain data: what the readers give, what is drawn, and what collision shapes are prepared from.
// Immutable once shared (shared_ptr<const Mesh>): any thread may then read it. Never on the physics thread.
// Units: metres, in the mesh (= body) frame, axes exactly as the file gives them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "math/types.h"

namespace ambf::mesh {

struct Color {
  float r = 0.0F, g = 0.0F, b = 0.0F, a = 1.0F;  // each in [0, 1]
};

struct Material {
  std::string name;
  Color ambient{0.3F, 0.3F, 0.3F, 1.0F};
  Color diffuse{0.7F, 0.7F, 0.7F, 1.0F};  // a: opacity of the material
  Color specular{1.0F, 1.0F, 1.0F, 1.0F};
  Color emission{0.0F, 0.0F, 0.0F, 1.0F};
  float shininess = 64.0F;  // Phong exponent, [0, 1000]
  float metallic = 0.0F;    // [0, 1]: share of the surface that is bare metal, its diffuse colour what it mirrors
  // Existing file of the diffuse texture, absolute or relative to the working folder, or the name of one of the mesh's
  // pictures; or empty.
  std::string texture_file;
  std::string normal_map_file;  // likewise for the normal (bump) map
};

// Triangles of one material. Vertices are split where normals or texture coordinates differ: weld() or CollisionMesh
// join them again.
struct Submesh {
  std::vector<float> positions;                     // xyz per vertex
  std::vector<float> normals;                       // xyz per vertex, unit length; as many as positions
  std::vector<float> texcoords;                     // uv per vertex, v upwards; empty when the file has none
  std::vector<float> tangents;                      // xyz and handedness w (+-1) per vertex; empty without a normal map
  std::vector<std::uint32_t> triangles;             // three vertex indices each, counter-clockwise seen from outside
  std::vector<std::array<std::uint32_t, 2>> lines;  // segments of polylines, vertex indices
  int material = -1;                                // index into Mesh::materials, -1: none (use the body's colour)

  std::size_t vertex_count() const { return positions.size() / 3; }
  std::size_t triangle_count() const { return triangles.size() / 3; }
  math::Vec3 vertex(std::size_t i) const { return {positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]}; }
};

struct BoundingBox {
  math::Vec3 min, max;  // m
  math::Vec3 size() const { return max - min; }
  double diagonal() const { return math::norm(size()); }
};

// Image files (PNG, JPEG) that a mesh file holds within, by the name that materials know them by: other contents have
// other names.
using Pictures = std::map<std::string, std::shared_ptr<const std::string>>;

struct Mesh {
  std::vector<Submesh> submeshes;
  std::vector<Material> materials;
  Pictures pictures;
  BoundingBox bounds;
  std::size_t vertex_count() const;
  std::size_t triangle_count() const;
};

// The same surface for collision and physics: positions welded, doubles, materials forgotten.
struct CollisionMesh {
  std::vector<math::Vec3> vertices;                     // m, mesh frame
  std::vector<std::array<std::uint32_t, 3>> triangles;  // no degenerate ones
  std::vector<std::array<std::uint32_t, 2>> lines;      // no duplicates
  BoundingBox bounds;
};

// Smallest box around all vertices; zero for an empty mesh.
BoundingBox bounds_of(const std::vector<Submesh>& submeshes);
BoundingBox bounds_of(const std::vector<math::Vec3>& points);

}  // namespace ambf::mesh
