#include "runtime/local_simulation.h"

#include "base/clock.h"
#include "runtime/detail/loader_work.h"
#include "runtime/detail/physics_loop.h"
#include "runtime/detail/request_scope.h"
#include "runtime/detail/world_setup.h"

namespace ambf::runtime {

namespace {

SimulationOptions with_fixed_steps(SimulationOptions options) {
  options.fixed_step = true;
  options.readers = 0;  // frame() is all that is read, on the thread that steps
  return options;
}

}  // namespace

struct LocalSimulation::Impl final : LoopHost {
  Impl(const SimulationOptions& options, const scene::World& world, scene::ColorTable colors, base::Log& log,
       std::shared_ptr<mesh::MeshCache> meshes)
      : gravity(world.gravity),
        work(
            options, world, std::move(colors), log,
            [this](RequestPtr request) {
              RequestScope scope(loop);
              request->run(scope);
              request->answer(true);
            },
            nullptr, std::move(meshes)),
        loop(options, time_config(options, world), make_live_world(options, world, work.commands()), log, *this) {
    loop.attach_thread();
    loop.control().begin();
    work.load_world(world);
    step(0);
  }

  bool step(unsigned n) {
    loop.control().start_steps(n);  // also holds the clock: nothing else runs
    do {
      loop.run(base::steady_ns());
    } while (loop.control().service_steps_left() > 0);
    loop.control().steps_answered();
    loop.measure(base::steady_ns());
    loop.publish(base::steady_ns());
    return !loop.control().diverged();
  }

  const math::Vec3 gravity;  // of the world file: what a reset goes back to
  LoaderWork work;
  PhysicsLoop loop;
};

LocalSimulation::LocalSimulation(SimulationOptions options, const scene::World& world, scene::ColorTable colors,
                                 base::Log& log, std::shared_ptr<mesh::MeshCache> meshes)
    : impl_(std::make_unique<Impl>(with_fixed_steps(std::move(options)), world, std::move(colors), log,
                                   std::move(meshes))) {}

LocalSimulation::~LocalSimulation() = default;

state::Outcome LocalSimulation::load(const state::LoadRequest& request) { return impl_->work.load_model(request); }
state::Outcome LocalSimulation::load(const scene::Model& model) { return impl_->work.load(model, {}, {}); }
state::Outcome LocalSimulation::unload(const std::string& model) { return impl_->work.unload(model); }
state::Outcome LocalSimulation::remove(const std::string& object) { return impl_->work.remove(object); }
state::Outcome LocalSimulation::save(const state::SaveModelRequest& request) {
  return impl_->work.save(request, impl_->loop.frames().newest());
}

bool LocalSimulation::step(unsigned n) { return impl_->step(n); }

void LocalSimulation::reset() {
  RequestScope scope(impl_->loop);
  scope.world().set_gravity(impl_->gravity);
  scope.reset_world();
  impl_->work.reset_parents();
  impl_->step(0);
}

state::Outcome LocalSimulation::snapshot(const std::string& name) { return impl_->work.take_snapshot(name, ""); }

state::Outcome LocalSimulation::forget(const std::string& name) { return impl_->work.forget_snapshot(name); }

state::Outcome LocalSimulation::restore(const std::string& name) {
  state::Outcome outcome = impl_->work.restore_snapshot(name, "");
  impl_->loop.publish(base::steady_ns());
  return outcome;
}

state::Outcome LocalSimulation::set_parameter(state::ObjectId object, state::Parameter parameter,
                                              const math::Vec3& value) {
  state::Outcome outcome;
  outcome.message = state::check(parameter, value);
  return outcome.message.empty() ? RequestScope(impl_->loop).set_parameter(object, parameter, value) : outcome;
}

void LocalSimulation::set_gravity(const math::Vec3& gravity_world) {
  RequestScope(impl_->loop).set_gravity(gravity_world);
}

state::Outcome LocalSimulation::push(state::ObjectId body, const state::Push& push) {
  state::Outcome outcome;
  outcome.message = state::check(push);
  return outcome.message.empty() ? RequestScope(impl_->loop).push(body, push) : outcome;
}

state::Outcome LocalSimulation::set_parent(state::ObjectId object, const std::string& parent) {
  return impl_->work.set_parent(object, parent);
}

bool LocalSimulation::hold(state::ObjectId body, state::Source source, model::Law& law) {
  return impl_->loop.world().hold(body, source, law);
}
void LocalSimulation::let_go(state::ObjectId body, state::Source source) { impl_->loop.world().let_go(body, source); }

std::unique_ptr<state::EffectorPort> LocalSimulation::hold(state::ObjectId body, state::Source source) {
  return impl_->loop.world().effector_table().hold(*impl_->work.structure(), body, source);
}

std::unique_ptr<state::CommandPort> LocalSimulation::bind(state::ObjectId object, state::Source source) {
  return impl_->work.commands().bind(object, source);
}

const state::Frame& LocalSimulation::frame() const { return *impl_->loop.frames().newest(); }

std::shared_ptr<const state::Structure> LocalSimulation::structure() const { return impl_->work.structure(); }

}  // namespace ambf::runtime
