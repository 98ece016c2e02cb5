// From a hand's pose to the reference of the body that it moves and to the pose of its camera: Table 3.5, rows 1-11, of
// the dissertation as corrected in the design notes (EQUATIONS 4). One Mapping for each device-effector-camera triplet;
// it keeps the 17 frames. No time, threads or simulation in here. Not thread-safe.
//
// A user's hand moves the tool as the user sees it: along and about the axes of the camera's picture. REF moves only
// while the device is engaged, and always from where it was: pressing a clutch, a camera that somebody else turns,
// another scaling or another mode never moves it.
#pragma once

#include "math/types.h"
#include "state/devices.h"

namespace ambf::devices {

// One camera of a device: rows 1-4.
class CameraClutch {
 public:
  // Once a tick. `moving`: the device's camera clutch is pressed, and the device holds the camera's lock; then pose()
  // is where it wants the camera, in W. Else pose() is the camera's own.
  void tick(const math::Pose& T_world_cam, const math::Pose& T_u_iid, const math::Pose& T_u_iid_previous,
            double camera_scaling, bool moving);
  const math::Pose& pose() const { return T_world_cam_cl_; }         // CAM-CL
  const math::Pose& before() const { return T_world_cam_pre_cl_; }   // CAM-PRE-CL
  const math::Pose& hand_before() const { return T_u_iid_pre_cl_; }  // IID-PRE-CL

 private:
  math::Pose T_world_cam_cl_, T_world_cam_pre_cl_, T_u_iid_pre_cl_;
};

struct MappingInput {
  math::Pose T_u_iid;
  math::Pose T_world_cam;  // of the device's first camera, newest
  bool clutch = false, camera_clutch = false;
  bool camera_lock = false;        // with camera_clutch: the device may move its cameras
  double workspace_scaling = 1.0;  // S
  double camera_scaling = 10.0;    // S_CAM: the camera's metres for each of the hand
  state::RotationReference rotation = state::RotationReference::camera;
  double dt = 0.0;  // s since the last tick: in mode w the offset to the hand's absolute rotation shrinks at kAlignRate
};

class Mapping {
 public:
  // Mode w: REF's rotation approaches R_SDE_BO R_IID R_SDE_TO (row 11) so fast, rad/s, and jumps nowhere.
  static constexpr double kAlignRate = 1.0;

  // The device's mounting, which its driver has undone already: for the frames IID-B to IID-TO alone.
  void set_mounting(const math::Pose& T_base_bo, const math::Pose& T_e_to);
  // SDE-BO and SDE-TO: `location` and `orientation offset`.
  void set_offsets(const math::Pose& T_world_sde_bo, const math::Quat& R_sde_to);

  // REF begins at this pose (a new effector, a fault that is over, a reset), wherever the hand then is.
  void start_at(const math::Pose& T_world_ref);
  // While clutched: physics keeps REF, and lets it follow the body along axes that a partner moves
  // (state::SetPoint::engaged); the device engages again from there.
  void adopt(const math::Pose& T_world_ref) { frames_.T_world_ref = T_world_ref; }

  void tick(const MappingInput& in);
  void set_effector(const math::Pose& T_world_sde) { frames_.T_world_sde = T_world_sde; }

  const state::MappingFrames& frames() const { return frames_; }

 private:
  void anchor(const math::Pose& T_u_iid, const MappingInput& in);

  state::MappingFrames frames_;
  CameraClutch camera_;
  bool first_ = true;
  math::Pose T_u_iid_previous_;
  math::Quat R_sde_to_;  // as the device file says; frames_.T_sde_to is in force
  // What REF was anchored with.
  math::Quat R_world_cam_anchor_;
  double scaling_anchor_ = 1.0;
  state::RotationReference rotation_anchor_ = state::RotationReference::camera;
};

}  // namespace ambf::devices
