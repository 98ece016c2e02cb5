#include "mesh/facing.h"

#include <numeric>

#include "mesh/mass_properties.h"
#include "mesh/weld.h"

namespace ambf::mesh {

namespace {

// Union-find over vertices: one root for each connected part of a surface.
class Parts {
 public:
  explicit Parts(std::size_t vertices) : parent_(vertices) { std::iota(parent_.begin(), parent_.end(), 0U); }
  std::uint32_t root(std::uint32_t vertex) {
    while (parent_[vertex] != vertex) vertex = parent_[vertex] = parent_[parent_[vertex]];
    return vertex;
  }
  void join(std::uint32_t a, std::uint32_t b) { parent_[root(a)] = root(b); }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace

Facing facing_of(const Submesh& part) {
  Mesh alone;
  alone.submeshes.push_back(part);
  const CollisionMesh surface = make_collision_mesh(alone);
  if (!is_closed(surface)) return Facing::mixed;
  Parts parts(surface.vertices.size());
  for (const auto& t : surface.triangles) {
    parts.join(t[0], t[1]);
    parts.join(t[0], t[2]);
  }
  std::vector<double> volumes(surface.vertices.size());  // of the part of each root
  for (const auto& t : surface.triangles) {
    const math::Vec3 a = surface.vertices[t[0]] - surface.bounds.min, b = surface.vertices[t[1]] - surface.bounds.min,
                     c = surface.vertices[t[2]] - surface.bounds.min;
    volumes[parts.root(t[0])] += math::dot(a, math::cross(b, c)) / 6.0;
  }
  bool outwards = true, inwards = true;
  for (const auto& t : surface.triangles) {
    const double volume = volumes[parts.root(t[0])];
    outwards = outwards && volume > 0.0;
    inwards = inwards && volume < 0.0;
  }
  return outwards ? Facing::outwards : inwards ? Facing::inwards : Facing::mixed;
}

}  // namespace ambf::mesh
