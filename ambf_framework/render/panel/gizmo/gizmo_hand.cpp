#include "render/panel/gizmo/detail/gizmo_hand.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "render/marks/layer_shapes.h"
#include "render/navigation/way_to_physics.h"
#include "render/scene/object_kind.h"
#include "state/kind_rows.h"

namespace ambf::render {

namespace {

constexpr int kSides = 7;  // that a body is taken hold of from: the viewer's, and six

const state::ObjectInfo* find_object(const state::Frame& frame, state::ObjectId object) {
  const std::uint32_t index = state::find(*frame.structure, object);
  return index == state::kNone ? nullptr : &frame.structure->objects[index];
}

bool is_static(const state::Frame& frame, const state::ObjectInfo& body) {
  return frame.structure->bodies[body.slot].mass <= 0.0;
}

}  // namespace

// Written once by the physics side, then read by us.
struct GizmoHand::Answer {
  std::atomic<bool> come{false};
  bool hit = false;
  state::PickHit where;
};

bool GizmoHand::can_turn(const state::Frame& frame, state::ObjectId object) {
  const state::ObjectInfo* info = find_object(frame, object);
  return info != nullptr && (!is_body(*info) || !frame.run.paused);
}

bool GizmoHand::pose_of(const state::Frame& frame, state::ObjectId object, math::Pose& T_world_object) {
  const state::ObjectInfo* info = find_object(frame, object);
  if (info == nullptr) return false;
  const math::Pose* T = state::rows_of(info->kind).T_world(frame, info->slot);
  if (T != nullptr) T_world_object = *T;
  return T != nullptr;
}

std::string GizmoHand::begin(const state::Frame& frame, state::ObjectId object, bool turns,
                             const math::Vec3& towards_viewer, std::int64_t now_ns) {
  let_go();
  const state::ObjectInfo* info = find_object(frame, object);
  if (info == nullptr || !pose_of(frame, object, T_world_start_)) return "there is nothing to move";
  object_ = object;
  epoch_ = frame.epoch;
  T_world_target_ = T_world_start_;
  ended_ns_ = now_ns;
  const bool body = is_body(*info);
  placed_ = !body || is_static(frame, *info) || frame.run.paused;
  if (!body || turns || (is_static(frame, *info) && !frame.run.paused)) {
    port_ = command_.bind(object, state::Source::panel);
    if (port_ == nullptr) return info->name + " is gone";
    port_->hold();
    way_ = body ? Way::body_command : Way::pose_command;
    return {};
  }
  const Sphere bounds = bounds_of(frame.structure->bodies[info->slot]);
  if (!(bounds.radius > 0.0)) return info->name + " has no shape to take hold of";
  pick_ = pick_ability_.make_pick_port();
  if (pick_ == nullptr) return "too many pointers hold something";
  way_ = Way::pull;
  middle_world_ = T_world_start_ * bounds.centre;
  radius_m_ = 1.01 * bounds.radius;
  towards_viewer_ = towards_viewer;
  try_pick();
  return {};
}

void GizmoHand::try_pick() {
  const std::array<math::Vec3, kSides> sides = {
      {towards_viewer_, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}};
  const math::Vec3 out = radius_m_ * sides[static_cast<std::size_t>(tried_++)];
  answer_ = std::make_shared<Answer>();
  pick_->pick(middle_world_ + out, middle_world_ - out, [answer = answer_](bool hit, const state::PickHit& where) {
    answer->hit = hit;
    answer->where = where;
    answer->come.store(true, std::memory_order_release);
  });
}

void GizmoHand::post(const state::Frame& frame) {
  const state::ObjectInfo* info = find_object(frame, object_);
  if (info == nullptr || !moved_) return;
  if (way_ == Way::pull) {
    if (grasped_) pick_->drag(grasped_world_ + T_world_target_.position - T_world_start_.position);
  } else if (way_ == Way::body_command) {
    state::RigidBodyCommand command;
    command.type = state::CartesianCommandType::position;
    command.T_world_body = T_world_target_;
    if (state::check(command).empty()) port_->post(command);
  } else if (way_ == Way::pose_command) {
    const state::KindRows& rows = state::rows_of(info->kind);
    const math::Pose T_world_parent =
        *rows.T_world(frame, info->slot) * math::inverse(*rows.T_parent(frame, info->slot));
    state::PoseCommand command{true, math::inverse(T_world_parent) * T_world_target_};
    if (state::check(command).empty()) port_->post(command);
  }
}

void GizmoHand::move(const state::Frame& frame, const math::Pose& T_world_target) {
  if (way_ == Way::none || ending_) return;
  moved_ = true;
  T_world_target_ = T_world_target;
  post(frame);
}

void GizmoHand::end(const state::Frame& frame, std::int64_t now_ns) {
  if (way_ == Way::none) return;
  ending_ = true;
  ended_ns_ = now_ns;
  const state::ObjectInfo* info = find_object(frame, object_);
  // What is pulled or driven is let go where it is; what is put somewhere has to arrive there.
  if (info == nullptr || !moved_ || !placed_) let_go();
}

std::string GizmoHand::update(const state::Frame& frame, std::int64_t now_ns) {
  if (way_ == Way::none) return {};
  math::Pose T_world_now;
  if (frame.epoch != epoch_ || !pose_of(frame, object_, T_world_now)) {  // a reset took it back, or it is gone
    let_go();
    return {};
  }
  // Letting go before it has come would end it unseen.
  if (ending_ && (has_come(T_world_now, T_world_target_) || now_ns - ended_ns_ > kLongestWay_ns)) {
    let_go();
    return {};
  }
  if (answer_ == nullptr || !answer_->come.load(std::memory_order_acquire)) return {};
  const std::shared_ptr<Answer> answer = std::move(answer_);
  answer_.reset();
  if (answer->hit && answer->where.object == object_) {
    grasped_ = true;
    grasped_world_ = answer->where.point_world;
    post(frame);
    return {};
  }
  if (tried_ < kSides) {
    try_pick();
    return {};
  }
  const std::string name = find_object(frame, object_)->local_name;
  let_go();
  return name + " cannot be taken hold of: it collides with nothing, or something is all around it";
}

void GizmoHand::let_go() {
  if (port_ != nullptr) port_->release();
  if (pick_ != nullptr) pick_->release();
  port_.reset();
  pick_.reset();
  answer_.reset();
  way_ = Way::none;
  moved_ = ending_ = grasped_ = placed_ = false;
  tried_ = 0;
}

}  // namespace ambf::render
