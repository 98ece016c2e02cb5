// Collision shapes. A Shape is immutable and shared: it is built off the physics thread (by the loader), handed to
// bodies, and freed off the physics thread. The same mesh with the same placement gives the same Shape, whatever the
// number of bodies. Never moves, never draws. SI units; offsets are in the body (mesh) frame, and T_body_com moves
// them into the frame of the centre of mass: child = inv(T_body_com) * offset.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "math/types.h"
#include "mesh/mesh.h"
#include "scene/description.h"

namespace ambf::physics {

namespace detail {
struct ShapeData;
struct MeshSourceData;
}  // namespace detail

struct BoundingBox {
  math::Vec3 min, max;  // m
};

// Shared by all shapes.
struct ShapeOptions {
  math::Pose T_body_com;  // where the centre of mass is in the body frame
  double margin = 0.001;  // m, collision margin
  double scale = 1.0;     // of dimensions and mesh vertices; offsets are taken as they are
  bool moving =
      true;  // false for static bodies: concave meshes are then kept as bounding-volume trees, which are cheap
  int hull_points = 64;     // a hull keeps at most so many points: queries are linear in them
  int convex_points = 256;  // likewise for `convex mesh`
};

class Shape {
 public:
  explicit Shape(std::unique_ptr<detail::ShapeData> data);
  ~Shape();
  Shape(const Shape&) = delete;
  Shape& operator=(const Shape&) = delete;

  bool empty() const;          // collides with nothing
  bool concave() const;        // a triangle mesh
  bool infinite() const;       // contains a plane
  BoundingBox bounds() const;  // in the COM frame, margin included
  math::Vec3 inertia(
      double mass) const;  // principal, kg m^2, about the COM-frame axes; zero where the shape gives none
  detail::ShapeData& data() const { return *data_; }

 private:
  std::unique_ptr<detail::ShapeData> data_;
};

using SharedShape = std::shared_ptr<const Shape>;

// Triangles of one mesh (all its parts), kept once however many shapes are made of it, and as long as the source.
// Thread-safe; never on the physics thread.
class MeshSource {
 public:
  MeshSource(std::vector<math::Vec3> vertices, const std::vector<std::array<std::uint32_t, 3>>& triangles);
  // All sources of one mesh, those of other worlds too, share what is constant of their shapes.
  explicit MeshSource(std::shared_ptr<const mesh::CollisionMesh> mesh);
  ~MeshSource();
  MeshSource(const MeshSource&) = delete;
  MeshSource& operator=(const MeshSource&) = delete;

  // `offset`: the mesh's pose in the body frame. Equal arguments give the same Shape as long as anybody holds it.
  // A hull or convex mesh of a flat mesh is still a hull; a mesh without vertices gives the empty shape.
  SharedShape shape(scene::CollisionMeshType type, const math::Pose& offset, const ShapeOptions& options) const;
  bool in_use() const;  // somebody holds a shape of it

 private:
  std::unique_ptr<detail::MeshSourceData> data_;
};

// Primitives, and hulls that MeshSource made with the same options and their own offset. One plane alone is used
// directly (soft bodies need that), one primitive without offset and one hull too; everything else becomes a compound.
// No parts: the empty shape.
SharedShape make_shape(const std::vector<scene::PlacedGeometry>& parts, const ShapeOptions& options,
                       const std::vector<SharedShape>& hulls = {});
SharedShape make_empty_shape();

}  // namespace ambf::physics
