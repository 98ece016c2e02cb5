// One live world and the iterations that advance it, on the thread of the caller: the physics thread (physics_thread.h)
// or the user of a LocalSimulation. An iteration is run(), then publish() when publish_due(). In the steady state it
// neither allocates, locks nor waits (Bullet's own allocations excepted).
#pragma once

#include <memory>
#include <vector>

#include "base/clock.h"
#include "base/log.h"
#include "base/rolling_stats.h"
#include "inputs/recorder.h"
#include "model/live_world.h"
#include "model/prepared.h"
#include "runtime/detail/frame_reader.h"
#include "runtime/detail/run_control.h"
#include "runtime/detail/step_frames.h"
#include "runtime/detail/time_keeper.h"
#include "runtime/options.h"

namespace ambf::runtime {

// What the loop calls back, on the thread that drives it.
class LoopHost {
 public:
  virtual ~LoopHost() = default;
  virtual void add_reports(state::RunState&) {}          // before a frame is published
  virtual void on_published() {}                         // after it
  virtual bool stop_requested() const { return false; }  // ends an iteration after the current step
  // A replay has the clocks of its recording.
  virtual std::int64_t frame_time_ns(std::int64_t now_ns) { return now_ns; }
  virtual double watch_s(double now_s) { return now_s; }
};

class PhysicsLoop {
 public:
  // `log`, `host` and `record` must outlive it. `record`: where all that steps obey is noted; null: nowhere.
  PhysicsLoop(const SimulationOptions& options, const TimeConfig& time, std::unique_ptr<model::LiveWorld> world,
              base::Log& log, LoopHost& host, inputs::Channel* record = nullptr);
  PhysicsLoop(const PhysicsLoop&) = delete;
  PhysicsLoop& operator=(const PhysicsLoop&) = delete;

  struct Ran {
    bool steps = false;          // at least one
    bool service_steps = false;  // the last one of a Step request
  };
  Ran run(std::int64_t now_ns);
  // What run() consists of, by the watchdogs' clock. An iteration begins; a step, false when everything has diverged;
  // commands where no step follows.
  void begin_iteration(double watch_s, std::uint64_t steps, bool still);
  bool step(double watch_s);
  void take_commands(double watch_s);
  // The watchdogs' clock as it is now.
  double watch_s() const { return host_.watch_s(base::to_seconds(keeper_.watch_ns())); }
  // Whether a frame is to be published at the end of an iteration. `ran`: the iteration ran steps.
  bool publish_due(std::int64_t now_ns, bool ran) const;
  void publish(std::int64_t now_ns);
  // The CPU share of RunState is that of the calling thread, from now on.
  void attach_thread();
  // Statistics of RunState; call once per iteration, after run().
  void measure(std::int64_t now_ns);

  RunControl& control() { return control_; }
  const RunControl& control() const { return control_; }
  TimeKeeper& keeper() { return keeper_; }
  model::LiveWorld& world() { return *world_; }
  FramePool& frames() { return frames_; }
  StepFrames& step_frames() { return step_frames_; }
  // Whether the last run() ended because its time budget was used up.
  bool budget_used() const { return budget_used_; }
  // Whether it ended because the reader of every step is behind.
  bool waits_for_step_reader() const { return waits_for_step_reader_; }
  // The next publish_due() is true.
  void mark_changed() { changed_ = true; }
  // Into the recording of inputs, if there is one.
  template <class Record>
  void note(const Record& record) {
    if (record_ != nullptr) record_->add(record);
  }

  // Links a prepared change in; `garbage` and `frames` receive what it replaced.
  void swap(model::Prepared&& prepared, model::Garbage& garbage, std::vector<std::unique_ptr<state::Frame>>& frames);

 private:
  static constexpr std::int64_t kHeartbeatNs = 20'000'000;  // max time between frames: readers see that all is well

  void fill(state::Frame& frame, std::int64_t now_ns);
  void record_step(std::int64_t now_ns);
  void diverge(std::uint32_t body);
  const char* name_of_body(std::uint32_t body) const;
  void report(const model::CutReport& cut);
  void report_soft_body(const model::CutReport& cut);
  void report_needle(const model::CutReport& cut);
  void report_touch(const model::CutReport& cut);
  void report(const model::FrozenReport& frozen);
  void report_pile();
  void report_crowd();

  const SimulationOptions options_;
  std::unique_ptr<model::LiveWorld> world_;
  base::Log& log_;
  LoopHost& host_;
  inputs::Channel* const record_;
  FramePool frames_;
  StepFrames step_frames_;
  TimeKeeper keeper_;
  RunControl control_;
  std::vector<std::unique_ptr<state::Frame>> new_frames_;  // for the pool, sized for the newest structure
  std::vector<std::unique_ptr<state::Frame>> old_frames_;  // replaced ones, until the next swap; capacity reserved
  bool changed_ = true, crowd_reported_ = false, pile_reported_ = false, budget_used_ = false,
       waits_for_step_reader_ = false;
  std::uint64_t toggles_ = 0, sequence_ = 0;
  std::int64_t started_ns_ = 0, last_publish_ns_ = 0, last_measure_ns_ = 0, last_cpu_ns_ = 0;
  std::int64_t lateness_ns_ = 0;  // of the last iteration; negative: no deadline was promised
  double publish_s_ = 0.0;        // mean thread CPU time of a sampled publication
  base::RollingStats lateness_;
  state::RunState run_state_;
};

}  // namespace ambf::runtime
