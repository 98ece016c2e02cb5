#include "runtime/detail/run_control.h"

#include <algorithm>

#include "base/clock.h"

namespace ambf::runtime {

namespace {
constexpr double kServiceIteration_s = 0.2;  // simulated, in one iteration for a Step request: within a watchdog's time
constexpr std::int64_t kStepsGraceNs = base::kNanosecondsPerSecond;  // to finish, when the world is paused or released
}  // namespace

// The only place that knows which of several causes wins.
void RunControl::settle() {
  mode_ = !begun_               ? RunMode::waiting
          : diverged_           ? RunMode::diverged
          : service_steps_ > 0  ? RunMode::stepping
          : paused_             ? RunMode::paused
          : throttle_.engaged() ? RunMode::throttled
                                : RunMode::clock;
}

bool RunControl::idle() const {
  switch (mode_) {
    case RunMode::waiting:
    case RunMode::diverged: return true;
    case RunMode::paused: return manual_steps_ == 0;
    case RunMode::throttled: return !throttle_.toggle_waiting();
    case RunMode::clock:
    case RunMode::stepping: break;
  }
  return false;
}

void RunControl::begin() {
  begun_ = true;
  settle();
}

void RunControl::set_paused(bool paused, std::int64_t now_ns) {
  paused_ = paused;
  manual_steps_ = 0;
  if (paused) limit_service_steps(now_ns);
  settle();
}

void RunControl::world_command(const state::WorldCommand& command, std::int64_t now_ns) {
  throttle_.on_command(command);
  if (!command.enable_step_throttling) limit_service_steps(now_ns);
  settle();
}

void RunControl::world_command_silent() {
  throttle_.on_silence();
  settle();
}

void RunControl::start_steps(std::uint64_t steps) {
  service_steps_ = diverged_ ? 0 : steps;
  throttle_.engage();  // the world waits for the next request
  settle();
}

void RunControl::steps_answered() {
  steps_end_ns_ = 0;
  steps_cut_ = false;
}

// The client may have disconnected, or asked for too many steps; bound them so that others are served.
void RunControl::limit_service_steps(std::int64_t now_ns) {
  if (service_steps_ > 0 && steps_end_ns_ == 0) steps_end_ns_ = now_ns + kStepsGraceNs;
}

void RunControl::diverge() {
  diverged_ = true;
  manual_steps_ = 0;
  settle();
}

void RunControl::recover() {
  diverged_ = false;
  settle();
}

// At least one; few enough that a request keeps its own commands alive between two iterations.
std::uint64_t RunControl::max_service_steps() const {
  return static_cast<std::uint64_t>(std::max(1.0, kServiceIteration_s / keeper_.step_s()));
}

StepPlan RunControl::plan(std::int64_t now_ns) {
  planned_mode_ = mode_;
  toggle_planned_ = mode_ == RunMode::throttled && throttle_.toggle_waiting();
  if (mode_ != RunMode::clock) {
    keeper_.hold(now_ns);  // the time of a pause is not caught up afterwards
    iteration_left_ = 0;
  }
  switch (mode_) {
    case RunMode::waiting:
    case RunMode::diverged: return {};
    case RunMode::stepping: return {std::min(service_steps_, max_service_steps()), true};
    case RunMode::paused: return {manual_steps_, true};
    case RunMode::throttled: return {throttle_.steps_left(), true};
    case RunMode::clock: break;
  }
  if (iteration_left_ > 0) return {iteration_left_, true};
  const IterationPlan due = keeper_.begin_iteration(now_ns);
  const auto steps = static_cast<std::uint64_t>(due.steps);
  if (keeper_.mode() == TimeMode::real_time) return {steps, false, due.lateness_ns};
  // An iteration of fixed steps may stand for hours: it is run in pieces, with requests served in between.
  iteration_left_ = steps;
  return {steps, true, due.lateness_ns};
}

RunControl::Finished RunControl::steps_done(std::uint64_t steps, std::int64_t now_ns) {
  Finished finished;
  switch (planned_mode_) {
    case RunMode::waiting:
    case RunMode::diverged: break;
    case RunMode::throttled:
      if (toggle_planned_) finished.toggle = throttle_.steps_done(static_cast<unsigned>(steps));
      break;
    case RunMode::stepping:
      service_steps_ = diverged_ ? 0 : service_steps_ - steps;
      steps_cut_ = service_steps_ > 0 && steps_end_ns_ != 0 && now_ns > steps_end_ns_;
      if (steps_cut_) service_steps_ = 0;
      finished.service_steps = service_steps_ == 0;
      break;
    case RunMode::paused: manual_steps_ -= std::min(steps, manual_steps_); break;
    case RunMode::clock: iteration_left_ -= std::min(steps, iteration_left_); break;
  }
  settle();
  return finished;
}

}  // namespace ambf::runtime
