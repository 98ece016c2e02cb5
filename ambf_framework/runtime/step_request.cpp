#include "runtime/detail/step_request.h"

#include "model/live_world.h"
#include "runtime/detail/physics_thread.h"
#include "runtime/detail/requests.h"

namespace ambf::runtime {

void StepResult::finish(state::Outcome outcome) {
  outcome_ = std::move(outcome);
  wake();
}

void StepResult::show() {
  if (reader_ != nullptr) {
    frame_ = reader_->latest();  // pinned here, where nothing newer can have been published yet
    outcome_.sim_step = frame_->sim_step;
    outcome_.sim_time = frame_->sim_time;
  }
  wake();
}

void StepResult::wake() {
  finished_.store(true, std::memory_order_release);
  signal_.notify_all();
}

bool StepResult::wait(std::chrono::nanoseconds timeout) {
  const auto seen = signal_.count();
  if (!finished_.load(std::memory_order_acquire)) signal_.wait_beyond(seen, timeout);
  return finished_.load(std::memory_order_acquire);
}

void StepResult::let_go() {
  if (!finished_.load(std::memory_order_acquire)) return;  // still the physics thread's
  frame_ = nullptr;
  reader_.reset();
}

Progress StepRequest::run(RequestScope& scope) {
  if (!started_) {
    started_ = true;
    result_->set_first_step(scope.world().sim_step() + 1);
    for (auto& [port, command] : commands_) port->post(command, received_ns_);
    scope.start_steps(n_);
  } else {
    // Its sender is waiting, and cannot send them again.
    for (auto& [port, command] : commands_) port->keep_alive();
  }
  if (scope.steps_left() > 0) return Progress::again;
  state::Outcome& outcome = result_->outcome();
  outcome.success = !scope.diverged() && !scope.steps_cut();
  outcome.message = scope.diverged()    ? "the simulation diverged; see its log"
                    : scope.steps_cut() ? "ended before its last step: the world was paused or released"
                                        : "";
  outcome.sim_step = scope.world().sim_step();
  outcome.sim_time = scope.world().sim_time();
  return Progress::done;
}

bool StepRequest::shown() {
  result_->show();
  return true;
}

void StepRequest::answer(bool ran) {
  if (ran) return;
  state::Outcome outcome;
  outcome.message = kNotRun;
  result_->finish(std::move(outcome));
}

}  // namespace ambf::runtime
