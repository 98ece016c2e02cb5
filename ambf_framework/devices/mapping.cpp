#include "devices/mapping.h"

#include <algorithm>

#include "math/rotation.h"

namespace ambf::devices {

using math::inverse;
using math::normalized;
using math::Pose;
using math::Quat;
using math::rotate;
using math::Vec3;

void CameraClutch::tick(const Pose& T_world_cam, const Pose& T_u_iid, const Pose& T_u_iid_previous,
                        double camera_scaling, bool moving) {
  if (!moving) {
    T_world_cam_pre_cl_ = T_world_cam_cl_ = T_world_cam;  // row 3
    T_u_iid_pre_cl_ = T_u_iid;                            // row 4
    return;
  }
  // Rows 1, 2. The position adds up on what was wanted before, not on the newest frame, which shows it a step later.
  const Vec3 moved = T_u_iid.position - T_u_iid_previous.position;
  T_world_cam_cl_.position += camera_scaling * rotate(T_world_cam_cl_.orientation, moved);
  T_world_cam_cl_.orientation =
      normalized(T_world_cam_pre_cl_.orientation * (T_u_iid.orientation * inverse(T_u_iid_pre_cl_.orientation)));
}

void Mapping::set_mounting(const Pose& T_base_bo, const Pose& T_e_to) {
  frames_.T_base_bo = T_base_bo;
  frames_.T_e_to = T_e_to;
  frames_.T_u_base = inverse(T_base_bo);
}

void Mapping::set_offsets(const Pose& T_world_sde_bo, const Quat& R_sde_to) {
  frames_.T_world_sde_bo = T_world_sde_bo;
  frames_.T_sde_to = {{}, R_sde_to};
  R_sde_to_ = R_sde_to;
}

void Mapping::start_at(const Pose& T_world_ref) {
  frames_.T_world_ref = T_world_ref;
  first_ = true;
}

void Mapping::anchor(const Pose& T_u_iid, const MappingInput& in) {
  frames_.T_u_iid_cl = T_u_iid;  // rows 5, 6
  frames_.T_world_ref.orientation = normalized(frames_.T_world_ref.orientation);
  frames_.T_world_ref_o = frames_.T_world_ref;  // rows 7, 8: in world units
  R_world_cam_anchor_ = in.T_world_cam.orientation;
  scaling_anchor_ = in.workspace_scaling;
  rotation_anchor_ = in.rotation;
  // Row 11 holds for REF as it is.
  frames_.T_sde_to.orientation = in.rotation == state::RotationReference::world
                                     ? normalized(inverse(frames_.T_world_sde_bo.orientation * T_u_iid.orientation) *
                                                  frames_.T_world_ref.orientation)
                                     : R_sde_to_;
}

void Mapping::tick(const MappingInput& in) {
  const Quat& R_world_cam = in.T_world_cam.orientation;
  const bool rotation_changed = first_ || in.rotation != rotation_anchor_;
  if (first_) T_u_iid_previous_ = in.T_u_iid;
  if (rotation_changed || R_world_cam != R_world_cam_anchor_ || in.workspace_scaling != scaling_anchor_) {
    anchor(T_u_iid_previous_, in);
  }
  first_ = false;

  camera_.tick(in.T_world_cam, in.T_u_iid, T_u_iid_previous_, in.camera_scaling, in.camera_clutch && in.camera_lock);

  if (in.clutch || in.camera_clutch) {
    anchor(in.T_u_iid, in);
  } else {
    Pose& ref = frames_.T_world_ref;
    ref.position =
        frames_.T_world_ref_o.position +
        in.workspace_scaling * rotate(R_world_cam, in.T_u_iid.position - frames_.T_u_iid_cl.position);  // row 9
    if (in.rotation == state::RotationReference::camera) {
      const Quat turn = in.T_u_iid.orientation * inverse(frames_.T_u_iid_cl.orientation);
      ref.orientation = R_world_cam * turn * inverse(R_world_cam) * frames_.T_world_ref_o.orientation;  // row 10
    } else {
      Quat& R_to = frames_.T_sde_to.orientation;
      const Vec3 away = math::log(inverse(R_to) * R_sde_to_);
      const double angle = norm(away);
      if (angle > 0.0 && !rotation_changed)
        R_to = normalized(R_to * math::exp(away * std::min(1.0, kAlignRate * in.dt / angle)));
      ref.orientation = frames_.T_world_sde_bo.orientation * in.T_u_iid.orientation * R_to;  // row 11
    }
  }

  frames_.T_world_u = frames_.T_world_cam = in.T_world_cam;
  frames_.T_world_cam_cl = camera_.pose();
  frames_.T_world_cam_pre_cl = camera_.before();
  frames_.T_u_iid_pre_cl = camera_.hand_before();
  frames_.T_u_iid = in.T_u_iid;
  frames_.T_base_e = frames_.T_base_bo * in.T_u_iid * inverse(frames_.T_e_to);
  T_u_iid_previous_ = in.T_u_iid;
}

}  // namespace ambf::devices
