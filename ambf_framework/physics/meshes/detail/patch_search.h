// Where two surfaces touch, when they have far too many triangles near each other to compare them all. The tree of
// the one is a hierarchy of patches, each with one vertex of its own and how far the others rise above that. Vertices
// are probed against the other surface; the patches that may hold the deepest are divided first (best first), then
// those that may hold the outermost contacts of a footing. Some hundred probes find what thousands of pairs of
// triangles would, whatever their number. Keeps no state of its own: deterministic. Private to physics/; physics
// thread.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "physics/meshes/detail/constants.h"
#include "physics/meshes/detail/surface_probe.h"

namespace ambf::physics::detail {

struct OpenPatch {
  int node;
  double key;                 // the greatest is divided next
  double distance;            // of its vertex, m; where that does not touch: as far as contacts are looked for
  btVector3 normal{0, 0, 0};  // there; zero: it does not touch
};

// One surface's patches against the other. All in the frame of the other, the target.
template <class Probe, class Add>
class PatchSearch {
 public:
  // `range`: how far contacts are searched. `max_visits`: bounds the work where each probe is long because the
  // surfaces cross each other. `add(vertex, at, probed)` receives what touches within `range`.
  PatchSearch(const FeatureMesh& mesh, const btTransform& T_target_mesh, double range, std::size_t max_visits,
              Probe& probe, Add add, std::vector<OpenPatch>& storage)
      : mesh_(mesh),
        T_target_mesh_(T_target_mesh),
        range_(range),
        max_visits_(max_visits),
        probe_(probe),
        add_(add),
        open_(storage) {
    open_.clear();
  }

  Probed look_at(int vertex) {
    const FeatureMesh::Vertex& v = mesh_.vertices[static_cast<std::size_t>(vertex)];
    return look(vertex, T_target_mesh_ * v.at, range_);
  }

  void open(int node) {
    if (patch(node).vertex >= 0 && !exhausted(2)) add_open(node);
  }

  // Divides patches until so many vertices have been probed, those that may be deepest first; of equal ones the
  // greatest.
  void explore(std::size_t probes) {
    const std::size_t end = probes_ + probes;
    const auto key = [this](const OpenPatch& at) { return kSlack * radius(at.node) - lowest(at); };
    heap(key);
    while (!open_.empty() && probes_ < end && !exhausted(2)) divide(take(), key);
  }

  // Divides patches that may hold a contact with the greatest `direction . point - kDepthPreference distance`, of
  // those whose normals are like that one. `best`: of the contacts known.
  void reach_out(const btVector3& direction, const btVector3& normal, double best, std::size_t probes) {
    const btVector3 in_mesh = (T_target_mesh_.getBasis().transpose() * direction).absolute();
    const auto key = [&](const OpenPatch& at) {
      if (at.normal.dot(normal) < kSameDirectionCosine) return -kNever;
      const FeatureMesh::Node& node = mesh_.nodes[static_cast<std::size_t>(at.node)];
      return direction.dot(T_target_mesh_ * node.centre()) + in_mesh.dot(node.half()) - kDepthPreference * lowest(at);
    };
    heap(key);
    const std::size_t end = probes_ + probes;
    set_score(direction, normal, best);
    while (!open_.empty() && probes_ < end && !exhausted() && open_.front().key > best_ + kSameScore)
      divide(take(), key);
    scoring_ = false;
  }

  // From a vertex to whichever neighbour is better in the same sense, and on.
  void climb(int vertex, const btVector3& direction, const btVector3& normal, double best, std::size_t moves) {
    set_score(direction, normal, best);
    for (; moves > 0 && !exhausted(); --moves) {
      const double before = best_;
      int better = -1;
      for (const int neighbour :
           mesh_.neighbours_of(vertex).first(std::min(mesh_.neighbours_of(vertex).size(), kMaxClimbNeighbours))) {
        const double known = best_;
        look_at(neighbour);
        if (best_ > known) better = neighbour;
      }
      if (better < 0 || best_ <= before + kSameScore) break;
      vertex = better;
    }
    scoring_ = false;
  }

  std::size_t probes() const { return probes_; }

 private:
  static constexpr double kSlack = Probe::kFlat ? 0.0 : kBendSlack;
  static constexpr double kNever = 1e300;

  // A total order: the same patches are divided whatever the order of the heap.
  static bool less(const OpenPatch& a, const OpenPatch& b) {
    return a.key < b.key || (a.key == b.key && a.node > b.node);
  }

  bool exhausted(std::size_t share = 1) const { return share * probe_.visits() > max_visits_; }
  const FeatureMesh::Patch& patch(int node) const { return mesh_.patches[static_cast<std::size_t>(node)]; }
  double radius(int node) const { return static_cast<double>(patch(node).radius); }

  // No vertex of the patch is closer, as far as the other surface is flat there.
  double lowest(const OpenPatch& at) const {
    const FeatureMesh::Patch& p = patch(at.node);
    const double r = radius(at.node);
    if (at.normal.isZero()) return at.distance - r;
    const btVector3 normal = T_target_mesh_.getBasis() * mean_normal(p);
    const double facing = static_cast<double>(p.rise) + (at.normal + normal).length() * r;
    const double turned = static_cast<double>(p.fall) + (at.normal - normal).length() * r;
    return at.distance - std::min({r, facing, turned});
  }

  Probed look(int vertex, const btVector3& at, double range) {
    ++probes_;
    const FeatureMesh::Vertex& v = mesh_.vertices[static_cast<std::size_t>(vertex)];
    const btVector3 outward = T_target_mesh_.getBasis() * v.normal;
    Probed found = probe_.probe(at, outward, range_, range);
    if (found.touches && found.sharp) found.touches = in_cone(v, -found.normal);
    if (found.touches && !found.sharp && !v.rim && v.cone > kSmoothCone && v.cone > found.cone + kFlatterCone)
      take_direction_of(v, found);
    if (found.touches && found.distance <= range_) {
      add_(vertex, at, found);
      if (scoring_ && found.normal.dot(normal_) > kSameDirectionCosine)
        best_ = std::max(best_, direction_.dot(at) - kDepthPreference * found.distance);
    }
    return found;
  }

  // Whether nothing else of the mesh would be touched first from there.
  bool in_cone(const FeatureMesh::Vertex& v, const btVector3& direction) const {
    if (v.rim) return true;
    const double cosine = direction.dot(T_target_mesh_.getBasis() * widened(v.axis));
    return (v.normal.isZero() ? std::abs(cosine) : cosine) >= static_cast<double>(v.cone);
  }

  // Where surfaces touch their normals are opposite; next to that the flatter one knows better: what is round slides
  // on what is flat without being braked by its own slope.
  void take_direction_of(const FeatureMesh::Vertex& v, Probed& found) const {
    btVector3 axis = T_target_mesh_.getBasis() * widened(v.axis);
    double cosine = axis.dot(found.normal);
    if (cosine < 0.0) {
      axis = -axis;
      cosine = -cosine;
    }
    if (cosine < kSameDirectionCosine) return;
    found.distance /= cosine;
    found.normal = axis;
  }

  bool add_open(int node) {
    const int vertex = patch(node).vertex;
    const Probed found =
        look(vertex, T_target_mesh_ * mesh_.vertices[static_cast<std::size_t>(vertex)].at, range_ + radius(node));
    if (!found.near || open_.size() >= open_.capacity()) return false;
    open_.push_back(
        {node, 0.0, found.touches ? found.distance : range_, found.touches ? found.normal : btVector3(0, 0, 0)});
    return true;
  }

  void set_score(const btVector3& direction, const btVector3& normal, double best) {
    best_ = best;
    direction_ = direction;
    normal_ = normal;
    scoring_ = true;
  }

  template <class Key>
  void heap(Key&& key) {
    for (OpenPatch& at : open_) at.key = key(at);
    std::erase_if(open_, [](const OpenPatch& at) { return !std::isfinite(at.key); });
    std::make_heap(open_.begin(), open_.end(), less);
  }

  OpenPatch take() {
    std::pop_heap(open_.begin(), open_.end(), less);
    const OpenPatch at = open_.back();
    open_.pop_back();
    return at;
  }

  template <class Key>
  void push(Key&& key) {
    open_.back().key = key(open_.back());
    if (!std::isfinite(open_.back().key)) {
      open_.pop_back();
    } else {
      std::push_heap(open_.begin(), open_.end(), less);
    }
  }

  template <class Key>
  void divide(const OpenPatch& at, Key&& key) {
    const FeatureMesh::Node& node = mesh_.nodes[static_cast<std::size_t>(at.node)];
    const int known = patch(at.node).vertex;
    if (node.right < 0) {
      const FeatureMesh::Triangle& triangle = mesh_.triangles[static_cast<std::size_t>(node.triangle)];
      for (std::size_t k = 0; k < 3; ++k)
        if (triangle.owns[k] && triangle.vertex[k] != known) look_at(triangle.vertex[k]);
      return;
    }
    for (const int child : {at.node + 1, node.right}) {
      if (patch(child).vertex < 0) continue;
      if (patch(child).vertex != known) {
        if (add_open(child)) push(key);
        continue;
      }
      open_.push_back(at);
      open_.back().node = child;
      push(key);
    }
  }

  const FeatureMesh& mesh_;
  const btTransform& T_target_mesh_;
  double range_;
  std::size_t max_visits_;
  Probe& probe_;
  Add add_;
  std::vector<OpenPatch>& open_;
  std::size_t probes_ = 0;
  bool scoring_ = false;
  double best_ = 0.0;
  btVector3 direction_{0, 0, 0}, normal_{0, 0, 0};
};

}  // namespace ambf::physics::detail
