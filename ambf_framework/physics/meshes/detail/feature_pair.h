// Where the features of two triangles touch: a vertex above a face, or an edge across an edge. Private to physics/.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "physics/meshes/detail/constants.h"
#include "physics/meshes/detail/feature_mesh.h"

namespace ambf::physics::detail {

// One triangle in the frame of B.
struct Placed {
  int index = -1;
  std::array<btVector3, 3> at;
  btVector3 normal;
};

inline bool above(const btVector3& point, const std::array<btVector3, 3>& face, const btVector3& normal) {
  for (std::size_t k = 0; k < 3; ++k) {
    const btVector3 side = face[(k + 1) % 3] - face[k];
    if (normal.cross(side).dot(point - face[k]) < -kFaceOverhang * side.length()) return false;
  }
  return true;
}

inline const btVector3& corner(const FeatureMesh& mesh, const FeatureMesh::Triangle& triangle, std::size_t k) {
  return mesh.vertices[static_cast<std::size_t>(triangle.vertex[k % 3])].at;
}

inline bool leans_over(const btVector3& direction, const std::array<btVector3, 2>& faces) {
  return direction.dot(faces[0]) > kConeSine || direction.dot(faces[1]) > kConeSine;
}

// Whether something that touches a triangle there, from that direction, touches no other triangle first.
inline bool outermost(const FeatureMesh& mesh, const FeatureMesh::Triangle& triangle, const btVector3& point,
                      const btVector3& direction) {
  const double cosine = direction.dot(triangle.normal);
  if ((triangle.sheet ? std::abs(cosine) : cosine) > kFaceDirectionCosine) return true;
  if (!triangle.sheet && cosine < -kFacingCosine) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    const btVector3 &from = corner(mesh, triangle, k), side = corner(mesh, triangle, k + 1) - from;
    if ((point - from).cross(side).length2() > kEdgeDistance * kEdgeDistance * side.length2()) continue;
    if (triangle.edge[k] < 0) return false;
    if (leans_over(direction, mesh.edges[static_cast<std::size_t>(triangle.edge[k])].into)) return false;
  }
  return true;
}

// The features of one triangle of A and one of B.
class FeaturePair {
 public:
  FeaturePair(const FeatureMesh& a, const FeatureMesh& b, const btTransform& T_b_a, double reach)
      : a_(a), b_(b), T_b_a_(T_b_a), margins_(a.margin + b.margin), reach_(reach + margins_) {}

  void set(int triangle_a, int triangle_b) {
    if (first_.index != triangle_a) {
      first_.index = triangle_a;
      of_a_ = &a_.triangles[static_cast<std::size_t>(triangle_a)];
      for (std::size_t k = 0; k < 3; ++k) first_.at[k] = T_b_a_ * vertex(a_, of_a_->vertex[k]).at;
      first_.normal = T_b_a_.getBasis() * of_a_->normal;
    }
    second_.index = triangle_b;
    of_b_ = &b_.triangles[static_cast<std::size_t>(triangle_b)];
    for (std::size_t k = 0; k < 3; ++k) second_.at[k] = vertex(b_, of_b_->vertex[k]).at;
    second_.normal = of_b_->normal;
  }

  // Neither is all on one side of the other, out of reach.
  bool near() const { return near(first_, second_, of_b_->sheet) && near(second_, first_, of_a_->sheet); }

  template <class Add>
  void vertices_of_a(Add&& add) const {
    for (std::size_t k = 0; k < 3; ++k) {
      if (!of_a_->owns[k]) continue;
      const btVector3 outward = T_b_a_.getBasis() * vertex(a_, of_a_->vertex[k]).normal;
      on_face(first_.at[k], outward, first_, second_, of_b_->sheet, [&](const btVector3& normal, double distance) {
        add(first_.at[k] - normal * (distance - b_.margin), normal, distance - margins_);
      });
    }
  }
  template <class Add>
  void vertices_of_b(Add&& add) const {
    for (std::size_t k = 0; k < 3; ++k) {
      if (!of_b_->owns[k]) continue;
      on_face(second_.at[k], vertex(b_, of_b_->vertex[k]).normal, second_, first_, of_a_->sheet,
              [&](const btVector3& normal, double distance) {
                add(second_.at[k] + -normal * b_.margin, -normal, distance - margins_);
              });
    }
  }

  template <class Add>
  void edges(Add&& add) const {
    for (std::size_t i = 0; i < 3; ++i) {
      if (!of_a_->owns_edge[i]) continue;
      for (std::size_t k = 0; k < 3; ++k)
        if (of_b_->owns_edge[k])
          cross(a_.edges[static_cast<std::size_t>(of_a_->edge[i])], b_.edges[static_cast<std::size_t>(of_b_->edge[k])],
                add);
    }
  }

 private:
  static const FeatureMesh::Vertex& vertex(const FeatureMesh& mesh, int i) {
    return mesh.vertices[static_cast<std::size_t>(i)];
  }

  bool near(const Placed& points, const Placed& face, bool sheet) const {
    double low = 1e300, high = -1e300;
    for (const btVector3& point : points.at) {
      const double height = face.normal.dot(point - face.at[0]);
      low = std::min(low, height);
      high = std::max(high, height);
    }
    return low <= reach_ && high >= (sheet ? -reach_ : -kMaxFeatureDepth);
  }

  // A vertex of `own` above, or little below, another face. `outward`: at the vertex, zero if that has no outside.
  template <class Found>
  void on_face(const btVector3& point, const btVector3& outward, const Placed& own, const Placed& face, bool sheet,
               Found&& found) const {
    btVector3 normal = face.normal;
    if (sheet) {
      // From whichever side the other surface comes.
      const btVector3 middle = (own.at[0] + own.at[1] + own.at[2]) / 3.0;
      const double side = outward.isZero() ? (middle - face.at[0]).dot(normal) : -outward.dot(normal);
      if (side < 0.0) normal = -normal;
    }
    const double distance = normal.dot(point - face.at[0]);
    if (distance > reach_ || distance < -kMaxFeatureDepth || outward.dot(normal) > kFacingCosine) return;
    if (sheet && !outward.isZero() &&
        (distance < -std::max(margins_, kSheetDepth) || outward.dot(normal) > -kSheetFacing))
      return;
    // What has no outside and is all below this face may as well be above another one, beyond.
    if (!sheet && outward.isZero() && std::all_of(own.at.begin(), own.at.end(), [&](const btVector3& corner) {
          return normal.dot(corner - face.at[0]) < 0.0;
        }))
      return;
    if (above(point, face.at, face.normal)) found(normal, distance);
  }

  template <class Add>
  void cross(const FeatureMesh::Edge& of_a, const FeatureMesh::Edge& of_b, Add&& add) const {
    const btVector3 start = T_b_a_ * of_a.from, along = T_b_a_.getBasis() * (of_a.to - of_a.from);
    const btVector3 along_b = of_b.to - of_b.from, between = start - of_b.from;
    const double aa = along.length2(), bb = along_b.length2(), ab = along.dot(along_b);
    const double denominator = aa * bb - ab * ab;
    if (!(denominator > 1e-6 * aa * bb)) return;  // parallel: their vertices touch faces or other edges
    const double ra = along.dot(between), rb = along_b.dot(between);
    const double s = (ab * rb - bb * ra) / denominator, t = (aa * rb - ab * ra) / denominator;
    if (s < 0.0 || s > 1.0 || t < 0.0 || t > 1.0) return;
    const btVector3 on_a = start + along * s, on_b = of_b.from + along_b * t;
    btVector3 normal = along.cross(along_b) / std::sqrt(denominator);
    const std::array<btVector3, 2> faces_a{T_b_a_.getBasis() * of_a.into[0], T_b_a_.getBasis() * of_a.into[1]};
    const auto outermost = [&] { return !leans_over(normal, of_b.into) && !leans_over(-normal, faces_a); };
    // Two rims may meet from either side.
    if (normal.dot(on_a - on_b) < 0.0) normal = -normal;
    if (!outermost()) {
      normal = -normal;
      if (!outermost()) return;
    }
    const double distance = normal.dot(on_a - on_b);
    if (distance > reach_ || distance < -kMaxFeatureDepth) return;
    add(on_b + normal * b_.margin, normal, distance - margins_);
  }

  const FeatureMesh &a_, &b_;
  const btTransform& T_b_a_;
  double margins_, reach_;
  const FeatureMesh::Triangle *of_a_ = nullptr, *of_b_ = nullptr;
  Placed first_, second_;
};

}  // namespace ambf::physics::detail
