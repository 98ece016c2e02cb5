// Shapes of triangle meshes: hulls, convex meshes, triangle meshes (static: a tree of boxes; moving: GImpact), point
// clouds.
#include <algorithm>
#include <map>
#include <mutex>

#include "mesh/hull.h"
#include "mesh/mesh.h"
#include "physics/detail/bullet.h"
#include "physics/detail/shape_data.h"
#include "physics/shape.h"

namespace ambf::physics {

using detail::ShapeData;
using detail::to_bullet;

namespace {

// Everything that distinguishes one shape of a mesh from another.
struct Variant {
  scene::CollisionMeshType type;
  math::Pose T_com_mesh;
  double scale, margin;
  bool moving;
  int max_points;
  bool operator==(const Variant& other) const {
    return type == other.type && T_com_mesh == other.T_com_mesh && scale == other.scale && margin == other.margin &&
           moving == other.moving && max_points == other.max_points;
  }
};

// Vertices and indices as Bullet reads them in place.
struct PlacedMesh {
  std::vector<double> vertices;  // xyz
  std::vector<int> indices;
};

}  // namespace

namespace detail {

struct MeshSourceData {
  std::shared_ptr<const mesh::CollisionMesh> mesh;
  struct Made {
    Variant variant;
    std::weak_ptr<const Shape> shape;
  };
  std::mutex mutex;
  std::vector<Made> made;
};

}  // namespace detail

namespace {

math::Vec3 place(const math::Vec3& vertex, const Variant& variant) {
  return variant.T_com_mesh * (vertex * variant.scale);
}

std::unique_ptr<ShapeData> hull(const std::vector<math::Vec3>& vertices, const Variant& variant) {
  auto data = std::make_unique<ShapeData>();
  mesh::HullOptions options;
  options.max_points = variant.max_points;
  const mesh::ReducedHull reduced = mesh::reduce_hull(vertices, options);
  auto shape = std::make_unique<btConvexHullShape>();
  for (const math::Vec3& point : reduced.points) shape->addPoint(to_bullet(place(point, variant)), false);
  shape->setMargin(variant.margin);
  shape->recalcLocalAabb();
  const auto point = [&](std::uint32_t index) { return to_bullet(place(reduced.points[index], variant)); };
  for (const auto& [a, b, c] : reduced.triangles) {
    const btVector3 normal = (point(b) - point(a)).cross(point(c) - point(a));
    if (normal.length() <= 0.0) continue;
    btVector4 face(normal.x(), normal.y(), normal.z(), 0.0);
    face /= normal.length();
    face.setW(face.dot(point(a)));
    data->hull_faces.push_back(face);
  }
  for (const auto& triangle : reduced.triangles)
    for (std::size_t k = 0; k < 3; ++k)  // each edge is of two triangles, which run along it opposite ways
      if (const std::uint32_t from = triangle[k], to = triangle[(k + 1) % 3]; from < to)
        data->hull_edges.push_back({point(from), point(to)});
  data->shape = std::move(shape);
  return data;
}

detail::SharedSurface make_surface(const mesh::CollisionMesh& mesh, const Variant& variant) {
  std::vector<math::Vec3> vertices;
  std::vector<std::array<int, 3>> corners;
  for (const math::Vec3& vertex : mesh.vertices) vertices.push_back(place(vertex, variant));
  for (const auto& triangle : mesh.triangles)
    corners.push_back({static_cast<int>(triangle[0]), static_cast<int>(triangle[1]), static_cast<int>(triangle[2])});
  return detail::make_mesh_surface(vertices, corners, variant.margin, variant.moving);
}

// Worlds of one process that share a mesh share its surface, which is constant: two thirds of what a robot with fine
// meshes takes. Bullet's shapes count their users, so each world has its own.
detail::SharedSurface surface_of(const std::shared_ptr<const mesh::CollisionMesh>& mesh, const Variant& variant) {
  struct Made {
    std::weak_ptr<const mesh::CollisionMesh> mesh;
    Variant variant;
    std::weak_ptr<const detail::FeatureMesh> surface;
  };
  static std::mutex mutex;
  static std::multimap<const mesh::CollisionMesh*, Made> made;
  const auto find = [&]() -> detail::SharedSurface {
    const auto [first, last] = made.equal_range(mesh.get());
    for (auto each = first; each != last; ++each)
      if (each->second.mesh.lock() == mesh && each->second.variant == variant)
        if (auto surface = each->second.surface.lock()) return surface;
    return nullptr;
  };
  {
    const std::lock_guard lock(mutex);
    if (auto surface = find()) return surface;
  }
  auto surface = make_surface(*mesh, variant);  // takes long: other threads go on
  const std::lock_guard lock(mutex);
  if (auto of_another = find()) return of_another;
  std::erase_if(made, [](const auto& each) { return each.second.surface.expired(); });
  made.emplace(mesh.get(), Made{mesh, variant, surface});
  return surface;
}

std::unique_ptr<ShapeData> triangle_mesh(const std::shared_ptr<const mesh::CollisionMesh>& mesh,
                                         const Variant& variant) {
  auto data = std::make_unique<ShapeData>();
  auto placed = std::make_shared<PlacedMesh>();
  placed->vertices.reserve(mesh->vertices.size() * 3);
  for (const math::Vec3& vertex : mesh->vertices) {
    const math::Vec3 p = place(vertex, variant);
    placed->vertices.insert(placed->vertices.end(), {p.x, p.y, p.z});
  }
  placed->indices.reserve(mesh->triangles.size() * 3);
  for (const auto& triangle : mesh->triangles)
    for (const std::uint32_t index : triangle) placed->indices.push_back(static_cast<int>(index));
  data->triangles = std::make_unique<btTriangleIndexVertexArray>(
      static_cast<int>(mesh->triangles.size()), placed->indices.data(), static_cast<int>(3 * sizeof(int)),
      static_cast<int>(mesh->vertices.size()), placed->vertices.data(), static_cast<int>(3 * sizeof(double)));
  data->keeps_alive = placed;
  data->concave = true;
  if (variant.moving) {
    auto shape = std::make_unique<btGImpactMeshShape>(data->triangles.get());
    shape->setMargin(variant.margin);
    shape->updateBound();
    data->shape = std::move(shape);
  } else {
    auto shape = std::make_unique<btBvhTriangleMeshShape>(data->triangles.get(), true, true);
    shape->setMargin(variant.margin);
    data->shape = std::move(shape);
  }
  detail::keep_surface(*data, *data->shape, surface_of(mesh, variant));
  return data;
}

std::unique_ptr<ShapeData> point_cloud(const std::vector<math::Vec3>& vertices, const Variant& variant) {
  auto data = std::make_unique<ShapeData>();
  // One sphere serves all points.
  data->parts.push_back(std::make_unique<btSphereShape>(variant.margin));
  auto compound = std::make_unique<btCompoundShape>(true, static_cast<int>(vertices.size()));
  for (const math::Vec3& vertex : vertices)
    compound->addChildShape(btTransform(btQuaternion::getIdentity(), to_bullet(place(vertex, variant))),
                            data->parts.front().get());
  data->shape = std::move(compound);
  return data;
}

std::unique_ptr<ShapeData> build(const detail::MeshSourceData& source, const Variant& variant) {
  switch (variant.type) {
    case scene::CollisionMeshType::convex_hull:
    case scene::CollisionMeshType::convex_mesh: return hull(source.mesh->vertices, variant);
    case scene::CollisionMeshType::point_cloud: return point_cloud(source.mesh->vertices, variant);
    case scene::CollisionMeshType::triangle_mesh: break;
  }
  return triangle_mesh(source.mesh, variant);
}

}  // namespace

MeshSource::MeshSource(std::vector<math::Vec3> vertices, const std::vector<std::array<std::uint32_t, 3>>& triangles)
    : data_(std::make_unique<detail::MeshSourceData>()) {
  mesh::CollisionMesh mesh;
  mesh.vertices = std::move(vertices);
  const std::size_t count = mesh.vertices.size();
  for (const auto& triangle : triangles)
    if (triangle[0] < count && triangle[1] < count && triangle[2] < count) mesh.triangles.push_back(triangle);
  data_->mesh = std::make_shared<const mesh::CollisionMesh>(std::move(mesh));
}

MeshSource::MeshSource(std::shared_ptr<const mesh::CollisionMesh> mesh)
    : data_(std::make_unique<detail::MeshSourceData>()) {
  data_->mesh = std::move(mesh);
}

MeshSource::~MeshSource() = default;

bool MeshSource::in_use() const {
  const std::lock_guard lock(data_->mutex);
  return std::ranges::any_of(data_->made, [](const auto& made) { return !made.shape.expired(); });
}

SharedShape MeshSource::shape(scene::CollisionMeshType type, const math::Pose& offset,
                              const ShapeOptions& options) const {
  const bool needs_triangles = type == scene::CollisionMeshType::triangle_mesh;
  const mesh::CollisionMesh& mesh = *data_->mesh;
  if (mesh.vertices.empty() || (needs_triangles && mesh.triangles.empty())) return make_empty_shape();
  Variant variant{type, math::inverse(options.T_body_com) * offset, options.scale, options.margin, options.moving, 0};
  if (type == scene::CollisionMeshType::convex_hull) variant.max_points = options.hull_points;
  if (type == scene::CollisionMeshType::convex_mesh) variant.max_points = options.convex_points;
  if (!needs_triangles) variant.moving = true;  // only concave meshes differ
  const std::lock_guard lock(data_->mutex);
  std::erase_if(data_->made, [](const auto& made) { return made.shape.expired(); });
  for (const auto& made : data_->made)
    if (made.variant == variant)
      if (SharedShape shape = made.shape.lock()) return shape;
  auto shape = std::make_shared<const Shape>(build(*data_, variant));
  data_->made.push_back({variant, shape});
  return shape;
}

}  // namespace ambf::physics
