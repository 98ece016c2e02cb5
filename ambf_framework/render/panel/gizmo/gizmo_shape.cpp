#include "render/panel/gizmo/detail/gizmo_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/rotation.h"

namespace ambf::render {

namespace {

using math::Vec3;

constexpr double kArrow_px = 96.0, kRing_px = 72.0, kHead_px = 17.0;
constexpr double kInner = 0.16;  // of the arrow: free around the centre, where all three meet
constexpr std::array<DebugColor, 3> kColors = {
    {{0.93F, 0.26F, 0.24F, 0.95F}, {0.27F, 0.76F, 0.28F, 0.95F}, {0.26F, 0.50F, 0.98F, 0.95F}}};
constexpr DebugColor kBright = {1.0F, 0.86F, 0.20F, 1.0F};
constexpr double kPi = std::numbers::pi;
constexpr double kFromTheEdge = 0.2;  // sine of the angle below which a ring is seen from its edge

struct Place {
  double x = 0.0, y = 0.0;  // px
};

// Where a point is in the picture; none behind the camera.
std::optional<Place> place_of(const Vec3& point, const GizmoPointer& pointer) {
  const double aspect = pointer.width / pointer.height;
  const auto clip =
      transform(projection_matrix(pointer.camera, aspect) * view_matrix(pointer.camera.T_world_camera), point);
  if (clip[3] < 1e-6) return std::nullopt;
  return Place{0.5 * (1.0 + clip[0] / clip[3]) * pointer.width, 0.5 * (1.0 - clip[1] / clip[3]) * pointer.height};
}

double distance_to(const Place& a, const Place& b, double x, double y) {
  const double along_x = b.x - a.x, along_y = b.y - a.y;
  const double square = along_x * along_x + along_y * along_y;
  double part = 0.0;
  if (square > 1e-9) part = std::clamp(((x - a.x) * along_x + (y - a.y) * along_y) / square, 0.0, 1.0);
  return std::hypot(x - a.x - part * along_x, y - a.y - part * along_y);
}

Vec3 towards_viewer(const Vec3& point, const Camera& camera) {
  const Vec3 back = backward(camera.T_world_camera);
  return camera.orthographic_width_m > 0.0 ? back : math::normalized(camera.T_world_camera.position - point, back);
}

// The part of a ring that is seen: its half in front, all of it when it is looked at from above.
struct Arc {
  Vec3 start;  // from the centre, unit
  double angle_rad = 0.0;
};
Arc seen_arc(const Vec3& axis, const Vec3& viewer) {
  constexpr double kFromAbove = 0.97;
  const Vec3 start = math::normalized(math::cross(viewer, axis), {axis.y, axis.z, axis.x});
  return {start, std::abs(math::dot(axis, viewer)) > kFromAbove ? 2.0 * kPi : kPi};
}

struct Line {
  Vec3 from, along;  // unit
};
Line ray_of(const GizmoPointer& pointer) {
  const Ray ray = ray_through(pointer.camera, pointer.width, pointer.height, pointer.x, pointer.y);
  return {ray.from, math::normalized(ray.to - ray.from)};
}

// How far along `axis` from `centre` the two lines come closest.
std::optional<double> closest_along(const Vec3& centre, const Vec3& axis, const Line& ray) {
  const double between = math::dot(axis, ray.along), square = 1.0 - between * between;
  constexpr double kMinAngle_rad = 0.03;
  if (square < kMinAngle_rad * kMinAngle_rad) return std::nullopt;
  const Vec3 apart = ray.from - centre;
  return (math::dot(apart, axis) - between * math::dot(apart, ray.along)) / square;
}

// Where the ray meets the ring's plane, from its centre.
Vec3 on_plane(const Vec3& centre, const Vec3& axis, const Line& ray) {
  const double t = math::dot(centre - ray.from, axis) / math::dot(ray.along, axis);
  return ray.from + t * ray.along - centre;
}

// Of a ring seen from its edge: as far as the pointer goes along it, as if it were rolled.
std::optional<double> rolled(const GizmoShape& shape, const Vec3& axis, const GizmoPointer& from,
                             const GizmoPointer& to) {
  const Vec3& centre = shape.centre;
  const Vec3 viewer = towards_viewer(centre, from.camera);
  const Vec3 tangent =
      math::normalized(math::cross(axis, viewer));  // of its nearest point when it turns by a positive angle
  const double depth = -(math::inverse(from.camera.T_world_camera) * centre).x;
  const PixelScale scale(from.camera, static_cast<int>(from.width), static_cast<int>(from.height), 1.0);
  if (depth <= 0.0) return std::nullopt;
  const double metres = scale.metres(centre, 1.0);
  const double right_m = (to.x - from.x) * metres, up_m = (from.y - to.y) * metres;
  const Vec3 moved = right_m * right(from.camera.T_world_camera) + up_m * up(from.camera.T_world_camera);
  return math::dot(moved, tangent) / shape.ring_m;
}

}  // namespace

Vec3 axis_of(const GizmoHandle& handle) {
  return handle.axis == 0 ? Vec3{1, 0, 0} : handle.axis == 1 ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
}

GizmoShape gizmo_at(const Vec3& centre_world, const PixelScale& scale, bool rings) {
  return {centre_world, scale.metres(centre_world, kArrow_px), scale.metres(centre_world, kRing_px), rings};
}

std::optional<GizmoHandle> handle_at(const GizmoShape& shape, const GizmoPointer& pointer, double reach_px) {
  std::optional<GizmoHandle> found;
  double nearest = reach_px;
  const auto consider = [&](const GizmoHandle& handle, const Vec3& a, const Vec3& b) {
    const auto from = place_of(a, pointer), to = place_of(b, pointer);
    if (!from || !to) return;
    const double distance = distance_to(*from, *to, pointer.x, pointer.y);
    if (distance >= nearest) return;
    nearest = distance;
    found = handle;
  };
  const Vec3 viewer = towards_viewer(shape.centre, pointer.camera);
  for (int i = 0; i < 3; ++i) {
    const Vec3 axis = axis_of({false, i});
    consider({false, i}, shape.centre + kInner * shape.arrow_m * axis, shape.centre + shape.arrow_m * axis);
    if (!shape.rings) continue;
    const Arc arc = seen_arc(axis, viewer);
    constexpr int kPieces = 32;
    const auto point = [&](int piece) {
      const double angle = arc.angle_rad * piece / kPieces;
      return shape.centre + shape.ring_m * math::rotate(math::from_axis_angle(axis, angle), arc.start);
    };
    for (int piece = 0; piece < kPieces; ++piece) consider({true, i}, point(piece), point(piece + 1));
  }
  return found;
}

std::optional<double> way_along(const GizmoShape& shape, const GizmoHandle& handle, const GizmoPointer& from,
                                const GizmoPointer& to) {
  const Vec3& centre = shape.centre;
  const Vec3 axis = axis_of(handle);
  const Line start = ray_of(from), now = ray_of(to);
  if (!handle.turns) {
    const auto a = closest_along(centre, axis, start), b = closest_along(centre, axis, now);
    if (!a || !b) return std::nullopt;
    return *b - *a;
  }
  if (std::abs(math::dot(axis, start.along)) < kFromTheEdge || std::abs(math::dot(axis, now.along)) < kFromTheEdge) {
    return rolled(shape, axis, from, to);
  }
  const Vec3 a = on_plane(centre, axis, start), b = on_plane(centre, axis, now);
  if (math::norm(a) < 1e-9 || math::norm(b) < 1e-9) return std::nullopt;
  return std::atan2(math::dot(axis, math::cross(a, b)), math::dot(a, b));
}

Vec3 grip_of(const GizmoShape& shape, const GizmoHandle& ring, const GizmoPointer& pointer) {
  const Vec3 axis = axis_of(ring), viewer = towards_viewer(shape.centre, pointer.camera);
  const Line ray = ray_of(pointer);
  const Vec3 nearest = math::normalized(viewer - math::dot(viewer, axis) * axis, {axis.y, axis.z, axis.x});
  if (std::abs(math::dot(axis, ray.along)) < kFromTheEdge) return nearest;
  return math::normalized(on_plane(shape.centre, axis, ray), nearest);
}

void draw_gizmo(const GizmoShape& shape, const Camera& camera, const std::optional<GizmoHandle>& bright,
                double ui_scale, WorldShapes& out) {
  const Vec3 viewer = towards_viewer(shape.centre, camera);
  const auto color = [&](const GizmoHandle& handle) {
    return bright && *bright == handle ? kBright : kColors[static_cast<std::size_t>(handle.axis)];
  };
  const auto width = [&](const GizmoHandle& handle, double px) {
    return ui_scale * (bright && *bright == handle ? px + 1.5 : px);
  };
  for (int i = 0; shape.rings && i < 3; ++i) {
    const GizmoHandle handle{true, i};
    const Arc arc = seen_arc(axis_of(handle), viewer);
    out.arc(shape.centre, axis_of(handle), shape.ring_m * arc.start, arc.angle_rad, color(handle), width(handle, 2.5),
            Seen::always);
  }
  for (int i = 0; i < 3; ++i) {
    const GizmoHandle handle{false, i};
    const Vec3 axis = axis_of(handle);
    out.arrow(shape.centre + kInner * shape.arrow_m * axis, shape.centre + shape.arrow_m * axis, color(handle),
              shape.arrow_m * kHead_px / kArrow_px, width(handle, 3.0), Seen::always);
  }
}

}  // namespace ambf::render
