#include "adf/detail/view_parser.h"

#include <array>
#include <cmath>

#include "adf/detail/bind.h"
#include "adf/detail/scalars.h"
#include "scene/keys.h"

namespace ambf::adf {

namespace {

constexpr double kPi = 3.14159265358979323846;
// Of AMBF 3.0, where a file gives camera intrinsics without them: pixels.
constexpr unsigned kWindowWidth = 640, kWindowHeight = 480;
constexpr double kFocalLength = 100.0;
constexpr double kMinView_rad = 1e-4, kMaxView_rad = 3.1;

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

// In pixels of the window's resolution, as AMBF 3.0's matrix has them: cx and cy from the upper left corner, s with y
// up.
void apply_intrinsics(const Fields& fields, double width, double height, state::Lens& lens, Report& report) {
  const Fields given = fields.map("camera intrinsics");
  const double f = given.number("f", kFocalLength);
  const double fx = given.number("fx", given.number("fy", f)), fy = given.number("fy", given.number("fx", f));
  const double cx = given.number("cx", 0.5 * width), cy = given.number("cy", 0.5 * height), s = given.number("s", 0.0);
  constexpr double kRatio = state::Optics::kMaxRatio;
  const double aside = state::Optics::kMaxAside * height, shorter = std::min(fx, fy);
  struct Range {
    const char* key;
    double found, least, most;
  };
  for (const Range& range :
       {Range{given.has("fy") ? "fy" : "f", fy, 0.5 * height / std::tan(0.5 * kMaxView_rad),
              0.5 * height / std::tan(0.5 * kMinView_rad)},
        Range{"fx", fx, fy / kRatio, fy * kRatio}, Range{"cx", cx, 0.5 * width - aside, 0.5 * width + aside},
        Range{"cy", cy, 0.5 * height - aside, 0.5 * height + aside}, Range{"s", s, -shorter, shorter}}) {
    if (range.found >= range.least && range.found <= range.most) continue;
    const char* key = given.has(range.key) ? range.key : "fx";
    report.error(given.mark(key), std::string("camera intrinsics/") + key,
                 "expected " + scene::text_of(range.least) + " to " + scene::text_of(range.most) +
                     " pixels of the `window resolution`, found " + scene::text_of(range.found),
                 "`camera intrinsics` is ignored, the field view angle counts");
    return;
  }
  lens.field_of_view_rad = 2.0 * std::atan(0.5 * height / fy);
  lens.optics = {.focal_ratio = fx / fy,
                 .axis_right = (cx - 0.5 * width) / height,
                 .axis_down = (cy - 0.5 * height) / height,
                 .skew = s / -fy};
}

std::optional<std::array<double, 16>> read_matrix(const Value& rows) {
  std::array<double, 16> out{};
  if (!rows.is_list() || rows.size() != 4) return std::nullopt;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Value row = rows.item(i / 4);
    if (!row.is_list() || row.size() != 4 || !row.item(i % 4).is_scalar()) return std::nullopt;
    const std::optional<double> number = to_number(row.item(i % 4).text());
    if (!number || !std::isfinite(*number)) return std::nullopt;
    out[i] = *number;
  }
  return out;
}

void apply_matrix(const Fields& fields, const Value& rows, double aspect, state::Lens& lens, Report& report) {
  const auto matrix = read_matrix(rows);
  state::Lens read = lens;
  bool good = matrix.has_value();
  if (good) {
    const std::array<double, 16>& m = *matrix;
    for (const std::size_t i : {3, 4, 7, 8, 9, 12, 13, 15}) good = good && m[i] == 0.0;
    good = good && m[0] > 0.0 && m[5] > 0.0 && m[14] == -1.0;
    read.near_m = m[11] / (m[10] - 1.0);
    read.far_m = m[11] / (m[10] + 1.0);
    read.field_of_view_rad = 2.0 * std::atan(1.0 / m[5]);
    // By row and column as AMBF 3.0 fills them.
    read.optics = {m[0] / m[5] * aspect, -0.5 * aspect * m[2], 0.5 * m[6], -aspect * m[1] / m[5]};
    good = good && read.near_m > 0.0 && read.near_m < read.far_m && std::isfinite(read.far_m) &&
           read.field_of_view_rad > kMinView_rad && read.field_of_view_rad < kMaxView_rad &&
           state::check(read.optics).empty();
  }
  if (good) {
    lens = read;
  } else {
    report.error(fields.mark("projection matrix"), "projection matrix",
                 "expected four rows of four numbers, of a perspective camera",
                 "it is ignored, the field view angle counts");
  }
}

// What AMBF 3.0 added to describe what a camera sees.
void apply_projection(const Fields& fields, scene::Camera& camera, Report& report) {
  const Fields window = fields.map("window resolution");
  const unsigned width = window.whole("width", kWindowWidth), height = window.whole("height", kWindowHeight);
  if (fields.has("window resolution") && !fields.has("publish image resolution")) {
    camera.image.width = width;
    camera.image.height = height;
  }
  for (const char* key : {"camera intrinsics", "projection matrix"}) {
    if (fields.has(key) && fields.has("orthographic view width"))
      report.warning(fields.mark(key), key, "has no effect beside `orthographic view width`", "keep one of them");
  }
  if (fields.has("camera intrinsics")) {
    apply_intrinsics(fields, width, height, camera.lens, report);
  } else if (const auto rows = fields.find("projection matrix")) {
    apply_matrix(fields, *rows, static_cast<double>(width) / height, camera.lens, report);
  }
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
  apply_projection(fields, camera, file.report);
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
