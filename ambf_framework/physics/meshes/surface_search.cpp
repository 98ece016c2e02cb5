// The part of SurfaceContacts for surfaces with too many triangles near each other.
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>

#include "physics/meshes/surface_contacts.h"

namespace ambf::physics::detail {

namespace {

constexpr std::size_t kMostExplored = 48;      // vertices of one side, to find the deepest
constexpr std::size_t kMostMoves = 3;          // from a vertex to its neighbour, on the way outward
constexpr std::size_t kMostReached = 6;        // likewise, to find the outermost in one of four directions
constexpr std::size_t kMostVisits = 6000;      // of branches and triangles by one side; in haste, a quarter
constexpr std::size_t kFootings = 2;           // groups of like normals whose outermost contacts are looked for
constexpr std::size_t kVisit = 2, kProbe = 5;  // what they cost, in some 5 ns

template <class Of>
void unique_nodes(std::vector<int>& nodes, const std::vector<SurfaceContacts::Pair>& pairs, Of&& of) {
  nodes.clear();
  for (const auto& pair : pairs) nodes.push_back(of(pair));
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
}

}  // namespace

// The vertices of one mesh against the other surface.
struct SurfaceContacts::Side {
  const FeatureMesh& mesh;
  bool of_a;
  const btTransform& T_b_a;
  double reach, margin_b, margins;
  std::size_t most_visits;
  std::span<const SurfaceVertex> known;
};

template <class Probe>
void SurfaceContacts::search_side(const Side& side, Probe probe) {
  const btTransform T_target_mesh = side.of_a ? side.T_b_a : side.T_b_a.inverse();
  const btMatrix3x3& R_b_a = side.T_b_a.getBasis();
  const auto found = [&](int vertex, const btVector3& at, const Probed& probed) {
    const SurfaceVertex from{vertex, side.of_a};
    const double distance = probed.distance - side.margins;
    if (side.of_a) {
      add(at - probed.normal * (probed.distance - side.margin_b), probed.normal, distance, from);
    } else {
      const btVector3 normal = R_b_a * -probed.normal;
      add(side.mesh.vertices[static_cast<std::size_t>(vertex)].at + normal * side.margin_b, normal, distance, from);
    }
  };
  PatchSearch search(side.mesh, T_target_mesh, side.reach + side.margins, side.most_visits, probe, found, open_);
  for (const SurfaceVertex& vertex : side.known)
    // Of the surface that was searched then, which may have been a coarser one: on this one it is as good a guess as any.
    if (vertex.of_a == side.of_a && static_cast<std::size_t>(vertex.vertex) < side.mesh.vertices.size())
      search.look_at(vertex.vertex);
  for (const int node : begin_) search.open(node);
  constexpr std::size_t kEase = Probe::kFlat ? 4 : 1;  // boxes are probed with ease
  search.explore(kEase * kMostExplored - std::min(begin_.size(), kMostExplored / 2));

  std::array<btVector3, kFootings> normals;
  for (std::size_t footing = 0; footing < kFootings; ++footing) {
    const SurfaceContact* deepest = nullptr;
    for (const SurfaceContact& contact : contacts_) {
      const bool other = std::all_of(normals.begin(), normals.begin() + static_cast<std::ptrdiff_t>(footing),
                                     [&](const btVector3& n) { return contact.normal.dot(n) <= kSameDirection; });
      if (other && (!deepest || contact.distance < deepest->distance)) deepest = &contact;
    }
    if (!deepest) break;
    const btVector3 normal = normals[footing] = deepest->normal;
    btVector3 u, v;
    btPlaneSpace1(normal, u, v);
    for (const btVector3& direction : {u + v, -u - v, u - v, v - u}) {
      const btVector3 in_target = side.of_a ? direction : direction * R_b_a;
      const btVector3 normal_in_target = side.of_a ? normal : -normal * R_b_a;
      const double origin = side.of_a ? 0.0 : direction.dot(side.T_b_a.getOrigin());
      double best = -1e300;
      int climber = -1;
      const auto score_known = [&] {
        for (const SurfaceContact& contact : contacts_) {
          if (contact.normal.dot(normal) <= kSameDirection) continue;
          const double score =
              direction.dot(contact.point) - origin - kDepthPreference * (contact.distance + side.margins);
          if (score <= best) continue;
          best = score;
          climber = contact.vertex.of_a == side.of_a ? contact.vertex.vertex : -1;
        }
      };
      score_known();
      search.reach_out(in_target, normal_in_target, best, kEase * kMostReached);
      score_known();
      if (climber >= 0) search.climb(climber, in_target, normal_in_target, best, kMostMoves);
    }
  }
  cost_ += kProbe * search.probes() + kVisit * probe.visits();
}

void SurfaceContacts::search(const FeatureMesh& a, const FeatureMesh& b, const btTransform& T_b_a, double reach,
                             bool in_haste, std::span<const SurfaceVertex> known) {
  const std::size_t visits = in_haste ? kMostVisits / 4 : kMostVisits;
  unique_nodes(begin_, frontier_, [](const Pair& pair) { return pair.a; });
  if (b.box) {
    search_solid(a, *b.box, T_b_a, reach, known);
  } else {
    search_side({a, true, T_b_a, reach, b.margin, a.margin + b.margin, visits, known},
                MeshProbe(b, a.margin + b.margin));
  }
  unique_nodes(begin_, frontier_, [](const Pair& pair) { return pair.b; });
  search_side({b, false, T_b_a, reach, b.margin, a.margin + b.margin, visits, known},
              MeshProbe(a, a.margin + b.margin));
}

void SurfaceContacts::search_solid(const FeatureMesh& a, const btVector3& half, const btTransform& T_b_a, double reach,
                                   std::span<const SurfaceVertex> known) {
  search_side({a, true, T_b_a, reach, 0.0, a.margin, kMostVisits, known}, BoxProbe(half));
}

}  // namespace ambf::physics::detail
