// Which triangles meet at which edge: made once for all edges of a mesh, in time linear in their number. Used while a
// shape is prepared, off the physics thread. Private to physics/.
#pragma once

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <vector>

#include "physics/meshes/detail/feature_mesh.h"

namespace ambf::physics::detail {

class EdgeTable {
 public:
  struct Side {
    int triangle, side;  // the edge from that corner to the next
  };
  struct Edge {
    int low, high;  // its vertices, the lower number first
    int begin;      // of its sides
  };

  // Edges are ordered by their vertices; the sides of each by triangle.
  EdgeTable(std::size_t vertices, const std::vector<FeatureMesh::Triangle>& triangles) : edge_of_(triangles.size()) {
    std::vector<int> first(vertices + 1, 0);
    for (const auto& t : triangles)
      for (std::size_t k = 0; k < 3; ++k) ++first[static_cast<std::size_t>(low(t, k)) + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    sides_.resize(3 * triangles.size());
    std::vector<int> next(first.begin(), first.end() - 1);
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        sides_[static_cast<std::size_t>(next[static_cast<std::size_t>(low(triangles[t], k))]++)] = {
            static_cast<int>(t), static_cast<int>(k)};
    edges_.reserve(3 * triangles.size() / 2 + 1);
    for (std::size_t v = 0; v < vertices; ++v) add_edges(static_cast<int>(v), first[v], first[v + 1], triangles);
    edges_.push_back({-1, -1, static_cast<int>(sides_.size())});
  }

  std::span<const Edge> edges() const { return std::span(edges_).first(edges_.size() - 1); }
  std::span<const Side> sides(const Edge& edge) const {
    const auto begin = static_cast<std::size_t>(edge.begin);
    return std::span(sides_).subspan(begin, static_cast<std::size_t>((&edge + 1)->begin) - begin);
  }
  const Edge& edge_of(int triangle, int side) const {
    const auto edge = edge_of_[static_cast<std::size_t>(triangle)][static_cast<std::size_t>(side)];
    return edges_[static_cast<std::size_t>(edge)];
  }
  // The triangle's second and third corner changed places. Its sides keep their old numbers.
  void turned(int triangle) {
    auto& edges = edge_of_[static_cast<std::size_t>(triangle)];
    std::swap(edges[0], edges[2]);
  }

 private:
  static int low(const FeatureMesh::Triangle& t, std::size_t k) { return std::min(t.vertex[k], t.vertex[(k + 1) % 3]); }
  static int high(const FeatureMesh::Triangle& t, std::size_t k) {
    return std::max(t.vertex[k], t.vertex[(k + 1) % 3]);
  }

  // Of the edges from one vertex to higher ones.
  void add_edges(int vertex, int begin, int end, const std::vector<FeatureMesh::Triangle>& triangles) {
    const auto far = [&](const Side& s) {
      return high(triangles[static_cast<std::size_t>(s.triangle)], static_cast<std::size_t>(s.side));
    };
    std::sort(sides_.begin() + begin, sides_.begin() + end, [&](const Side& a, const Side& b) {
      return std::array{far(a), a.triangle, a.side} < std::array{far(b), b.triangle, b.side};
    });
    for (int i = begin; i < end; ++i) {
      const Side& side = sides_[static_cast<std::size_t>(i)];
      if (i == begin || far(side) != edges_.back().high) edges_.push_back({vertex, far(side), i});
      edge_of_[static_cast<std::size_t>(side.triangle)][static_cast<std::size_t>(side.side)] =
          static_cast<int>(edges_.size()) - 1;
    }
  }

  std::vector<Side> sides_;
  std::vector<Edge> edges_;  // and one behind the last, where the sides end
  std::vector<std::array<int, 3>> edge_of_;
};

}  // namespace ambf::physics::detail
