#include "render/panel/view_actions.h"

#include <cmath>
#include <cstdio>

#include "math/rotation.h"
#include "render/camera/intrinsics.h"

namespace ambf::render {

namespace {

// Where the camera stands as seen from the target.
math::Vec3 direction_of(Side side) {
  const double third = 1.0 / std::sqrt(3.0);
  switch (side) {
    case Side::front: return {1, 0, 0};
    case Side::back: return {-1, 0, 0};
    case Side::left: return {0, -1, 0};
    case Side::right: return {0, 1, 0};
    case Side::top: return {0, 0, 1};
    case Side::bottom: return {0, 0, -1};
    case Side::corner: break;
  }
  return {third, third, third};
}

// The window's resolution is only what the lengths refer to.
std::string intrinsics_as_adf(const Camera& camera) {
  constexpr int kWidth = 640, kHeight = 480;
  const state::Intrinsics in = intrinsics_of(camera, kWidth, kHeight);
  char text[240];
  std::snprintf(text, sizeof text,
                "window resolution: {width: %d, height: %d}\n"
                "camera intrinsics: {fx: %.6g, fy: %.6g, cx: %.6g, cy: %.6g, s: %.6g}\n",
                kWidth, kHeight, in.fx, in.fy, in.cx + 0.5, in.cy + 0.5, 0.0 - in.skew);
  return text;
}

}  // namespace

View seen_from(const View& view, const math::Pose& T_world_parent, Side side) {
  const math::Vec3 target_world = T_world_parent * target_of(view);
  const math::Pose T_world_camera =
      looking_at(target_world + direction_of(side) * view.target_distance_m, target_world);
  return {math::inverse(T_world_parent) * T_world_camera, view.target_distance_m};
}

View shifted(const View& view, const math::Pose& T_world_parent, const math::Vec3& shift_world) {
  View out = view;
  out.T_parent_camera.position += math::rotate(math::inverse(T_world_parent.orientation), shift_world);
  return out;
}

View centred_on(const View& view, const math::Pose& T_world_parent, const math::Vec3& point_world) {
  return shifted(view, T_world_parent, point_world - T_world_parent * target_of(view));
}

View moved_to(const View& view, const math::Pose& T_world_parent, const math::Pose& T_world_camera) {
  return {math::inverse(T_world_parent) * T_world_camera, view.target_distance_m};
}

std::string as_adf(const std::string& name, const View& view, const Camera& camera, const std::string& parent) {
  const math::Vec3 at = view.T_parent_camera.position, target = target_of(view);
  std::string out = "name: " + name + "\n";
  const auto vector = [&](const char* key, const math::Vec3& v) {
    char line[200];
    std::snprintf(line, sizeof line, "%s: {x: %.6g, y: %.6g, z: %.6g}\n", key, v.x, v.y, v.z);
    out += line;
  };
  const auto number = [&](const char* key, double value) {
    char line[80];
    std::snprintf(line, sizeof line, "%s: %.6g\n", key, value);
    out += line;
  };
  vector("location", at);
  vector("look at", target);
  vector("up", up(view.T_parent_camera));
  out += "clipping plane: {near: ";
  char planes[80];
  std::snprintf(planes, sizeof planes, "%.6g, far: %.6g}\n", camera.near_m, camera.far_m);
  out += planes;
  if (camera.orthographic_width_m > 0.0) {
    number("orthographic view width", camera.orthographic_width_m);
  } else {
    number("field view angle", camera.field_of_view_rad);
    if (!(camera.optics == state::Optics{})) out += intrinsics_as_adf(camera);
  }
  if (!parent.empty()) out += "parent: " + parent + "\n";
  return out;
}

}  // namespace ambf::render
