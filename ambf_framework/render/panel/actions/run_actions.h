// Requests of the panel that change how the world runs: pause, steps there and back, speed, resets, snapshots, pushes.
// Main thread.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "render/panel/detail/held_joints.h"
#include "render/panel/notices.h"
#include "state/abilities/command.h"
#include "state/abilities/run.h"
#include "state/frame.h"

namespace ambf::render {

class RunActions {
 public:
  // `held` is released where the world goes back in time.
  RunActions(state::RunAbility& run, state::CommandAbility& command, HeldJoints& held, const Notices& notices)
      : run_(run), command_(command), held_(held), notices_(notices) {}

  // Once a picture; the frame stays valid until the next call.
  void observe(const state::Frame& frame) { frame_ = &frame; }

  void toggle_pause();
  void step(unsigned steps);  // while paused; keeps the state before it
  bool can_step_back() const { return !steps_back_.empty() && steps_back_epoch_ == frame_->epoch; }
  void step_back();
  void set_speed(double factor) { run_.set_speed(factor); }
  void reset_world();
  void reset_bodies();
  void reset_mechanism(state::ObjectId body);  // and all that is jointed to it
  void push(state::ObjectId body, const state::Push& push);

  void take_snapshot(const std::string& name, const std::string& path);
  void restore_snapshot(const std::string& name, const std::string& path);
  void forget_snapshot(const std::string& name);
  std::vector<std::string> snapshots() const;  // without those of step()

 private:
  state::RunAbility& run_;
  state::CommandAbility& command_;
  HeldJoints& held_;
  const Notices& notices_;
  const state::Frame* frame_ = nullptr;
  std::deque<std::string> steps_back_;  // names of snapshots, newest last
  unsigned next_step_back_ = 0;
  std::uint64_t steps_back_epoch_ = 0;
};

}  // namespace ambf::render
