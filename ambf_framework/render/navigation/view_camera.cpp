#include "render/navigation/view_camera.h"

#include <algorithm>
#include <cmath>

#include "math/rotation.h"
#include "render/navigation/framing.h"
#include "render/navigation/way_to_physics.h"

namespace ambf::render {

void ViewCamera::take_over(const state::Frame& frame) {
  taken_over_ = true;
  port_ = command_.bind(object_, state::Source::pointer);
  view_.T_parent_camera = frame.cameras[slot_].T_parent_camera;
  // Turning is about what the file says is looked at, as far ahead as that is.
  const double ahead = math::dot(view_.T_parent_camera.position - info_.look_at, backward(view_.T_parent_camera));
  view_.target_distance_m = ahead > 1e-3 ? ahead : 1.0;
  set_lens(camera_, frame.cameras[slot_].lens);
}

void ViewCamera::follow(const state::Frame& frame, const ScenePoses& poses, const std::vector<Sphere>& things,
                        double aspect, std::int64_t now_ns) {
  if (!object_.valid()) {
    if (!framed_ && !things.empty()) {
      framed_ = true;
      const Framing all = framing(things, aspect);
      camera_ = all.camera;
      view_ = all.view;
    }
    frame_asked(frame, aspect, now_ns);
    camera_.T_world_camera = view_.T_parent_camera;
    return;
  }
  const state::Structure& structure = *frame.structure;
  if (structure.version != structure_version_) {
    structure_version_ = structure.version;
    const std::uint32_t object = state::find(structure, object_);
    slot_ = object == state::kNone ? state::kNone : structure.objects[object].slot;
    if (slot_ != state::kNone) info_ = structure.cameras[slot_];
  }
  const math::Pose* T_world = slot_ == state::kNone ? nullptr : poses.of(structure.objects[info_.object]);
  if (T_world == nullptr) return;  // gone: the window will be, too
  if (!taken_over_) take_over(frame);
  if (frame.epoch != epoch_) framed_ = false;  // a reset brought it back to where it was before we framed it
  epoch_ = frame.epoch;
  if (wants_framing() && !things.empty()) {
    framed_ = true;
    const Framing all = framing(things, aspect);
    state::Lens lens = frame.cameras[slot_].lens;
    lens.near_m = all.camera.near_m;
    lens.far_m = all.camera.far_m;
    lens.field_of_view_rad = all.camera.field_of_view_rad;
    tune_.set_lens(object_, lens);
    move(all.view, now_ns);  // not released: that would end the command before it is seen
  }
  const state::CameraState& now = frame.cameras[slot_];
  lens_ = now.lens;
  set_lens(camera_, lens_);
  if (on_its_way_ && (now_ns - moved_ns_ > kLongestWay_ns || has_come(now.T_parent_camera, view_.T_parent_camera))) {
    on_its_way_ = false;
  }
  if (!on_its_way_) view_.T_parent_camera = now.T_parent_camera;
  T_world_parent_ = *T_world * math::inverse(now.T_parent_camera);
  camera_.T_world_camera = on_its_way_ ? T_world_parent_ * view_.T_parent_camera : *T_world;
  frame_asked(frame, aspect, now_ns);
}

// Keeps the lens but for clipping planes that would cut what is framed.
void ViewCamera::frame_asked(const state::Frame& frame, double aspect, std::int64_t now_ns) {
  if (asked_.empty()) return;
  const Framing all = framing(asked_, aspect, camera_);
  asked_.clear();
  framed_ = true;
  const double near_m = std::min(camera_.near_m, all.camera.near_m), far_m = std::max(camera_.far_m, all.camera.far_m);
  if (!object_.valid()) {
    camera_.near_m = near_m;
    camera_.far_m = far_m;
    view_ = all.view;
    return;
  }
  if (near_m != camera_.near_m || far_m != camera_.far_m) {
    state::Lens lens = frame.cameras[slot_].lens;
    lens.near_m = near_m;
    lens.far_m = far_m;
    tune_.set_lens(object_, lens);
  }
  View view = all.view;
  view.T_parent_camera = math::inverse(T_world_parent_) * view.T_parent_camera;
  move(view, now_ns);
  camera_.T_world_camera = all.view.T_parent_camera;
}

void ViewCamera::move(const View& view, std::int64_t now_ns) {
  view_ = view;
  if (port_ == nullptr) return;
  moved_ns_ = now_ns;
  on_its_way_ = true;
  state::PoseCommand command{true, view.T_parent_camera};
  if (state::check(command).empty()) port_->post(command);
}

void ViewCamera::begin_like(const ViewCamera& other) {
  if (object_.valid()) return;
  framed_ = true;
  camera_ = other.camera_;
  view_ = {camera_.T_world_camera, other.view_.target_distance_m};
}

void ViewCamera::widen(double factor) {
  state::Lens lens = lens_;
  if (!lens.orthographic) return;
  lens.orthographic_width_m = std::clamp(lens.orthographic_width_m * factor, 1e-3, 1e3);
  tune_.set_lens(object_, lens);
  lens_ = lens;
}

void ViewCamera::rest() {
  if (port_ != nullptr) port_->release();
}

void ViewCamera::reset(const math::Pose& T_parent_camera, std::int64_t now_ns) {
  framed_ = false;
  if (!object_.valid() || info_.frames_scene) return;  // follow() frames it anew
  View view = view_;
  view.T_parent_camera = T_parent_camera;
  view.target_distance_m = std::max(1e-3, math::norm(T_parent_camera.position - info_.look_at));
  tune_.set_lens(object_, info_.lens);
  move(view, now_ns);
}

}  // namespace ambf::render
