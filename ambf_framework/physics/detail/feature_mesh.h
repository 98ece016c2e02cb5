// The surface of a body as its contacts see it: vertices, sharp edges and faces of a triangle mesh, each belonging to one triangle, in
// a tree of boxes. Built off the physics thread with its shape, then never changed: any number of bodies and threads may read it.
// It knows no bodies and finds no contacts. Private to physics/. Metres, in the frame of the centre of mass.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "physics/detail/bullet.h"

namespace ambf::physics::detail {

struct FeatureMesh {
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
    btVector3 at, normal;  // outward, the mean of the faces by angle; zero on a sheet
  };
  // Depth first: the left child of a branch follows it.
  struct Node {
    btVector3 centre, half;
    int right = -1;  // child of a branch; -1: a leaf, of
    int triangle = -1;
  };

  std::vector<Vertex> vertices;
  std::vector<Triangle> triangles;
  std::vector<Edge> edges;
  std::vector<Node> nodes;       // empty without triangles
  double margin = 0.0;           // how far outside the triangles the surface is
  std::optional<btVector3> box;  // half extents, if the surface is that of a solid box
};

// Equal vertices are joined, triangles without area left out. Closed surfaces are turned outward, whatever their winding; but those of
// static bodies that face inward may be rooms.
std::shared_ptr<const FeatureMesh> make_feature_mesh(const std::vector<math::Vec3>& vertices,
                                                     const std::vector<std::array<int, 3>>& triangles, double margin,
                                                     bool moving);
std::shared_ptr<const FeatureMesh> make_feature_box(const btVector3& half_extents);

}  // namespace ambf::physics::detail
