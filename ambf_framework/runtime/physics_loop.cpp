#include "runtime/detail/physics_loop.h"

#include <algorithm>
#include <cstdio>

#include "base/clock.h"
#include "base/limits.h"
#include "inputs/physics_records.h"
#include "physics/soft_body.h"
#include "physics/thread.h"
#include "physics/tissue.h"
#include "runtime/detail/world_setup.h"
#include "state/columns.h"
#include "state/sensors.h"
#include "state/soft_bodies.h"

namespace ambf::runtime {

namespace {

constexpr std::int64_t kBudgetNs = 2'000'000;     // longest stretch of steps without serving requests
constexpr std::int64_t kFreePublishNs = 200'000;  // free runs: no more frames than anybody can read
constexpr std::int64_t kMeasureNs = base::kNanosecondsPerSecond;
constexpr std::uint64_t kPublishSample = 16;  // publications between two that are measured: reading the clock costs too
constexpr std::uint64_t kCrowdedSteps = 500;  // with crowded meshes, are worth a warning: fewer pass unnoticed
constexpr int kMaxStepsWithSoftBodies = 10;   // an iteration: their steps are dear (dissertation 5.5.1)
constexpr std::uint64_t kPileSteps = 10;      // in which pairs of a crowd were left out: fewer pass unnoticed

}  // namespace

PhysicsLoop::PhysicsLoop(const SimulationOptions& options, const TimeConfig& time,
                         std::unique_ptr<model::LiveWorld> world, base::Log& log, LoopHost& host,
                         inputs::Channel* record)
    : options_(options),
      world_(std::move(world)),
      log_(log),
      host_(host),
      record_(record),
      frames_([this] { return state::make_frame(world_->structure()); }, options.readers),
      keeper_(time),
      control_(keeper_, options.release_silent_throttle) {
  world_->record_to(record_);
  keeper_.start(base::steady_ns());
  old_frames_.reserve(2 * base::frames_for(options.readers));
  started_ns_ = last_measure_ns_ = base::steady_ns();
}

PhysicsLoop::Ran PhysicsLoop::run(std::int64_t now_ns) {
  const bool soft = physics::soft_body_count(world_->physics()) > 0;
  keeper_.set_loaded_step_limit(soft ? kMaxStepsWithSoftBodies : 0);
  const StepPlan plan = control_.plan(now_ns);
  lateness_ns_ = plan.lateness_ns;
  begin_iteration(watch_s(), plan.steps, control_.still(plan));
  std::uint64_t done = 0;
  budget_used_ = waits_for_step_reader_ = false;
  const bool real_time = !options_.fixed_step && control_.mode() == RunMode::clock;
  // A recording must not depend on how far another thread has come.
  world_->physics().set_real_time(real_time && record_ == nullptr);
  while (done < plan.steps) {
    waits_for_step_reader_ = !real_time && step_frames_.full();
    if (waits_for_step_reader_) break;
    const bool good = step(base::to_seconds(keeper_.watch_ns(static_cast<std::int64_t>(done))));
    ++done;
    if (!good || host_.stop_requested()) break;
    budget_used_ = plan.budgeted && base::steady_ns() - now_ns > kBudgetNs;
    if (budget_used_) break;
  }
  const std::int64_t end_ns = base::steady_ns();
  keeper_.end_iteration(end_ns, static_cast<std::int64_t>(done));
  const RunControl::Finished finished = control_.steps_done(done, end_ns);
  if (finished.toggle) {
    ++toggles_;
    changed_ = true;  // a finished toggle is always shown
  }
  // Cameras and static bodies follow commands while paused.
  if (done == 0 && !waits_for_step_reader_) take_commands(watch_s());
  return {done > 0, finished.service_steps};
}

void PhysicsLoop::begin_iteration(double watch_s, std::uint64_t steps, bool still) {
  note(inputs::IterationRecord{watch_s, steps, still});
  world_->take_picks(still);
  world_->take_effectors(watch_s, steps);
}

void PhysicsLoop::take_commands(double watch_s) {
  note(inputs::TakeRecord{watch_s, false});
  world_->take_commands(watch_s);
}

bool PhysicsLoop::step(double watch_s) {
  note(inputs::TakeRecord{watch_s, true});
  world_->take_commands(watch_s);
  world_->step(keeper_.step_s());
  while (const auto cut = world_->take_cut_report()) report(*cut);
  for (const physics::SoftDivergence& each : physics::freeze_diverged_soft_bodies(world_->physics())) {
    const std::uint32_t object = state::soft_bodies(*world_->structure())[each.body->user_index()].object;
    log_.warning(
        "soft body '%s' diverged at step %u: node %zu moved at %.3g m/s. It is frozen where it was until a reset; "
        "everything else goes on. Try %s.",
        world_->structure()->objects[object].name.c_str(), world_->sim_step(), each.node, each.speed,
        dynamic_cast<const physics::Tissue*>(each.body) != nullptr ? "a lower `young modulus` or larger elements"
        : dynamic_cast<const physics::Thread*>(each.body) != nullptr
            ? "longer segments or a larger `radius`"
            : "less stiffness, more `piterations` or a larger `kDP`");
  }
  const std::uint32_t body = world_->diverged_body();
  if (body != state::kNone) {
    const std::vector<model::FrozenReport> frozen = world_->freeze_diverged();
    if (!world_->anything_moves()) {
      diverge(body);
      return false;
    }
    for (const model::FrozenReport& each : frozen) report(each);
  }
  if (step_frames_.wanted()) record_step(base::steady_ns());
  return true;
}

void PhysicsLoop::record_step(std::int64_t now_ns) {
  std::unique_ptr<state::Frame> frame = step_frames_.take_empty(world_->structure());
  if (frame == nullptr) return;
  fill(*frame, now_ns);
  frame->sequence = sequence_ + 1;
  step_frames_.put(std::move(frame));
}

void PhysicsLoop::report(const model::FrozenReport& frozen) {
  log_.warning(
      "body '%s' diverged at step %u (%.3g m/s, %.3g rad/s): it is frozen where it was, with %zu bodies that joints "
      "connect to it, until a reset or a command within bounds. Everything else goes on.",
      name_of_body(frozen.body), world_->sim_step(), frozen.linear_speed, frozen.angular_speed, frozen.jointed);
}

void PhysicsLoop::diverge(std::uint32_t body) {
  control_.diverge();
  run_state_.diverged_body = body;
  world_->controllers_off();
  log_.error(
      "body '%s' diverged at step %u: its state is not finite or absurdly fast, and nothing else moves. The world is "
      "paused, all controllers are off; the last good state stays visible. Reset the world to go on.",
      name_of_body(body), world_->sim_step());
}

// In real time every iteration with steps is shown; a free run is shown as often as a reader can follow.
bool PhysicsLoop::publish_due(std::int64_t now_ns, bool ran) const {
  const std::int64_t since = now_ns - last_publish_ns_;
  if (since >= kHeartbeatNs || changed_) return true;
  return ran ? !options_.fixed_step || since >= kFreePublishNs : world_->changed();
}

void PhysicsLoop::fill(state::Frame& frame, std::int64_t now_ns) {
  world_->fill(frame);
  world_->fill_parameters(frame);
  frame.wall_time = base::to_seconds(now_ns - started_ns_);
  frame.steady_ns = now_ns;
  frame.system_ns = base::system_ns();
  frame.toggles = toggles_;
  run_state_.step_s = keeper_.step_s();
  run_state_.speed_factor = keeper_.speed();
  run_state_.max_steps_per_turn = static_cast<unsigned>(keeper_.step_cap());
  run_state_.fixed_step = options_.fixed_step;
  run_state_.paused = control_.shown_paused();
  run_state_.throttled = control_.throttled();
  run_state_.diverged = control_.diverged();
  if (!control_.diverged()) run_state_.diverged_body = state::kNone;
  run_state_.solver = solver_name(options_.solver);
  run_state_.watchdog_s = frame.run.watchdog_s;
  host_.add_reports(run_state_);
  frame.run = run_state_;
}

void PhysicsLoop::publish(std::int64_t time_ns) {
  const std::int64_t now_ns = host_.frame_time_ns(time_ns);
  const bool sample = sequence_ % kPublishSample == 0;
  const std::int64_t cpu_ns = sample ? base::thread_cpu_ns() : 0;
  const state::Structure* structure = world_->structure().get();
  state::Frame* frame = &frames_.begin_write();
  if (frame->structure.get() != structure) {
    // The pool still holds frames of an older structure: each is replaced when it is written next.
    old_frames_.push_back(frames_.exchange_write_slot(std::move(new_frames_.back())));
    new_frames_.pop_back();
    frame = &frames_.begin_write();
  }
  const state::Frame* good = frames_.newest();
  fill(*frame, now_ns);
  if (control_.diverged() && good != nullptr) state::keep_last_good(*good, *frame);
  frame->sequence = ++sequence_;
  if (record_ != nullptr)
    note(inputs::PublishedRecord{sequence_, now_ns, state::state_hash(*frame), frame->sim_step, frame->run.throttled});
  frames_.publish();
  host_.on_published();
  changed_ = false;
  last_publish_ns_ = now_ns;
  if (sample) {
    const double seconds = base::to_seconds(base::thread_cpu_ns() - cpu_ns);
    publish_s_ = publish_s_ == 0.0 ? seconds : publish_s_ + 0.01 * (seconds - publish_s_);
  }
}

void PhysicsLoop::swap(model::Prepared&& prepared, model::Garbage& garbage,
                       std::vector<std::unique_ptr<state::Frame>>& frames) {
  std::vector<std::unique_ptr<state::Frame>> sized = std::move(prepared.frames);
  garbage = world_->apply(std::move(prepared));
  // Every slot of the pool gets a frame of the new size, at once unless it is being read, else when it is written next
  // (publish). What was replaced, now or since the last swap, is returned, with the spare frames of that swap.
  frames = std::move(new_frames_);
  new_frames_ = std::move(sized);
  for (int slot = 0; slot < frames_.slots(); ++slot) {
    if (frames_.try_exchange_slot(slot, new_frames_.back())) {
      frames.push_back(std::move(new_frames_.back()));
      new_frames_.pop_back();
    }
  }
  for (auto& old : old_frames_) frames.push_back(std::move(old));
  old_frames_.clear();
  // Published before it moves: should it diverge in this very iteration, there is a good frame of it.
  publish(base::steady_ns());
  changed_ = true;
}

void PhysicsLoop::attach_thread() { last_cpu_ns_ = base::thread_cpu_ns(); }

void PhysicsLoop::measure(std::int64_t now_ns) {
  if (lateness_ns_ >= 0) lateness_.add(lateness_ns_, now_ns);
  if (now_ns - last_measure_ns_ < kMeasureNs) return;
  const std::int64_t cpu_ns = base::thread_cpu_ns();
  const double window_s = base::to_seconds(now_ns - last_measure_ns_);
  run_state_.physics_cpu_share = base::to_seconds(cpu_ns - last_cpu_ns_) / window_s;
  last_cpu_ns_ = cpu_ns;
  last_measure_ns_ = now_ns;
  run_state_.real_time_factor = keeper_.real_time_factor();
  run_state_.steps_per_second = keeper_.steps_per_second();
  run_state_.turns_per_second = keeper_.iterations_per_second();
  run_state_.steps_given_up = keeper_.steps_given_up();
  const model::LiveWorld::PhaseTimes phases = world_->phase_times();
  for (int i = 0; i < state::kPhaseCount; ++i) run_state_.seconds_per_phase[i] = phases.seconds_per_step[i];
  const double steps_per_iteration =
      keeper_.iterations_per_second() > 0.0 ? keeper_.steps_per_second() / keeper_.iterations_per_second() : 0.0;
  run_state_.seconds_per_phase[static_cast<int>(state::Phase::publish)] =
      publish_s_ / std::max(steps_per_iteration, 1.0);
  const base::Percentiles lateness = lateness_.percentiles(now_ns);
  run_state_.lateness_p50 = base::to_seconds(lateness.p50_ns);
  run_state_.lateness_p99 = base::to_seconds(lateness.p99_ns);
  run_state_.lateness_p999 = base::to_seconds(lateness.p999_ns);
  run_state_.lateness_max = base::to_seconds(lateness.max_ns);
  report_pile();
  report_crowd();
}

void PhysicsLoop::report_pile() {
  if (pile_reported_) return;
  const physics::World::Crowd crowd = world_->physics().crowd();
  if (crowd.steps < kPileSteps || crowd.body == nullptr) return;
  pile_reported_ = true;
  log_.warning(
      "'%s' and %zu other bodies are at one place: not all of their contacts are computed in each step until they come "
      "apart, and steps take longer. Put them apart. This is said once.",
      name_of_body(crowd.body->user_index()), crowd.near_bodies);
}

void PhysicsLoop::report_crowd() {
  if (crowd_reported_ || world_->crowded_steps() < kCrowdedSteps) return;
  const auto [a, b] = world_->max_depth_meshes();
  if (a == state::kNone || b == state::kNone) return;
  crowd_reported_ = true;
  log_.warning(
      "'%s' and '%s', and perhaps others, touch with so many triangles that not all of their contacts are computed in "
      "each step. Put them apart, or give them coarser collision meshes, hulls or primitives. This is said once.",
      name_of_body(a), name_of_body(b));
}

}  // namespace ambf::runtime
