#include "render/window/detail/picker.h"

#include <algorithm>
#include <atomic>

#include "render/scene/object_kind.h"
#include "state/soft_bodies.h"

namespace ambf::render {

// Written once by the physics side, then read by us.
struct Picker::Answer {
  std::atomic<bool> come{false};
  bool hit = false;
  state::PickHit where;
};

namespace {

// The point that the pointer shows at `depth_m` in front of the camera.
math::Vec3 point_at(const Camera& camera, double width, double height, double x_px, double y_px, double depth_m) {
  const Ray ray = ray_through(camera, width, height, x_px, y_px);
  const double share = (depth_m - camera.near_m) / (camera.far_m - camera.near_m);
  return ray.from + share * (ray.to - ray.from);
}

}  // namespace

bool Picker::press(const Camera& camera, double width, double height, double x_px, double y_px) {
  if (port_ == nullptr) return false;
  pressed_ = true;
  width_ = width;
  height_ = height;
  x_px_ = x_px;
  y_px_ = y_px;
  answer_ = std::make_shared<Answer>();
  const Ray ray = ray_through(camera, width, height, x_px, y_px);
  port_->pick(ray.from, ray.to, [answer = answer_](bool hit, const state::PickHit& where) {
    answer->hit = hit;
    answer->where = where;
    answer->come.store(true, std::memory_order_release);
  });
  return true;
}

void Picker::drag(const Camera& camera, double width, double height, double x_px, double y_px) {
  width_ = width;
  height_ = height;
  x_px_ = x_px;
  y_px_ = y_px;
  if (!holding_) return;
  target_world_ = point_at(camera, width, height, x_px, y_px, depth_m_);
  port_->drag(target_world_);
}

void Picker::release() {
  if (pressed_) port_->release();
  pressed_ = holding_ = seen_ = false;
  body_ = state::kNone;
  force_world_ = {};
  answer_.reset();
}

bool Picker::update(const state::Frame& frame, const ScenePoses& poses, const Camera& camera) {
  const state::Structure& structure = *frame.structure;
  if (holding_) {
    const std::uint32_t object = state::find(structure, held_);
    const auto mine = [this](const auto& picks) -> const math::Vec3* {
      const auto pick =
          std::find_if(picks.begin(), picks.end(), [this](const auto& p) { return p.picker == port_->id(); });
      return pick == picks.end() ? nullptr : &pick->force_world;
    };
    const math::Vec3* force = mine(frame.picks);
    if (force == nullptr) force = mine(state::soft_picks(frame));
    const bool shown = force != nullptr;
    if (object == state::kNone || (seen_ && !shown)) {  // the body is gone, or a reset has let go of it
      release();
      return false;
    }
    body_ = structure.objects[object].slot;
    seen_ = seen_ || shown;
    if (shown) force_world_ = *force;
    return false;
  }
  if (answer_ == nullptr || !answer_->come.load(std::memory_order_acquire)) return false;
  const std::shared_ptr<Answer> answer = std::move(answer_);
  answer_.reset();
  if (!answer->hit || !pressed_) return false;
  const std::uint32_t object = state::find(structure, answer->where.object);
  if (object == state::kNone) return false;
  const bool soft = structure.objects[object].kind == state::soft_body_kind().kind;
  if (!soft && !is_body(structure.objects[object])) return false;
  held_ = last_ = answer->where.object;
  body_ = structure.objects[object].slot;
  if (!soft && body_ >= poses.bodies.size()) return false;
  if (is_room(structure, structure.objects[object])) {
    release();
    return true;
  }
  holding_ = true;
  depth_m_ = -(math::inverse(camera.T_world_camera) * answer->where.point_world).x;
  drag(camera, width_, height_, x_px_, y_px_);
  return true;
}

}  // namespace ambf::render
