// What a device sees of the newest frame: its effector, its cameras, its partners. Device's thread; nothing allocates.
#pragma once

#include <array>
#include <cstdint>

#include "devices/device_settings.h"
#include "state/frame.h"

namespace ambf::devices {

class FrameView {
 public:
  static constexpr std::size_t kMaxCameras = 16, kMaxJawJoints = 32;

  explicit FrameView(state::Source source) : source_(source) {}

  // Objects are found by their ids, again whenever the binding or the structure changes.
  void bind(const EffectorBinding* binding);
  void update(const state::Frame* frame, std::int64_t now_ns);

  const state::Frame* frame() const { return frame_; }
  bool is_new() const { return is_new_; }  // another frame than in the update before
  double age_s() const { return age_s_; }  // of the frame, since it was published
  bool has_effector() const { return body_ != state::kNone; }
  const state::BodyState& body() const { return frame_->bodies[body_]; }
  // Where the body (mesh) frame is by now: moved on by its velocity since the step that the frame shows, for at most
  // one iteration of physics. It stands during a pause and while physics waits for a clock.
  math::Pose T_world_sde() const;
  math::Twist twist_world_sde() const;  // of the body frame's origin
  // What physics made of this device's set-points; null: nothing yet.
  const state::EffectorState* own() const;
  bool partner_engaged() const;  // another device moves the same body
  bool is_shared() const;        // another device holds the same body
  double jaw_opening() const;    // mean of the joints': 0 closed .. 1 open; 0.5 without joints

  std::size_t cameras() const { return camera_count_; }
  bool has_camera(std::size_t i) const { return i < camera_count_ && cameras_[i] != state::kNone; }
  const state::CameraState& camera(std::size_t i) const { return frame_->cameras[cameras_[i]]; }
  // Someone other than a device commands it.
  bool camera_commanded(std::size_t i) const;

 private:
  void find_objects();

  const state::Source source_;
  const EffectorBinding* binding_ = nullptr;
  const state::Frame* frame_ = nullptr;
  std::uint64_t sequence_ = 0, structure_version_ = 0;
  std::uint32_t sim_step_ = 0;
  std::int64_t step_ns_ = 0;  // when that step was shown first; 0: not yet
  bool is_new_ = false, stale_ = true;
  double age_s_ = 0.0, step_age_s_ = 0.0, period_s_ = 1e-3;
  std::uint32_t body_ = state::kNone;  // slots
  math::Vec3 com_body_;
  std::size_t camera_count_ = 0, jaw_joint_count_ = 0;
  std::array<std::uint32_t, kMaxCameras> cameras_{}, camera_objects_{};
  std::array<std::uint32_t, kMaxJawJoints> jaw_joints_{};
};

}  // namespace ambf::devices
