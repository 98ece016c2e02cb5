// The surface of a body as its contacts see it: vertices, sharp edges and faces of a triangle mesh, each belonging to
// one triangle, in a tree of boxes. Built off the physics thread with its shape, then constant, except that
// for_search() makes a second surface on first use: any number of bodies and threads may read it. It knows no bodies
// and finds no contacts. Private to physics/. Metres, in the frame of the centre of mass.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "physics/detail/bullet.h"

namespace ambf::physics::detail {

inline btVector3 widened(const std::array<float, 3>& v) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

struct FeatureMesh : std::enable_shared_from_this<FeatureMesh> {
  struct Triangle {
    std::array<int, 3> vertex;
    std::array<int, 3> edge;        // from each vertex to the next, if it is convex or a rim's; -1: it is not
    std::array<bool, 3> owns;       // whether the vertex is looked at with this triangle: each is with one only
    std::array<bool, 3> owns_edge;  // likewise for sharp edges
    btVector3 normal;               // unit, outward
    bool sheet;                     // of a surface with two outsides: an open one, or a room
  };
  // Only convex edges and those of a rim can touch anything that faces do not touch first.
  struct Edge {
    btVector3 from, to;
    std::array<btVector3, 2> into;  // unit, across the edge into the faces that meet there; zero: no face
  };
  struct Vertex {
    btVector3 at, normal{0, 0, 0};  // outward, the mean of the faces by angle; zero on a sheet
    std::array<float, 3> axis{};    // the same, but also on a sheet, where it may as well be turned round
    float cone = -2.0F;  // what touches only this vertex comes from a direction whose cosine with the axis is no less,
    bool rim = false;    // unless this is where a surface ends: then it comes from anywhere
  };
  // Depth first: the left child of a branch follows it. In single precision, rounded outward: half as much memory to
  // walk through.
  struct Node {
    std::array<float, 3> middle, extent;  // of its box, the second from there to each side
    btVector3 centre() const { return widened(middle); }
    btVector3 half() const { return widened(extent); }
    int right = -1;  // child of a branch; -1: a leaf, of
    int triangle = -1;
  };

  // What is below a node of the tree, for searches among very many vertices; in single precision, for there are many.
  struct Patch {
    int vertex = -1;                // one of those that its triangles own, to speak for all; -1: they own none
    std::array<float, 3> normal{};  // mean
    float rise = 0, fall = 0;       // no vertex is farther above and below that one, along the normal, m
    float radius = 0;               // nor farther from it, m
    float spread =
        0;  // no triangle's normal differs more from the mean (length of the difference); 2: or it has two sides
  };

  std::vector<Vertex> vertices;
  std::vector<Triangle> triangles;
  std::vector<Edge> edges;
  std::vector<Node> nodes;           // empty without triangles
  std::vector<Patch> patches;        // one for each node
  std::vector<int> neighbours;       // vertices at the other ends of a vertex's edges, vertex by vertex
  std::vector<int> first_neighbour;  // of each vertex, in there; and the end

  std::span<const int> neighbours_of(int vertex) const {
    const auto v = static_cast<std::size_t>(vertex);
    const auto begin = static_cast<std::size_t>(first_neighbour[v]),
               end = static_cast<std::size_t>(first_neighbour[v + 1]);
    return std::span(neighbours).subspan(begin, end - begin);
  }
  double margin = 0.0;           // how far outside the triangles the surface is
  bool moving = true;            // of a moving body
  std::optional<btVector3> box;  // half extents, if the surface is that of a solid box

  // The surface that searches among very many triangles use: without long thin triangles where there are many of
  // them, else this one. The first call makes it, which takes up to some 50 ms and ten times the memory of this
  // surface: only few bodies ever touch where that is needed. Any thread; a second one waits for the first.
  const FeatureMesh& for_search() const;
  bool ready_for_search() const { return ready_.load(std::memory_order_acquire); }  // for_search() returns at once
  // True for one caller: the one who sees to it that for_search() is called.
  bool claim_preparation() const { return !claimed_.exchange(true, std::memory_order_relaxed); }
  void return_claim() const { claimed_.store(false, std::memory_order_relaxed); }

 private:
  mutable std::once_flag once_;
  mutable std::shared_ptr<const FeatureMesh> divided_;  // null: this surface itself serves searches
  mutable std::atomic<bool> ready_{false}, claimed_{false};
};

inline btVector3 mean_normal(const FeatureMesh::Patch& patch) { return widened(patch.normal); }

// Equal vertices are joined, triangles without area left out. Closed surfaces are turned outward, whatever their
// winding; but those of static bodies that face inward may be rooms.
std::shared_ptr<const FeatureMesh> make_feature_mesh(const std::vector<math::Vec3>& vertices,
                                                     const std::vector<std::array<int, 3>>& triangles, double margin,
                                                     bool moving);
std::shared_ptr<const FeatureMesh> make_feature_box(const btVector3& half_extents);

}  // namespace ambf::physics::detail
