// What a request may do to the physics loop while it runs, on the loop's thread.
#pragma once

#include <memory>
#include <vector>

#include "runtime/detail/physics_loop.h"
#include "state/abilities/outcome.h"
#include "state/abilities/pick.h"
#include "state/parameters.h"
#include "state/view.h"

namespace ambf::runtime {

class RequestScope {
 public:
  explicit RequestScope(PhysicsLoop& loop) : loop_(loop) {}

  model::LiveWorld& world() { return loop_.world(); }
  bool diverged() const { return loop_.control().diverged(); }

  void set_paused(bool paused);
  void step_paused(std::uint64_t steps) { loop_.control().step_paused(steps); }
  void start_steps(std::uint64_t steps) { loop_.control().start_steps(steps); }
  std::uint64_t steps_left() const { return loop_.control().service_steps_left(); }
  bool steps_cut() const { return loop_.control().service_steps_cut(); }
  // Commands that came since the last step, and the watchdogs' clock as it is now.
  void take_commands() { loop_.world().take_commands(loop_.watch_s()); }
  // First of all that a request of the loader does: it belongs to this change of the scene.
  void begin_scene_request(std::uint64_t change);
  void world_command_silent() { loop_.control().world_command_silent(); }

  // Links a prepared change in; `garbage` and `frames` receive what it replaced.
  void swap(model::Prepared&& prepared, model::Garbage& garbage, std::vector<std::unique_ptr<state::Frame>>& frames) {
    loop_.swap(std::move(prepared), garbage, frames);
  }
  void reset_world();
  void reset_bodies();
  void reset_bodies(const std::vector<state::ObjectId>& bodies);
  void set_speed(double factor);
  void set_gravity(const math::Vec3& gravity_world);
  bool set_hold(state::ObjectId object, bool hold);
  void set_lens(state::ObjectId camera, const state::Lens& lens);
  void set_beam(state::ObjectId light, const state::Beam& beam);
  bool pick(std::size_t slot, std::uint64_t press, const math::Vec3& from_world, const math::Vec3& to_world,
            state::PickHit& hit);
  // Values that state::check has passed.
  state::Outcome set_parameter(state::ObjectId object, state::Parameter parameter, const math::Vec3& value);
  state::Outcome push(state::ObjectId body, const state::Push& push);
  void restored();  // the world was restored from a snapshot

 private:
  PhysicsLoop& loop_;
};

}  // namespace ambf::runtime
