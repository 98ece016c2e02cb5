#include "physics/detail/feature_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace ambf::physics::detail {

namespace {

// Sines of the angle by which two faces turn away from each other at an edge: from here it is not flat, and from here two such
// edges can meet before vertices and faces do.
constexpr double kConvexSine = 1e-4, kSharpSine = 0.03;
// Cracks between triangles are no rim: a surface is open if its rim is longer than this times the root of its area.
constexpr double kRimShare = 0.5;
constexpr double kConeSlack = 0.02, kPi = 3.141592653589793;  // rad

using Sides = std::vector<std::pair<int, int>>;  // triangle, which of its edges

class Builder {
 public:
  Builder(const std::vector<math::Vec3>& vertices, const std::vector<std::array<int, 3>>& triangles, bool moving)
      : moving_(moving) {
    weld(vertices, triangles);
    connect();
    orient();
    set_normals();
    share_out();
    list_neighbours();
    std::vector<int> order(mesh_->triangles.size());
    std::iota(order.begin(), order.end(), 0);
    if (!order.empty()) add_node(order, 0, order.size());
    make_patches();
  }
  std::shared_ptr<FeatureMesh> take() { return std::move(mesh_); }

 private:
  const btVector3& at(int triangle, int corner) const {
    const auto& t = mesh_->triangles[static_cast<std::size_t>(triangle)];
    return mesh_->vertices[static_cast<std::size_t>(t.vertex[static_cast<std::size_t>(corner % 3)])].at;
  }
  // Twice the area as a vector along the normal.
  btVector3 area(int triangle) const {
    return (at(triangle, 1) - at(triangle, 0)).cross(at(triangle, 2) - at(triangle, 0));
  }
  int count() const { return static_cast<int>(mesh_->triangles.size()); }
  FeatureMesh::Triangle& triangle(int i) { return mesh_->triangles[static_cast<std::size_t>(i)]; }

  void weld(const std::vector<math::Vec3>& vertices, const std::vector<std::array<int, 3>>& triangles) {
    std::map<std::tuple<double, double, double>, int> known;
    std::vector<int> place(vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const math::Vec3& v = vertices[i];
      const auto [entry, news] = known.try_emplace({v.x, v.y, v.z}, static_cast<int>(mesh_->vertices.size()));
      if (news) mesh_->vertices.push_back({.at = to_bullet(v)});
      place[i] = entry->second;
    }
    for (const auto& corners : triangles) {
      FeatureMesh::Triangle t{};
      for (std::size_t k = 0; k < 3; ++k) t.vertex[k] = place[static_cast<std::size_t>(corners[k])];
      mesh_->triangles.push_back(t);
      const int added = count() - 1;
      const double longest = std::max({(at(added, 1) - at(added, 0)).length2(), (at(added, 2) - at(added, 1)).length2(),
                                       (at(added, 0) - at(added, 2)).length2()});
      if (!(area(added).length() > 1e-9 * longest)) mesh_->triangles.pop_back();
    }
  }

  void connect() {
    for (int t = 0; t < count(); ++t)
      for (int k = 0; k < 3; ++k) {
        const int from = triangle(t).vertex[static_cast<std::size_t>(k)];
        const int to = triangle(t).vertex[static_cast<std::size_t>((k + 1) % 3)];
        sides_[{std::min(from, to), std::max(from, to)}].push_back({t, k});
      }
  }

  // Triangles that share an edge run along it in opposite directions. Surface by surface, then outward as a whole.
  void orient() {
    std::vector<bool> seen(mesh_->triangles.size());
    for (int start = 0; start < count(); ++start) {
      if (seen[static_cast<std::size_t>(start)]) continue;
      std::vector<int> surface{start};
      seen[static_cast<std::size_t>(start)] = true;
      double rim = 0.0;
      for (std::size_t i = 0; i < surface.size(); ++i)
        for (int k = 0; k < 3; ++k) rim += visit_neighbour(surface, surface[i], k, seen);
      double volume = 0.0, extent = 0.0;
      const btVector3 origin = at(start, 0);
      for (const int t : surface) {
        volume += area(t).dot(at(t, 0) - origin);
        extent += 0.5 * area(t).length();
      }
      const bool room = !moving_ && volume < 0.0;
      const bool sheet = room || rim > kRimShare * std::sqrt(extent);
      for (const int t : surface) {
        triangle(t).sheet = sheet;
        if (!sheet && volume < 0.0) std::swap(triangle(t).vertex[1], triangle(t).vertex[2]);
      }
    }
    // The edges of turned triangles are numbered differently.
    sides_.clear();
    connect();
  }

  // Returns the length of the edge if nobody or more than one triangle is beyond it.
  double visit_neighbour(std::vector<int>& surface, int t, int k, std::vector<bool>& seen) {
    const int from = triangle(t).vertex[static_cast<std::size_t>(k)];
    const int to = triangle(t).vertex[static_cast<std::size_t>((k + 1) % 3)];
    const Sides& sides = sides_[{std::min(from, to), std::max(from, to)}];
    if (sides.size() != 2) return (at(t, k + 1) - at(t, k)).length();
    const int other = sides[0].first == t ? sides[1].first : sides[0].first;
    if (seen[static_cast<std::size_t>(other)]) return 0.0;
    seen[static_cast<std::size_t>(other)] = true;
    surface.push_back(other);
    FeatureMesh::Triangle& neighbour = triangle(other);
    for (std::size_t i = 0; i < 3; ++i)
      if (neighbour.vertex[i] == from && neighbour.vertex[(i + 1) % 3] == to) {
        std::swap(neighbour.vertex[1], neighbour.vertex[2]);
        break;
      }
    return 0.0;
  }

  void set_normals() {
    std::vector<bool> sheet(mesh_->vertices.size());
    for (int t = 0; t < count(); ++t) {
      triangle(t).normal = area(t).normalized();
      for (int k = 0; k < 3; ++k) {
        const auto v = static_cast<std::size_t>(triangle(t).vertex[static_cast<std::size_t>(k)]);
        const double angle = (at(t, k + 1) - at(t, k)).angle(at(t, k + 2) - at(t, k));
        mesh_->vertices[v].normal += triangle(t).normal * angle;
        if (triangle(t).sheet) sheet[v] = true;
      }
    }
    for (std::size_t v = 0; v < sheet.size(); ++v) {
      FeatureMesh::Vertex& vertex = mesh_->vertices[v];
      const bool any = vertex.normal.length2() > 1e-12;
      if (any) vertex.normal.normalize();
      vertex.cone = any ? 1.0F : -2.0F;
      for (int k = 0; k < 3; ++k) vertex.axis[static_cast<std::size_t>(k)] = static_cast<float>(vertex.normal[k]);
      if (sheet[v] || !any) vertex.normal.setZero();
    }
    set_cones();
  }

  void set_cones() {
    const auto narrow = [this](int v, double cosine) {
      float& cone = mesh_->vertices[static_cast<std::size_t>(v)].cone;
      cone = std::min(cone, static_cast<float>(cosine));
    };
    for (int t = 0; t < count(); ++t)
      for (const int v : triangle(t).vertex)
        narrow(v, triangle(t).normal.dot(widened(mesh_->vertices[static_cast<std::size_t>(v)].axis)));
    for (const auto& [ends, sides] : sides_)
      if (sides.size() != 2)
        for (const int v : {ends.first, ends.second}) mesh_->vertices[static_cast<std::size_t>(v)].rim = true;
    for (FeatureMesh::Vertex& vertex : mesh_->vertices)
      if (vertex.cone > -1.0F)
        vertex.cone = static_cast<float>(
            std::cos(std::min(kPi, std::acos(std::min(1.0, static_cast<double>(vertex.cone))) + kConeSlack)));
  }

  // From the edge into the face, perpendicular to the edge.
  btVector3 into(int t, int k) const {
    const btVector3 along = (at(t, k + 1) - at(t, k)).normalized(), to_third = at(t, k + 2) - at(t, k);
    return (to_third - along * along.dot(to_third)).normalized();
  }

  void share_out() {
    std::vector<bool> taken(mesh_->vertices.size());
    for (int t = 0; t < count(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto v = static_cast<std::size_t>(triangle(t).vertex[k]);
        triangle(t).owns[k] = !taken[v];
        taken[v] = true;
        triangle(t).edge[k] = -1;
      }
    for (const auto& [ends, sides] : sides_) {
      const auto [t, k] = sides.front();
      FeatureMesh::Edge edge{at(t, k), at(t, k + 1), {into(t, k), btVector3(0, 0, 0)}};
      bool sharp = true;
      if (sides.size() > 2) edge.into[0].setZero();  // who knows what is inside
      if (sides.size() == 2) {
        edge.into[1] = into(sides[1].first, sides[1].second);
        const double turn = triangle(t).normal.dot(edge.into[1]);
        const double sine = triangle(t).sheet ? std::abs(turn) : -turn;
        // The edge of a blade, whose faces are back to back.
        const bool blade = edge.into[0].dot(edge.into[1]) > 0.0 && sine > -kConvexSine;
        if (sine < kConvexSine && !blade) continue;
        sharp = sine > kSharpSine || blade;
      }
      for (const auto& [around, side] : sides)
        triangle(around).edge[static_cast<std::size_t>(side)] = static_cast<int>(mesh_->edges.size());
      triangle(t).owns_edge[static_cast<std::size_t>(k)] = sharp;
      mesh_->edges.push_back(edge);
    }
  }

  static FeatureMesh::Node box_around(const btVector3& low, const btVector3& high) {
    constexpr double kRounding = 1e-6;  // some ten times what is lost
    FeatureMesh::Node node;
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(k);
      node.middle[i] = static_cast<float>(0.5 * (low[k] + high[k]));
      node.extent[i] =
          static_cast<float>(0.5 * (high[k] - low[k]) + kRounding * (std::abs(low[k]) + std::abs(high[k])));
    }
    return node;
  }

  void list_neighbours() {
    std::vector<int>& first = mesh_->first_neighbour;
    first.assign(mesh_->vertices.size() + 1, 0);
    for (const auto& [ends, sides] : sides_)
      for (const int v : {ends.first, ends.second}) ++first[static_cast<std::size_t>(v) + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    mesh_->neighbours.resize(static_cast<std::size_t>(first.back()));
    std::vector<int> next = first;
    const auto add = [&](int to, int other) {
      mesh_->neighbours[static_cast<std::size_t>(next[static_cast<std::size_t>(to)]++)] = other;
    };
    for (const auto& [ends, sides] : sides_) {
      add(ends.first, ends.second);
      add(ends.second, ends.first);
    }
  }

  void add_node(std::vector<int>& order, std::size_t begin, std::size_t end) {
    btVector3 low(1e300, 1e300, 1e300), high = -low, first = low, last = high;
    const auto centre = [this](int t) { return at(t, 0) + at(t, 1) + at(t, 2); };
    for (std::size_t i = begin; i < end; ++i) {
      for (int k = 0; k < 3; ++k) {
        low.setMin(at(order[i], k));
        high.setMax(at(order[i], k));
      }
      first.setMin(centre(order[i]));
      last.setMax(centre(order[i]));
    }
    const std::size_t here = mesh_->nodes.size();
    mesh_->nodes.push_back(box_around(low, high));
    if (end - begin == 1) {
      mesh_->nodes[here].triangle = order[begin];
      return;
    }
    const int axis = (last - first).maxAxis();
    const std::size_t middle = (begin + end) / 2;
    const auto before = [&](int a, int b) { return std::pair(centre(a)[axis], a) < std::pair(centre(b)[axis], b); };
    const auto start = order.begin();
    std::nth_element(start + static_cast<std::ptrdiff_t>(begin), start + static_cast<std::ptrdiff_t>(middle),
                     start + static_cast<std::ptrdiff_t>(end), before);
    add_node(order, begin, middle);
    mesh_->nodes[here].right = static_cast<int>(mesh_->nodes.size());
    add_node(order, middle, end);
  }

  // From the leaves up: children follow their parents.
  void make_patches() {
    mesh_->patches.resize(mesh_->nodes.size());
    std::vector<btVector3> areas(mesh_->nodes.size());
    for (std::size_t i = mesh_->nodes.size(); i-- > 0;) {
      const FeatureMesh::Node& node = mesh_->nodes[i];
      const bool leaf = node.right < 0;
      areas[i] = leaf ? area(node.triangle) : areas[i + 1] + areas[static_cast<std::size_t>(node.right)];
      btVector3 normal = areas[i];
      if (normal.length2() > 1e-30) normal.normalize();
      mesh_->patches[i] =
          leaf ? patch_of_leaf(node.triangle, normal)
               : merged(node, mesh_->patches[i + 1], mesh_->patches[static_cast<std::size_t>(node.right)], normal);
      mesh_->patches[i].spread = leaf ? leaf_spread(node.triangle, normal)
                                      : std::max(turned(normal, mesh_->patches[i + 1]),
                                                 turned(normal, mesh_->patches[static_cast<std::size_t>(node.right)]));
      for (int k = 0; k < 3; ++k) mesh_->patches[i].normal[static_cast<std::size_t>(k)] = static_cast<float>(normal[k]);
    }
  }

  void include(FeatureMesh::Patch& patch, const btVector3& normal, const btVector3& offset, double rise, double fall,
               double radius) const {
    const double along = normal.dot(offset);
    patch.rise = std::max(patch.rise, static_cast<float>(along + rise));
    patch.fall = std::max(patch.fall, static_cast<float>(fall - along));
    patch.radius = std::max(patch.radius, static_cast<float>(offset.length() + radius));
  }

  FeatureMesh::Patch patch_of_leaf(int t, const btVector3& normal) {
    FeatureMesh::Patch patch;
    int first = -1;
    for (int k = 0; k < 3; ++k) {
      if (!triangle(t).owns[static_cast<std::size_t>(k)]) continue;
      if (first < 0) {
        first = k;
        patch.vertex = triangle(t).vertex[static_cast<std::size_t>(k)];
      }
      include(patch, normal, at(t, k) - at(t, first), 0.0, 0.0, 0.0);
    }
    return patch;
  }

  float leaf_spread(int t, const btVector3& normal) {
    return triangle(t).sheet ? 2.0F : static_cast<float>((triangle(t).normal - normal).length());
  }
  static float turned(const btVector3& normal, const FeatureMesh::Patch& part) {
    return std::min(2.0F, static_cast<float>((normal - mean_normal(part)).length()) + part.spread);
  }

  // Of two patches' vertices the one nearer the middle speaks for both, so that what is known of it need not be found again.
  FeatureMesh::Patch merged(const FeatureMesh::Node& node, const FeatureMesh::Patch& left,
                            const FeatureMesh::Patch& right, const btVector3& normal) const {
    const auto place = [this](const FeatureMesh::Patch& p) {
      return mesh_->vertices[static_cast<std::size_t>(p.vertex)].at;
    };
    FeatureMesh::Patch patch;
    const bool of_left = right.vertex < 0 || (left.vertex >= 0 && (place(left) - node.centre()).length2() <=
                                                                      (place(right) - node.centre()).length2());
    patch.vertex = of_left ? left.vertex : right.vertex;
    if (patch.vertex < 0) return patch;
    const btVector3 origin = place(patch);
    for (const FeatureMesh::Patch* part : {&left, &right}) {
      if (part->vertex < 0) continue;
      const double r = static_cast<double>(part->radius), turned = (normal - mean_normal(*part)).length() * r;
      include(patch, normal, place(*part) - origin, std::min(r, static_cast<double>(part->rise) + turned),
              std::min(r, static_cast<double>(part->fall) + turned), r);
    }
    const double in_box = (origin - node.centre()).length() + node.half().length();
    patch.radius = std::min(patch.radius, static_cast<float>(in_box));
    return patch;
  }

  bool moving_;
  std::shared_ptr<FeatureMesh> mesh_ = std::make_shared<FeatureMesh>();
  std::map<std::pair<int, int>, Sides> sides_;
};

}  // namespace

std::shared_ptr<const FeatureMesh> make_feature_mesh(const std::vector<math::Vec3>& vertices,
                                                     const std::vector<std::array<int, 3>>& triangles, double margin,
                                                     bool moving) {
  auto mesh = Builder(vertices, triangles, moving).take();
  mesh->margin = margin;
  return mesh;
}

std::shared_ptr<const FeatureMesh> make_feature_box(const btVector3& half) {
  std::vector<math::Vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back({i & 1 ? half.x() : -half.x(), i & 2 ? half.y() : -half.y(), i & 4 ? half.z() : -half.z()});
  auto mesh = Builder(corners,
                      {{0, 1, 3},
                       {0, 3, 2},
                       {4, 5, 7},
                       {4, 7, 6},
                       {0, 1, 5},
                       {0, 5, 4},
                       {2, 3, 7},
                       {2, 7, 6},
                       {0, 2, 6},
                       {0, 6, 4},
                       {1, 3, 7},
                       {1, 7, 5}},
                      true)
                  .take();
  mesh->box = half;
  return mesh;
}

}  // namespace ambf::physics::detail
