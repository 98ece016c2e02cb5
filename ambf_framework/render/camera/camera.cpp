#include "render/camera/camera.h"

#include <algorithm>
#include <cmath>

#include "math/rotation.h"

namespace ambf::render {

using math::Vec3;

void set_lens(Camera& camera, const state::Lens& lens) {
  camera.near_m = lens.near_m;
  camera.far_m = lens.far_m;
  camera.field_of_view_rad = lens.field_of_view_rad;
  camera.orthographic_width_m = lens.orthographic ? lens.orthographic_width_m : 0.0;
  camera.optics = lens.optics;
}

Sphere around(const Sphere& a, const Sphere& b) {
  if (a.radius < 0.0) return b;
  if (b.radius < 0.0) return a;
  const Vec3 apart = b.centre - a.centre;
  const double distance = math::norm(apart);
  if (distance + b.radius <= a.radius) return a;
  if (distance + a.radius <= b.radius) return b;
  const double radius = 0.5 * (distance + a.radius + b.radius);
  return {a.centre + apart * ((radius - a.radius) / distance), radius};
}

Mat4 view_matrix(const math::Pose& T_world_camera) {
  const Mat4 m = to_matrix(math::inverse(T_world_camera));
  Mat4 out = m;
  // Rows of the camera frame (x back, y right, z up) in OpenGL's order (right, up, back).
  for (std::size_t column = 0; column < 4; ++column) {
    out.m[4 * column + 0] = m.m[4 * column + 1];
    out.m[4 * column + 1] = m.m[4 * column + 2];
    out.m[4 * column + 2] = m.m[4 * column + 0];
  }
  return out;
}

Mat4 projection_matrix(const Camera& camera, double aspect) {
  if (camera.orthographic_width_m > 0.0) {
    return orthographic(camera.orthographic_width_m, aspect, camera.near_m, camera.far_m);
  }
  Mat4 m = perspective(camera.field_of_view_rad, aspect, camera.near_m, camera.far_m);
  const PicturePlane seen = picture_plane(camera, aspect);
  m.m[0] *= static_cast<float>(camera.optics.focal_ratio);
  m.m[4] = static_cast<float>(-seen.slant / (seen.half_width * seen.half_height));
  m.m[8] = static_cast<float>((seen.middle_right - seen.slant * seen.middle_up / seen.half_height) / seen.half_width);
  m.m[9] = static_cast<float>(seen.middle_up / seen.half_height);
  return m;
}

PicturePlane picture_plane(const Camera& camera, double aspect) {
  PicturePlane out;
  if (camera.orthographic_width_m > 0.0) {
    out.half_width = camera.orthographic_width_m / 2.0;
    out.half_height = out.half_width / aspect;
    return out;
  }
  const state::Optics& optics = camera.optics;
  const double t = std::tan(camera.field_of_view_rad / 2.0);
  out.half_height = t;
  out.half_width = t * aspect / optics.focal_ratio;
  out.slant = t * optics.skew / optics.focal_ratio;
  // The axis itself is seen at 2 axis_right / aspect, -2 axis_down of clip space.
  out.middle_up = 2.0 * t * optics.axis_down;
  out.middle_right = 2.0 * (out.slant * optics.axis_down - t / optics.focal_ratio * optics.axis_right) - camera.shift;
  return out;
}

Vec3 backward(const math::Pose& T_camera) { return math::rotate(T_camera.orientation, {1.0, 0.0, 0.0}); }
Vec3 right(const math::Pose& T_camera) { return math::rotate(T_camera.orientation, {0.0, 1.0, 0.0}); }
Vec3 up(const math::Pose& T_camera) { return math::rotate(T_camera.orientation, {0.0, 0.0, 1.0}); }

Ray ray_through(const Camera& camera, double width, double height, double x_px, double y_px) {
  const double x = 2.0 * x_px / width - 1.0, y = 1.0 - 2.0 * y_px / height;
  const PicturePlane seen = picture_plane(camera, width / height);
  const Vec3 aside{0.0, seen.middle_right + seen.half_width * x + seen.slant * y,
                   seen.middle_up + seen.half_height * y};
  if (camera.orthographic_width_m > 0.0) {
    return {camera.T_world_camera * (aside + Vec3{-camera.near_m, 0, 0}),
            camera.T_world_camera * (aside + Vec3{-camera.far_m, 0, 0})};
  }
  const Vec3 direction = aside + Vec3{-1.0, 0.0, 0.0};
  return {camera.T_world_camera * (camera.near_m * direction), camera.T_world_camera * (camera.far_m * direction)};
}

Frustum::Frustum(const Mat4& world_to_clip) {
  for (std::size_t i = 0; i < 6; ++i) {
    Plane plane{};
    const double sign = i % 2 == 0 ? 1.0 : -1.0;
    for (std::size_t k = 0; k < 4; ++k) plane[k] = world_to_clip.m[4 * k + 3] + sign * world_to_clip.m[4 * k + i / 2];
    const double length = std::sqrt(plane[0] * plane[0] + plane[1] * plane[1] + plane[2] * plane[2]);
    for (double& value : plane) value /= std::max(length, 1e-12);
    planes_[i] = plane;
  }
}

bool Frustum::may_see(const Sphere& sphere) const {
  return std::all_of(planes_.begin(), planes_.end(),
                     [&](const Plane& plane) { return distance_m(plane, sphere.centre) >= -sphere.radius; });
}

bool Frustum::near_plane_cuts(const Sphere& sphere) const {
  return distance_m(planes_[4], sphere.centre) < sphere.radius;
}

double Frustum::distance_m(const Plane& plane, const Vec3& point) {
  return plane[0] * point.x + plane[1] * point.y + plane[2] * point.z + plane[3];
}

math::Pose looking_at(const Vec3& position, const Vec3& target) {
  const Vec3 back = math::normalized(position - target, {1.0, 0.0, 0.0});
  Vec3 aside = math::cross({0.0, 0.0, 1.0}, back);
  if (math::norm(aside) < 1e-6) aside = math::cross({0.0, 1.0, 0.0}, back);
  aside = math::normalized(aside);
  const Vec3 upward = math::cross(back, aside);
  const double R[9] = {back.x, aside.x, upward.x, back.y, aside.y, upward.y, back.z, aside.z, upward.z};
  return {position, math::from_matrix(R)};
}

}  // namespace ambf::render
