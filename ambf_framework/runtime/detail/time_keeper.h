// Decides how many steps an iteration of the physics thread runs and when the next iteration begins, and says truly how
// fast the simulation is. Pure: the clock's values are handed in, nothing sleeps here. Steady nanoseconds. Owned by the
// physics thread.
//
// Step length h and steps of one iteration, from L = speed / frequency, the simulated time that an iteration stands
// for:
//   real time     h = min(1 ms, L); an iteration runs the steps that are due by the wall clock (Eq. 3.1)
//   fixed step    n = ceil(L / 1 ms), h = L / n; each iteration runs exactly n steps; iterations are paced
//   free running  as fixed step, without pacing
// Steps of one run are all equally long and never interpolated, so simulated time is steps * h.
//
// Nothing spirals: in real time an iteration runs at most step_cap() steps, and no more than fit into 1/45 s by the
// cost of the recent ones (at least one); what the clock asked for beyond is given up, counted and never made up for.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/rolling_stats.h"

namespace ambf::runtime {

enum class TimeMode { real_time, fixed_step, free_running };

struct TimeConfig {
  TimeMode mode = TimeMode::real_time;
  double frequency_hz = 1000.0;          // iterations a second
  double speed = 1.0;                    // simulated seconds a wall second
  double longest_step_s = 1e-3;          // "dt_fixed"
  int max_steps_per_iteration = 0;       // "max iterations" of the world file; 0: not given
  std::int64_t rest_when_behind_ns = 0;  // slept each iteration although late: under SCHED_FIFO others need a chance
};

struct IterationPlan {
  std::int64_t steps = 0;        // to run in this iteration
  std::uint64_t given_up = 0;    // steps that this iteration should have run too
  std::int64_t lateness_ns = 0;  // behind the deadline promised
};

class TimeKeeper {
 public:
  // Values that are not positive are taken as their defaults.
  explicit TimeKeeper(const TimeConfig& config);

  double step_s() const { return step_s_; }                // h
  double steps_per_iteration() const { return nominal_; }  // as long as everything keeps up (a mean, in real time)
  int step_cap() const { return cap_; }
  TimeMode mode() const { return config_.mode; }
  double speed() const { return config_.speed; }
  // Simulated seconds a wall second from now on. Steps stay as long as they are: in real time more or fewer of them are
  // due, with fixed steps iterations come sooner or later. Free runs know no speed.
  void set_speed(double speed, std::int64_t now_ns);
  // "max iterations" of a world that was loaded later; 0: not given.
  void set_max_steps_per_iteration(int steps);
  // A further bound that what is loaded sets, in real time and for as long as it is there; 0: none.
  void set_loaded_step_limit(int steps);

  // The clock begins to run.
  void start(std::int64_t now_ns);

  // One iteration is begin_iteration or hold, the steps, end_iteration, and a sleep until next_deadline.
  IterationPlan begin_iteration(std::int64_t now_ns);
  // An iteration in which the clock does not decide (paused, throttled): no steps are due, none will be asked for later
  // on.
  IterationPlan hold(std::int64_t now_ns);
  void end_iteration(std::int64_t now_ns, std::int64_t steps_done);
  // When the next iteration shall begin; not after now_ns when it is late already.
  std::int64_t next_deadline(std::int64_t now_ns);

  // Since the start.
  double sim_time_s() const { return static_cast<double>(total_steps_) * step_s_; }

  // Over the last second, ending with the last end_iteration.
  double real_time_factor() const { return step_rate_.per_second() * step_s_; }  // simulated / wall seconds
  double steps_per_second() const { return step_rate_.per_second(); }
  double iterations_per_second() const { return iteration_rate_.per_second(); }
  std::uint64_t steps_given_up() const { return given_up_; }

  // The time of command watchdogs: in real time the wall's, but not faster than the simulation is allowed to catch up;
  // otherwise simulated time. It stands still while nothing is simulated in a hold. `steps`: done in this iteration so
  // far, so that a command expires at the same step however many of them an iteration takes.
  std::int64_t watch_ns(std::int64_t steps = 0) const {
    const bool by_wall = config_.mode == TimeMode::real_time && !holding_;
    return static_cast<std::int64_t>(watch_ns_ + (by_wall ? 0.0 : static_cast<double>(steps) * step_s_ * 1e9));
  }

 private:
  static constexpr double kSlowestTurnHz = 45.0;  // below, interaction and solvers suffer visibly
  static constexpr double kResyncPeriods = 10.0;

  std::int64_t steps_asked(std::int64_t now_ns) const;  // by the clock since origin_ns_
  std::int64_t grid(std::int64_t iteration) const;      // when iteration number `iteration` should begin
  void restart_grid(std::int64_t now_ns);
  double whole_steps() const;  // that an iteration waits for
  int affordable_steps() const;

  TimeConfig config_;
  double period_ns_ = 1e6, step_s_ = 1e-3, nominal_ = 1.0;
  int cap_ = 22;
  int loaded_limit_ = 0;

  std::int64_t origin_ns_ = 0;    // where the grid of deadlines and the asking of steps begin
  std::int64_t taken_ = 0;        // real time: steps of steps_asked that were run or given up
  std::int64_t iteration_ = 0;    // fixed step: iterations since origin_ns_
  std::int64_t deadline_ns_ = 0;  // promised for this iteration
  std::int64_t last_end_ns_ = 0;
  std::int64_t begin_ns_ = 0;
  bool holding_ = false;
  // Wall time a step of recent iterations; the cheapest counts, so that one stall is not taken for a slow machine.
  std::array<double, 8> step_costs_ns_{};
  std::size_t next_cost_ = 0;

  std::uint64_t total_steps_ = 0, iterations_ = 0, given_up_ = 0;
  double watch_ns_ = 0.0;
  base::RollingRate step_rate_, iteration_rate_;
};

}  // namespace ambf::runtime
