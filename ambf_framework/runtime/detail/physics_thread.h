// The physics thread: iteration after iteration, it serves requests and world commands, runs the loop (physics_loop.h)
// and sleeps until the next one is due. It waits for no other thread: no I/O, no locks, no allocation in the steady
// state. Its inputs are lock-free queues, its output is the frame pool.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <thread>
#include <vector>

#include "base/log.h"
#include "base/realtime.h"
#include "exchange/bounded_queue.h"
#include "exchange/signal.h"
#include "runtime/detail/answers.h"
#include "runtime/detail/fifo_guard.h"
#include "runtime/detail/physics_loop.h"
#include "runtime/detail/request.h"
#include "runtime/detail/request_scope.h"
#include "runtime/detail/stay_awake.h"
#include "runtime/options.h"
#include "state/command.h"

namespace ambf::runtime {

class PhysicsThread final : private LoopHost {
 public:
  // All references, and `record` (null: none), must outlive it. Starts at once; the first step waits for begin().
  PhysicsThread(const SimulationOptions& options, const TimeConfig& time, std::unique_ptr<model::LiveWorld> world,
                base::Log& log, inputs::Channel* record);
  ~PhysicsThread() override;
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
  // Permits the first step.
  void begin();
  // Ends the thread and answers what is in flight.
  void stop();

  FramePool& frames() { return loop_.frames(); }
  exchange::Signal& published() { return published_; }
  StepFrames& step_frames() { return loop_.step_frames(); }
  model::PickTable& pick_table() { return loop_.world().pick_table(); }
  model::EffectorTable& effector_table() { return loop_.world().effector_table(); }

 private:
  static constexpr int kRealTimePriority = 20;  // below devices, above comm

  void run();
  void iterate();
  void take_requests();
  void serve_steps();
  void refuse_waiting();
  void take_world_commands();
  bool inputs_ready() const;
  void answer_finished();
  void add_reports(state::RunState& run) override;
  void on_published() override;
  bool stop_requested() const override { return stop_; }

  // physics_wait.cpp
  void wait();
  void wait_long(std::int64_t deadline_ns);
  void await_steps();
  void guard_priority(std::int64_t now_ns);

  const SimulationOptions options_;
  base::Log& log_;

  // Inputs.
  exchange::BoundedQueue<RequestPtr> requests_{kMaxRequests};
  exchange::BoundedQueue<state::WorldCommand> world_commands_{base::kMaxWorldCommands};
  exchange::Signal wake_;
  std::atomic<bool> stop_{false}, begin_{false};
  std::atomic<std::uint64_t> refused_{0};
  std::atomic<double> graphics_rate_{0.0}, seconds_per_picture_{0.0}, comm_s_{0.0};

  exchange::Signal published_;
  PhysicsLoop loop_;
  Answers answers_;  // ends before the loop's frames do: requests may hold readers of them

  // Physics thread only from here on.
  RequestPtr stepping_;                           // the Step request being served
  std::array<RequestPtr, kMaxRequests> waiting_;  // Step requests behind it: a ring
  std::size_t waiting_first_ = 0, waiting_count_ = 0;
  std::vector<RequestPtr> finished_;  // to be answered after the next frame; capacity reserved
  bool fifo_granted_ = false, step_down_reported_ = false;
  FifoGuard fifo_guard_;
  StayAwake stay_awake_;
  std::thread thread_;
};

}  // namespace ambf::runtime
