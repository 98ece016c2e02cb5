#include "devices/detail/frame_view.h"

#include <algorithm>

#include "base/clock.h"
#include "math/rotation.h"

namespace ambf::devices {

using state::kNone;

namespace {

constexpr double kLongestPeriod_s = 0.1;  // extrapolating farther would invent motion

std::uint32_t slot_of(const state::Structure& structure, state::ObjectId id) {
  const std::uint32_t object = id.valid() ? state::find(structure, id) : kNone;
  return object == kNone ? kNone : structure.objects[object].slot;
}

}  // namespace

void FrameView::bind(const EffectorBinding* binding) {
  binding_ = binding;
  stale_ = true;
}

void FrameView::update(const state::Frame* frame, std::int64_t now_ns) {
  frame_ = frame;
  is_new_ = false;
  if (frame == nullptr) return;
  is_new_ = frame->sequence != sequence_;
  sequence_ = frame->sequence;
  // Between slow iterations of physics, frames show the same step again.
  if (step_ns_ == 0 || frame->sim_step != sim_step_) {
    if (step_ns_ != 0) period_s_ = std::min(kLongestPeriod_s, base::to_seconds(frame->steady_ns - step_ns_));
    sim_step_ = frame->sim_step;
    step_ns_ = frame->steady_ns;
  }
  age_s_ = base::to_seconds(now_ns - frame->steady_ns);
  const bool time_flows = !frame->run.paused && !frame->run.throttled;
  step_age_s_ = time_flows ? base::to_seconds(now_ns - step_ns_) : 0.0;
  if (stale_ || frame->structure->version != structure_version_) find_objects();
}

void FrameView::find_objects() {
  const state::Structure& structure = *frame_->structure;
  structure_version_ = structure.version;
  stale_ = false;
  body_ = kNone;
  camera_count_ = jaw_joint_count_ = 0;
  if (binding_ == nullptr) return;
  if (binding_->port != nullptr) body_ = slot_of(structure, binding_->body);
  if (body_ != kNone) com_body_ = structure.bodies[body_].T_body_com.position;
  for (const EffectorBinding::Camera& camera : binding_->cameras) {
    if (camera_count_ == kMaxCameras) break;
    const std::uint32_t slot = slot_of(structure, camera.id);
    cameras_[camera_count_] = slot;
    camera_objects_[camera_count_++] = slot == kNone ? kNone : structure.cameras[slot].object;
  }
  for (const state::ObjectId id : binding_->jaw_joints) {
    const std::uint32_t slot = slot_of(structure, id);
    if (slot != kNone && jaw_joint_count_ < kMaxJawJoints) jaw_joints_[jaw_joint_count_++] = slot;
  }
}

math::Twist FrameView::twist_world_sde() const {
  const state::BodyState& state = body();
  const math::Vec3 from_com = rotate(state.T_world_body.orientation, -com_body_);
  return {state.twist_world.linear + cross(state.twist_world.angular, from_com), state.twist_world.angular};
}

math::Pose FrameView::T_world_sde() const {
  const double seconds = std::clamp(step_age_s_, 0.0, period_s_);
  const math::Twist twist = twist_world_sde();
  const math::Pose& T = body().T_world_body;
  return {T.position + twist.linear * seconds, math::normalized(math::exp(twist.angular * seconds) * T.orientation)};
}

const state::EffectorState* FrameView::own() const {
  const auto& rows = frame_->effectors;
  const auto row =
      std::find_if(rows.begin(), rows.end(), [this](const auto& r) { return r.body == body_ && r.source == source_; });
  return row == rows.end() ? nullptr : &*row;
}

bool FrameView::partner_engaged() const {
  return std::any_of(frame_->effectors.begin(), frame_->effectors.end(),
                     [this](const auto& r) { return r.body == body_ && r.source != source_ && r.pulls && r.engaged; });
}

bool FrameView::is_shared() const {
  return std::any_of(frame_->effectors.begin(), frame_->effectors.end(),
                     [this](const auto& r) { return r.body == body_ && r.source != source_; });
}

double FrameView::jaw_opening() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < jaw_joint_count_; ++i) {
    const state::JointInfo& joint = frame_->structure->joints[jaw_joints_[i]];
    const double span = joint.upper - joint.lower;
    const double position = frame_->joints[jaw_joints_[i]].position;
    sum += span > 0.0 ? std::clamp((position - joint.lower) / span, 0.0, 1.0) : 0.5;
  }
  return jaw_joint_count_ == 0 ? 0.5 : sum / static_cast<double>(jaw_joint_count_);
}

bool FrameView::camera_commanded(std::size_t i) const {
  const std::uint32_t object = camera_objects_[i];
  return std::any_of(frame_->commands.begin(), frame_->commands.end(), [object](const state::CommandState& row) {
    return row.object == object && row.in_force && row.source < state::Source::device_0;
  });
}

}  // namespace ambf::devices
