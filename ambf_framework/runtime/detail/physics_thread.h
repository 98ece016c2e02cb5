// The physics thread: one turn after the other, it takes requests and commands, decides how many steps to run, runs
// them and publishes a frame. It waits for nobody: no I/O, no locks, no allocation in the steady state. Its inputs are
// lock-free queues, its output is the frame pool.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <thread>
#include <vector>

#include "base/log.h"
#include "base/realtime.h"
#include "base/rolling_stats.h"
#include "exchange/bounded_queue.h"
#include "exchange/signal.h"
#include "model/live_world.h"
#include "model/prepared.h"
#include "runtime/detail/answers.h"
#include "runtime/detail/fifo_guard.h"
#include "runtime/detail/frame_reader.h"
#include "runtime/detail/request.h"
#include "runtime/detail/stay_awake.h"
#include "runtime/detail/throttle.h"
#include "runtime/detail/time_keeper.h"
#include "runtime/options.h"
#include "state/command.h"

namespace ambf::runtime {

class PhysicsThread {
 public:
  // All references must outlive it. Starts at once; the first step waits for begin().
  PhysicsThread(const SimulationOptions& options, const TimeConfig& time, std::unique_ptr<model::LiveWorld> world,
                base::Log& log);
  ~PhysicsThread();
  PhysicsThread(const PhysicsThread&) = delete;
  PhysicsThread& operator=(const PhysicsThread&) = delete;

  // --- Any thread; none of these waits.

  // False when too many requests are in flight or the thread has stopped: the request is then answered with ran =
  // false.
  bool submit(RequestPtr request);
  // Throttling; every command counts, in order. False when its queue is full.
  bool post_world(const state::WorldCommand& command);
  void count_refused_command() { refused_.fetch_add(1, std::memory_order_relaxed); }
  void report_graphics(double hz, double seconds_per_picture) {
    graphics_rate_.store(hz, std::memory_order_relaxed);
    seconds_per_picture_.store(seconds_per_picture, std::memory_order_relaxed);
  }
  void report_comm(double seconds_per_frame) { comm_s_.store(seconds_per_frame, std::memory_order_relaxed); }
  // Lets the first step happen.
  void begin();
  // Ends the thread and answers what is in flight.
  void stop();

  FramePool& frames() { return frames_; }
  exchange::Signal& published() { return published_; }
  model::PickTable& pick_table() { return world_->pick_table(); }

 private:
  friend class Turn;

  static constexpr std::int64_t kHeartbeatNs = 20'000'000;  // a frame at least this often: readers see that all is well
  static constexpr int kRealTimePriority = 20;              // below devices, above comm

  struct Plan {
    std::uint64_t steps = 0;
    bool budgeted = false;  // stop after kBudget of wall time and go on next turn
    bool toggle = false;    // these are the steps of one throttle toggle
    bool turn = false;      // these are what is left of a turn of fixed steps
  };

  void run();
  void turn();
  void take_requests();
  void refuse_waiting();
  void take_world_commands();
  Plan decide(std::int64_t now_ns);
  std::uint64_t run_steps(const Plan& plan, std::int64_t now_ns);
  bool step_once(std::uint64_t done);
  std::uint64_t most_service_steps() const;
  void diverge(std::uint32_t body);
  void publish(std::int64_t now_ns);
  void answer_finished();
  void serve_steps();
  void end_steps_soon();
  void wait();
  void wait_long(std::int64_t deadline_ns);
  void await_steps();
  bool clock_decides() const { return begun_ && !paused_ && !diverged_ && service_steps_ == 0 && !throttle_.engaged(); }
  void take_reports() {
    run_state_.graphics_rate = graphics_rate_.load(std::memory_order_relaxed);
    run_state_.seconds_per_picture = seconds_per_picture_.load(std::memory_order_relaxed);
    run_state_.comm_seconds_per_frame = comm_s_.load(std::memory_order_relaxed);
  }
  void measure(std::int64_t now_ns);
  void guard_priority(std::int64_t now_ns);
  void tell_of_crowd();

  const SimulationOptions options_;
  std::unique_ptr<model::LiveWorld> world_;
  base::Log& log_;

  // Inputs.
  exchange::BoundedQueue<RequestPtr> requests_{kMaxRequests};
  exchange::BoundedQueue<state::WorldCommand> world_commands_{4096};
  exchange::Signal wake_;
  std::atomic<bool> stop_{false}, begun_{false};
  std::atomic<std::uint64_t> refused_{0};
  std::atomic<double> graphics_rate_{0.0}, seconds_per_picture_{0.0}, comm_s_{0.0};

  // Output.
  FramePool frames_;
  exchange::Signal published_;
  Answers answers_;  // ends before the frames do: requests may hold readers of them

  // Physics thread only from here on.
  TimeKeeper keeper_;
  Throttle throttle_;
  RequestPtr stepping_;                           // the Step request being served
  std::array<RequestPtr, kMaxRequests> waiting_;  // Step requests behind it: a ring
  std::size_t waiting_first_ = 0, waiting_count_ = 0;
  std::vector<RequestPtr> finished_;                       // to be answered after the next frame; capacity reserved
  std::vector<std::unique_ptr<state::Frame>> new_frames_;  // for the pool, sized for the newest structure
  std::vector<std::unique_ptr<state::Frame>>
      old_frames_;  // replaced ones, until the next swap takes them along; reserved
  bool paused_ = false, diverged_ = false, changed_ = true, told_of_crowd_ = false;
  std::uint64_t manual_steps_ = 0, service_steps_ = 0, turn_left_ = 0, toggles_ = 0, sequence_ = 0;
  std::int64_t started_ns_ = 0, last_publish_ns_ = 0, last_measure_ns_ = 0, last_cpu_ns_ = 0;
  std::int64_t steps_end_ns_ = 0;  // the Step request being served has until then; 0: as long as it needs
  bool steps_cut_ = false;         // it was not given more
  std::int64_t lateness_ns_ = 0;   // below zero: nothing was promised
  bool budget_used_ = false;
  double publish_s_ = 0.0;  // mean thread CPU time of a sampled publication
  base::RollingStats lateness_;
  bool fifo_granted_ = false, step_down_said_ = false;
  FifoGuard fifo_guard_;
  StayAwake stay_awake_;
  state::RunState run_state_;
  std::thread thread_;
};

// What a request may touch, while it runs.
class Turn {
 public:
  explicit Turn(PhysicsThread& thread) : thread_(thread) {}

  model::LiveWorld& world() { return *thread_.world_; }
  bool diverged() const { return thread_.diverged_; }

  void set_paused(bool paused);
  void add_manual_steps(std::uint64_t steps) { thread_.manual_steps_ += thread_.diverged_ ? 0 : steps; }
  void start_steps(std::uint64_t steps);
  void world_command_silent() { thread_.throttle_.on_silence(); }
  std::uint64_t steps_left() const { return thread_.service_steps_; }
  bool steps_cut() const { return thread_.steps_cut_; }

  // Links a prepared change in; `garbage` and `frames` get what it replaced.
  void swap(model::Prepared&& prepared, model::Garbage& garbage, std::vector<std::unique_ptr<state::Frame>>& frames);
  void reset_world();
  void reset_bodies();
  void reset_bodies(const std::vector<state::ObjectId>& bodies);
  void set_speed(double factor);
  void restored();
  void mark_changed() { thread_.changed_ = true; }

 private:
  PhysicsThread& thread_;
};

}  // namespace ambf::runtime
