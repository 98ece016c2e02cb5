// What a Simulation consists of; for simulation.cpp only.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "base/clock.h"
#include "runtime/detail/loader.h"
#include "runtime/detail/loader_work.h"
#include "runtime/detail/physics_thread.h"
#include "runtime/detail/requests.h"
#include "runtime/simulation.h"

namespace ambf::runtime {

struct Simulation::Impl {
  Impl(const SimulationOptions& options, const scene::World& world, scene::ColorTable colors, base::Log& log_in,
       inputs::Recorder* recorder);
  ~Impl() {
    // Requesters first: the loader may wait for the physics thread, which answers all it has when it stops.
    stopping = true;
    physics.stop();
    loader.stop();
  }

  // Runs `job` on the loader thread and passes its outcome on.
  template <class Job>
  void on_loader(Job job, state::Completion done) {
    loader.post([this, job = std::move(job), done = std::move(done)](bool run) {
      const state::Outcome outcome = run && !stopping ? job() : LoaderWork::stopped();
      if (done) done(outcome);
    });
  }

  // Refuses, counts and reports what is not.
  bool is_finite(const char* what, const math::Vec3& value) {
    if (math::is_finite(value)) return true;
    physics.count_refused_command();
    log.warning("%s refused: it is not finite", what);
    return false;
  }

  template <class Action>
  void on_physics(Action action) {
    physics.submit(make_action(std::move(action)));
  }

  // The end of one pointer's slot that others see.
  class Pointer final : public state::PickPort {
   public:
    Pointer(Impl& impl, int slot) : impl_(impl), slot_(impl.picks[slot]), number_(slot) {}
    ~Pointer() override { impl_.picks.give_back(number_); }
    std::uint32_t id() const override { return static_cast<std::uint32_t>(number_); }
    void pick(const math::Vec3& from_world, const math::Vec3& to_world, PickRequest::Done done) override {
      release();
      ++slot_.presses;
      if (!impl_.is_finite("picking ray", from_world) || !impl_.is_finite("picking ray", to_world)) {
        if (done) done(false, {});
        return;
      }
      impl_.physics.submit(
          std::make_unique<PickRequest>(number_, slot_.presses, from_world, to_world, std::move(done)));
    }
    void drag(const math::Vec3& target_world) override {
      if (!impl_.is_finite("dragging target", target_world)) return;
      slot_.target.post({slot_.presses, target_world}, base::steady_ns());
    }
    void release() override { slot_.ended.store(slot_.presses, std::memory_order_release); }

   private:
    Impl& impl_;
    model::PickSlot& slot_;
    const int number_;
  };

  template <class Action>
  void on_physics_answered(Action action, state::Completion done) {
    physics.submit(std::make_unique<AnsweredRequest<Action>>(std::move(action), std::move(done)));
  }

  // Answers at once, and counts, when there is something to complain of.
  bool refuses(std::string why, const state::Completion& done) {
    if (why.empty()) return false;
    physics.count_refused_command();
    state::Outcome outcome;
    outcome.message = std::move(why);
    if (done) done(outcome);
    return true;
  }

  base::Log& log;
  const math::Vec3 gravity;  // of the world file: what a reset goes back to
  LoaderWork work;           // on the loader thread; outlives the physics thread
  const bool recorded;       // inputs are
  std::atomic<bool> stopping{false};
  PhysicsThread physics;
  model::PickTable& picks;  // this and `effectors`: of the world that `physics` owns
  model::EffectorTable& effectors;
  Loader loader;
};

}  // namespace ambf::runtime
