// How far one point of a body is above or below the surface of another: what a search among very many points asks.
// The nearest place of a mesh that faces the point, or of a solid box. Costs some 1 us for a mesh of any size. Keeps
// nothing but a reference. Private to physics/. Metres, in the frame of that surface.
#pragma once

#include "physics/meshes/detail/feature_mesh.h"

namespace ambf::physics::detail {

struct Probed {
  bool near = false;     // there is something within range, whether it is a contact or not
  bool touches = false;  // the rest is known
  bool sharp =
      false;  // the point is beside an edge or a corner: it counts only if its own surface agrees with the direction
  float cone = 2.0F;                          // how flat the surface is around there: the least of the vertices' cones
  double distance = 0.0;                      // m, to the triangles (margins not counted); negative: below
  btVector3 point{0, 0, 0}, normal{0, 0, 0};  // on the surface, and unit, out of it
};

class MeshProbe {
 public:
  static constexpr bool kFlat = false;  // what is seen from one point is so everywhere near it
  // `margins`: of both surfaces, m.
  MeshProbe(const FeatureMesh& mesh, double margins) : mesh_(mesh), margins_(margins) {}
  // `outward`: unit, of the other body at the point; zero: it is a sheet and has no outside. What is farther away
  // than `near_range` is sought up to `range`, and may be not quite the nearest.
  Probed probe(const btVector3& point, const btVector3& outward, double near_range, double range);
  std::size_t visits() const { return visits_; }  // of boxes and triangles, by all calls

 private:
  struct Nearest;
  bool all_face_away(int node, const btVector3& outward) const;
  void visit_triangle(int index, const btVector3& point, const btVector3& outward, Nearest& nearest) const;
  Probed judge(const Nearest& nearest, const btVector3& point, const btVector3& outward) const;

  const FeatureMesh& mesh_;
  double margins_;
  std::size_t visits_ = 0;
};

class BoxProbe {
 public:
  static constexpr bool kFlat = true;
  explicit BoxProbe(const btVector3& half) : half_(half) {}
  Probed probe(const btVector3& point, const btVector3& outward, double near_range, double range);
  std::size_t visits() const { return visits_; }

 private:
  btVector3 half_;
  std::size_t visits_ = 0;
};

}  // namespace ambf::physics::detail
