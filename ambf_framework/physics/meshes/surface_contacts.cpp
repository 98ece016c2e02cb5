#include "physics/meshes/detail/surface_contacts.h"

#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>

#include <algorithm>
#include <cmath>

#include "physics/meshes/detail/constants.h"
#include "physics/meshes/detail/feature_pair.h"

namespace ambf::physics::detail {

namespace {

btVector3 clamped(const btVector3& v, const btVector3& half) {
  btVector3 result = v;
  result.setMax(-half);
  result.setMin(half);
  return result;
}

}  // namespace

struct SurfaceContacts::Frame {
  explicit Frame(const btTransform& transform) : T_b_a(transform), absolute(transform.getBasis().absolute()) {}
  btTransform T_b_a;
  btMatrix3x3 absolute;

  btVector3 half(const btVector3& half_in_a) const { return absolute * half_in_a; }
};

SurfaceContacts::SurfaceContacts() {
  for (auto* pairs : {&pairs_, &next_, &found_}) pairs->reserve(4 * kMaxTrianglesInBox + 4);
  frontier_.reserve(4 * kFrontierPairs);
  begin_.reserve(4 * kFrontierPairs);
  open_.reserve(kMaxOpenPatches);
  for (auto* nodes : {&near_, &nearer_, &leaves_}) nodes->reserve(4 * kMaxGjkTriangles + 2);
  contacts_.reserve(kMaxCandidates);
  group_of_.reserve(kMaxCandidates);
  chosen_.reserve(kMaxGroups * kMaxGroupSize);
}

// What a search uses now.
const FeatureMesh& SurfaceContacts::searched(const FeatureMesh& mesh) const {
  if (!preparation_ || mesh.ready_for_search()) return mesh.for_search();
  preparation_->request(mesh);
  return mesh;
}

// Level by level through both trees. False if there are too many: then found_ are some of the pairs, and frontier_
// all others or what leads to them.
bool SurfaceContacts::find_pairs(const FeatureMesh& a, const FeatureMesh& b, const Frame& frame, double reach,
                                 std::size_t max) {
  pairs_.clear();
  found_.clear();
  frontier_.clear();
  if (a.nodes.empty() || b.nodes.empty()) return true;
  std::size_t before = 0;  // pairs found above the frontier
  int last = -1;
  btVector3 centre, half;  // of that node of A, in B's frame
  const auto visit = [&](int node_a, int node_b) {
    const FeatureMesh::Node &of_a = a.nodes[static_cast<std::size_t>(node_a)],
                            &of_b = b.nodes[static_cast<std::size_t>(node_b)];
    if (node_a != last) {
      last = node_a;
      centre = frame.T_b_a * of_a.centre();
      half = frame.half(of_a.half()) + btVector3(reach, reach, reach);
    }
    const btVector3 gap = (centre - of_b.centre()).absolute() - of_b.half() - half;
    if (std::max({gap.x(), gap.y(), gap.z()}) > 0.0) return;
    if (of_a.right < 0 && of_b.right < 0) {
      found_.push_back({of_a.triangle, of_b.triangle});
    } else {
      next_.push_back({node_a, node_b});
    }
  };
  next_.clear();
  visit(0, 0);
  while (!next_.empty()) {
    if (frontier_.empty() && next_.size() + found_.size() > kFrontierPairs) {
      frontier_ = next_;
      before = found_.size();
    }
    if (next_.size() > 2 * max || found_.size() > max) break;
    std::swap(pairs_, next_);
    next_.clear();
    for (const Pair& pair : pairs_) {
      const FeatureMesh::Node &of_a = a.nodes[static_cast<std::size_t>(pair.a)],
                              &of_b = b.nodes[static_cast<std::size_t>(pair.b)];
      const bool split_a = of_b.right < 0 || (of_a.right >= 0 && of_a.half().length2() > of_b.half().length2());
      if (split_a) {
        visit(pair.a + 1, pair.b);
        visit(of_a.right, pair.b);
      } else {
        visit(pair.a, pair.b + 1);
        visit(pair.a, of_b.right);
      }
    }
    cost_ += 2 * kPairVisitCost * pairs_.size();
  }
  // Without a frontier they are few, whatever `max` says: one level of branches below it.
  const bool all = next_.empty() && (found_.size() <= max || frontier_.empty());
  if (!all) found_.resize(before);
  cost_ += kFeaturePairCost * found_.size();
  return all;
}

// Triangles of A whose boxes overlap the one given in A's frame. False if there are too many.
bool SurfaceContacts::find_triangles(const FeatureMesh& a, const btVector3& centre, const btVector3& half) {
  next_.clear();
  found_.clear();
  if (!a.nodes.empty()) next_.push_back({0, 0});
  while (!next_.empty()) {
    const Pair pair = next_.back();
    next_.pop_back();
    cost_ += kPairVisitCost;
    const FeatureMesh::Node& node = a.nodes[static_cast<std::size_t>(pair.a)];
    const btVector3 gap = (node.centre() - centre).absolute() - node.half() - half;
    if (gap.x() > 0.0 || gap.y() > 0.0 || gap.z() > 0.0) continue;
    if (node.right >= 0) {
      next_.push_back({node.right, 0});
      next_.push_back({pair.a + 1, 0});
      continue;
    }
    if (found_.size() == kMaxTrianglesInBox) return false;
    found_.push_back({node.triangle, 0});
  }
  return true;
}

// Triangles of A that may be within `reach` of B; of too many, the nearest and some of the rest.
void SurfaceContacts::find_near(const FeatureMesh& a, const btConvexShape& b, const btTransform& T_b_a, double reach) {
  btVector3 low, high;
  b.getAabb(btTransform::getIdentity(), low, high);
  const btVector3 middle = (low + high) * 0.5, half = (high - low) * 0.5;
  // What is left of B's box without the same thickness on all sides: a point in a ball, a line in a capsule, a sheet
  // in a plate.
  const double thickness = half[half.minAxis()];
  const btVector3 core = half - btVector3(thickness, thickness, thickness);
  // No more than the distance between the node and B.
  const auto gap = [&](const FeatureMesh::Node& node) {
    const btVector3 centre = T_b_a * node.centre(), away = centre - middle - clamped(centre - middle, core);
    const double distance = away.length();
    if (!(distance > 1e-9)) return -reach;
    const btVector3 direction = away / distance;
    return direction.dot(centre - b.localGetSupportingVertex(direction)) -
           (T_b_a.getBasis().transpose() * direction).absolute().dot(node.half());
  };
  const auto note = [&](std::vector<Near>& to, int node) {
    const double distance = gap(a.nodes[static_cast<std::size_t>(node)]);
    if (distance <= reach) to.push_back({node, distance});
  };
  near_.clear();
  leaves_.clear();
  if (!a.nodes.empty()) note(near_, 0);
  while (!near_.empty()) {
    keep_nearest(near_, 2 * kMaxGjkTriangles);
    nearer_.clear();
    for (const Near& at : near_) {
      const FeatureMesh::Node& node = a.nodes[static_cast<std::size_t>(at.node)];
      if (node.right < 0) {
        leaves_.push_back(at);
      } else {
        note(nearer_, at.node + 1);
        note(nearer_, node.right);
      }
    }
    cost_ += 2 * kPairVisitCost * near_.size();
    keep_nearest(leaves_, kMaxGjkTriangles);
    std::swap(near_, nearer_);
  }
  found_.clear();
  for (const Near& leaf : leaves_) found_.push_back({a.nodes[static_cast<std::size_t>(leaf.node)].triangle, 0});
}

void SurfaceContacts::keep_nearest(std::vector<Near>& all, std::size_t max) {
  if (all.size() <= max) return;
  const auto half = all.begin() + static_cast<std::ptrdiff_t>(max / 2);
  std::nth_element(all.begin(), half, all.end(), [](const Near& x, const Near& y) {
    return std::pair(x.distance, x.node) < std::pair(y.distance, y.node);
  });
  std::sort(half, all.end(), [](const Near& x, const Near& y) { return x.node < y.node; });
  const std::size_t stride = (all.size() - max / 2 + max / 2 - 1) / (max / 2);
  std::size_t kept = max / 2;
  for (std::size_t i = kept; i < all.size(); i += stride) all[kept++] = all[i];
  all.resize(kept);
}

void SurfaceContacts::add(const btVector3& point, const btVector3& normal, double distance, SurfaceVertex vertex) {
  if (!std::isfinite(distance)) return;  // of a body that is nowhere
  if (contacts_.size() == kMaxCandidates) {
    // The deeper half says more.
    const auto middle = contacts_.begin() + kMaxCandidates / 2;
    std::nth_element(contacts_.begin(), middle, contacts_.end(),
                     [](const SurfaceContact& x, const SurfaceContact& y) { return x.distance < y.distance; });
    contacts_.erase(middle, contacts_.end());
  }
  contacts_.push_back({point, normal, std::max(distance, -kMaxReportedDepth), vertex});
}

void SurfaceContacts::add_old(const SurfaceContact& contact) {
  for (const SurfaceContact& known : contacts_)
    if ((known.point - contact.point).length2() < 100.0 * kSamePoint * kSamePoint) return;
  add(contact.point, contact.normal, contact.distance);
}

void SurfaceContacts::touch(const FeatureMesh& a, const FeatureMesh& b, const btTransform& T_b_a, double reach,
                            bool& fine, std::span<const SurfaceVertex> known) {
  contacts_.clear();
  cost_ = 1;
  const Frame frame(T_b_a);
  const double range = std::max(reach + a.margin + b.margin, kMaxFeatureDepth);
  bool all = find_pairs(a, b, frame, range, fine ? kFrontierPairs : kMaxTrianglePairs);
  const bool hurried = !fine && budget_.hurried();
  fine = !all;
  const FeatureMesh *of_a = &a, *of_b = &b;
  if (!all) {
    of_a = &searched(a);
    of_b = &searched(b);
    if (of_a != &a || of_b != &b) all = find_pairs(*of_a, *of_b, frame, range, kMaxTrianglePairs);
  }
  FeaturePair pair(*of_a, *of_b, T_b_a, reach);
  const auto found = [this](const btVector3& point, const btVector3& normal, double distance) {
    add(point, normal, distance);
  };
  for (const Pair& at : found_) {
    pair.set(at.a, at.b);
    if (!pair.near()) continue;
    if (!b.box) pair.vertices_of_a(found);
    pair.vertices_of_b(found);
    pair.edges(found);
  }
  if (!all) {
    search(*of_a, *of_b, T_b_a, reach, hurried, known);
  } else if (b.box) {
    touch_solid(a, *b.box, frame, reach, known);
  }
}

// A box is known to be solid: a vertex anywhere inside knows the nearest way out.
void SurfaceContacts::touch_solid(const FeatureMesh& a, const btVector3& half, const Frame& frame, double reach,
                                  std::span<const SurfaceVertex> known) {
  const btTransform T_a_b = frame.T_b_a.inverse();
  const double far = reach + a.margin;
  const btVector3 around = T_a_b.getBasis().absolute() * (half + btVector3(far, far, far));
  if (!find_triangles(a, T_a_b.getOrigin(), around)) {
    begin_.assign(1, 0);
    search_solid(searched(a), half, frame.T_b_a, reach, known);
    return;
  }
  cost_ += kBoxTriangleCost * found_.size();
  for (const Pair& pair : found_) {
    const FeatureMesh::Triangle& triangle = a.triangles[static_cast<std::size_t>(pair.a)];
    for (std::size_t k = 0; k < 3; ++k) {
      if (!triangle.owns[k]) continue;
      const btVector3 at = frame.T_b_a * a.vertices[static_cast<std::size_t>(triangle.vertex[k])].at;
      const btVector3 nearest = clamped(at, half), outside = at - nearest;
      double distance = outside.length();
      if (distance > far) continue;
      btVector3 normal(0, 0, 0), point = nearest;
      if (distance > 1e-9) {
        normal = outside / distance;
      } else {
        const btVector3 inside = half - at.absolute();
        const int axis = inside.minAxis();
        normal[axis] = at[axis] < 0.0 ? -1.0 : 1.0;
        distance = -inside[axis];
        point[axis] = normal[axis] * half[axis];
      }
      add(point, normal, distance - a.margin);
    }
  }
}

void SurfaceContacts::touch(const FeatureMesh& a, const btConvexShape& b, const btTransform& T_b_a, double reach) {
  contacts_.clear();
  cost_ = 1;
  find_near(a, b, T_b_a, reach + a.margin);
  cost_ += kGjkCost * found_.size();

  // Takes what GJK finds for one triangle.
  struct Closest final : btDiscreteCollisionDetectorInterface::Result {
    Closest(SurfaceContacts& contacts, const FeatureMesh& mesh, const btTransform& transform, double within)
        : owner(contacts), a(mesh), T_b_a(transform), reach(within) {}
    void setShapeIdentifiersA(int, int) override {}
    void setShapeIdentifiersB(int, int) override {}
    void addContactPoint(const btVector3& normal, const btVector3& point, btScalar distance) override {
      if (distance > reach) return;
      const btVector3 on_a = T_b_a.invXform(point + normal * (distance + a.margin));
      if (outermost(a, *triangle, on_a, T_b_a.getBasis().transpose() * -normal)) owner.add(point, normal, distance);
    }
    SurfaceContacts& owner;
    const FeatureMesh& a;
    const btTransform& T_b_a;
    double reach;
    const FeatureMesh::Triangle* triangle = nullptr;
  } closest(*this, a, T_b_a, reach);
  btGjkPairDetector::ClosestPointInput input;
  input.m_transformA = T_b_a;
  input.m_transformB.setIdentity();
  const double range = reach + a.margin + b.getMargin();
  input.m_maximumDistanceSquared = range * range;
  for (const Pair& pair : found_) {
    const FeatureMesh::Triangle& triangle = a.triangles[static_cast<std::size_t>(pair.a)];
    btTriangleShape face(corner(a, triangle, 0), corner(a, triangle, 1), corner(a, triangle, 2));
    face.setMargin(a.margin);
    btGjkPairDetector detector(&face, &b, &simplex_, &depths_);
    closest.triangle = &triangle;
    detector.getClosestPoints(input, closest, nullptr);
  }
}

}  // namespace ambf::physics::detail
