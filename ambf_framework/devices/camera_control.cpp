#include "devices/detail/camera_control.h"

#include <algorithm>

#include "math/rotation.h"

namespace ambf::devices {

void CameraControl::acquire(EffectorBinding* binding, const FrameView& view, bool pressed) {
  const std::size_t count = binding == nullptr ? 0 : std::min(binding->cameras.size(), view.cameras());
  for (std::size_t i = 0; i < held_.size(); ++i) {
    if (i >= count) {
      held_[i] = false;
    } else if (!pressed || !view.has_camera(i) || (held_[i] && view.camera_commanded(i))) {
      if (held_[i]) {
        binding->cameras[i].port->release();  // others may move it at once
        binding->cameras[i].lock->release(source_);
      }
      held_[i] = false;
    } else if (!held_[i] && binding->cameras[i].port != nullptr && !view.camera_commanded(i)) {
      held_[i] = binding->cameras[i].lock->acquire(source_);
    }
  }
}

std::uint16_t CameraControl::held() const {
  static_assert(FrameView::kMaxCameras <= 16);
  unsigned bits = 0;
  for (std::size_t i = 0; i < held_.size(); ++i) bits |= held_[i] ? 1u << i : 0u;
  return static_cast<std::uint16_t>(bits);
}

void CameraControl::command(EffectorBinding* binding, const FrameView& view, const state::MappingFrames& frames,
                            const math::Pose& T_u_iid_previous, double camera_scaling, std::int64_t now_ns) {
  if (binding == nullptr) return;
  for (std::size_t i = 0; i < std::min(binding->cameras.size(), view.cameras()); ++i) {
    if (!view.has_camera(i)) continue;
    const state::CameraState& camera = view.camera(i);
    if (i > 0) clutches_[i].tick(camera.T_world_camera, frames.T_u_iid, T_u_iid_previous, camera_scaling, held_[i]);
    if (!held_[i]) continue;
    const math::Pose& T_world_wanted = i == 0 ? frames.T_world_cam_cl : clutches_[i].pose();
    const math::Pose T_world_parent = camera.T_world_camera * inverse(camera.T_parent_camera);
    math::Pose T_parent_wanted = inverse(T_world_parent) * T_world_wanted;
    // The next frame shows what is posted here, and the next pose is computed from it: rounding errors of its length
    // would double each time.
    T_parent_wanted.orientation = math::normalized(T_parent_wanted.orientation);
    binding->cameras[i].port->post(state::PoseCommand{true, T_parent_wanted}, now_ns);
  }
}

}  // namespace ambf::devices
