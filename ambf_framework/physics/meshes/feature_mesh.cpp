#include "physics/meshes/detail/feature_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "mesh/weld.h"
#include "physics/meshes/detail/constants.h"
#include "physics/meshes/detail/edge_table.h"
#include "physics/meshes/detail/feature_tree.h"
#include "physics/meshes/detail/needles.h"

namespace ambf::physics::detail {

namespace {

class Builder {
 public:
  Builder(const std::vector<math::Vec3>& vertices, const std::vector<std::array<int, 3>>& triangles, bool moving)
      : moving_(moving) {
    weld(vertices, triangles);
    orient();
    set_normals();
    share_out();
    list_neighbours();
    make_tree(*mesh_);
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

  // The number of each vertex among the distinct ones, which are kept. What is hardly apart is joined, too: surfaces
  // that files cut along cracks would otherwise be all rims, which are solid nowhere.
  std::vector<int> join_near(const std::vector<math::Vec3>& vertices) {
    std::vector<int> place(vertices.size(), -1);
    std::vector<math::Vec3> sane;
    std::vector<std::size_t> from;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const math::Vec3& v = vertices[i];
      if (!(std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) < kMaxCoordinate)) continue;
      sane.push_back(v);
      from.push_back(i);
    }
    const mesh::Weld joined = mesh::weld(sane, kWeldDistance);
    mesh_->vertices.reserve(joined.distinct.size());
    for (const std::uint32_t i : joined.distinct) mesh_->vertices.push_back({.at = to_bullet(sane[i])});
    for (std::size_t i = 0; i < from.size(); ++i) place[from[i]] = static_cast<int>(joined.welded[i]);
    return place;
  }

  void weld(const std::vector<math::Vec3>& vertices, const std::vector<std::array<int, 3>>& triangles) {
    const std::vector<int> place = join_near(vertices);
    mesh_->triangles.reserve(triangles.size());
    for (const auto& corners : triangles) {
      FeatureMesh::Triangle t{};
      for (std::size_t k = 0; k < 3; ++k) t.vertex[k] = place[static_cast<std::size_t>(corners[k])];
      if (std::min({t.vertex[0], t.vertex[1], t.vertex[2]}) < 0) continue;
      mesh_->triangles.push_back(t);
      const int added = count() - 1;
      const double longest = std::max({(at(added, 1) - at(added, 0)).length2(), (at(added, 2) - at(added, 1)).length2(),
                                       (at(added, 0) - at(added, 2)).length2()});
      if (!(area(added).length() > 1e-9 * longest)) mesh_->triangles.pop_back();
    }
  }

  // Triangles that share an edge run along it in opposite directions. Surface by surface, then outward as a whole.
  void orient() {
    EdgeTable table(mesh_->vertices.size(), mesh_->triangles);
    std::vector<bool> seen(mesh_->triangles.size());
    for (int start = 0; start < count(); ++start) {
      if (seen[static_cast<std::size_t>(start)]) continue;
      std::vector<int> surface{start};
      seen[static_cast<std::size_t>(start)] = true;
      double rim = 0.0;
      for (std::size_t i = 0; i < surface.size(); ++i)
        for (int k = 0; k < 3; ++k) rim += visit_neighbour(table, surface, surface[i], k, seen);
      double volume = 0.0, extent = 0.0;
      const btVector3 origin = at(start, 0);
      for (const int t : surface) {
        volume += area(t).dot(at(t, 0) - origin);
        extent += 0.5 * area(t).length();
      }
      const bool room = !moving_ && volume < 0.0;
      const bool sheet = room || rim > kOpenRimRatio * std::sqrt(extent);
      for (const int t : surface) {
        triangle(t).sheet = sheet;
        if (!sheet && volume < 0.0) std::swap(triangle(t).vertex[1], triangle(t).vertex[2]);
      }
    }
    // The edges of turned triangles are numbered differently.
    table_.emplace(mesh_->vertices.size(), mesh_->triangles);
  }

  // Returns the length of the edge if nobody or more than one triangle is beyond it.
  double visit_neighbour(EdgeTable& table, std::vector<int>& surface, int t, int k, std::vector<bool>& seen) {
    const int from = triangle(t).vertex[static_cast<std::size_t>(k)];
    const int to = triangle(t).vertex[static_cast<std::size_t>((k + 1) % 3)];
    const std::span<const EdgeTable::Side> sides = table.sides(table.edge_of(t, k));
    if (sides.size() != 2) return (at(t, k + 1) - at(t, k)).length();
    const int other = sides[0].triangle == t ? sides[1].triangle : sides[0].triangle;
    if (seen[static_cast<std::size_t>(other)]) return 0.0;
    seen[static_cast<std::size_t>(other)] = true;
    surface.push_back(other);
    FeatureMesh::Triangle& neighbour = triangle(other);
    for (std::size_t i = 0; i < 3; ++i)
      if (neighbour.vertex[i] == from && neighbour.vertex[(i + 1) % 3] == to) {
        std::swap(neighbour.vertex[1], neighbour.vertex[2]);
        table.turned(other);
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
    for (const EdgeTable::Edge& edge : table_->edges())
      if (table_->sides(edge).size() != 2)
        for (const int v : {edge.low, edge.high}) mesh_->vertices[static_cast<std::size_t>(v)].rim = true;
    for (FeatureMesh::Vertex& vertex : mesh_->vertices)
      if (vertex.cone > -1.0F)
        vertex.cone = static_cast<float>(std::cos(
            std::min(std::numbers::pi, std::acos(std::min(1.0, static_cast<double>(vertex.cone))) + kConeSlack)));
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
    for (const EdgeTable::Edge& ends : table_->edges()) {
      const std::span<const EdgeTable::Side> sides = table_->sides(ends);
      const auto [t, k] = sides.front();
      FeatureMesh::Edge edge{at(t, k), at(t, k + 1), {into(t, k), btVector3(0, 0, 0)}};
      bool sharp = true;
      if (sides.size() > 2) edge.into[0].setZero();  // who knows what is inside
      if (sides.size() == 2) {
        edge.into[1] = into(sides[1].triangle, sides[1].side);
        const double turn = triangle(t).normal.dot(edge.into[1]);
        const double sine = triangle(t).sheet ? std::abs(turn) : -turn;
        // The edge of a blade, whose faces are back to back.
        const bool blade = edge.into[0].dot(edge.into[1]) > 0.0 && sine > -kConvexEdgeSine;
        if (sine < kConvexEdgeSine && !blade) continue;
        sharp = sine > kSharpEdgeSine || blade;
      }
      for (const auto& [around, side] : sides)
        triangle(around).edge[static_cast<std::size_t>(side)] = static_cast<int>(mesh_->edges.size());
      triangle(t).owns_edge[static_cast<std::size_t>(k)] = sharp;
      mesh_->edges.push_back(edge);
    }
  }

  void list_neighbours() {
    std::vector<int>& first = mesh_->first_neighbour;
    first.assign(mesh_->vertices.size() + 1, 0);
    for (const EdgeTable::Edge& edge : table_->edges())
      for (const int v : {edge.low, edge.high}) ++first[static_cast<std::size_t>(v) + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    mesh_->neighbours.resize(static_cast<std::size_t>(first.back()));
    std::vector<int> next = first;
    const auto add = [&](int to, int other) {
      mesh_->neighbours[static_cast<std::size_t>(next[static_cast<std::size_t>(to)]++)] = other;
    };
    for (const EdgeTable::Edge& edge : table_->edges()) {
      add(edge.low, edge.high);
      add(edge.high, edge.low);
    }
  }

  bool moving_;
  std::shared_ptr<FeatureMesh> mesh_ = std::make_shared<FeatureMesh>();
  std::optional<EdgeTable> table_;
};

}  // namespace

std::shared_ptr<const FeatureMesh> make_feature_mesh(const std::vector<math::Vec3>& vertices,
                                                     const std::vector<std::array<int, 3>>& triangles, double margin,
                                                     bool moving) {
  auto mesh = Builder(vertices, triangles, moving).take();
  mesh->margin = margin;
  mesh->moving = moving;
  return mesh;
}

const FeatureMesh& FeatureMesh::for_search() const {
  std::call_once(once_, [this] {
    if (const std::optional<DividedSurface> surface = divide_needles(*this)) {
      auto divided = Builder(surface->vertices, surface->triangles, moving).take();
      divided->margin = margin;
      divided_ = std::move(divided);
    }
    ready_.store(true, std::memory_order_release);
  });
  return divided_ ? *divided_ : *this;
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
