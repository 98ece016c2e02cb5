// The part of SurfaceContacts for surfaces with too many triangles near each other.
#include <algorithm>
#include <array>

#include "physics/meshes/detail/constants.h"
#include "physics/meshes/detail/surface_contacts.h"

namespace ambf::physics::detail {

namespace {

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
  std::size_t max_visits;
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
  PatchSearch search(side.mesh, T_target_mesh, side.reach + side.margins, side.max_visits, probe, found, open_);
  for (const SurfaceVertex& vertex : side.known)
    // Of the surface that was searched then, which may have been a coarser one: on this one it is as good a guess as
    // any.
    if (vertex.of_a == side.of_a && static_cast<std::size_t>(vertex.vertex) < side.mesh.vertices.size())
      search.look_at(vertex.vertex);
  for (const int node : begin_) search.open(node);
  constexpr std::size_t kProbeFactor = Probe::kFlat ? kBoxProbeFactor : 1;
  search.explore(kProbeFactor * kMaxExploreProbes - std::min(begin_.size(), kMaxExploreProbes / 2));

  std::array<btVector3, kFootings> normals;
  for (std::size_t footing = 0; footing < kFootings; ++footing) {
    const SurfaceContact* deepest = nullptr;
    for (const SurfaceContact& contact : contacts_) {
      const bool other = std::all_of(normals.begin(), normals.begin() + static_cast<std::ptrdiff_t>(footing),
                                     [&](const btVector3& n) { return contact.normal.dot(n) <= kSameDirectionCosine; });
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
          if (contact.normal.dot(normal) <= kSameDirectionCosine) continue;
          const double score =
              direction.dot(contact.point) - origin - kDepthPreference * (contact.distance + side.margins);
          if (score <= best) continue;
          best = score;
          climber = contact.vertex.of_a == side.of_a ? contact.vertex.vertex : -1;
        }
      };
      score_known();
      search.reach_out(in_target, normal_in_target, best, kProbeFactor * kMaxReachProbes);
      score_known();
      if (climber >= 0) search.climb(climber, in_target, normal_in_target, best, kMaxClimbMoves);
    }
  }
  cost_ += kProbeCost * search.probes() + kSearchVisitCost * probe.visits();
}

void SurfaceContacts::search(const FeatureMesh& a, const FeatureMesh& b, const btTransform& T_b_a, double reach,
                             bool hurried, std::span<const SurfaceVertex> known) {
  const std::size_t visits = hurried ? kMaxSearchVisits / kHurriedShare : kMaxSearchVisits;
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
  search_side({a, true, T_b_a, reach, 0.0, a.margin, kMaxSearchVisits, known}, BoxProbe(half));
}

}  // namespace ambf::physics::detail
