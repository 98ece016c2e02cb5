// Where a picture is taken from, and where things are in it. Camera frame: x backwards, y right, z up; OpenGL's eye
// axes are x_gl = y, y_gl = z, z_gl = x. Pixels count from the upper left corner. Pure functions, any thread.
#pragma once

#include <array>

#include "math/types.h"
#include "render/camera/matrix.h"
#include "state/view.h"

namespace ambf::render {

struct Camera {
  math::Pose T_world_camera;
  double near_m = 0.1, far_m = 10.0;
  double field_of_view_rad = 0.7;     // as in state::Lens
  double orthographic_width_m = 0.0;  // > 0: orthographic
  state::Optics optics;               // perspective only
  double shift = 0.0;  // of a stereo eye's picture: what is 1 m ahead is shown so far to the right; perspective only
};

void set_lens(Camera& camera, const state::Lens& lens);

struct Sphere {
  math::Vec3 centre;
  double radius = 0.0;  // m; negative: empty
};

// Smallest sphere around both of two spheres; an empty one counts for nothing.
Sphere around(const Sphere& a, const Sphere& b);

Mat4 view_matrix(const math::Pose& T_world_camera);
Mat4 projection_matrix(const Camera& camera, double aspect);

// What a picture shows of the plane 1 m ahead; of an orthographic camera, of every plane. At x, y of OpenGL's clip
// space (-1 .. 1 to the right and up) that is middle_right + half_width x + slant y to the right of the camera, and
// middle_up + half_height y above it.
struct PicturePlane {
  double half_width = 1.0, half_height = 1.0, middle_right = 0.0, middle_up = 0.0, slant = 0.0;  // m
};
PicturePlane picture_plane(const Camera& camera, double aspect);

math::Vec3 backward(const math::Pose& T_camera);  // the camera's axes, in the frame its pose is given in
math::Vec3 right(const math::Pose& T_camera);
math::Vec3 up(const math::Pose& T_camera);

struct Ray {
  math::Vec3 from, to;  // on the near and the far plane, m
};
Ray ray_through(const Camera& camera, double width, double height, double x_px, double y_px);

// The six planes of what a camera sees.
class Frustum {
 public:
  explicit Frustum(const Mat4& world_to_clip);
  bool may_see(const Sphere& sphere) const;
  bool near_plane_cuts(const Sphere& sphere) const;  // or passes behind it

 private:
  using Plane = std::array<double, 4>;
  static double distance_m(const Plane& plane, const math::Vec3& point);
  std::array<Plane, 6> planes_;  // left, right, lower, upper, near, far: unit normal inwards, offset
};

// A pose at `position` that looks at `target` with world z up (or y when looking along z).
math::Pose looking_at(const math::Vec3& position, const math::Vec3& target);

}  // namespace ambf::render
