// The requests that Simulation makes of the physics thread, one small class each (steps: step_request.h).
#pragma once

#include <functional>
#include <future>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "model/prepared.h"
#include "model/saved_state.h"
#include "runtime/detail/physics_thread.h"
#include "runtime/detail/request.h"
#include "state/abilities/outcome.h"
#include "state/abilities/pick.h"

namespace ambf::runtime {

inline constexpr const char* kNotRun = "the simulation has stopped, or too many requests are waiting";

// Something short that nobody waits for: pause, reset, gravity, dragging.
template <class Action>
class ActionRequest final : public Request {
 public:
  explicit ActionRequest(Action action) : action_(std::move(action)) {}
  Progress run(RequestScope& scope) override {
    action_(scope);
    return Progress::done;
  }
  void answer(bool) override {}

 private:
  Action action_;
};

template <class Action>
RequestPtr make_action(Action action) {
  return std::make_unique<ActionRequest<Action>>(std::move(action));
}

// The same, for who wants to hear what came of it: `action(scope, outcome)`.
template <class Action>
class AnsweredRequest final : public Request {
 public:
  AnsweredRequest(Action action, state::Completion done) : action_(std::move(action)), done_(std::move(done)) {}
  Progress run(RequestScope& scope) override {
    action_(scope, outcome_);
    return Progress::done;
  }
  void answer(bool ran) override {
    if (!ran) outcome_.message = kNotRun;
    if (done_) done_(outcome_);
  }

 private:
  Action action_;
  state::Completion done_;
  state::Outcome outcome_;
};

// Of the loader: part of a change of the scene, which it counts (the first one is 1).
class SceneRequest : public Request {
 public:
  explicit SceneRequest(std::uint64_t change) : change_(change) {}
  std::uint64_t change() const { return change_; }
  bool from_loader() const override { return true; }

 private:
  const std::uint64_t change_;
};

// A structural change. The promise gets whether it was applied; what was replaced waits here for its destruction by the
// loader.
class SwapRequest final : public SceneRequest {
 public:
  SwapRequest(std::uint64_t change, model::Prepared prepared) : SceneRequest(change), prepared_(std::move(prepared)) {}

  struct Result {
    bool applied = false;
    model::Garbage garbage;
    std::vector<std::unique_ptr<state::Frame>> frames;
    std::uint32_t sim_step = 0;
    double sim_time = 0.0;
    double physics_cpu_s = 0.0;
  };
  std::future<Result> result() { return promise_.get_future(); }

  Progress run(RequestScope& scope) override;
  void answer(bool ran) override;

 private:
  model::Prepared prepared_;
  Result result_;
  std::promise<Result> promise_;
};

// Takes the whole state as bytes.
class SaveRequest final : public SceneRequest {
 public:
  using SceneRequest::SceneRequest;
  struct Saved {
    std::string error;  // empty: done
    std::vector<std::uint8_t> bytes;
    std::uint32_t sim_step = 0;
    double sim_time = 0.0;
  };
  std::future<Saved> result() { return promise_.get_future(); }

  Progress run(RequestScope& scope) override;
  void answer(bool ran) override;

 private:
  Saved saved_;
  std::promise<Saved> promise_;
};

// What model::decode() has let pass, with the structural change (or none) that hangs cameras and lights as they hung
// then.
class RestoreRequest final : public SceneRequest {
 public:
  RestoreRequest(std::uint64_t change, model::SavedState state, model::Prepared parents)
      : SceneRequest(change), state_(std::move(state)), parents_(std::move(parents)) {}

  struct Restored {
    std::string error;  // empty: done
    std::uint32_t sim_step = 0;
    double sim_time = 0.0;
    model::Garbage garbage;
    std::vector<std::unique_ptr<state::Frame>> frames;
  };
  std::future<Restored> result() { return promise_.get_future(); }

  Progress run(RequestScope& scope) override;
  void answer(bool ran) override;

 private:
  const model::SavedState state_;
  model::Prepared parents_;
  Restored restored_;
  std::promise<Restored> promise_;
};

// A pointer looks for something to hold.
class PickRequest final : public Request {
 public:
  using Done = std::function<void(bool, const state::PickHit&)>;
  PickRequest(std::size_t slot, std::uint64_t press, const math::Vec3& from_world, const math::Vec3& to_world,
              Done done)
      : slot_(slot), press_(press), from_world_(from_world), to_world_(to_world), done_(std::move(done)) {}

  Progress run(RequestScope& scope) override;
  void answer(bool ran) override;

 private:
  const std::size_t slot_;
  const std::uint64_t press_;
  const math::Vec3 from_world_, to_world_;
  Done done_;
  bool hit_ = false;
  state::PickHit where_;
};

}  // namespace ambf::runtime
