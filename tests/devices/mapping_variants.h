// The mapping as the dissertation prints it, one printed row at a time: tests of the mapping must fail with each.
#pragma once

#include "devices/mapping.h"
#include "math/rotation.h"

namespace ambf::devices::testing {

enum class Printed { nothing, row_2, row_9, row_10, no_reanchoring };

// Independent of the product's class; mode c alone.
class MappingVariant {
 public:
  explicit MappingVariant(Printed printed) : printed_(printed) {}

  void start_at(const math::Pose& T_world_ref) { frames_.T_world_ref = T_world_ref; }
  const state::MappingFrames& frames() const { return frames_; }

  void tick(const MappingInput& in) {
    const math::Quat& R = in.T_world_cam.orientation;
    const bool changed = !(R == R_anchor_) || in.workspace_scaling != S_anchor_;
    if (first_) {
      previous_ = in.T_u_iid;
      anchor(in.T_u_iid, in);
    } else if (changed && printed_ != Printed::no_reanchoring) {
      anchor(previous_, in);
    }
    first_ = false;
    move_camera(in);
    if (in.clutch || in.camera_clutch) {
      anchor(in.T_u_iid, in);
    } else {
      move_reference(in, R);
    }
    previous_ = in.T_u_iid;
  }

 private:
  void anchor(const math::Pose& T_u_iid, const MappingInput& in) {
    hand_ = T_u_iid;
    origin_ = frames_.T_world_ref;
    R_anchor_ = in.T_world_cam.orientation;
    // The printed row 7 keeps REF-O in the hand's units, with the scaling of its time.
    origin_scaling_ = S_anchor_;
    S_anchor_ = in.workspace_scaling;
  }

  void move_camera(const MappingInput& in) {
    math::Pose& cl = frames_.T_world_cam_cl;
    if (!in.camera_clutch || !in.camera_lock) {
      cl = camera_before_ = in.T_world_cam;
      hand_before_ = in.T_u_iid.orientation;
      return;
    }
    cl.position += in.camera_scaling * rotate(cl.orientation, in.T_u_iid.position - previous_.position);
    const math::Quat turn = printed_ == Printed::row_2 ? inverse(hand_before_) * in.T_u_iid.orientation
                                                       : in.T_u_iid.orientation * inverse(hand_before_);
    cl.orientation = camera_before_.orientation * turn;
  }

  void move_reference(const MappingInput& in, const math::Quat& R) {
    math::Pose& ref = frames_.T_world_ref;
    const double S = in.workspace_scaling;
    const math::Vec3 moved = rotate(R, in.T_u_iid.position - hand_.position);
    ref.position =
        printed_ == Printed::row_9 ? S * (origin_.position / origin_scaling_ + moved) : origin_.position + S * moved;
    if (printed_ == Printed::row_10) {
      const math::Quat turn = inverse(hand_.orientation) * in.T_u_iid.orientation;
      ref.orientation = origin_.orientation * R * turn * inverse(R);
    } else {
      const math::Quat turn = in.T_u_iid.orientation * inverse(hand_.orientation);
      ref.orientation = math::normalized(R * turn * inverse(R) * origin_.orientation);
    }
  }

  Printed printed_;
  state::MappingFrames frames_;
  bool first_ = true;
  math::Pose previous_, hand_, origin_, camera_before_;
  math::Quat hand_before_, R_anchor_;
  double S_anchor_ = 1.0, origin_scaling_ = 1.0;
};

}  // namespace ambf::devices::testing
