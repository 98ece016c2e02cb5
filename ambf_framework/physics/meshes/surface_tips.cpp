#include "physics/meshes/surface_tips.h"

#include <algorithm>
#include <cmath>

#include "physics/meshes/detail/attached_surface.h"

namespace ambf::physics::detail {

namespace {

constexpr float kFlatCone = 0.9997F;  // cosine: a vertex with a wider cone (feature_mesh.h) is in a plane
constexpr int kRimPlaces = 16;        // of the rim of a cylinder or cone
constexpr std::uint64_t kEdge = std::uint64_t{1} << 20;

class Finder {
 public:
  Finder(const TipSearch& search, std::vector<SurfaceTip>& found) : search_(search), found_(found) {}

  void add(const btVector3& at, double radius, std::uint64_t number) {
    for (int axis = 0; axis < 3; ++axis)
      if (!(at[axis] >= search_.low[axis] - radius && at[axis] <= search_.high[axis] + radius)) return;
    if (found_.size() == found_.capacity()) {
      fits_ = false;
      return;
    }
    found_.push_back({at, radius, number});
  }
  // Between the ends, which are corners.
  void add_edge(const btVector3& from, const btVector3& to, double radius, std::uint64_t edge) {
    const btVector3 along = to - from;
    const double places = std::min(std::ceil(along.length() / search_.spacing), static_cast<double>(kEdge - 1));
    double first = 0.0, last = 1.0;  // of the way, within the box
    for (int axis = 0; axis < 3; ++axis) {
      const double low = search_.low[axis] - radius - from[axis], high = search_.high[axis] + radius - from[axis];
      if (std::abs(along[axis]) < 1e-12) {
        if (low > 0.0 || high < 0.0) return;
        continue;
      }
      const double a = low / along[axis], b = high / along[axis];
      first = std::max(first, std::min(a, b)), last = std::min(last, std::max(a, b));
    }
    if (!(first <= last)) return;
    const auto begin = static_cast<std::uint64_t>(std::max(1.0, std::ceil(first * places)));
    const auto end = static_cast<std::uint64_t>(std::max(0.0, std::min(places - 1.0, std::floor(last * places))));
    for (std::uint64_t i = begin; i <= end && fits_; ++i)
      add(from + along * (static_cast<double>(i) / places), radius, kEdge * (edge + 1) + i);
  }
  bool fits() const { return fits_; }
  const TipSearch& search() const { return search_; }

 private:
  const TipSearch& search_;
  std::vector<SurfaceTip>& found_;
  bool fits_ = true;
};

// A line of balls.
void add_line(const btVector3& from, const btVector3& to, double radius, Finder& finder) {
  if (radius >= finder.search().blunt) return;
  finder.add(from, radius, 0);
  finder.add(to, radius, 1);
  finder.add_edge(from, to, radius, 0);
}

void add_rim(const btVector3& middle, int axis, double ring, double margin, std::uint64_t number, Finder& finder) {
  for (int i = 0; i < kRimPlaces; ++i) {
    const double angle = SIMD_2_PI * i / kRimPlaces;
    btVector3 at = middle;
    at[(axis + 1) % 3] += ring * std::cos(angle);
    at[(axis + 2) % 3] += ring * std::sin(angle);
    finder.add(at, margin, number + static_cast<std::uint64_t>(i));
  }
}

void add_mesh(const FeatureMesh& mesh, Finder& finder) {
  const btVector3 around(mesh.margin, mesh.margin, mesh.margin);
  const btVector3 low = finder.search().low - around, high = finder.search().high + around;
  std::array<int, 64> stack{};
  std::size_t waiting = 0;
  if (!mesh.nodes.empty()) stack[waiting++] = 0;
  while (waiting > 0 && finder.fits()) {
    const int here = stack[--waiting];
    const FeatureMesh::Node& node = mesh.nodes[static_cast<std::size_t>(here)];
    const btVector3 least = node.centre() - node.half(), most = node.centre() + node.half();
    if (!TestAabbAgainstAabb2(least, most, low, high)) continue;
    if (node.right >= 0) {
      if (waiting + 2 <= stack.size()) stack[waiting++] = node.right, stack[waiting++] = here + 1;
      continue;
    }
    const FeatureMesh::Triangle& triangle = mesh.triangles[static_cast<std::size_t>(node.triangle)];
    for (std::size_t k = 0; k < 3; ++k) {
      const FeatureMesh::Vertex& vertex = mesh.vertices[static_cast<std::size_t>(triangle.vertex[k])];
      if (triangle.owns[k] && (vertex.rim || vertex.cone < kFlatCone))
        finder.add(vertex.at, mesh.margin, static_cast<std::uint64_t>(triangle.vertex[k]));
      if (!triangle.owns_edge[k] || triangle.edge[k] < 0) continue;
      const FeatureMesh::Edge& edge = mesh.edges[static_cast<std::size_t>(triangle.edge[k])];
      finder.add_edge(edge.from, edge.to, mesh.margin, static_cast<std::uint64_t>(triangle.edge[k]));
    }
  }
}

void add_convex(const btCollisionShape& shape, const std::vector<std::array<btVector3, 2>>& edges, Finder& finder) {
  switch (shape.getShapeType()) {
    case SPHERE_SHAPE_PROXYTYPE: {
      const auto& sphere = static_cast<const btSphereShape&>(shape);
      if (sphere.getRadius() < finder.search().blunt) finder.add({0, 0, 0}, sphere.getRadius(), 0);
      break;
    }
    case CAPSULE_SHAPE_PROXYTYPE: {
      const auto& capsule = static_cast<const btCapsuleShape&>(shape);
      btVector3 end(0, 0, 0);
      end[capsule.getUpAxis()] = capsule.getHalfHeight();
      add_line(-end, end, capsule.getRadius(), finder);
      break;
    }
    case CYLINDER_SHAPE_PROXYTYPE: {
      const auto& cylinder = static_cast<const btCylinderShape&>(shape);
      const int axis = cylinder.getUpAxis();
      const double radius = cylinder.getRadius(), half = cylinder.getHalfExtentsWithMargin()[axis];
      btVector3 end(0, 0, 0);
      end[axis] = half;
      add_rim(end, axis, radius, 0.0, 2, finder);
      add_rim(-end, axis, radius, 0.0, 2 + kRimPlaces, finder);
      end[axis] = std::max(0.0, half - radius);
      add_line(-end, end, std::min(radius, half), finder);
      break;
    }
    case CONE_SHAPE_PROXYTYPE: {
      const auto& cone = static_cast<const btConeShape&>(shape);
      const int axis = cone.getConeUpIndex();
      btVector3 end(0, 0, 0);
      end[axis] = 0.5 * cone.getHeight();
      finder.add(end, cone.getMargin(), 0);
      add_rim(-end, axis, cone.getRadius(), cone.getMargin(), 2, finder);
      break;
    }
    case CONVEX_HULL_SHAPE_PROXYTYPE: {
      const auto& hull = static_cast<const btConvexHullShape&>(shape);
      for (int i = 0; i < hull.getNumPoints(); ++i)
        finder.add(hull.getScaledPoint(i), hull.getMargin(), static_cast<std::uint64_t>(i));
      for (std::size_t i = 0; i < edges.size(); ++i) finder.add_edge(edges[i][0], edges[i][1], hull.getMargin(), i);
      break;
    }
    default: break;
  }
}

}  // namespace

bool find_tips(const btCollisionShape& shape, const std::vector<std::array<btVector3, 2>>& edges,
               const TipSearch& search, std::vector<SurfaceTip>& found) {
  Finder finder(search, found);
  if (const FeatureMesh* mesh = attached_surface(shape); mesh != nullptr)
    add_mesh(*mesh, finder);
  else
    add_convex(shape, edges, finder);
  return finder.fits();
}

}  // namespace ambf::physics::detail
