#include "adf/detail/view_parser.h"

#include <algorithm>
#include <cmath>

namespace ambf::adf {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr unsigned kLargestPicture = 8192;  // pixels a side; more than graphics memory grants
constexpr unsigned kBestShadows = 5;

bool parse_view(const Fields& fields, scene::Camera& camera, Report& report) {
  camera.location = fields.vector("location", camera.location);
  camera.look_at = fields.vector("look at", camera.look_at);
  camera.up = fields.vector("up", camera.up);
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

bool parse_lens(const Fields& fields, scene::Camera& camera, Report& report) {
  const Fields clipping = fields.map("clipping plane");
  camera.near_m = clipping.number("near", camera.near_m);
  camera.far_m = clipping.number("far", camera.far_m);
  if (camera.near_m >= camera.far_m) {
    report.error(
        fields.mark("clipping plane"), "clipping plane",
        "expected near below far, found " + std::to_string(camera.near_m) + " and " + std::to_string(camera.far_m));
    return false;
  }
  camera.field_view_angle_rad = fields.number("field view angle", camera.field_view_angle_rad);
  if (camera.field_view_angle_rad >= kPi) {
    report.error(fields.mark("field view angle"), "field view angle",
                 "expected less than pi, found " + std::to_string(camera.field_view_angle_rad),
                 "the angle is in radians");
    return false;
  }
  camera.orthographic_width_m = fields.number("orthographic view width", 0.0);
  if (fields.has("stereo")) {
    const Fields stereo = fields.map("stereo");
    camera.stereo = stereo.has("mode");
    camera.eye_separation_m = stereo.number("eye separation", camera.eye_separation_m);
    camera.focal_length_m = stereo.number("focal length", camera.focal_length_m);
  }
  return true;
}

std::array<unsigned, 2> parse_resolution(const Fields& fields, std::string_view key, std::array<unsigned, 2> fallback,
                                         Report& report) {
  const Fields map = fields.map(key);
  std::array<unsigned, 2> size{map.whole("width", fallback[0]), map.whole("height", fallback[1])};
  if (size[0] > kLargestPicture || size[1] > kLargestPicture) {
    report.warning(map.mark(), std::string(key), "more than " + std::to_string(kLargestPicture) + " pixels a side",
                   "it is cut to that");
    size = {std::min(size[0], kLargestPicture), std::min(size[1], kLargestPicture)};
  }
  return size;
}

void parse_pictures(const Fields& fields, const FileContext& file, scene::Camera& camera) {
  camera.publish_image = fields.flag("publish image", false);
  camera.image_interval = fields.whole("publish image interval", camera.image_interval);
  camera.image_resolution = parse_resolution(fields, "publish image resolution", camera.image_resolution, file.report);
  camera.publish_depth = fields.flag("publish depth", false);
  camera.depth_interval = fields.whole("publish depth interval", camera.depth_interval);
  camera.depth_resolution = parse_resolution(fields, "publish depth resolution", camera.depth_resolution, file.report);
  if (fields.has("publish depth noise")) {
    const Fields noise = fields.map("publish depth noise");
    camera.depth_noise = true;
    camera.depth_noise_mean = noise.number("mean", camera.depth_noise_mean);
    camera.depth_noise_std_dev = noise.number("std_dev", noise.number("std dev", camera.depth_noise_std_dev));
    camera.depth_noise_bias = noise.number("bias", camera.depth_noise_bias);
  }
  camera.preprocessing_shaders = parse_shaders(fields, "preprocessing shaders", file);
  camera.depth_compute_shaders = parse_shaders(fields, "depth compute shaders", file);
  camera.multipass = fields.flag("multipass", false);
}

}  // namespace

std::optional<scene::Camera> parse_camera(const Block& block, const FileContext& file, NameBook& names) {
  const Fields& fields = block.fields;
  scene::Camera camera;
  if (!parse_view(fields, camera, file.report) || !parse_lens(fields, camera, file.report)) return std::nullopt;
  camera.identity = parse_identity(block, file, names);
  camera.parent = fields.text("parent");
  camera.controlling_devices = fields.texts("controlling devices");
  camera.monitor = fields.whole("monitor", camera.monitor);
  camera.visible = fields.flag("visible", camera.visible);
  parse_pictures(fields, file, camera);
  const Fields mouse = fields.map("mouse control multipliers");
  camera.mouse_pan = mouse.number("pan", camera.mouse_pan);
  camera.mouse_rotate = mouse.number("rotate", camera.mouse_rotate);
  camera.mouse_scroll = mouse.number("scroll", camera.mouse_scroll);
  camera.mouse_arcball = mouse.number("arcball", camera.mouse_arcball);
  return camera;
}

std::optional<scene::Light> parse_light(const Block& block, const FileContext& file, NameBook& names) {
  const Fields& fields = block.fields;
  Report& report = file.report;
  scene::Light light;
  const math::Vec3 direction = fields.vector("direction", light.direction);
  const double length = math::norm(direction);
  if (!(length > 1e-9) || !std::isfinite(length)) {
    report.error(fields.mark("direction"), "direction", "expected a direction, found the zero vector",
                 "usually {x: 0, y: 0, z: -1}");
    return std::nullopt;
  }
  light.direction = direction / length;
  light.cutoff_angle_rad = fields.number("cutoff angle", light.cutoff_angle_rad);
  if (light.cutoff_angle_rad > kPi) {
    report.warning(fields.mark("cutoff angle"), "cutoff angle",
                   "expected at most pi, found " + std::to_string(light.cutoff_angle_rad),
                   "pi is used; the angle is in radians");
    light.cutoff_angle_rad = kPi;
  }
  unsigned quality = fields.whole("shadow quality", 0);
  if (quality > kBestShadows) {
    report.warning(fields.mark("shadow quality"), "shadow quality", "expected 0 to 5, found " + std::to_string(quality),
                   "5 is used");
    quality = kBestShadows;
  }
  light.shadow_quality = static_cast<int>(quality);
  light.identity = parse_identity(block, file, names);
  light.parent = fields.text("parent");
  light.location = fields.vector("location", light.location);
  light.spot_exponent = fields.number("spot exponent", light.spot_exponent);
  const Fields attenuation = fields.map("attenuation");
  light.attenuation_constant = attenuation.number("constant", light.attenuation_constant);
  light.attenuation_linear = attenuation.number("linear", light.attenuation_linear);
  light.attenuation_quadratic = attenuation.number("quadratic", light.attenuation_quadratic);
  return light;
}

}  // namespace ambf::adf
