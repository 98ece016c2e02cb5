// What the mouse does in a window.
#include <algorithm>
#include <functional>

#include "base/clock.h"
#include "render/window/camera_window.h"

namespace ambf::render {

void CameraWindow::handle_inputs(const Scene& scene, const Gestures& gestures,
                                 const std::function<void(const Input&)>& others) {
  gestures_ = gestures;
  const std::vector<Input> inputs = window_->take_inputs();
  if (inputs.empty()) return;
  const WindowMoment now = moment(scene);
  for (const Input& input : inputs) {
    gestures_ = gestures;  // the key before it may have changed them
    // A release concerns the part that saw the press, whatever lies under the pointer now.
    const auto* button = std::get_if<ButtonInput>(&input);
    bool taken = false;
    for (const auto& part : shared_.parts) {
      if (taken) {
        part->on_consumed(now, input);
      } else {
        taken = part->on_input(now, input);
      }
    }
    if (taken && (button == nullptr || button->pressed)) continue;
    if (button != nullptr) {
      on_button(*button);
    } else if (const auto* motion = std::get_if<MotionInput>(&input)) {
      on_motion(*motion);
    } else if (const auto* wheel = std::get_if<WheelInput>(&input)) {
      on_wheel(*wheel);
    } else {
      others(input);
    }
  }
}

void CameraWindow::on_button(const ButtonInput& button) {
  x_ = button.x;
  y_ = gestures_.mirrored ? window_->size().height - button.y : button.y;
  if (!button.pressed) {
    if (button.button == MouseButton::left) {
      if (picker_.pressed()) picker_.release();
      panning_ = false;
      rotating_ = false;
    }
    if (button.button == MouseButton::middle) panning_ = rotating_ = false;
    if (button.button == MouseButton::right) looking_ = false;
    view_->rest();
    return;
  }
  switch (button.button) {
    case MouseButton::left:
      if (gestures_.picking || button.modifiers.control) {
        const auto [width, height] = scene_size();
        pick_eye_ = eye_at(eyes_of(view_->camera(), view_->lens(), width), x_);
        if (!picker_.press(pick_eye_.camera, pick_eye_.width, height, x_ - pick_eye_.left, y_)) {
          shared_.messages->add("too many pointers hold something");
        }
      } else {
        (button.modifiers.alt ? rotating_ : panning_) = true;
      }
      break;
    case MouseButton::middle: (button.modifiers.shift ? panning_ : rotating_) = true; break;
    case MouseButton::right: looking_ = true; break;
  }
}

void CameraWindow::on_motion(const MotionInput& motion) {
  const auto [width, height] = scene_size();
  const double y = gestures_.mirrored ? height - motion.y : motion.y;
  const double right_px = motion.x - x_, down_px = y - y_;
  x_ = motion.x;
  y_ = y;
  if (width <= 0 || height <= 0) return;
  if (picker_.pressed()) {
    picker_.drag(pick_eye_.camera, pick_eye_.width, height, x_ - pick_eye_.left, y_);
    return;
  }
  const double turn = gestures_.inverted ? -1.0 : 1.0;
  const double slow = motion.left_shift && !rotating_ ? kSlow : 1.0;
  const std::int64_t now_ns = base::steady_ns();
  const View& view = view_->view();
  const state::CameraInfo& info = view_->info();
  if (panning_) {
    const Camera& camera = view_->camera();
    const double scale = camera.orthographic_width_m > 0.0
                             ? camera.orthographic_width_m * (view_->lens().stereo ? 2.0 : 1.0) / width
                             : pan_scale(view, info.pan, camera.field_of_view_rad, height);
    const double wide = camera.orthographic_width_m > 0.0 ? 1.0 : camera.optics.focal_ratio;
    view_->move(pan(view, right_px / wide, down_px, slow * scale), now_ns);
  } else if (looking_) {
    view_->move(look(view, right_px, turn * down_px, slow * kLookPerPixel * info.rotate), now_ns);
  } else if (rotating_) {
    view_->move(orbit(view, right_px, turn * down_px, slow * kOrbitPerPixel * info.arcball), now_ns);
  }
}

void CameraWindow::on_wheel(const WheelInput& wheel) {
  const double notches = wheel.notches * (wheel.left_shift ? kSlow : 1.0);
  const double multiplier = view_->info().scroll;
  if (view_->camera().orthographic_width_m > 0.0) {
    view_->widen(1.0 - 0.1 * std::clamp(notches * multiplier, -5.0, 5.0));
    return;
  }
  // The target keeps the reference's distance of half a metre, or less where the camera is made for small things.
  const double least = std::min(kMinTargetDistance_m, 5.0 * view_->camera().near_m);
  view_->move(dolly(view_->view(), notches, multiplier, least), base::steady_ns());
}

}  // namespace ambf::render
