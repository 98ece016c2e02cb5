#include "render/window/measure.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "math/rotation.h"
#include "render/camera/stereo.h"
#include "render/marks/layer_shapes.h"
#include "render/navigation/view_camera.h"

namespace ambf::render {

namespace {

constexpr std::size_t kMaxPoints = 3;
constexpr DebugColor kMark = {1.0F, 0.80F, 0.10F, 1.0F}, kRim = {0.12F, 0.09F, 0.0F, 0.9F},
                     kAngle = {0.35F, 0.85F, 1.0F, 1.0F}, kHover = {1.0F, 0.80F, 0.10F, 0.55F};

void draw_point(const math::Vec3& at, double ui, WorldShapes& debug) {
  debug.point(at, kRim, 11.0 * ui, Seen::always);
  debug.point(at, kMark, 8.0 * ui, Seen::always);
}

void draw_distance(const math::Vec3& a, const math::Vec3& b, const DebugColor& color, double ui, WorldShapes& debug) {
  debug.line(a, b, kRim, 4.5 * ui, Seen::always);
  debug.line(a, b, color, 2.5 * ui, Seen::always);
  debug.text(0.5 * (a + b), Measure::distance_text(math::norm(b - a)), kMark);
}

void draw_angle(const math::Vec3& a, const math::Vec3& corner, const math::Vec3& b, double ui, WorldShapes& debug) {
  const double angle = Measure::angle_rad(a, corner, b);
  const math::Vec3 to_a = a - corner, to_b = b - corner;
  const double radius = 0.3 * std::min(math::norm(to_a), math::norm(to_b));
  char text[32];
  std::snprintf(text, sizeof text, "%.1f\u00b0", angle * 180.0 / std::numbers::pi);
  const math::Vec3 normal = math::cross(to_a, to_b);
  if (radius <= 0.0 || math::norm(normal) <= 0.0) {  // in a line
    debug.text(corner, text, kAngle);
    return;
  }
  const math::Vec3 axis = math::normalized(normal), start = radius * math::normalized(to_a);
  debug.sector(corner, axis, start, angle, {kAngle[0], kAngle[1], kAngle[2], 0.25F}, Seen::always);
  debug.arc(corner, axis, start, angle, kAngle, 2.0 * ui, Seen::always);
  debug.text(corner + 1.6 * math::rotate(math::from_axis_angle(axis, 0.5 * angle), start), text, kAngle);
}

}  // namespace

void Measure::set_on(bool on) {
  on_ = on;
  points_.clear();
  hovered_.reset();
}

std::string Measure::hint() const {
  switch (points_.size()) {
    case 0: return "measuring: click a first point (Esc ends)";
    case 1: return "measuring: click a second point (Esc ends)";
    case 2: return "measuring: click a third point for the angle at the second (Esc ends)";
    default: return "measuring: click to begin anew (Esc ends)";
  }
}

std::string Measure::distance_text(double metres) {
  char text[32];
  if (metres < 1.0) {
    std::snprintf(text, sizeof text, metres < 0.01 ? "%.3f mm" : metres < 0.1 ? "%.2f mm" : "%.1f mm", 1e3 * metres);
  } else {
    std::snprintf(text, sizeof text, "%.3f m", metres);
  }
  return text;
}

double Measure::angle_rad(const math::Vec3& a, const math::Vec3& corner, const math::Vec3& b) {
  const math::Vec3 to_a = a - corner, to_b = b - corner;
  return std::atan2(math::norm(math::cross(to_a, to_b)), math::dot(to_a, to_b));
}

std::vector<math::Vec3> Measure::points(const state::Structure& structure, const ScenePoses& poses) const {
  std::vector<math::Vec3> places;
  for (const Point& point : points_) {
    const std::uint32_t object = state::find(structure, point.body);
    if (object == state::kNone || structure.objects[object].slot >= poses.bodies.size()) return {};
    places.push_back(poses.bodies[structure.objects[object].slot] * point.point_body);
  }
  return places;
}

std::optional<SurfaceHit> Measure::under(const WindowMoment& moment, double x, double y) const {
  if (moment.view == nullptr || moment.sizes.width <= 0.0 || moment.sizes.height <= 0.0) return std::nullopt;
  const std::vector<EyeView> eyes = eyes_of(moment.view->camera(), moment.view->lens(), moment.sizes.width);
  const EyeView& eye = eye_at(eyes, x);
  const double y_px = moment.sizes.mirrored ? moment.sizes.height - y : y;
  const Ray ray = ray_through(eye.camera, eye.width, moment.sizes.height, x - eye.left, y_px);
  const state::Structure& structure = *moment.frame->structure;
  const std::vector<BodyLook> looks =
      moment.shows.looks != nullptr
          ? moment.shows.looks->by_slot(structure, moment.shows.layers->shows(LayerId::no_visuals))
          : std::vector<BodyLook>{};
  return first_surface(structure, moment.poses->bodies, looks, moment.shows.layers->shows(LayerId::collision), ray);
}

bool Measure::on_input(const WindowMoment& moment, const Input& input) {
  if (const auto* motion = std::get_if<MotionInput>(&input)) {
    x_ = motion->x;
    y_ = motion->y;
    pointer_here_ = true;
    return false;
  }
  if (!on_) return false;
  if (const auto* key = std::get_if<KeyInput>(&input)) {
    if (key->key != "Esc" || key->released || key->held) return false;
    set_on(false);
    return true;
  }
  const auto* button = std::get_if<ButtonInput>(&input);
  if (button == nullptr || !button->pressed || button->button != MouseButton::left || button->modifiers.control) {
    return false;
  }
  const std::optional<SurfaceHit> hit = under(moment, button->x, button->y);
  if (!hit) return true;  // beside everything
  if (points_.size() == kMaxPoints) points_.clear();
  const state::Structure& structure = *moment.frame->structure;
  points_.push_back({structure.objects[structure.bodies[hit->body].object].id, hit->point_body});
  return true;
}

void Measure::draw(const WindowMoment& moment, WorldShapes& debug) {
  if (!on_) return;
  const std::vector<math::Vec3> at = points(*moment.frame->structure, *moment.poses);
  if (at.size() != points_.size()) points_.clear();
  const double ui = moment.sizes.scale;
  if (hovered_ns_ != moment.now_ns) {  // once a picture, not once an eye
    hovered_ns_ = moment.now_ns;
    hovered_ = pointer_here_ ? under(moment, x_, y_) : std::nullopt;
  }
  if (hovered_) {
    debug.point(hovered_->point_world, kHover, 9.0 * ui, Seen::always);
    if (at.size() == 1) draw_distance(at[0], hovered_->point_world, kHover, ui, debug);
  }
  if (at.size() >= 2) draw_distance(at[0], at[1], kMark, ui, debug);
  if (at.size() == 3) {
    draw_distance(at[1], at[2], kMark, ui, debug);
    draw_angle(at[0], at[1], at[2], ui, debug);
  }
  for (const math::Vec3& point : at) draw_point(point, ui, debug);
}

}  // namespace ambf::render
