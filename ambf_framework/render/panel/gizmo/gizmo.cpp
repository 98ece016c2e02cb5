#include "render/panel/gizmo/gizmo.h"

#include <cmath>
#include <cstdio>
#include <numbers>

#include "math/rotation.h"
#include "render/camera/stereo.h"
#include "render/navigation/view_camera.h"
#include "render/panel/kinds/panel_kinds.h"

namespace ambf::render {

namespace {

constexpr double kReach_px = 8.0;

// The eye whose picture the pointer is in.
GizmoPointer pointer_at(const WindowMoment& moment, double x, double y) {
  const EyeView eye = eye_at(eyes_of(moment.camera, moment.view->lens(), moment.sizes.width), x);
  return {eye.camera, eye.width, moment.sizes.height, x - eye.left,
          moment.sizes.mirrored ? moment.sizes.height - y : y};
}

// In window units, as the pointer counts.
double reach(const WindowMoment& moment) {
  return kReach_px * moment.sizes.scale * moment.sizes.height / std::max(1, moment.sizes.picture_height);
}

std::string way_text(const GizmoHandle& handle, double way) {
  char text[48];
  if (handle.turns) {
    std::snprintf(text, sizeof text, "%+.1f\u00b0", way * 180.0 / std::numbers::pi);
  } else if (std::abs(way) < 1.0) {
    std::snprintf(text, sizeof text, "%+.1f mm", way * 1e3);
  } else {
    std::snprintf(text, sizeof text, "%+.3f m", way);
  }
  return text;
}

}  // namespace

std::optional<GizmoShape> Gizmo::shape(const WindowMoment& moment, state::ObjectId selected) const {
  // One does not move from outside what one looks through.
  if (!shown || moment.frame == nullptr || selected == moment.camera_object) return std::nullopt;
  const std::uint32_t object = state::find(*moment.frame->structure, selected);
  if (object == state::kNone) return std::nullopt;
  const math::Pose* T_world_object = moment.poses->of(moment.frame->structure->objects[object]);
  if (T_world_object == nullptr) return std::nullopt;
  const PixelScale scale(moment.camera, moment.sizes.picture_width, moment.sizes.picture_height, moment.sizes.scale);
  return gizmo_at(T_world_object->position, scale, GizmoHand::can_turn(*moment.frame, selected));
}

bool Gizmo::on_input(const WindowMoment& moment, const Input& input, state::ObjectId selected, std::string& message) {
  if (moment.frame == nullptr || moment.view == nullptr || !(moment.sizes.width > 0.0) || !(moment.sizes.height > 0.0))
    return false;
  if (const auto* motion = std::get_if<MotionInput>(&input)) {
    const GizmoPointer pointer = pointer_at(moment, motion->x, motion->y);
    if (!drag_) {
      const auto here = shape(moment, selected);
      under_pointer_ = here ? handle_at(*here, pointer, reach(moment)) : std::nullopt;
      return false;  // others may want to know, too
    }
    GizmoPointer to = pointer;
    to.camera = drag_->from.camera;  // what follows the object does not run away from the pointer
    const auto way = way_along(drag_->shape, drag_->handle, drag_->from, to);
    if (!way) return true;
    drag_->way = snapped(*drag_, *way);
    hand_.move(*moment.frame, target_of(*drag_));
    return true;
  }
  const auto* button = std::get_if<ButtonInput>(&input);
  if (button == nullptr || button->button != MouseButton::left) return false;
  if (!button->pressed) {
    if (!drag_) return false;
    let_go(*moment.frame, moment.now_ns);
    return true;
  }
  const auto here = shape(moment, selected);
  if (!here || button->modifiers.control) return false;
  const GizmoPointer pointer = pointer_at(moment, button->x, button->y);
  const auto handle = handle_at(*here, pointer, reach(moment));
  if (!handle) return false;
  const math::Vec3 viewer = math::normalized(moment.camera.T_world_camera.position - here->centre);
  message = hand_.begin(*moment.frame, selected, handle->turns, viewer, moment.now_ns);
  if (!message.empty()) return true;
  Drag drag{selected, moment.window, *handle, *here, pointer, {}, 0.0};
  GizmoHand::pose_of(*moment.frame, selected, drag.T_world_start);
  drag_ = drag;
  under_pointer_ = handle;
  return true;
}

std::string Gizmo::observe(const state::Frame& frame, std::int64_t now_ns) {
  std::string message = hand_.update(frame, now_ns);
  if (!hand_.holds()) drag_.reset();  // gone, or a reset took it back
  return message;
}

void Gizmo::let_go(const state::Frame& frame, std::int64_t now_ns) {
  if (!drag_) return;
  hand_.end(frame, now_ns);
  drag_.reset();
}

// Shifts end where the coordinate is a multiple, whatever it was; turns are multiples themselves.
double Gizmo::snapped(const Drag& drag, double way) const {
  if (!snaps) return way;
  if (drag.handle.turns) return snap_rad > 0.0 ? std::round(way / snap_rad) * snap_rad : way;
  const double start = math::dot(drag.T_world_start.position, axis_of(drag.handle));
  return snap_m > 0.0 ? std::round((start + way) / snap_m) * snap_m - start : way;
}

math::Pose Gizmo::target_of(const Drag& drag) const {
  math::Pose target = drag.T_world_start;
  const math::Vec3 axis = axis_of(drag.handle);
  if (drag.handle.turns) {
    target.orientation = math::normalized(math::from_axis_angle(axis, drag.way) * target.orientation);
  } else {
    target.position += drag.way * axis;
  }
  return target;
}

void Gizmo::draw(const WindowMoment& moment, state::ObjectId selected, WorldShapes& out) const {
  const auto here = shape(moment, drag_ ? drag_->object : selected);
  if (!here) return;
  const bool ours = drag_ && drag_->window == moment.window;
  draw_gizmo(*here, moment.camera, ours ? std::optional(drag_->handle) : under_pointer_, moment.sizes.scale, out);
  if (!ours) return;
  constexpr DebugColor kText = {1.0F, 0.86F, 0.20F, 1.0F}, kWay = {1.0F, 0.86F, 0.20F, 0.8F};
  const math::Vec3 start = drag_->shape.centre;
  if (drag_->handle.turns) {
    const math::Vec3 axis = axis_of(drag_->handle);
    const math::Vec3 grip = grip_of(drag_->shape, drag_->handle, drag_->from);
    out.sector(here->centre, axis, here->ring_m * grip, drag_->way, {1.0F, 0.86F, 0.20F, 0.30F}, Seen::always);
  } else {
    out.line(start, start + drag_->way * axis_of(drag_->handle), kWay, 1.5 * moment.sizes.scale, Seen::always);
    out.point(start, kWay, 7.0 * moment.sizes.scale, Seen::always);
  }
  out.text(here->centre, way_text(drag_->handle, drag_->way), kText);
}

}  // namespace ambf::render
