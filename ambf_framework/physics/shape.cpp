#include "physics/shape.h"

#include <algorithm>

#include "math/rotation.h"
#include "physics/detail/bullet.h"
#include "physics/detail/shape_data.h"

namespace ambf::physics {

using detail::from_bullet;
using detail::to_bullet;

Shape::Shape(std::unique_ptr<detail::ShapeData> data) : data_(std::move(data)) {}
Shape::~Shape() = default;

bool Shape::empty() const { return data_->empty; }
bool Shape::concave() const { return data_->concave; }
bool Shape::infinite() const { return data_->infinite; }

BoundingBox Shape::bounds() const {
  if (data_->empty) return {};
  btVector3 low, high;
  data_->shape->getAabb(btTransform::getIdentity(), low, high);
  return {from_bullet(low), from_bullet(high)};
}

math::Vec3 Shape::inertia(double mass) const {
  if (data_->empty || data_->infinite || mass <= 0.0) return {};
  if (data_->concave && data_->shape->getShapeType() != GIMPACT_SHAPE_PROXYTYPE) {
    // A tree of triangles gives none: that of its bounding box, as Bullet takes for hulls and compounds.
    const BoundingBox box = bounds();
    const math::Vec3 size = box.max - box.min;
    const math::Vec3 s2 = math::scaled(size, size);
    return math::Vec3{s2.y + s2.z, s2.x + s2.z, s2.x + s2.y} * (mass / 12.0);
  }
  btVector3 inertia(0, 0, 0);
  data_->shape->calculateLocalInertia(mass, inertia);
  return from_bullet(inertia);
}

namespace {

std::unique_ptr<btCollisionShape> plane(const scene::Geometry& geometry, const math::Pose& T_com_part, double scale) {
  const math::Vec3 normal = math::rotate(T_com_part.orientation, math::normalized(geometry.normal));
  const double offset = geometry.offset * scale + math::dot(normal, T_com_part.position);
  return std::make_unique<btStaticPlaneShape>(to_bullet(normal), offset);
}

// Along x, y or z.
template <class X, class Y, class Z, class... Arguments>
std::unique_ptr<btCollisionShape> along(scene::Axis axis, Arguments... arguments) {
  switch (axis) {
    case scene::Axis::x: return std::make_unique<X>(arguments...);
    case scene::Axis::y: return std::make_unique<Y>(arguments...);
    case scene::Axis::z: break;
  }
  return std::make_unique<Z>(arguments...);
}

btVector3 cylinder_half_extents(scene::Axis axis, double radius, double half_height) {
  switch (axis) {
    case scene::Axis::x: return {half_height, radius, radius};
    case scene::Axis::y: return {radius, half_height, radius};
    case scene::Axis::z: break;
  }
  return {radius, radius, half_height};
}

std::unique_ptr<btCollisionShape> primitive(const scene::Geometry& geometry, const ShapeOptions& options) {
  const double scale = options.scale;
  const double radius = geometry.radius * scale, height = geometry.height * scale;
  std::unique_ptr<btCollisionShape> shape;
  switch (geometry.shape) {
    case scene::Shape::box: shape = std::make_unique<btBoxShape>(to_bullet(geometry.size * (0.5 * scale))); break;
    case scene::Shape::sphere: return std::make_unique<btSphereShape>(radius);  // the margin of a sphere is its radius
    case scene::Shape::capsule:
      return along<btCapsuleShapeX, btCapsuleShape, btCapsuleShapeZ>(geometry.axis, radius,
                                                                     std::max(0.0, height - 2.0 * radius));
    case scene::Shape::cylinder:
      shape = along<btCylinderShapeX, btCylinderShape, btCylinderShapeZ>(
          geometry.axis, cylinder_half_extents(geometry.axis, radius, 0.5 * height));
      break;
    case scene::Shape::cone:
      shape = along<btConeShapeX, btConeShape, btConeShapeZ>(geometry.axis, radius, height);
      break;
    case scene::Shape::plane: break;  // made by plane()
  }
  if (shape) shape->setMargin(options.margin);
  return shape;
}

bool is_identity(const math::Pose& pose) {
  return math::norm(pose.position) < 1e-12 &&
         math::norm(math::Vec3{pose.orientation.x, pose.orientation.y, pose.orientation.z}) < 1e-12;
}

}  // namespace

SharedShape make_empty_shape() {
  auto data = std::make_unique<detail::ShapeData>();
  data->shape = std::make_unique<btEmptyShape>();
  data->empty = true;
  return std::make_shared<const Shape>(std::move(data));
}

SharedShape make_shape(const std::vector<scene::PlacedGeometry>& parts, const ShapeOptions& options,
                       const std::vector<SharedShape>& hulls) {
  if (parts.empty() && hulls.empty()) return make_empty_shape();
  if (parts.empty() && hulls.size() == 1) return hulls.front();
  auto data = std::make_unique<detail::ShapeData>();
  const math::Pose T_com_body = math::inverse(options.T_body_com);
  std::vector<math::Pose> T_com_parts;
  for (const scene::PlacedGeometry& part : parts) {
    const bool is_plane = part.geometry.shape == scene::Shape::plane;
    const math::Pose T_com_part = T_com_body * part.offset;
    data->infinite = data->infinite || is_plane;
    data->parts.push_back(is_plane ? plane(part.geometry, T_com_part, options.scale)
                                   : primitive(part.geometry, options));
    if (part.geometry.shape == scene::Shape::box) {
      const auto& box = static_cast<const btBoxShape&>(*data->parts.back());
      detail::keep_surface(*data, *data->parts.back(), detail::make_box_surface(box.getHalfExtentsWithMargin()));
    }
    T_com_parts.push_back(is_plane ? math::Pose{} : T_com_part);
  }
  if (hulls.empty() && parts.size() == 1 && is_identity(T_com_parts.front())) {
    data->shape = std::move(data->parts.front());
    data->parts.clear();
  } else {
    auto compound = std::make_unique<btCompoundShape>(true, static_cast<int>(parts.size() + hulls.size()));
    for (std::size_t i = 0; i < parts.size(); ++i)
      compound->addChildShape(to_bullet(T_com_parts[i]), data->parts[i].get());
    for (const SharedShape& hull : hulls) {
      if (hull->empty()) continue;
      compound->addChildShape(btTransform::getIdentity(), hull->data().shape.get());  // points are in the COM frame
      data->hulls.push_back(hull);
    }
    compound->setMargin(options.margin);
    data->shape = std::move(compound);
  }
  return std::make_shared<const Shape>(std::move(data));
}

}  // namespace ambf::physics
