#include "shown_world.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/clock.h"
#include "math/rotation.h"
#include "state/command.h"

namespace ambf::python {

namespace {

constexpr const char* kRefusal = "the world belongs to the program that shows it";
constexpr double kSlowest = 1e-3, kFastest = 1e3;  // as of a simulation

// Laid over what the world has; the parent stays where it is.
template <class Placed>
void place(const math::Pose& T_parent_object, math::Pose Placed::*in_world, math::Pose Placed::*in_parent, Placed& of) {
  const math::Pose T_world_parent = of.*in_world * math::inverse(of.*in_parent);
  of.*in_parent = T_parent_object;
  of.*in_world = T_world_parent * T_parent_object;
}

}  // namespace

// A frame stays valid until the second next call: the last two are kept beside the newest.
class ShownWorld::Reader final : public state::FrameReader {
 public:
  explicit Reader(ShownWorld& world) : world_(world) {}
  const state::Frame* latest() override {
    std::shared_ptr<const state::Frame> newest = world_.newest();
    std::rotate(frames_.begin(), frames_.end() - 1, frames_.end());
    frames_.front() = std::move(newest);
    return frames_.front().get();
  }
  const state::Frame* previous() override { return frames_[1].get(); }
  bool wait_newer(std::uint64_t, std::chrono::nanoseconds) override { return true; }

 private:
  ShownWorld& world_;
  std::array<std::shared_ptr<const state::Frame>, 3> frames_;
};

class ShownWorld::Port final : public state::CommandPort {
 public:
  Port(ShownWorld& world, state::ObjectId object) : world_(world), object_(object) {}
  void post(const state::Command& command) override {
    const auto* pose = std::get_if<state::PoseCommand>(&command);
    if (pose == nullptr || !pose->enabled) return;
    const std::lock_guard lock(world_.mutex_);
    world_.own(object_).T_parent_object = pose->T_parent_object;
  }
  void post(const state::Command& command, std::int64_t) override { post(command); }
  void keep_alive() override {}
  void hold() override {}
  void release() override {}  // it stays where it was put

 private:
  ShownWorld& world_;
  const state::ObjectId object_;
};

ShownWorld::ShownWorld(const state::Frame& frame, base::Log& log) : log_(log) { show(frame, 0.0); }

void ShownWorld::show(const state::Frame& frame, double seconds) {
  auto copy = std::make_shared<const state::Frame>(frame);
  const std::int64_t now_ns = base::steady_ns();
  {
    const std::lock_guard lock(mutex_);
    if (given_of_ != frame.structure) {
      given_of_ = frame.structure;
      auto own = std::make_shared<state::Structure>(*frame.structure);
      own->version = structure_ == nullptr ? 1 : structure_->version + 1;
      structure_ = std::move(own);
    }
    given_ = std::move(copy);
    given_ns_ = now_ns;
    due_ns_ = std::max(due_ns_ + base::to_ns(seconds / speed_), now_ns);
    changed_ = true;
  }
}

bool ShownWorld::wait_until_over(std::chrono::nanoseconds timeout) {
  const std::int64_t end_ns = base::steady_ns() + timeout.count();
  std::unique_lock lock(mutex_);
  for (;;) {
    const std::int64_t now_ns = base::steady_ns();
    if (ended_ || reset_) return true;
    if (paused_ && steps_ > 0) {
      --steps_;
      return true;
    }
    if (!paused_ && now_ns >= due_ns_) return true;
    if (now_ns >= end_ns) return false;
    const std::int64_t until_ns = paused_ ? end_ns : std::min(due_ns_, end_ns);
    news_.wait_for(lock, std::chrono::nanoseconds(until_ns - now_ns));
  }
}

bool ShownWorld::take_reset() {
  const std::lock_guard lock(mutex_);
  return std::exchange(reset_, false);
}

bool ShownWorld::paused() {
  const std::lock_guard lock(mutex_);
  return paused_;
}

void ShownWorld::end() {
  const std::lock_guard lock(mutex_);
  ended_ = true;
  news_.notify_all();
}

bool ShownWorld::ended() {
  const std::lock_guard lock(mutex_);
  return ended_;
}

std::unique_ptr<state::FrameReader> ShownWorld::make_reader() { return std::make_unique<Reader>(*this); }

std::shared_ptr<const state::Structure> ShownWorld::structure() {
  const std::lock_guard lock(mutex_);
  return structure_;
}

void ShownWorld::set_paused(bool paused) {
  const std::lock_guard lock(mutex_);
  paused_ = paused;
  steps_ = 0;
  changed_ = true;
  news_.notify_all();
}

void ShownWorld::step_paused(unsigned steps) {
  const std::lock_guard lock(mutex_);
  if (!paused_) return;
  steps_ += steps;
  news_.notify_all();
}

void ShownWorld::reset_world() {
  const std::lock_guard lock(mutex_);
  reset_ = true;
  news_.notify_all();
}

void ShownWorld::set_speed(double factor) {
  if (!(factor >= kSlowest && factor <= kFastest)) return;
  const std::lock_guard lock(mutex_);
  speed_ = factor;
  changed_ = true;
}

std::unique_ptr<state::StepTicket> ShownWorld::step(unsigned, std::vector<state::AddressedCommand>, bool) {
  return nullptr;  // only the Step service asks for it
}

void ShownWorld::set_gravity(const math::Vec3&) { log_.warning("gravity: %s", kRefusal); }

void ShownWorld::set_lens(state::ObjectId camera, const state::Lens& lens) {
  const std::lock_guard lock(mutex_);
  own(camera).lens = lens;
}

void ShownWorld::set_beam(state::ObjectId light, const state::Beam& beam) {
  const std::lock_guard lock(mutex_);
  own(light).beam = beam;
}

std::unique_ptr<state::CommandPort> ShownWorld::bind(state::ObjectId object, state::Source) {
  const std::lock_guard lock(mutex_);
  const std::uint32_t index = state::find(*structure_, object);
  if (index == state::kNone) return nullptr;
  const state::ObjectKind kind = structure_->objects[index].kind;
  if (kind != state::ObjectKind::camera && kind != state::ObjectKind::light) return nullptr;
  return std::make_unique<Port>(*this, object);
}

void ShownWorld::refuse(const state::Completion& done) {
  state::Outcome outcome;
  outcome.message = kRefusal;
  if (done) done(outcome);
}

ShownWorld::Own& ShownWorld::own(state::ObjectId object) {
  changed_ = true;
  const auto found = std::find_if(own_.begin(), own_.end(), [&](const Own& each) { return each.object == object; });
  if (found != own_.end()) return *found;
  own_.push_back({object});
  return own_.back();
}

void ShownWorld::lay_over(state::Frame& frame) const {
  frame.run.paused = paused_;
  frame.run.speed_factor = speed_;
  for (const Own& each : own_) {
    const std::uint32_t index = state::find(*structure_, each.object);
    if (index == state::kNone) continue;
    const state::ObjectInfo& info = structure_->objects[index];
    if (info.kind == state::ObjectKind::camera) {
      state::CameraState& camera = frame.cameras[info.slot];
      if (each.lens) camera.lens = *each.lens;
      if (each.T_parent_object)
        place(*each.T_parent_object, &state::CameraState::T_world_camera, &state::CameraState::T_parent_camera, camera);
    } else if (info.kind == state::ObjectKind::light) {
      state::LightState& light = frame.lights[info.slot];
      if (each.beam) light.beam = *each.beam;
      if (each.T_parent_object)
        place(*each.T_parent_object, &state::LightState::T_world_light, &state::LightState::T_parent_light, light);
    }
  }
}

std::shared_ptr<const state::Frame> ShownWorld::newest() {
  const std::lock_guard lock(mutex_);
  if (!changed_) return shown_;
  changed_ = false;
  auto frame = std::make_shared<state::Frame>(*given_);
  frame->sequence = ++sequence_;
  frame->steady_ns = given_ns_;
  frame->structure = structure_;
  lay_over(*frame);
  shown_ = std::move(frame);
  return shown_;
}

}  // namespace ambf::python
