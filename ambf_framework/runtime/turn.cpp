// What requests may do to the physics thread while they run.
#include "base/clock.h"
#include "runtime/detail/physics_thread.h"

namespace ambf::runtime {

void Turn::set_paused(bool paused) {
  thread_.paused_ = paused;
  thread_.manual_steps_ = 0;
  if (paused) thread_.end_steps_soon();
  thread_.changed_ = true;
}

void Turn::start_steps(std::uint64_t steps) {
  thread_.service_steps_ = thread_.diverged_ ? 0 : steps;
  thread_.throttle_.engage();  // the world waits for the next request
}

void Turn::swap(model::Prepared&& prepared, model::Garbage& garbage,
                std::vector<std::unique_ptr<state::Frame>>& frames) {
  std::vector<std::unique_ptr<state::Frame>> sized = std::move(prepared.frames);
  garbage = thread_.world_->apply(std::move(prepared));
  // Every slot of the pool gets a frame of the new size, at once where nobody reads it and otherwise when its turn
  // comes (publish). What was replaced, now or since the last swap, goes along to be freed, with the spare frames of
  // that swap.
  frames = std::move(thread_.new_frames_);
  thread_.new_frames_ = std::move(sized);
  for (int slot = 0; slot < FramePool::kSlots; ++slot) {
    if (thread_.frames_.try_exchange_slot(slot, thread_.new_frames_.back())) {
      frames.push_back(std::move(thread_.new_frames_.back()));
      thread_.new_frames_.pop_back();
    }
  }
  for (auto& old : thread_.old_frames_) frames.push_back(std::move(old));
  thread_.old_frames_.clear();
  // Shown before it moves: should it diverge in this very turn, there is a good frame of it.
  thread_.publish(base::steady_ns());
  thread_.changed_ = true;
}

void Turn::reset_world() {
  thread_.world_->reset();
  thread_.changed_ = true;
  thread_.diverged_ = false;
}

void Turn::reset_bodies() {
  thread_.world_->reset_bodies();
  thread_.changed_ = true;
  thread_.diverged_ = false;
}

void Turn::reset_bodies(const std::vector<state::ObjectId>& bodies) {
  thread_.world_->reset_bodies(bodies);
  thread_.changed_ = true;
  thread_.diverged_ = false;
}

void Turn::set_speed(double factor) {
  thread_.keeper_.set_speed(factor, base::steady_ns());
  thread_.changed_ = true;
}

void Turn::restored() {
  thread_.changed_ = true;
  thread_.diverged_ = false;
}

}  // namespace ambf::runtime
