#include "runtime/detail/requests.h"

#include "base/clock.h"
#include "model/live_world.h"

namespace ambf::runtime {

Progress SwapRequest::run(RequestScope& scope) {
  scope.begin_scene_request(change());
  const std::int64_t start_ns = base::thread_cpu_ns();
  scope.swap(std::move(prepared_), result_.garbage, result_.frames);
  result_.physics_cpu_s = base::to_seconds(base::thread_cpu_ns() - start_ns);
  result_.applied = true;
  result_.sim_step = scope.world().sim_step();
  result_.sim_time = scope.world().sim_time();
  return Progress::done;
}

void SwapRequest::answer(bool) { promise_.set_value(std::move(result_)); }

Progress SaveRequest::run(RequestScope& scope) {
  scope.begin_scene_request(change());
  if (scope.diverged()) {
    saved_.error = "the simulation has diverged: there is no state worth keeping";
    return Progress::done;
  }
  scope.take_commands();  // ages of commands are kept: they must be those of this moment
  saved_.bytes = scope.world().save();
  saved_.sim_step = scope.world().sim_step();
  saved_.sim_time = scope.world().sim_time();
  return Progress::done;
}

void SaveRequest::answer(bool ran) {
  if (!ran) saved_.error = kNotRun;
  promise_.set_value(std::move(saved_));
}

Progress RestoreRequest::run(RequestScope& scope) {
  scope.begin_scene_request(change());
  if (parents_.success) scope.swap(std::move(parents_), restored_.garbage, restored_.frames);
  scope.take_commands();  // restored commands continue at their ages on the watchdogs' clock as it is now
  scope.world().restore(state_);
  scope.restored();
  restored_.sim_step = scope.world().sim_step();
  restored_.sim_time = scope.world().sim_time();
  return Progress::done;
}

void RestoreRequest::answer(bool ran) {
  if (!ran) restored_.error = kNotRun;
  promise_.set_value(std::move(restored_));
}

Progress PickRequest::run(RequestScope& scope) {
  hit_ = scope.pick(slot_, press_, from_world_, to_world_, where_);
  return Progress::done;
}

void PickRequest::answer(bool ran) {
  if (done_) done_(ran && hit_, where_);
}

}  // namespace ambf::runtime
