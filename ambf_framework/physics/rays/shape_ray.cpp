// A convex solid is where several conditions hold, each along one span of the ray: it is entered at the last of their
// beginnings, if that is before the first of their ends.
#include "physics/rays/detail/shape_ray.h"

#include <algorithm>
#include <cmath>

#include "physics/shape.h"

namespace ambf::physics::detail {
namespace {

struct Span {
  double begin = -SIMD_INFINITY, end = SIMD_INFINITY;
  btVector3 normal{0, 0, 0};  // outward, where it begins; any length

  bool empty() const { return begin > end; }
  void clip(double from, double to, const btVector3& outward) {
    if (from > begin) {
      begin = from;
      normal = outward;
    }
    end = std::min(end, to);
  }
  void make_empty() { end = -SIMD_INFINITY, begin = SIMD_INFINITY; }
};

// normal . x <= offset
void clip_half_space(Span& span, const LocalRay& ray, const btVector3& normal, double offset) {
  const double speed = normal.dot(ray.along), above = normal.dot(ray.start) - offset;
  if (speed < 0.0) {
    span.clip(-above / speed, SIMD_INFINITY, normal);
  } else if (speed > 0.0) {
    span.end = std::min(span.end, -above / speed);
  } else if (above > 0.0) {
    span.make_empty();
  }
}

void clip_slab(Span& span, const LocalRay& ray, int axis, double low, double high) {
  btVector3 unit(0, 0, 0);
  unit[axis] = 1.0;
  clip_half_space(span, ray, unit, high);
  clip_half_space(span, ray, -unit, -low);
}

// a t^2 + 2 b t + c <= 0 with a > 0, without loss of digits; false: nowhere.
bool roots(double a, double b, double c, double& low, double& high) {
  const double d = b * b - a * c;
  if (d < 0.0) return false;
  const double q = -(b + std::copysign(std::sqrt(d), b));
  low = q / a;
  high = q == 0.0 ? 0.0 : c / q;
  if (low > high) std::swap(low, high);
  return true;
}

Span through_box(const LocalRay& ray, const btVector3& half) {
  Span span;
  for (int axis = 0; axis < 3; ++axis) clip_slab(span, ray, axis, -half[axis], half[axis]);
  return span;
}

Span through_sphere(const LocalRay& ray, const btVector3& centre, double radius) {
  Span span;
  const btVector3 from = ray.start - centre;
  double low = 0.0, high = 0.0;
  if (!roots(ray.along.length2(), from.dot(ray.along), from.length2() - radius * radius, low, high)) {
    span.make_empty();
    return span;
  }
  span.clip(low, high, from + ray.along * low);
  return span;
}

btVector3 across(const btVector3& v, int axis) {
  btVector3 out = v;
  out[axis] = 0.0;
  return out;
}

// Infinitely long.
void clip_cylinder(Span& span, const LocalRay& ray, int axis, double radius) {
  const btVector3 from = across(ray.start, axis), along = across(ray.along, axis);
  const double a = along.length2(), c = from.length2() - radius * radius;
  double low = 0.0, high = 0.0;
  if (a == 0.0) {
    if (c > 0.0) span.make_empty();
  } else if (roots(a, from.dot(along), c, low, high)) {
    span.clip(low, high, from + along * low);
  } else {
    span.make_empty();
  }
}

// The half below its tip, which is at +height / 2 on the axis; the cut at the base comes with the slab.
void clip_cone(Span& span, const LocalRay& ray, int axis, double radius, double height) {
  const double slope = radius / height, k = slope * slope;
  const double up = ray.along[axis], below_tip = ray.start[axis] - 0.5 * height;
  const btVector3 from = across(ray.start, axis), along = across(ray.along, axis);
  const double a = along.length2() - k * up * up;
  const double b = from.dot(along) - k * below_tip * up;
  const double c = from.length2() - k * below_tip * below_tip;
  const auto outward = [&](double t) {
    btVector3 normal = from + along * t;
    normal[axis] = -k * (below_tip + up * t);
    return normal;
  };
  double low = 0.0, high = 0.0;
  if (a > 0.0) {
    if (!roots(a, b, c, low, high)) return span.make_empty();
    return span.clip(low, high, outward(low));
  }
  if (a < 0.0) {
    // Within the cone's opening: one side of the tip is this half, the other its mirror image.
    if (!roots(-a, -b, -c, low, high)) return;  // never outside of both
    if (up > 0.0) {
      span.end = std::min(span.end, low);
    } else {
      span.clip(high, SIMD_INFINITY, outward(high));
    }
    return;
  }
  if (b < 0.0) {
    span.clip(-0.5 * c / b, SIMD_INFINITY, outward(-0.5 * c / b));
  } else if (b > 0.0) {
    span.end = std::min(span.end, -0.5 * c / b);
  } else if (c > 0.0) {
    span.make_empty();
  }
}

bool is_inside(const Span& span) { return !span.empty() && span.begin < 0.0 && span.end >= 0.0; }

void enter(const LocalRay& ray, const btVector3& normal, double fraction, int triangle, LocalHit& hit) {
  hit.fraction = fraction;
  hit.normal = normal.length2() > 0.0 ? normal.normalized() : -ray.along.normalized();
  hit.triangle = triangle;
  hit.hit = true;
}

void start_inside(const LocalRay& ray, bool from_inside, LocalHit& hit) {
  if (from_inside) enter(ray, -ray.along, 0.0, -1, hit);
}

void meet(const LocalRay& ray, const Span& span, bool from_inside, LocalHit& hit) {
  if (is_inside(span)) return start_inside(ray, from_inside, hit);
  if (!span.empty() && span.begin >= 0.0 && span.begin < hit.fraction) enter(ray, span.normal, span.begin, -1, hit);
}

// A cylinder and a ball at each of its ends: entered where the first of them is.
void meet_capsule(const LocalRay& ray, const btCapsuleShape& capsule, bool from_inside, LocalHit& hit) {
  const int axis = capsule.getUpAxis();
  const double half = capsule.getHalfHeight(), radius = capsule.getRadius();
  btVector3 end(0, 0, 0);
  end[axis] = half;
  Span middle;
  clip_cylinder(middle, ray, axis, radius);
  clip_slab(middle, ray, axis, -half, half);
  const Span parts[] = {middle, through_sphere(ray, end, radius), through_sphere(ray, -end, radius)};
  for (const Span& part : parts)
    if (is_inside(part)) return start_inside(ray, from_inside, hit);
  for (const Span& part : parts) meet(ray, part, from_inside, hit);
}

Span through_hull(const LocalRay& ray, const std::vector<btVector4>& faces) {
  Span span;
  for (const btVector4& face : faces) {
    clip_half_space(span, ray, face, face.w());
    if (span.empty() || span.end < 0.0 || span.begin > 1.0) return span;
  }
  return span;
}

// Of a hull that is the shape or a child of it; none where it is flat.
const std::vector<btVector4>& faces_of(const ShapeData& data, const btCollisionShape& hull) {
  for (const auto& child : data.hulls)
    if (child->data().shape.get() == &hull) return child->data().hull_faces;
  return data.hull_faces;
}

void cast_part(const ShapeData& data, const btCollisionShape& shape, const LocalRay& ray, bool from_inside,
               LocalHit& hit) {
  Span span;
  switch (shape.getShapeType()) {
    case BOX_SHAPE_PROXYTYPE:
      span = through_box(ray, static_cast<const btBoxShape&>(shape).getHalfExtentsWithMargin());
      break;
    case SPHERE_SHAPE_PROXYTYPE:
      span = through_sphere(ray, btVector3(0, 0, 0), static_cast<const btSphereShape&>(shape).getRadius());
      break;
    case CAPSULE_SHAPE_PROXYTYPE: return meet_capsule(ray, static_cast<const btCapsuleShape&>(shape), from_inside, hit);
    case CYLINDER_SHAPE_PROXYTYPE: {
      const auto& cylinder = static_cast<const btCylinderShape&>(shape);
      const int axis = cylinder.getUpAxis();
      const double half = cylinder.getHalfExtentsWithMargin()[axis];
      clip_cylinder(span, ray, axis, cylinder.getHalfExtentsWithMargin()[(axis + 1) % 3]);
      clip_slab(span, ray, axis, -half, half);
      break;
    }
    case CONE_SHAPE_PROXYTYPE: {
      const auto& cone = static_cast<const btConeShape&>(shape);
      const int axis = cone.getConeUpIndex();
      const double half = 0.5 * cone.getHeight();
      clip_cone(span, ray, axis, cone.getRadius(), cone.getHeight());
      clip_slab(span, ray, axis, -half, half);
      break;
    }
    case STATIC_PLANE_PROXYTYPE: {
      const auto& plane = static_cast<const btStaticPlaneShape&>(shape);
      clip_half_space(span, ray, plane.getPlaneNormal(), plane.getPlaneConstant());
      break;
    }
    case CONVEX_HULL_SHAPE_PROXYTYPE:
      if (faces_of(data, shape).empty()) return;
      span = through_hull(ray, faces_of(data, shape));
      break;
    case TRIANGLE_MESH_SHAPE_PROXYTYPE:
    case GIMPACT_SHAPE_PROXYTYPE: {
      const SurfaceHit met = cast_at_surface(shape, ray.start, ray.along, hit.fraction);
      if (met.triangle >= 0) enter(ray, met.normal, met.fraction, met.triangle, hit);
      return;
    }
    default: return;
  }
  meet(ray, span, from_inside, hit);
}

}  // namespace

void cast_ray(const ShapeData& data, const LocalRay& ray, bool from_inside, LocalHit& hit) {
  if (!data.shape->isCompound()) return cast_part(data, *data.shape, ray, from_inside, hit);
  const auto& compound = static_cast<const btCompoundShape&>(*data.shape);
  for (int i = 0; i < compound.getNumChildShapes(); ++i) {
    const btTransform& T_shape_part = compound.getChildTransform(i);
    const btMatrix3x3 into = T_shape_part.getBasis().transpose();
    const LocalRay local{into * (ray.start - T_shape_part.getOrigin()), into * ray.along};
    LocalHit met;
    met.fraction = hit.fraction;
    cast_part(data, *compound.getChildShape(i), local, from_inside, met);
    if (!met.hit || (hit.hit && met.fraction >= hit.fraction)) continue;
    met.normal = T_shape_part.getBasis() * met.normal;
    hit = met;
  }
}

}  // namespace ambf::physics::detail
