#include "render/camera/intrinsics.h"

#include <cmath>

namespace ambf::render {

state::Intrinsics intrinsics_of(const Camera& camera, int width, int height) {
  state::Intrinsics out;
  out.width = width;
  out.height = height;
  out.orthographic = camera.orthographic_width_m > 0.0;
  out.fy =
      out.orthographic ? width / camera.orthographic_width_m : 0.5 * height / std::tan(camera.field_of_view_rad / 2.0);
  out.fx = out.fy;
  // The middle of the picture is between pixels when there is an even number of them.
  out.cx = 0.5 * width - 0.5;
  out.cy = 0.5 * height - 0.5;
  if (out.orthographic) return out;
  out.fx = out.fy * camera.optics.focal_ratio;
  out.skew = out.fy * camera.optics.skew;
  out.cx += height * camera.optics.axis_right + out.fx * camera.shift;
  out.cy += height * camera.optics.axis_down;
  return out;
}

Camera eye_of(const Camera& middle, const state::Lens& lens, state::Eye eye) {
  if (eye == state::Eye::middle) return middle;
  const double aside_m = (eye == state::Eye::left ? -0.5 : 0.5) * lens.eye_separation_m;
  Camera camera = middle;
  camera.T_world_camera.position = middle.T_world_camera.position + aside_m * right(middle.T_world_camera);
  if (camera.orthographic_width_m <= 0.0) camera.shift = aside_m / lens.focal_length_m;
  return camera;
}

}  // namespace ambf::render
