#include "runtime/detail/physics_thread.h"

#include "base/clock.h"

namespace ambf::runtime {

PhysicsThread::PhysicsThread(const SimulationOptions& options, const TimeConfig& time,
                             std::unique_ptr<model::LiveWorld> world, base::Log& log, inputs::Channel* record)
    : options_(options), log_(log), loop_(options, time, std::move(world), log, *this, record) {
  finished_.reserve(kMaxRequests);
  thread_ = std::thread([this] { run(); });
}

PhysicsThread::~PhysicsThread() { stop(); }

void PhysicsThread::stop() {
  stop_ = true;
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
  // No request is run any more: those in flight are refused.
  if (stepping_) answers_.push(std::move(stepping_), false);
  for (; waiting_count_ > 0; --waiting_count_) {
    answers_.push(std::move(waiting_[waiting_first_]), false);
    waiting_first_ = (waiting_first_ + 1) % waiting_.size();
  }
  refuse_waiting();
}

void PhysicsThread::refuse_waiting() {
  RequestPtr request;
  while (requests_.try_pop(request)) answers_.push(std::move(request), false);
}

bool PhysicsThread::submit(RequestPtr request) {
  const std::size_t limit = request->from_loader()   ? kMaxRequests
                            : request->takes_steps() ? kPlacesForSteps
                                                     : kPlacesForOthers;
  if (!answers_.reserve(limit)) {
    log_.warning("request refused: %zu are in flight", limit);
    request->answer(false);
    return false;
  }
  if (stop_ || !requests_.try_push(std::move(request))) {
    answers_.push(std::move(request), false);
    return false;
  }
  wake_.notify_all();
  // The thread may have ended between our check and our push: then no other thread would ever answer.
  if (stop_) refuse_waiting();
  return true;
}

bool PhysicsThread::post_world(const state::WorldCommand& command) {
  const bool taken = world_commands_.try_push(command);
  wake_.notify_all();
  if (!taken) {
    count_refused_command();
    log_.warning("world command lost: more than %zu came within one iteration of the physics thread",
                 world_commands_.capacity());
  }
  return taken;
}

void PhysicsThread::begin() {
  begin_ = true;
  wake_.notify_all();
}

void PhysicsThread::run() {
  // A free run never sleeps by itself: under a real-time priority it would lock everybody else out.
  const base::RealTimeGrant grant = base::enter_real_time("physics", options_.fixed_step ? 0 : kRealTimePriority);
  log_.info("physics thread: %s", base::to_string(grant).c_str());
  fifo_granted_ = grant.fifo;
  loop_.attach_thread();
  while (!stop_) iterate();
}

void PhysicsThread::iterate() {
  const std::int64_t now = base::steady_ns();
  take_requests();
  take_world_commands();
  if (loop_.control().mode() == RunMode::waiting && begin_) loop_.control().begin();
  const PhysicsLoop::Ran ran = loop_.run(now);
  if (ran.service_steps) serve_steps();  // now, so that its answer follows the frame of this very step
  guard_priority(base::steady_ns());
  loop_.measure(base::steady_ns());

  const std::int64_t end = base::steady_ns();
  if (!finished_.empty() || loop_.publish_due(end, ran.steps)) loop_.publish(end);
  answer_finished();
  wait();
}

void PhysicsThread::take_requests() {
  RequestScope scope(loop_);
  RequestPtr request;
  while (requests_.try_pop(request)) {
    if (request->takes_steps()) {
      if (!stepping_ && waiting_count_ == 0) stay_awake_.asked(base::steady_ns());
      waiting_[(waiting_first_ + waiting_count_++) % waiting_.size()] = std::move(request);
    } else {
      request->run(scope);
      finished_.push_back(std::move(request));
    }
  }
  serve_steps();
}

// Step requests are served one after the other, each until its last step.
void PhysicsThread::serve_steps() {
  RequestScope scope(loop_);
  while (stepping_ || waiting_count_ > 0) {
    if (!stepping_) {
      stepping_ = std::move(waiting_[waiting_first_]);
      waiting_first_ = (waiting_first_ + 1) % waiting_.size();
      --waiting_count_;
    }
    if (stepping_->run(scope) == Progress::again) return;
    finished_.push_back(std::move(stepping_));
    loop_.control().steps_answered();
    if (waiting_count_ == 0) stay_awake_.answered(base::steady_ns());
  }
}

void PhysicsThread::take_world_commands() {
  state::WorldCommand command;
  while (world_commands_.try_pop(command)) loop_.control().world_command(command, base::steady_ns());
}

void PhysicsThread::add_reports(state::RunState& run) {
  run.commands_refused = refused_.load(std::memory_order_relaxed);
  run.graphics_rate = graphics_rate_.load(std::memory_order_relaxed);
  run.seconds_per_picture = seconds_per_picture_.load(std::memory_order_relaxed);
  run.comm_seconds_per_frame = comm_s_.load(std::memory_order_relaxed);
}

// Waiters for steps are woken first; what is published meanwhile is a copy for others.
void PhysicsThread::on_published() {
  answer_finished();
  published_.notify_all();
}

void PhysicsThread::answer_finished() {
  for (RequestPtr& request : finished_) {
    if (request->shown()) {
      answers_.dispose(std::move(request));
    } else {
      answers_.push(std::move(request), true);
    }
  }
  finished_.clear();
}

}  // namespace ambf::runtime
