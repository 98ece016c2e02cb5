#include "runtime/detail/time_keeper.h"

#include <algorithm>
#include <cmath>

namespace ambf::runtime {

namespace {
// A deadline met to the nanosecond has its step: forgives rounding, a millionth of a step.
constexpr double kRounding = 1e-6;

double positive_or(double value, double otherwise) { return value > 0.0 && std::isfinite(value) ? value : otherwise; }
}  // namespace

TimeKeeper::TimeKeeper(const TimeConfig& config) : config_(config) {
  const TimeConfig defaults;
  config_.frequency_hz = positive_or(config.frequency_hz, defaults.frequency_hz);
  config_.speed = positive_or(config.speed, defaults.speed);
  config_.longest_step_s = positive_or(config.longest_step_s, defaults.longest_step_s);
  config_.rest_when_behind_ns = std::max<std::int64_t>(config.rest_when_behind_ns, 0);

  period_ns_ = 1e9 / config_.frequency_hz;
  const double iteration_s = config_.speed / config_.frequency_hz;
  if (config_.mode == TimeMode::real_time) {
    step_s_ = std::min(config_.longest_step_s, iteration_s);
    nominal_ = iteration_s / step_s_;
  } else {
    nominal_ = std::max(1.0, std::ceil(iteration_s / config_.longest_step_s - kRounding));
    step_s_ = iteration_s / nominal_;
  }
  set_max_steps_per_iteration(config.max_steps_per_iteration);
}

void TimeKeeper::set_max_steps_per_iteration(int steps) {
  config_.max_steps_per_iteration = std::max(steps, 0);
  // Who asks for iterations slower than 45 Hz gets them: then an iteration may run what it stands for, and one step
  // more (Eq. 3.1).
  const double slowest = std::floor(config_.speed / (kSlowestTurnHz * step_s_) + kRounding);
  const double iteration = std::floor(nominal_ + kRounding) + 1.0;
  cap_ = static_cast<int>(std::clamp(std::max(slowest, iteration), 1.0, 1e6));
  if (config_.max_steps_per_iteration > 0) cap_ = std::min(cap_, config_.max_steps_per_iteration);
  if (loaded_limit_ > 0) cap_ = std::min(cap_, loaded_limit_);
}

void TimeKeeper::set_loaded_step_limit(int steps) {
  if (steps == loaded_limit_) return;
  loaded_limit_ = std::max(steps, 0);
  set_max_steps_per_iteration(config_.max_steps_per_iteration);
}

void TimeKeeper::set_speed(double speed, std::int64_t now_ns) {
  if (config_.mode == TimeMode::free_running || !(speed > 0.0) || !std::isfinite(speed)) return;
  if (config_.mode == TimeMode::real_time) {
    nominal_ = speed / (config_.frequency_hz * step_s_);
  } else {
    period_ns_ = nominal_ * step_s_ * 1e9 / speed;
  }
  config_.speed = speed;
  set_max_steps_per_iteration(config_.max_steps_per_iteration);
  restart_grid(now_ns);
}

void TimeKeeper::start(std::int64_t now_ns) {
  restart_grid(now_ns);
  last_end_ns_ = deadline_ns_ = now_ns;
  step_rate_.start(now_ns, static_cast<double>(total_steps_));
  iteration_rate_.start(now_ns, static_cast<double>(iterations_));
}

void TimeKeeper::restart_grid(std::int64_t now_ns) {
  origin_ns_ = now_ns;
  taken_ = 0;
  iteration_ = 0;
}

std::int64_t TimeKeeper::steps_asked(std::int64_t now_ns) const {
  const double steps = static_cast<double>(now_ns - origin_ns_) * config_.speed / (step_s_ * 1e9);
  return static_cast<std::int64_t>(std::floor(steps + kRounding));
}

// Slow motion has iterations without a step.
double TimeKeeper::whole_steps() const { return std::max(1.0, std::floor(nominal_ + kRounding)); }

std::int64_t TimeKeeper::grid(std::int64_t iteration) const {
  return origin_ns_ + static_cast<std::int64_t>(std::ceil(static_cast<double>(iteration) * period_ns_ - kRounding));
}

IterationPlan TimeKeeper::begin_iteration(std::int64_t now_ns) {
  IterationPlan plan;
  if (holding_) {  // time that passed during the hold does not count
    holding_ = false;
    restart_grid(now_ns);
    last_end_ns_ = deadline_ns_ = now_ns;
  }
  plan.lateness_ns = std::max<std::int64_t>(now_ns - deadline_ns_, 0);
  if (config_.mode != TimeMode::real_time) {
    ++iteration_;
    plan.steps = static_cast<std::int64_t>(nominal_);
    return plan;
  }
  const std::int64_t due = std::max<std::int64_t>(steps_asked(now_ns) - taken_, 0);
  if (due >
      0) {  // late since the moment when this iteration's worth of steps was due, also when nobody slept before it
    const double due_steps = static_cast<double>(taken_) + whole_steps();
    const double due_ns = static_cast<double>(origin_ns_) + due_steps * step_s_ * 1e9 / config_.speed;
    plan.lateness_ns = std::max(plan.lateness_ns, now_ns - static_cast<std::int64_t>(due_ns));
  }
  taken_ += due;
  begin_ns_ = now_ns;
  plan.steps = std::min<std::int64_t>(due, affordable_steps());
  plan.given_up = static_cast<std::uint64_t>(due - plan.steps);
  given_up_ += plan.given_up;
  return plan;
}

IterationPlan TimeKeeper::hold(std::int64_t) {
  holding_ = true;
  return {};  // nothing was promised, so nothing is late
}

int TimeKeeper::affordable_steps() const {
  const double cheapest = *std::min_element(step_costs_ns_.begin(), step_costs_ns_.end());
  const double budget_ns = std::max(1e9 / kSlowestTurnHz, period_ns_);
  return cheapest * cap_ <= budget_ns ? cap_ : std::max(1, static_cast<int>(budget_ns / cheapest));
}

void TimeKeeper::end_iteration(std::int64_t now_ns, std::int64_t steps_done) {
  const auto steps = static_cast<std::uint64_t>(std::max<std::int64_t>(steps_done, 0));
  if (config_.mode == TimeMode::real_time && !holding_ && steps > 0) {
    step_costs_ns_[next_cost_] = static_cast<double>(now_ns - begin_ns_) / static_cast<double>(steps);
    next_cost_ = (next_cost_ + 1) % step_costs_ns_.size();
  }
  total_steps_ += steps;
  ++iterations_;
  step_rate_.update(now_ns, static_cast<double>(total_steps_));
  iteration_rate_.update(now_ns, static_cast<double>(iterations_));

  if (config_.mode == TimeMode::real_time && !holding_) {
    // A stall of the whole machine does not let commands expire that arrive right after it.
    const double longest =
        std::max(static_cast<double>(cap_) * step_s_ * 1e9 / config_.speed, kResyncPeriods * period_ns_);
    watch_ns_ += std::min(static_cast<double>(now_ns - last_end_ns_), longest);
  } else {
    watch_ns_ += static_cast<double>(steps) * step_s_ * 1e9;
  }
  last_end_ns_ = now_ns;
}

std::int64_t TimeKeeper::next_deadline(std::int64_t now_ns) {
  const std::int64_t at_once = now_ns + config_.rest_when_behind_ns;
  if (config_.mode == TimeMode::free_running && !holding_) return deadline_ns_ = at_once;

  if (config_.mode == TimeMode::fixed_step && !holding_) {
    // Turns are made up for as long as they are few.
    const std::int64_t next = grid(iteration_);
    const double late_periods = static_cast<double>(now_ns - next) / period_ns_;
    if (late_periods > kResyncPeriods) {
      given_up_ += static_cast<std::uint64_t>(late_periods) * static_cast<std::uint64_t>(nominal_);
      restart_grid(now_ns);
      return deadline_ns_ = at_once;
    }
    return deadline_ns_ = std::max(next, next < now_ns ? at_once : next);
  }

  // A whole iteration's worth of steps is due already: then no time is lost with waiting for the grid.
  if (!holding_ && static_cast<double>(steps_asked(now_ns) - taken_) + kRounding >= whole_steps()) {
    return deadline_ns_ = at_once;
  }
  auto iteration = static_cast<std::int64_t>(static_cast<double>(now_ns - origin_ns_) / period_ns_);
  while (grid(iteration) <= now_ns) ++iteration;
  return deadline_ns_ = grid(iteration);
}

}  // namespace ambf::runtime
