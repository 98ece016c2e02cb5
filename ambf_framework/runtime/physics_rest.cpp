// The physics thread between its turns: how it waits, keeps its priority, and measures itself.
#include <algorithm>

#include "base/clock.h"
#include "runtime/detail/physics_thread.h"

namespace ambf::runtime {

namespace {

constexpr std::int64_t kIdleWaitNs = 20'000'000;
constexpr std::int64_t kMeasureNs = base::kNanosecondsPerSecond;
constexpr std::int64_t kRestNs = 50'000;      // others' chance between budgets of steps, under a real-time priority
constexpr std::uint64_t kCrowdedSteps = 500;  // with crowded meshes, are worth a warning: fewer pass unnoticed

}  // namespace

void PhysicsThread::wait() {
  if (budget_used_ && !options_.fixed_step) base::sleep_until(base::steady_ns() + kRestNs);
  if (clock_decides()) {
    if (turn_left_ > 0) return;
    const std::int64_t now = base::steady_ns();
    const std::int64_t deadline = keeper_.next_deadline(now);
    if (deadline - now > kIdleWaitNs) wait_long(deadline);
    if (clock_decides()) base::sleep_until(stop_ ? now : deadline);
    return;
  }
  if (begun_ && service_steps_ > 0) return;
  if (begun_ && !diverged_ && (paused_ ? manual_steps_ > 0 : throttle_.toggle_waiting())) return;
  await_steps();
  // What came between the last look and now is seen here; later arrivals wake us.
  const std::uint32_t seen = wake_.count();
  if (requests_.ready() || world_commands_.ready() || stop_) return;
  wake_.wait_until(seen, base::steady_ns() + kIdleWaitNs);
}

// Under SCHED_FIFO it would keep everyone else off the core, and run into the kernel's limit.
void PhysicsThread::await_steps() {
  const std::int64_t until_ns = stay_awake_.until_ns();
  if (until_ns == StayAwake::kNever || (fifo_granted_ && !fifo_guard_.stepped_down())) return;
  while (!requests_.ready() && !world_commands_.ready() && !stop_ && base::steady_ns() < until_ns) {
    std::this_thread::yield();  // whoever waits for this core goes first: it may be who asks
  }
}

// Turns so far apart (below 50 Hz) that who asks for something, or watches, is not made to wait for the next one.
void PhysicsThread::wait_long(std::int64_t deadline_ns) {
  while (!stop_ && clock_decides() && base::steady_ns() + kIdleWaitNs < deadline_ns) {
    const std::uint32_t seen = wake_.count();
    if (!requests_.ready() && !world_commands_.ready()) {
      wake_.wait_until(seen, base::steady_ns() + kIdleWaitNs);
    }
    take_requests();
    take_world_commands();
    const std::int64_t now = base::steady_ns();
    if (changed_ || !finished_.empty() || world_->changed() || now - last_publish_ns_ >= kHeartbeatNs) publish(now);
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
  if (step_down_said_) return;
  step_down_said_ = true;
  log_.info(
      "physics needs more than a core: while that lasts it runs under ordinary scheduling, because the kernel stops a "
      "SCHED_FIFO thread that uses more than 95 %% of each second");
}

void PhysicsThread::measure(std::int64_t now_ns) {
  guard_priority(now_ns);
  if (lateness_ns_ >= 0) lateness_.add(lateness_ns_, now_ns);
  if (now_ns - last_measure_ns_ < kMeasureNs) return;
  const std::int64_t cpu_ns = base::thread_cpu_ns();
  const double window_s = base::to_seconds(now_ns - last_measure_ns_);
  run_state_.physics_cpu_share = base::to_seconds(cpu_ns - last_cpu_ns_) / window_s;
  last_cpu_ns_ = cpu_ns;
  last_measure_ns_ = now_ns;
  run_state_.real_time_factor = keeper_.real_time_factor();
  run_state_.steps_per_second = keeper_.steps_per_second();
  run_state_.turns_per_second = keeper_.turns_per_second();
  run_state_.steps_given_up = keeper_.steps_given_up();
  const model::LiveWorld::PhaseTimes phases = world_->phase_times();
  for (int i = 0; i < state::kPhaseCount; ++i) run_state_.seconds_per_phase[i] = phases.seconds_per_step[i];
  const double turn_steps =
      keeper_.turns_per_second() > 0.0 ? keeper_.steps_per_second() / keeper_.turns_per_second() : 0.0;
  run_state_.seconds_per_phase[static_cast<int>(state::Phase::publish)] = publish_s_ / std::max(turn_steps, 1.0);
  const base::Percentiles lateness = lateness_.percentiles(now_ns);
  run_state_.lateness_p50 = base::to_seconds(lateness.p50_ns);
  run_state_.lateness_p99 = base::to_seconds(lateness.p99_ns);
  run_state_.lateness_p999 = base::to_seconds(lateness.p999_ns);
  run_state_.lateness_max = base::to_seconds(lateness.max_ns);
  tell_of_crowd();
}

void PhysicsThread::tell_of_crowd() {
  if (told_of_crowd_ || world_->crowded_steps() < kCrowdedSteps) return;
  const auto [a, b] = world_->deepest_meshes();
  if (a == state::kNone || b == state::kNone) return;
  told_of_crowd_ = true;
  const state::Structure& structure = *world_->structure();
  const auto name = [&](std::uint32_t body) { return structure.objects[structure.bodies[body].object].name.c_str(); };
  log_.warning(
      "'%s' and '%s', and perhaps others, touch with so many triangles that not all of their contacts are computed in "
      "each step. Put them apart, or give them coarser collision meshes, hulls or primitives. This is said once.",
      name(a), name(b));
}

}  // namespace ambf::runtime
