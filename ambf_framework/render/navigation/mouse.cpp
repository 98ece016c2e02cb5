#include "render/navigation/mouse.h"

#include <algorithm>
#include <cmath>

#include "math/rotation.h"
#include "render/camera/camera.h"

namespace ambf::render {

namespace {

// Elevation of the line of sight above the horizon.
double pitch_of(const math::Pose& T) { return std::asin(std::clamp(-backward(T).z, -1.0, 1.0)); }

// Turned by `yaw` about the parent's z and by `pitch` (positive: look further up) about the camera's right. A pitch
// beyond the limit is cut, but a view that is beyond it already may stay there.
math::Quat turned(const math::Pose& T, double yaw, double pitch) {
  const double now = pitch_of(T);
  const double wanted = std::clamp(now + pitch, std::min(-kPitchLimit_rad, now), std::max(kPitchLimit_rad, now));
  const math::Quat q = math::from_axis_angle({0.0, 0.0, 1.0}, yaw) * T.orientation *
                       math::from_axis_angle({0.0, 1.0, 0.0}, wanted - now);
  return math::normalized(q);
}

constexpr double kMaxShareOfTheWay = 0.2;  // to the target, a notch

}  // namespace

math::Vec3 target_of(const View& view) {
  return view.T_parent_camera.position - view.target_distance_m * backward(view.T_parent_camera);
}

View pan(const View& view, double right_px, double down_px, double metres_per_pixel) {
  View out = view;
  const math::Pose& T = view.T_parent_camera;
  out.T_parent_camera.position += metres_per_pixel * (down_px * up(T) - right_px * right(T));
  return out;
}

double pan_scale(const View& view, double multiplier, double field_of_view_rad, double height_px) {
  const double with_pointer = 2.0 * view.target_distance_m * std::tan(field_of_view_rad / 2.0) / height_px;
  return std::min(kPanPerPixel * multiplier, with_pointer);
}

View look(const View& view, double right_px, double down_px, double radians_per_pixel) {
  View out = view;
  out.T_parent_camera.orientation =
      turned(view.T_parent_camera, -right_px * radians_per_pixel, -down_px * radians_per_pixel);
  return out;
}

View orbit(const View& view, double right_px, double down_px, double radians_per_pixel) {
  View out = view;
  const math::Vec3 target = target_of(view);
  out.T_parent_camera.orientation =
      turned(view.T_parent_camera, -right_px * radians_per_pixel, -down_px * radians_per_pixel);
  out.T_parent_camera.position = target + view.target_distance_m * backward(out.T_parent_camera);
  return out;
}

View dolly(const View& view, double notches, double multiplier, double min_target_m) {
  const double step = std::min(kDollyPerNotch * multiplier, kMaxShareOfTheWay * view.target_distance_m);
  const double forwards = notches * step;
  View out = view;
  out.T_parent_camera.position -= forwards * backward(view.T_parent_camera);
  out.target_distance_m = std::max(view.target_distance_m - forwards, std::min(min_target_m, view.target_distance_m));
  return out;
}

}  // namespace ambf::render
