// A ray against the triangles of a surface, by its tree of boxes.
#include <algorithm>
#include <array>
#include <cmath>

#include "physics/meshes/detail/attached_surface.h"
#include "physics/meshes/mesh_contacts.h"

namespace ambf::physics::detail {
namespace {

constexpr int kStack = 64;  // branches left for later: one a level, and the tree halves its triangles

constexpr double kMissed = 2.0;

// The fraction at which the ray enters the box, if it does before `fraction`; else kMissed. Rounded outward, as the
// boxes are.
double entry(const FeatureMesh::Node& node, const btVector3& start, const btVector3& along, double fraction) {
  const btVector3 centre = node.centre(), half = node.half();
  double begin = 0.0, end = fraction;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = centre[axis] - half[axis] - start[axis], high = centre[axis] + half[axis] - start[axis];
    if (along[axis] == 0.0) {
      if (low > 0.0 || high < 0.0) return kMissed;
      continue;
    }
    const double a = low / along[axis], b = high / along[axis];
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
  return begin <= end + 1e-12 ? begin : kMissed;
}

// From either side. The edges belong to both neighbours, so that no ray passes between them: with the start as origin
// and the ray as axis, an edge's side depends on its two ends alone, whichever triangle names them.
bool meets(const FeatureMesh& mesh, const FeatureMesh::Triangle& triangle, const btVector3& start,
           const btVector3& along, double& fraction) {
  const btVector3 a = mesh.vertices[static_cast<std::size_t>(triangle.vertex[0])].at - start;
  const btVector3 b = mesh.vertices[static_cast<std::size_t>(triangle.vertex[1])].at - start;
  const btVector3 c = mesh.vertices[static_cast<std::size_t>(triangle.vertex[2])].at - start;
  const double u = along.dot(b.cross(c)), v = along.dot(c.cross(a)), w = along.dot(a.cross(b));
  const bool front = u >= 0.0 && v >= 0.0 && w >= 0.0, back = u <= 0.0 && v <= 0.0 && w <= 0.0;
  const double volume = u + v + w;
  if ((!front && !back) || volume == 0.0) return false;
  const double found = a.dot(triangle.normal) / along.dot(triangle.normal);
  if (!(found >= 0.0 && found < fraction)) return false;
  fraction = found;
  return true;
}

}  // namespace

SurfaceHit cast_at_surface(const btCollisionShape& shape, const btVector3& start, const btVector3& along,
                           double fraction) {
  SurfaceHit hit{fraction, -1, {0, 0, 0}};
  const FeatureMesh* mesh = attached_surface(shape);
  if (mesh == nullptr || mesh->nodes.empty()) return hit;
  // The nearer child first: what it holds often hides the other.
  struct Later {
    int node;
    double begin;
  };
  std::array<Later, kStack> later;
  std::size_t waiting = 0;
  if (entry(mesh->nodes[0], start, along, hit.fraction) < kMissed) later[waiting++] = {0, 0.0};
  while (waiting > 0) {
    const Later next = later[--waiting];
    if (next.begin > hit.fraction) continue;
    const FeatureMesh::Node& node = mesh->nodes[static_cast<std::size_t>(next.node)];
    if (node.right < 0) {
      const auto& triangle = mesh->triangles[static_cast<std::size_t>(node.triangle)];
      if (!meets(*mesh, triangle, start, along, hit.fraction)) continue;
      hit.triangle = node.triangle;
      hit.normal = triangle.normal;
      continue;
    }
    Later near{next.node + 1, 0.0}, far{node.right, 0.0};
    for (Later* child : {&near, &far})
      child->begin = entry(mesh->nodes[static_cast<std::size_t>(child->node)], start, along, hit.fraction);
    if (far.begin < near.begin) std::swap(near, far);
    if (far.begin < kMissed) later[waiting++] = far;
    if (near.begin < kMissed) later[waiting++] = near;
  }
  return hit;
}

}  // namespace ambf::physics::detail
