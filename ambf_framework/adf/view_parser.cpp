#include "adf/detail/view_parser.h"

#include <cmath>

#include "adf/detail/bind.h"

namespace ambf::adf {

namespace {

constexpr double kPi = 3.14159265358979323846;

bool check_view(const Fields& fields, scene::Camera& camera, Report& report) {
  const math::Vec3 view = camera.look_at - camera.location;
  if (!(math::norm(view) > 1e-9)) {
    // The original's default: a camera at the origin looks along -x.
    if (fields.has("look at") || fields.has("location")) {
      report.error(fields.mark("look at"), "look at", "expected a point away from `location`, found the same point",
                   "the camera needs a direction");
      return false;
    }
    camera.look_at = {-1.0, 0.0, 0.0};
    report.information(fields.mark(), "look at", "missing; the camera looks along -x");
    return true;
  }
  if (!(math::norm(camera.up) > 1e-9)) {
    report.error(fields.mark("up"), "up", "expected a direction, found the zero vector", "usually {x: 0, y: 0, z: 1}");
    return false;
  }
  if (math::norm(math::cross(view, camera.up)) < 1e-6 * math::norm(view) * math::norm(camera.up)) {
    camera.up = std::abs(view.z) > 0.9 * math::norm(view) ? math::Vec3{1.0, 0.0, 0.0} : math::Vec3{0.0, 0.0, 1.0};
    report.warning(fields.mark("up"), "up", "the camera looks along its own up direction",
                   camera.up.x > 0.0 ? "x is taken as up" : "z is taken as up");
  }
  return true;
}

bool check_lens(const Fields& fields, state::Lens& lens, Report& report) {
  if (lens.near_m >= lens.far_m) {
    report.error(
        fields.mark("clipping plane"), "clipping plane",
        "expected near below far, found " + std::to_string(lens.near_m) + " and " + std::to_string(lens.far_m));
    return false;
  }
  if (lens.field_of_view_rad >= kPi) {
    report.error(fields.mark("field view angle"), "field view angle",
                 "expected less than pi, found " + std::to_string(lens.field_of_view_rad), "the angle is in radians");
    return false;
  }
  lens.orthographic = lens.orthographic_width_m > 0.0;
  lens.stereo = fields.map("stereo").has("mode");
  return true;
}

}  // namespace

std::optional<scene::Camera> parse_camera(const Block& block, const FileContext& file, NameBook& names) {
  const Fields& fields = block.fields;
  auto camera = read<scene::Camera>(fields.value(), scene::group::kCamera, file.options.defaults);
  if (!check_view(fields, camera, file.report) || !check_lens(fields, camera.lens, file.report)) return std::nullopt;
  camera.identity = parse_identity(block, file, names);
  camera.depth_noise.on = fields.has("publish depth noise");
  camera.preprocessing_shaders = parse_shaders(fields, "preprocessing shaders", file);
  camera.depth_compute_shaders = parse_shaders(fields, "depth compute shaders", file);
  return camera;
}

std::optional<scene::Light> parse_light(const Block& block, const FileContext& file, NameBook& names) {
  const Fields& fields = block.fields;
  auto light = read<scene::Light>(fields.value(), scene::group::kLight, file.options.defaults);
  const double length = math::norm(light.direction);
  if (!(length > 1e-9) || !std::isfinite(length)) {
    file.report.error(fields.mark("direction"), "direction", "expected a direction, found the zero vector",
                      "usually {x: 0, y: 0, z: -1}");
    return std::nullopt;
  }
  light.direction = light.direction / length;
  light.identity = parse_identity(block, file, names);
  return light;
}

}  // namespace ambf::adf
