#include "runtime/detail/physics_thread.h"

#include <algorithm>

#include "base/clock.h"
#include "physics/world.h"
#include "state/columns.h"

namespace ambf::runtime {

namespace {

constexpr std::int64_t kBudgetNs = 2'000'000;     // longest stretch of steps without looking at requests
constexpr std::int64_t kFreePublishNs = 200'000;  // free runs: no more frames than anybody can read
constexpr double kServiceTurn_s = 0.2;  // simulated, in one turn for a Step request: well within a watchdog's time
constexpr std::int64_t kStepsGraceNs = base::kNanosecondsPerSecond;  // to finish, when the world is paused or released
constexpr std::uint64_t kPublishSample = 16;  // publications between two that are measured: reading the clock costs too

// As --solver calls them.
const char* solver_name(Solver solver) {
  switch (solver) {
    case Solver::direct: return "direct";
    case Solver::sequential_impulse: return "si";
    case Solver::mlcp: return "mlcp";
  }
  return "";
}

}  // namespace

PhysicsThread::PhysicsThread(const SimulationOptions& options, const TimeConfig& time,
                             std::unique_ptr<model::LiveWorld> world, base::Log& log)
    : options_(options),
      world_(std::move(world)),
      log_(log),
      frames_([this] { return state::make_frame(world_->structure()); }),
      keeper_(time),
      throttle_(options.release_silent_throttle) {
  keeper_.start(base::steady_ns());
  finished_.reserve(kMaxRequests);
  old_frames_.reserve(2 * model::kFramesPerPool);
  started_ns_ = last_measure_ns_ = base::steady_ns();
  thread_ = std::thread([this] { run(); });
}

PhysicsThread::~PhysicsThread() { stop(); }

void PhysicsThread::stop() {
  stop_ = true;
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
  // Nobody runs requests any more: those in flight are told so.
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
  // The thread may have ended between our look and our push: then nobody else would ever answer.
  if (stop_) refuse_waiting();
  return true;
}

bool PhysicsThread::post_world(const state::WorldCommand& command) {
  const bool taken = world_commands_.try_push(command);
  wake_.notify_all();
  if (!taken) {
    count_refused_command();
    log_.warning("world command lost: more than %zu came within one turn of the physics thread",
                 world_commands_.capacity());
  }
  return taken;
}

void PhysicsThread::begin() {
  begun_ = true;
  wake_.notify_all();
}

void PhysicsThread::run() {
  // A free run never sleeps by itself: under a real-time priority it would lock everybody else out.
  const base::RealTimeGrant grant = base::enter_real_time("physics", options_.fixed_step ? 0 : kRealTimePriority);
  log_.info("physics thread: %s", base::to_string(grant).c_str());
  fifo_granted_ = grant.fifo;
  last_cpu_ns_ = base::thread_cpu_ns();
  while (!stop_) turn();
}

void PhysicsThread::turn() {
  const std::int64_t now = base::steady_ns();
  take_requests();
  take_world_commands();
  const Plan plan = decide(now);
  world_->take_picks(plan.steps == 0 && !diverged_ && (paused_ || !begun_));
  const std::uint64_t steps = run_steps(plan, now);
  const bool running = steps > 0;
  if (!running) world_->take_commands(base::to_seconds(keeper_.watch_ns()));  // cameras and statics obey while paused
  measure(base::steady_ns());

  const std::int64_t end = base::steady_ns();
  // In real time every turn that simulated is shown; a free run is shown as often as anybody can look.
  const std::int64_t since = end - last_publish_ns_;
  const bool due = since >= kHeartbeatNs || (running && (!options_.fixed_step || since >= kFreePublishNs));
  if (due || changed_ || !finished_.empty() || (!running && world_->changed())) publish(end);
  answer_finished();
  wait();
}

void PhysicsThread::take_requests() {
  Turn turn(*this);
  RequestPtr request;
  while (requests_.try_pop(request)) {
    if (request->takes_steps()) {
      if (!stepping_ && waiting_count_ == 0) stay_awake_.asked(base::steady_ns());
      waiting_[(waiting_first_ + waiting_count_++) % waiting_.size()] = std::move(request);
    } else {
      request->run(turn);
      finished_.push_back(std::move(request));
    }
  }
  serve_steps();
}

// Step requests are served one after the other, each until its last step.
void PhysicsThread::serve_steps() {
  Turn turn(*this);
  while (stepping_ || waiting_count_ > 0) {
    if (!stepping_) {
      stepping_ = std::move(waiting_[waiting_first_]);
      waiting_first_ = (waiting_first_ + 1) % waiting_.size();
      --waiting_count_;
    }
    if (stepping_->run(turn) == Progress::again) return;
    finished_.push_back(std::move(stepping_));
    steps_end_ns_ = 0;
    steps_cut_ = false;
    if (waiting_count_ == 0) stay_awake_.answered(base::steady_ns());
  }
}

// Who asked for these steps may be gone, or have asked for far too many: without this nothing short of our end would
// stop them.
void PhysicsThread::end_steps_soon() {
  if (service_steps_ > 0 && steps_end_ns_ == 0) steps_end_ns_ = base::steady_ns() + kStepsGraceNs;
}

void PhysicsThread::take_world_commands() {
  state::WorldCommand command;
  while (world_commands_.try_pop(command)) {
    throttle_.on_command(command);
    if (!command.enable_step_throttling) end_steps_soon();
  }
}

PhysicsThread::Plan PhysicsThread::decide(std::int64_t now_ns) {
  if (!clock_decides()) {
    // It must not ask for the time of a pause afterwards.
    keeper_.hold_turn(now_ns);
    lateness_ns_ = -1;
    turn_left_ = 0;
    if (!begun_ || diverged_) return {};
    if (service_steps_ > 0) return {std::min(service_steps_, most_service_steps()), true, false, false};
    if (paused_) return {manual_steps_, true, false, false};
    return {throttle_.steps_left(), true, throttle_.toggle_waiting(), false};
  }
  if (turn_left_ > 0) {
    lateness_ns_ = -1;
    return {turn_left_, true, false, true};
  }
  const TurnPlan plan = keeper_.begin_turn(now_ns);
  lateness_ns_ = plan.lateness_ns;
  const auto steps = static_cast<std::uint64_t>(plan.steps);
  if (!options_.fixed_step) return {steps, false, false, false};
  // A turn of fixed steps may stand for hours: it is run in pieces, between which requests are looked at.
  turn_left_ = steps;
  return {steps, true, false, true};
}

// At least one; few enough that a request keeps its own commands alive between two turns.
std::uint64_t PhysicsThread::most_service_steps() const {
  return static_cast<std::uint64_t>(std::max(1.0, kServiceTurn_s / keeper_.step_s()));
}

std::uint64_t PhysicsThread::run_steps(const Plan& plan, std::int64_t now_ns) {
  std::uint64_t done = 0;
  budget_used_ = false;
  world_->physics().set_real_time(!options_.fixed_step && clock_decides());
  while (done < plan.steps) {
    const bool good = step_once(done);
    ++done;
    if (!good || stop_) break;
    budget_used_ = plan.budgeted && base::steady_ns() - now_ns > kBudgetNs;
    if (budget_used_) break;
  }
  keeper_.end_turn(base::steady_ns(), static_cast<std::int64_t>(done));
  if (plan.toggle) {
    if (throttle_.steps_done(static_cast<unsigned>(done))) {
      ++toggles_;
      changed_ = true;  // a finished toggle is always shown
    }
  } else if (service_steps_ > 0) {
    service_steps_ = diverged_ ? 0 : service_steps_ - done;
    steps_cut_ = service_steps_ > 0 && steps_end_ns_ != 0 && base::steady_ns() > steps_end_ns_;
    if (steps_cut_) service_steps_ = 0;
    if (service_steps_ == 0) serve_steps();  // now, so that its answer follows the frame of this very step
  } else if (plan.turn) {
    turn_left_ -= done;
  } else if (paused_) {
    manual_steps_ -= std::min(done, manual_steps_);
  }
  return done;
}

bool PhysicsThread::step_once(std::uint64_t done) {
  world_->take_commands(base::to_seconds(keeper_.watch_ns(static_cast<std::int64_t>(done))));
  world_->step(keeper_.step_s());
  const std::uint32_t body = world_->diverged_body();
  if (body == state::kNone) return true;
  diverge(body);
  return false;
}

void PhysicsThread::diverge(std::uint32_t body) {
  diverged_ = true;  // holds the world, whether it is paused or not
  run_state_.diverged_body = body;
  manual_steps_ = 0;
  world_->controllers_off();
  const state::Structure& structure = *world_->structure();
  log_.error(
      "body '%s' diverged at step %u: its state is not finite or absurdly fast. The world is paused, all controllers "
      "are off; "
      "the last good state stays visible. Reset the world to go on.",
      structure.objects[structure.bodies[body].object].name.c_str(), world_->sim_step());
}

void PhysicsThread::publish(std::int64_t now_ns) {
  const bool sample = sequence_ % kPublishSample == 0;
  const std::int64_t cpu_ns = sample ? base::thread_cpu_ns() : 0;
  const state::Structure* structure = world_->structure().get();
  state::Frame* frame = &frames_.begin_write();
  if (frame->structure.get() != structure) {
    // The pool still holds frames of an older structure: each is replaced when its turn comes.
    old_frames_.push_back(frames_.exchange_write_slot(std::move(new_frames_.back())));
    new_frames_.pop_back();
    frame = &frames_.begin_write();
  }
  const state::Frame* good = frames_.newest();
  world_->fill(*frame);
  if (diverged_ && good != nullptr) state::keep_last_good(*good, *frame);
  world_->fill_parameters(*frame);
  frame->sequence = ++sequence_;
  frame->wall_time = base::to_seconds(now_ns - started_ns_);
  frame->steady_ns = now_ns;
  frame->system_ns = base::system_ns();
  frame->toggles = toggles_;
  run_state_.step_s = keeper_.step_s();
  run_state_.speed_factor = keeper_.speed();
  run_state_.max_steps_per_turn = static_cast<unsigned>(keeper_.step_cap());
  run_state_.fixed_step = options_.fixed_step;
  run_state_.paused = paused_ || diverged_;
  run_state_.throttled = throttle_.engaged();
  run_state_.diverged = diverged_;
  if (!diverged_) run_state_.diverged_body = state::kNone;
  run_state_.solver = solver_name(options_.solver);
  run_state_.commands_refused = refused_.load(std::memory_order_relaxed);
  run_state_.watchdog_s = frame->run.watchdog_s;
  take_reports();
  frame->run = run_state_;
  frames_.publish();
  answer_finished();  // who waits for steps goes first; what is published meanwhile is a copy for others
  published_.notify_all();
  changed_ = false;
  last_publish_ns_ = now_ns;
  if (sample) {
    const double seconds = base::to_seconds(base::thread_cpu_ns() - cpu_ns);
    publish_s_ = publish_s_ == 0.0 ? seconds : publish_s_ + 0.01 * (seconds - publish_s_);
  }
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
