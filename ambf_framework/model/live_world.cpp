#include "model/live_world.h"

#include <ctime>

#include "model/detail/live_impl.h"
#include "model/detail/swap.h"
#include "model/kinds/kind.h"
#include "model/kinds/registry.h"
#include "physics/mounted_bodies.h"
#include "physics/soft_body.h"
#include "state/soft_bodies.h"

namespace ambf::model {
namespace {

constexpr std::uint32_t kSampleEvery = 16;  // steps between two whose phases are measured: reading the clock costs too

double thread_cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Running mean over about the last hundred samples.
void blend(double& mean, double sample) { mean = mean == 0.0 ? sample : mean + 0.01 * (sample - mean); }

}  // namespace

LiveWorld::Impl::Impl(std::unique_ptr<physics::World> physics_world, CommandTable& table)
    : physics(std::move(physics_world)),
      structure(std::make_shared<state::Structure>()),
      commands(table, *this),
      picks(*physics),
      effectors(tables, table.watchdog_s()),
      contacts(base::kMaxContactsInFrame) {
  cut_reports.reserve(kMaxCutReports);
  for (const auto& kind : kinds()) kind->add_actors(*this);
}

void LiveWorld::Impl::let_idle(LiveJoint& joint) {
  if (joint.motor_holds) {
    joint.joint->set_motor_velocity(0.0);
  } else {
    joint.joint->set_free();
  }
}

math::Pose LiveWorld::Impl::pose_of(std::uint32_t object) const {
  const state::ObjectInfo& info = structure->objects[object];
  return kind_of(info.kind).pose(*this, info.slot);
}

LiveObject* LiveWorld::Impl::find(state::ObjectId id, state::ObjectKind kind) const {
  const std::uint32_t object = state::find(*structure, id);
  if (object == state::kNone || structure->objects[object].kind != kind) return nullptr;
  return tables.of(kind)[structure->objects[object].slot].get();
}

LiveWorld::LiveWorld(std::unique_ptr<physics::World> world, CommandTable& commands)
    : impl_(std::make_unique<Impl>(std::move(world), commands)) {}

// Joints and bodies must have left their world before they or it end.
LiveWorld::~LiveWorld() {
  impl_->picks.end_all();
  for (std::size_t i = kinds().size(); i-- > 0;)
    for (std::uint32_t slot = 0; slot < impl_->tables.of(kinds()[i]->number()).size(); ++slot)
      kinds()[i]->unlink(*impl_, slot);
}

const std::shared_ptr<const state::Structure>& LiveWorld::structure() const { return impl_->structure; }
std::uint32_t LiveWorld::sim_step() const { return static_cast<std::uint32_t>(impl_->steps); }
double LiveWorld::sim_time() const { return impl_->sim_time; }
std::uint64_t LiveWorld::epoch() const { return impl_->epoch; }
bool LiveWorld::changed() const { return impl_->changed; }
physics::World& LiveWorld::physics() { return *impl_->physics; }

void LiveWorld::take_commands(double watchdog_s) {
  const bool sample = impl_->until_sample == 0;
  const double start = sample ? thread_cpu_s() : 0.0;
  if (impl_->commands.take(*impl_->structure, watchdog_s)) impl_->changed = true;
  if (impl_->effectors.end_silent(watchdog_s)) impl_->changed = true;
  if (sample) blend(impl_->commands_s, thread_cpu_s() - start);
}

void LiveWorld::step(double h_s) {
  Impl& live = *impl_;
  const bool sample = live.until_sample == 0;
  live.until_sample = sample ? kSampleEvery - 1 : live.until_sample - 1;
  const double start = sample ? thread_cpu_s() : 0.0;
  live.laws.forget_shares();
  live.actors.run(StepPhase::laws, h_s);
  live.actors.run(StepPhase::forces, h_s);
  const double before_physics = sample ? thread_cpu_s() : 0.0;

  live.physics->step();
  ++live.steps;
  live.sim_time = static_cast<double>(live.steps) * h_s;
  live.changed = true;

  const double after_physics = sample ? thread_cpu_s() : 0.0;
  live.actors.run(StepPhase::readings, h_s);
  if (sample) blend(live.controllers_s, before_physics - start + thread_cpu_s() - after_physics);
}

void LiveWorld::reset_bodies() {
  impl_->picks.end_all();
  impl_->effectors.end_all();
  impl_->end_pushes();
  impl_->laws.forget_shares();
  impl_->each_object(&Kind::before_reset);
  impl_->physics->release_grasps();
  for (LiveBody& live : impl_->tables.bodies()) {
    live.body->reset();
    live.controller.reset();
  }
  for (LiveJoint& live : impl_->tables.joints()) {
    live.joint->reset();
    live.controller.reset();
    Impl::let_idle(live);  // until a command that is still in force acts again
  }
  impl_->each_object(&Kind::after_reset);
  impl_->each_object(&Kind::bodies_reset);
  impl_->each_object(&Kind::all_placed);
  ++impl_->epoch;
  impl_->changed = true;
}

void LiveWorld::reset() {
  impl_->commands.forget_for_reset();
  impl_->effectors.end_all();
  impl_->picks.end_all();
  impl_->end_pushes();
  impl_->laws.forget_shares();
  impl_->each_object(&Kind::reset_parameters);
  ++impl_->parameters_version;
  impl_->each_object(&Kind::before_reset);
  impl_->physics->reset();
  impl_->each_object(&Kind::reset);
  impl_->each_object(&Kind::after_reset);
  impl_->each_object(&Kind::bodies_reset);  // what is held may have been moved since
  impl_->each_object(&Kind::all_placed);
  impl_->steps = 0;
  impl_->sim_time = 0.0;
  ++impl_->epoch;
  impl_->changed = true;
}

void LiveWorld::set_gravity(const math::Vec3& gravity_world) {
  impl_->physics->set_gravity(gravity_world);
  impl_->changed = true;
}
math::Vec3 LiveWorld::gravity() const { return impl_->physics->options().gravity; }

std::uint32_t LiveWorld::diverged_body() const {
  const physics::Body* body = impl_->physics->first_diverged();
  return body == nullptr ? state::kNone : body->user_index();
}

std::vector<FrozenReport> LiveWorld::freeze_diverged() {
  Impl& live = *impl_;
  std::vector<FrozenReport> reports;
  for (const physics::FrozenGroup& group : live.physics->freeze_diverged()) {
    reports.push_back(
        {group.bodies.front()->user_index(), group.bodies.size() - 1, group.linear_speed, group.angular_speed});
    for (const physics::Body* body : group.bodies) {
      const std::uint32_t slot = body->user_index();
      const state::ObjectInfo& info = live.structure->objects[live.structure->bodies[slot].object];
      live.commands.end_object(*live.structure, {info.kind, slot});
      live.picks.end_of(*body);
      live.effectors.end_of(live.tables.bodies()[slot]);
      live.tables.bodies()[slot].push_steps = 0;
      live.tables.bodies()[slot].controller.reset();
    }
  }
  for (LiveJoint& joint : live.tables.joints()) {
    if (!joint.joint->frozen()) continue;
    joint.order = {};
    joint.controller.reset();
    Impl::let_idle(joint);
  }
  live.list_pushed();
  live.changed = true;
  return reports;
}

bool LiveWorld::anything_moves() const {
  for (const LiveBody& live : impl_->tables.bodies())
    if (!live.body->is_static() && !live.body->frozen() && !physics::is_mounted(*live.body)) return true;
  return false;
}

void LiveWorld::Impl::report_cut(std::uint32_t body, state::Source source) {
  if (cut_reports.size() < kMaxCutReports) cut_reports.push_back({body, source});
}

void LiveWorld::Impl::report_cut(LiveBody& live, state::Source source) {
  const state::SourceSet bit = state::SourceSet{1} << static_cast<int>(source);
  if ((live.bounds_logged & bit) != 0) return;
  live.bounds_logged |= bit;
  report_cut(live.body->user_index(), source);
}

void LiveWorld::Impl::report_cut_gains(LiveBody& live) {
  if (live.gains_logged || cut_reports.size() == kMaxCutReports) return;
  live.gains_logged = true;
  cut_reports.push_back({live.body->user_index(), {}, CutReport::Of::gains});
}

bool LiveWorld::Impl::report_cut(std::uint32_t body, const CutReport::Touch& touch) {
  if (cut_reports.size() == kMaxCutReports) return false;
  cut_reports.push_back({body, {}, CutReport::Of::touch, touch});
  return true;
}

bool LiveWorld::Impl::report_soft_body(std::uint32_t soft_body, CutReport::Of of) {
  if (cut_reports.size() == kMaxCutReports) return false;
  cut_reports.push_back({soft_body, {}, of, {}});
  return true;
}

void LiveWorld::Impl::report_needle(std::uint32_t actuator, CutReport::Of of, bool& reported) {
  if (reported || cut_reports.size() == kMaxCutReports) return;
  cut_reports.push_back({actuator, {}, of, {}});
  reported = true;
}

void LiveWorld::Impl::prepare_effectors(double h_s) {
  effectors.prepare(*structure, static_cast<std::uint32_t>(steps + 1), h_s,
                    [this](LiveBody& body) { report_cut_gains(body); });
}

void LiveWorld::Impl::act_effectors(double h_s) {
  effectors.each_pulling([&](LiveEffector& effector) {
    laws.act(*effector.body, effector.is.source, effector.law, h_s,
             [this](LiveBody& body, state::Source source) { report_cut(body, source); });
  });
}

std::optional<CutReport> LiveWorld::take_cut_report() {
  if (impl_->cut_reports.empty()) return std::nullopt;
  const CutReport report = impl_->cut_reports.back();
  impl_->cut_reports.pop_back();
  return report;
}

std::uint64_t LiveWorld::crowded_steps() const { return impl_->physics->crowded_steps(); }

std::array<std::uint32_t, 2> LiveWorld::max_depth_meshes() const {
  const auto [a, b] = impl_->physics->max_depth_meshes();
  return {a ? a->user_index() : state::kNone, b ? b->user_index() : state::kNone};
}

void LiveWorld::controllers_off() {
  impl_->commands.forget_all();
  impl_->effectors.end_all();
  impl_->end_pushes();
  for (LiveJoint& live : impl_->tables.joints()) live.joint->set_free();
  impl_->changed = true;
}

bool LiveWorld::hold(state::ObjectId body, state::Source source, Law& law) {
  const std::uint32_t slot = impl_->body_slot(body);
  if (slot == state::kNone) return false;
  LiveBody& live = impl_->tables.bodies()[slot];
  return !live.body->is_static() && impl_->laws.hold(live, source, law);
}

void LiveWorld::let_go(state::ObjectId body, state::Source source) {
  const std::uint32_t slot = impl_->body_slot(body);
  if (slot != state::kNone) impl_->laws.let_go(impl_->tables.bodies()[slot], source);
}

bool LiveWorld::pick(std::size_t slot, std::uint64_t press, const math::Vec3& from_world, const math::Vec3& to_world,
                     state::PickHit& hit) {
  const auto ray = impl_->physics->ray_cast(from_world, to_world);
  const auto soft = physics::ray_cast_soft(*impl_->physics, from_world, to_world);
  if (soft && (!ray || ray->body == nullptr || soft->fraction < ray->fraction)) {
    const state::SoftBodyInfo& info = state::soft_bodies(*impl_->structure)[soft->body->user_index()];
    hit.object = impl_->structure->objects[info.object].id;
    hit.point_world = soft->point;
    hit.distance_m = math::norm(soft->point - from_world);
    impl_->picks.hold(slot, press, *soft->body, *soft);
    impl_->changed = true;
    return true;
  }
  if (!ray || ray->body == nullptr) return false;
  const std::uint32_t body = ray->body->user_index();
  hit.object = impl_->structure->objects[impl_->structure->bodies[body].object].id;
  hit.point_world = ray->point;
  hit.distance_m = math::norm(ray->point - from_world);
  impl_->picks.hold(slot, press, impl_->tables.bodies()[body], ray->point);
  impl_->changed = true;
  return true;
}

void LiveWorld::take_picks(bool still) {
  if (impl_->picks.take(*impl_->structure, impl_->tables.bodies(), still)) impl_->changed = true;
}

PickTable& LiveWorld::pick_table() { return impl_->picks.table(); }

void LiveWorld::take_effectors(double watchdog_s, std::uint64_t steps) {
  Impl& live = *impl_;
  const double h_s = live.physics->options().step;
  if (live.effectors.take(*live.structure, live.epoch, watchdog_s, steps, h_s)) live.changed = true;
}

EffectorTable& LiveWorld::effector_table() { return impl_->effectors.table(); }

void LiveWorld::record_to(inputs::Channel* channel) {
  impl_->commands.record_to(channel);
  impl_->effectors.record_to(channel);
  impl_->picks.record_to(channel);
}

LiveWorld::PhaseTimes LiveWorld::phase_times() const {
  PhaseTimes times;
  const auto set = [&](state::Phase phase, double seconds) {
    times.seconds_per_step[static_cast<int>(phase)] = seconds;
  };
  const physics::PhaseTimes of_physics = impl_->physics->phase_times();
  set(state::Phase::commands, impl_->commands_s);
  set(state::Phase::controllers, impl_->controllers_s);
  set(state::Phase::collision, of_physics.collision);
  set(state::Phase::solver, of_physics.solver);
  set(state::Phase::integration, of_physics.integration);
  return times;
}

}  // namespace ambf::model
