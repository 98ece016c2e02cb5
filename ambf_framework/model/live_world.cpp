#include "model/live_world.h"

#include <ctime>

#include "model/detail/live_impl.h"
#include "model/detail/swap.h"

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
      commands(table, tables),
      picks(*physics),
      contacts(state::kMaxContactsInFrame) {}

void LiveWorld::Impl::let_idle(LiveJoint& joint) {
  if (joint.motor_holds) {
    joint.joint->set_motor_velocity(0.0);
  } else {
    joint.joint->set_free();
  }
}

math::Pose LiveWorld::Impl::pose_of(const LivePlaced& placed, std::uint32_t parent_object) const {
  return parent_object == state::kNone ? placed.T_parent : pose_of(parent_object) * placed.T_parent;
}

// The catalogue lets no camera or light be its own ancestor, so this ends.
math::Pose LiveWorld::Impl::pose_of(std::uint32_t object) const {
  const state::ObjectInfo& info = structure->objects[object];
  switch (info.kind) {
    case state::ObjectKind::rigid_body: return tables.bodies[info.slot]->body->pose();
    case state::ObjectKind::camera:
      return pose_of(*tables.cameras[info.slot], structure->cameras[info.slot].parent_object);
    case state::ObjectKind::light:
      return pose_of(*tables.lights[info.slot], structure->lights[info.slot].parent_object);
    default: return {};
  }
}

LiveWorld::LiveWorld(std::unique_ptr<physics::World> world, CommandTable& commands)
    : impl_(std::make_unique<Impl>(std::move(world), commands)) {}

// Joints and bodies must have left their world before they or it end.
LiveWorld::~LiveWorld() {
  impl_->picks.end_all();
  for (auto& joint : impl_->tables.joints) impl_->physics->remove(*joint->joint);
  for (auto& body : impl_->tables.bodies) impl_->physics->remove(*body->body);
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
  if (sample) blend(impl_->commands_s, thread_cpu_s() - start);
}

void LiveWorld::step(double h_s) {
  const bool sample = impl_->until_sample == 0;
  impl_->until_sample = sample ? kSampleEvery - 1 : impl_->until_sample - 1;
  const double start = sample ? thread_cpu_s() : 0.0;
  impl_->commands.act(h_s);
  impl_->act_pushes();
  if (sample) blend(impl_->controllers_s, thread_cpu_s() - start);

  impl_->physics->step();
  ++impl_->steps;
  impl_->sim_time = static_cast<double>(impl_->steps) * h_s;
  impl_->changed = true;
}

void LiveWorld::reset_bodies() {
  impl_->picks.end_all();
  impl_->end_pushes();
  for (auto& live : impl_->tables.bodies) {
    live->body->reset();
    live->controller.reset();
  }
  for (auto& live : impl_->tables.joints) {
    live->joint->reset();
    live->controller.reset();
    Impl::let_idle(*live);  // until a command that is still in force acts again
  }
  ++impl_->epoch;
  impl_->changed = true;
}

void LiveWorld::reset() {
  impl_->commands.forget_all();
  impl_->picks.end_all();
  impl_->end_pushes();
  impl_->load_parameters();
  impl_->physics->reset();
  for (auto& live : impl_->tables.bodies) live->controller.reset();
  for (auto& live : impl_->tables.joints) Impl::let_idle(*live);
  for (auto* table : {&impl_->tables.cameras, &impl_->tables.lights})
    for (auto& placed : *table)
      if (!placed->orphaned) placed->T_parent = placed->T_parent_initial;
  for (const state::CameraInfo& camera : impl_->structure->cameras)
    impl_->tables.cameras[impl_->structure->objects[camera.object].slot]->lens = camera.lens;
  for (const state::LightInfo& light : impl_->structure->lights)
    impl_->tables.lights[impl_->structure->objects[light.object].slot]->beam = light.beam;
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

void LiveWorld::set_lens(state::ObjectId camera, const state::Lens& lens) {
  const std::uint32_t object = state::find(*impl_->structure, camera);
  if (object == state::kNone || impl_->structure->objects[object].kind != state::ObjectKind::camera) return;
  impl_->tables.cameras[impl_->structure->objects[object].slot]->lens = lens;
  impl_->changed = true;
}

void LiveWorld::set_beam(state::ObjectId light, const state::Beam& beam) {
  const std::uint32_t object = state::find(*impl_->structure, light);
  if (object == state::kNone || impl_->structure->objects[object].kind != state::ObjectKind::light) return;
  impl_->tables.lights[impl_->structure->objects[object].slot]->beam = beam;
  impl_->changed = true;
}

std::uint32_t LiveWorld::diverged_body() const {
  const physics::Body* body = impl_->physics->first_diverged();
  return body == nullptr ? state::kNone : body->user_index();
}

std::uint64_t LiveWorld::crowded_steps() const { return impl_->physics->crowded_steps(); }

std::array<std::uint32_t, 2> LiveWorld::deepest_meshes() const {
  const auto [a, b] = impl_->physics->deepest_meshes();
  return {a ? a->user_index() : state::kNone, b ? b->user_index() : state::kNone};
}

void LiveWorld::controllers_off() {
  impl_->commands.forget_all();
  impl_->end_pushes();
  for (auto& live : impl_->tables.joints) live->joint->set_free();
  impl_->changed = true;
}

bool LiveWorld::pick(std::size_t slot, std::uint64_t press, const math::Vec3& from_world, const math::Vec3& to_world,
                     state::PickHit& hit) {
  const auto ray = impl_->physics->ray_cast(from_world, to_world);
  if (!ray || ray->body == nullptr) return false;
  const std::uint32_t body = ray->body->user_index();
  hit.object = impl_->structure->objects[impl_->structure->bodies[body].object].id;
  hit.point_world = ray->point;
  hit.distance_m = math::norm(ray->point - from_world);
  impl_->picks.hold(slot, press, *impl_->tables.bodies[body], ray->point);
  impl_->changed = true;
  return true;
}

void LiveWorld::take_picks(bool still) {
  if (impl_->picks.take(*impl_->structure, impl_->tables.bodies, still)) impl_->changed = true;
}

PickTable& LiveWorld::pick_table() { return impl_->picks.table(); }

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
