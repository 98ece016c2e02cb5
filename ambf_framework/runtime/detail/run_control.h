// What the physics loop does now, and how many steps its next iteration runs: one state machine, with the transitions
// of docs/run_states.md. Pure: times are passed in. Owned by the physics loop.
#pragma once

#include <cstdint>

#include "runtime/detail/throttle.h"
#include "runtime/detail/time_keeper.h"
#include "state/command.h"

namespace ambf::runtime {

enum class RunMode : std::uint8_t {
  waiting,    // before begin(): nothing runs
  clock,      // the time keeper decides
  paused,     // runs only the steps of step_paused()
  throttled,  // each toggle of a client's step clock grants steps
  stepping,   // serves a Step request, whether paused or throttled
  diverged,   // nothing runs until a reset or a restore
};

struct StepPlan {
  std::uint64_t steps = 0;
  bool budgeted = false;          // may end early, when the time budget of an iteration is used up
  std::int64_t lateness_ns = -1;  // behind the promised deadline; negative: none was promised
};

class RunControl {
 public:
  // `keeper` must outlive it.
  RunControl(TimeKeeper& keeper, bool release_silent_throttle) : keeper_(keeper), throttle_(release_silent_throttle) {}

  RunMode mode() const { return mode_; }
  // Whether nothing will run until an event arrives. In mode clock the time keeper knows that.
  bool idle() const;
  // Whether an iteration with `plan` is one of a world at rest, in which grasped bodies are moved instead of pulled.
  bool still(const StepPlan& plan) const {
    return plan.steps == 0 && (mode_ == RunMode::paused || mode_ == RunMode::waiting);
  }
  bool shown_paused() const { return paused_ || diverged_; }
  bool throttled() const { return throttle_.engaged(); }
  bool diverged() const { return diverged_; }
  // Fixed steps: what is left of an iteration that is run in pieces.
  bool iteration_unfinished() const { return iteration_left_ > 0; }

  // --- Events.
  void begin();
  void set_paused(bool paused, std::int64_t now_ns);
  void step_paused(std::uint64_t steps) { manual_steps_ += diverged_ ? 0 : steps; }
  void world_command(const state::WorldCommand& command, std::int64_t now_ns);
  void world_command_silent();
  // A Step request; one at a time. Afterwards the world waits for the next one.
  void start_steps(std::uint64_t steps);
  std::uint64_t service_steps_left() const { return service_steps_; }
  bool service_steps_cut() const { return steps_cut_; }
  void steps_answered();  // the Step request is finished
  void diverge();
  void recover();  // a reset or a restore

  // --- Each iteration: plan, the steps, steps_done.
  StepPlan plan(std::int64_t now_ns);
  struct Finished {
    bool toggle = false;         // of the throttle
    bool service_steps = false;  // of the Step request
  };
  Finished steps_done(std::uint64_t steps, std::int64_t now_ns);

 private:
  void settle();  // mode_ from what is in force
  void limit_service_steps(std::int64_t now_ns);
  std::uint64_t max_service_steps() const;

  TimeKeeper& keeper_;
  Throttle throttle_;
  RunMode mode_ = RunMode::waiting, planned_mode_ = RunMode::waiting;
  // What the mode is derived from: a pause and a throttle stay in force while steps are served or the world is
  // diverged.
  bool begun_ = false, paused_ = false, diverged_ = false;
  bool toggle_planned_ = false;
  std::uint64_t manual_steps_ = 0, service_steps_ = 0, iteration_left_ = 0;
  std::int64_t steps_end_ns_ = 0;  // deadline of the Step request; 0: none
  bool steps_cut_ = false;         // it ended there
};

}  // namespace ambf::runtime
