// The physics thread between its iterations: how it waits, and how it keeps its priority.
#include "base/clock.h"
#include "runtime/detail/physics_thread.h"

namespace ambf::runtime {

namespace {

constexpr std::int64_t kIdleWaitNs = 20'000'000;
// For other threads: between budgets of steps, under a real-time priority, and while the reader of steps is behind.
constexpr std::int64_t kRestNs = 50'000;

}  // namespace

bool PhysicsThread::inputs_ready() const {
  return requests_.ready() || world_commands_.ready() || stop_ ||
         (begin_ && loop_.control().mode() == RunMode::waiting);
}

void PhysicsThread::wait() {
  RunControl& control = loop_.control();
  if (loop_.waits_for_step_reader()) base::sleep_until(base::steady_ns() + kRestNs);
  if (loop_.budget_used() && !options_.fixed_step) base::sleep_until(base::steady_ns() + kRestNs);
  if (control.mode() == RunMode::clock) {
    if (control.iteration_unfinished()) return;
    const std::int64_t now = base::steady_ns();
    const std::int64_t deadline = loop_.keeper().next_deadline(now);
    if (deadline - now > kIdleWaitNs) wait_long(deadline);
    if (control.mode() == RunMode::clock) base::sleep_until(stop_ ? now : deadline);
    return;
  }
  if (!control.idle()) return;
  await_steps();
  // What came between the last check and now is seen here; later arrivals wake us.
  const std::uint32_t seen = wake_.count();
  if (inputs_ready()) return;
  wake_.wait_until(seen, base::steady_ns() + kIdleWaitNs);
}

// Spins for the next Step request. Under SCHED_FIFO it would keep other threads off the core, and run into the kernel's
// limit.
void PhysicsThread::await_steps() {
  const std::int64_t until_ns = stay_awake_.until_ns();
  if (until_ns == StayAwake::kNever || (fifo_granted_ && !fifo_guard_.stepped_down())) return;
  while (!inputs_ready() && base::steady_ns() < until_ns) {
    std::this_thread::yield();  // a thread that waits for this core goes first: it may be the client
  }
}

// Iterations so far apart (below 50 Hz) that requests and readers are served in between.
void PhysicsThread::wait_long(std::int64_t deadline_ns) {
  while (!stop_ && loop_.control().mode() == RunMode::clock && base::steady_ns() + kIdleWaitNs < deadline_ns) {
    const std::uint32_t seen = wake_.count();
    if (!requests_.ready() && !world_commands_.ready()) {
      wake_.wait_until(seen, base::steady_ns() + kIdleWaitNs);
    }
    take_requests();
    take_world_commands();
    const std::int64_t now = base::steady_ns();
    constexpr bool kNoSteps = false;
    if (!finished_.empty() || loop_.publish_due(now, kNoSteps)) loop_.publish(now);
    answer_finished();
  }
}

// In lasting overload an ordinary thread gets further than one that the kernel stops every second.
void PhysicsThread::guard_priority(std::int64_t now_ns) {
  if (!fifo_granted_ || !fifo_guard_.due(now_ns)) return;
  const FifoGuard::Advice advice = fifo_guard_.update(now_ns, base::thread_cpu_ns());
  if (advice == FifoGuard::Advice::step_up) base::request_fifo(kRealTimePriority);
  if (advice != FifoGuard::Advice::step_down) return;
  base::leave_fifo();
  if (step_down_reported_) return;
  step_down_reported_ = true;
  log_.info(
      "physics needs more than a core: while that lasts it runs under ordinary scheduling, because the kernel stops a "
      "SCHED_FIFO thread that uses more than 95 %% of each second");
}

}  // namespace ambf::runtime
