#include "render/view_camera.h"

#include <algorithm>
#include <cmath>

#include "math/rotation.h"

namespace ambf::render {

namespace {

// A move is on its way to the physics thread and back for so long: until then our own pose counts.
constexpr std::int64_t kOnItsWay_ns = 250'000'000;

std::uint64_t key_of(state::ObjectId id) { return (std::uint64_t{id.generation} << 32) | id.index; }

}  // namespace

void ViewCamera::choose(const state::Structure& structure, const state::Frame& frame) {
  structure_version_ = structure.version;
  std::uint32_t first = state::kNone, kept = state::kNone;
  for (std::uint32_t slot = 0; slot < structure.cameras.size(); ++slot) {
    const state::ObjectId id = structure.objects[structure.cameras[slot].object].id;
    first_poses_.emplace(key_of(id), frame.cameras[slot].T_parent_camera);
    if (object_.valid() && id == object_) kept = slot;
    if (first == state::kNone && structure.cameras[slot].visible) first = slot;
  }
  if (kept != state::kNone) {
    slot_ = kept;
  } else if (first != state::kNone) {
    take_over(structure, first, frame);
  } else {
    port_.reset();
    object_ = {};
    slot_ = state::kNone;
    info_ = {};
    name_ = "view";
    framed_ = false;
  }
}

void ViewCamera::take_over(const state::Structure& structure, std::uint32_t slot, const state::Frame& frame) {
  slot_ = slot;
  info_ = structure.cameras[slot];
  object_ = structure.objects[info_.object].id;
  name_ = structure.objects[info_.object].local_name;
  port_ = control_.bind(object_, state::Source::pointer);
  view_.T_parent_camera = frame.cameras[slot].T_parent_camera;
  // Turning is about what the file says is looked at, as far ahead as that is.
  const double ahead = math::dot(view_.T_parent_camera.position - info_.look_at, backward(view_.T_parent_camera));
  view_.target_distance_m = ahead > 1e-3 ? ahead : 1.0;
  camera_.near_m = info_.near_plane_m;
  camera_.far_m = info_.far_plane_m;
  camera_.field_of_view_rad = info_.field_of_view_rad;
  camera_.orthographic_width_m = info_.orthographic_width_m;
}

void ViewCamera::follow(const state::Frame& frame, const ScenePoses& poses, const Sphere& scene, double aspect,
                        std::int64_t now_ns) {
  const state::Structure& structure = *frame.structure;
  if (structure.version != structure_version_) choose(structure, frame);
  if (slot_ == state::kNone) {
    if (!framed_ && scene.radius > 0.0) {
      framed_ = true;
      camera_ = framing(scene, aspect);
      view_ = {camera_.T_world_camera, math::norm(camera_.T_world_camera.position - scene.centre)};
    }
    camera_.T_world_camera = view_.T_parent_camera;
    return;
  }
  const state::CameraState& now = frame.cameras[slot_];
  const bool mine = now_ns - moved_ns_ < kOnItsWay_ns;
  if (!mine) view_.T_parent_camera = now.T_parent_camera;
  T_world_parent_ = poses.cameras[slot_] * math::inverse(now.T_parent_camera);
  camera_.T_world_camera = mine ? T_world_parent_ * view_.T_parent_camera : poses.cameras[slot_];
}

void ViewCamera::move(const View& view, std::int64_t now_ns) {
  view_ = view;
  moved_ns_ = now_ns;
  if (port_ == nullptr) return;
  state::PoseCommand command{true, view.T_parent_camera};
  if (state::check(command).empty()) port_->post(command);
}

void ViewCamera::widen(double factor) {
  camera_.orthographic_width_m = std::clamp(camera_.orthographic_width_m * factor, 1e-3, 1e3);
}

void ViewCamera::rest() {
  if (port_ != nullptr) port_->release();
}

void ViewCamera::reset_all(const state::Frame& frame, std::int64_t now_ns) {
  framed_ = false;
  const state::Structure& structure = *frame.structure;
  for (const state::CameraInfo& camera : structure.cameras) {
    const state::ObjectId id = structure.objects[camera.object].id;
    const auto first = first_poses_.find(key_of(id));
    if (first == first_poses_.end()) continue;
    if (id == object_) {
      View view = view_;
      view.T_parent_camera = first->second;
      view.target_distance_m = std::max(1e-3, math::norm(first->second.position - info_.look_at));
      camera_.orthographic_width_m = info_.orthographic_width_m;
      move(view, now_ns);
    } else if (const auto port = control_.bind(id, state::Source::pointer)) {
      port->post(state::PoseCommand{true, first->second});
    }
  }
}

}  // namespace ambf::render
