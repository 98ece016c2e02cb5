#include "physics/meshes/detail/needles.h"

#include <algorithm>

#include "physics/meshes/detail/constants.h"
#include "physics/meshes/detail/edge_table.h"
#include "physics/meshes/detail/feature_pair.h"

namespace ambf::physics::detail {

namespace {

class Divider {
 public:
  explicit Divider(const FeatureMesh& mesh) : triangles_(mesh.triangles) {
    at_.reserve(mesh.vertices.size());
    for (const auto& v : mesh.vertices) at_.push_back(v.at);
    for (const auto& t : triangles_) beside_edge_.push_back(is_needle_beside_edge(t));
  }

  std::optional<DividedSurface> run() {
    const std::size_t before = triangles_.size();
    const auto needles = static_cast<std::size_t>(std::count(beside_edge_.begin(), beside_edge_.end(), true));
    if (needles < kMinNeedles + before / kTrianglesPerNeedle) return {};
    for (int i = 0; i < kMaxHalvings && triangles_.size() < before + kMaxAddedTriangles / 2 && halve(); ++i) {
    }
    if (triangles_.size() == before) return {};
    DividedSurface result;
    for (const btVector3& v : at_) result.vertices.push_back(from_bullet(v));
    for (const auto& t : triangles_) result.triangles.push_back(t.vertex);
    return result;
  }

 private:
  const btVector3& at(const FeatureMesh::Triangle& t, std::size_t k) const {
    return at_[static_cast<std::size_t>(t.vertex[k % 3])];
  }
  double side(const FeatureMesh::Triangle& t, std::size_t k) const { return (at(t, k + 1) - at(t, k)).length(); }

  // 0: it is none.
  double needle_length(const FeatureMesh::Triangle& t) const {
    const double longest = std::max({side(t, 0), side(t, 1), side(t, 2)});
    const double height = (at(t, 1) - at(t, 0)).cross(at(t, 2) - at(t, 0)).length() / longest;
    return height < kNeedleHeight && longest > std::max(kMinNeedleLength, kNeedleSlenderness * height) ? longest : 0.0;
  }
  // The fans of a flat cap are not.
  bool is_needle_beside_edge(const FeatureMesh::Triangle& t) const {
    const double length = needle_length(t);
    for (std::size_t k = 0; length > 0.0 && k < 3; ++k)
      if (t.edge[k] >= 0 && side(t, k) > kLongSideRatio * length) return true;
    return false;
  }

  // Halves the long edges between needles. False if there are none.
  bool halve() {
    const EdgeTable table(at_.size(), triangles_);
    const std::size_t before = at_.size();
    const std::vector<int> middles = halve_edges(table);
    if (at_.size() == before) return false;
    std::vector<FeatureMesh::Triangle> whole = std::move(triangles_);
    const std::vector<bool> beside = std::move(beside_edge_);
    triangles_.clear();
    beside_edge_.clear();
    for (std::size_t t = 0; t < whole.size(); ++t) {
      std::array<int, 3> middle{};
      for (std::size_t k = 0; k < 3; ++k)
        middle[k] = middles[static_cast<std::size_t>(&table.edge_of(static_cast<int>(t), static_cast<int>(k)) -
                                                     table.edges().data())];
      divide(whole[t].vertex, middle);
      beside_edge_.resize(triangles_.size(), beside[t]);
    }
    return true;
  }

  // The new vertex on each edge; -1: it stays whole.
  std::vector<int> halve_edges(const EdgeTable& table) {
    std::vector<int> middle(table.edges().size(), -1);
    for (std::size_t e = 0; e < middle.size(); ++e) {
      const EdgeTable::Edge& edge = table.edges()[e];
      const std::span<const EdgeTable::Side> sides = table.sides(edge);
      const bool cut = std::all_of(sides.begin(), sides.end(), [this](const EdgeTable::Side& s) {
        const auto i = static_cast<std::size_t>(s.triangle);
        const double length = beside_edge_[i] ? needle_length(triangles_[i]) : 0.0;
        return length > 0.0 && side(triangles_[i], static_cast<std::size_t>(s.side)) > kLongSideRatio * length;
      });
      if (!cut) continue;
      middle[e] = static_cast<int>(at_.size());
      const btVector3 sum = at_[static_cast<std::size_t>(edge.low)] + at_[static_cast<std::size_t>(edge.high)];
      at_.push_back(sum * 0.5);
    }
    return middle;
  }

  // v: corners; m: the middles of the sides from each to the next.
  void divide(const std::array<int, 3>& v, const std::array<int, 3>& m) {
    const auto add = [this](int a, int b, int c) {
      FeatureMesh::Triangle t{};
      t.vertex = {a, b, c};
      triangles_.push_back(t);
    };
    const auto cuts = std::count_if(m.begin(), m.end(), [](int middle) { return middle >= 0; });
    if (cuts == 0) add(v[0], v[1], v[2]);
    if (cuts == 3) add(m[0], m[1], m[2]);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3, last = (k + 2) % 3;
      if (cuts == 3) add(v[k], m[k], m[last]);
      if (cuts == 1 && m[k] >= 0) {
        add(v[k], m[k], v[last]);
        add(m[k], v[next], v[last]);
      }
      if (cuts == 2 && m[last] < 0) {
        add(m[k], v[next], m[next]);
        add(v[k], m[k], m[next]);
        add(v[k], m[next], v[last]);
      }
    }
  }

  std::vector<btVector3> at_;
  std::vector<FeatureMesh::Triangle> triangles_;
  std::vector<bool> beside_edge_;  // of each triangle: it is part of a needle beside a convex edge
};

}  // namespace

std::optional<DividedSurface> divide_needles(const FeatureMesh& mesh) { return Divider(mesh).run(); }

}  // namespace ambf::physics::detail
