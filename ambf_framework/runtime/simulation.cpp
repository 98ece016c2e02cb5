#include "runtime/simulation.h"

#include <chrono>
#include <future>

#include "base/clock.h"
#include "model/live_world.h"
#include "runtime/detail/simulation_impl.h"
#include "runtime/detail/step_request.h"
#include "runtime/detail/world_setup.h"

namespace ambf::runtime {

Simulation::Impl::Impl(const SimulationOptions& options, const scene::World& world, scene::ColorTable colors,
                       base::Log& log_in, inputs::Recorder* recorder)
    : log(log_in),
      gravity(world.gravity),
      work(
          options, world, std::move(colors), log_in, [this](RequestPtr request) { physics.submit(std::move(request)); },
          recorder),
      recorded(recorder != nullptr),
      physics(options, time_config(options, world), make_live_world(options, world, work.commands()), log_in,
              recorder == nullptr ? nullptr : &recorder->make_channel(inputs::kPhysicsStream)),
      picks(physics.pick_table()),
      effectors(physics.effector_table()) {}

Simulation::Simulation(const SimulationOptions& options, const scene::World& world, scene::ColorTable colors,
                       base::Log& log, inputs::Recorder* recorder)
    : impl_(std::make_unique<Impl>(options, world, std::move(colors), log, recorder)) {
  std::promise<void> loaded;
  impl_->on_loader([this, &world] { return impl_->work.load_world(world); },
                   [&loaded](const state::Outcome&) { loaded.set_value(); });
  loaded.get_future().wait();
}

Simulation::~Simulation() = default;

void Simulation::begin() {
  if (impl_->recorded) {
    std::promise<void> saved;
    impl_->on_loader([this] { return impl_->work.save_start({}); },
                     [&saved](const state::Outcome&) { saved.set_value(); });
    saved.get_future().wait();
  }
  impl_->physics.begin();
}

std::unique_ptr<state::FrameReader> Simulation::make_reader() {
  return PoolFrameReader::make(impl_->physics.frames(), impl_->physics.published());
}

std::unique_ptr<state::StepReader> Simulation::read_steps() {
  return impl_->physics.step_frames().read(impl_->work.structure());
}

std::shared_ptr<const state::Structure> Simulation::structure() { return impl_->work.structure(); }

std::unique_ptr<state::CommandPort> Simulation::bind(state::ObjectId object, state::Source source) {
  return impl_->work.commands().bind(object, source);
}

void Simulation::post_world(const state::WorldCommand& command) { impl_->physics.post_world(command); }
void Simulation::world_command_expired() {
  impl_->on_physics([](RequestScope& scope) { scope.world_command_silent(); });
}
void Simulation::count_refused_command(state::ObjectId object) {
  impl_->physics.count_refused_command();
  impl_->work.commands().count_refused(object);
}
void Simulation::report_graphics(double hz, double seconds_per_picture) {
  impl_->physics.report_graphics(hz, seconds_per_picture);
}
void Simulation::report_comm(double seconds_per_frame) { impl_->physics.report_comm(seconds_per_frame); }

void Simulation::set_paused(bool paused) {
  impl_->on_physics([paused](RequestScope& scope) { scope.set_paused(paused); });
}
void Simulation::step_paused(unsigned steps) {
  impl_->on_physics([steps](RequestScope& scope) { scope.step_paused(steps); });
}
void Simulation::reset_world() {
  impl_->on_physics([gravity = impl_->gravity](RequestScope& scope) {
    scope.set_gravity(gravity);
    scope.reset_world();
  });
  // Parents are structure, and that is the loader's.
  impl_->on_loader([this] { return impl_->work.reset_parents(); }, {});
}
void Simulation::reset_bodies() {
  impl_->on_physics([](RequestScope& scope) { scope.reset_bodies(); });
}
void Simulation::reset_bodies(std::vector<state::ObjectId> bodies) {
  impl_->on_physics([bodies = std::move(bodies)](RequestScope& scope) { scope.reset_bodies(bodies); });
}
void Simulation::set_speed(double factor) {
  constexpr double kSlowest = 1e-3, kFastest = 1e3;
  if (!(factor >= kSlowest && factor <= kFastest)) {
    impl_->physics.count_refused_command();
    impl_->log.warning("speed refused: it must lie between %g and %g", kSlowest, kFastest);
    return;
  }
  impl_->on_physics([factor](RequestScope& scope) { scope.set_speed(factor); });
}

void Simulation::set_parameter(state::ObjectId object, state::Parameter parameter, const math::Vec3& value,
                               state::Completion done) {
  if (impl_->refuses(state::check(parameter, value), done)) return;
  impl_->on_physics_answered(
      [object, parameter, value](RequestScope& scope, state::Outcome& outcome) {
        outcome = scope.set_parameter(object, parameter, value);
      },
      std::move(done));
}

void Simulation::set_hold(state::ObjectId object, bool hold, state::Completion done) {
  impl_->on_physics_answered(
      [object, hold](RequestScope& scope, state::Outcome& outcome) {
        outcome.success = scope.set_hold(object, hold);
        if (!outcome.success) outcome.message = "it is gone, or neither a body nor a joint";
      },
      std::move(done));
}

void Simulation::push(state::ObjectId body, const state::Push& push, state::Completion done) {
  if (impl_->refuses(state::check(push), done)) return;
  impl_->on_physics_answered(
      [body, push](RequestScope& scope, state::Outcome& outcome) { outcome = scope.push(body, push); },
      std::move(done));
}

void Simulation::set_gravity(const math::Vec3& gravity_world) {
  if (!impl_->is_finite("gravity", gravity_world)) return;
  impl_->on_physics([gravity_world](RequestScope& scope) { scope.set_gravity(gravity_world); });
}

void Simulation::set_lens(state::ObjectId camera, const state::Lens& lens) {
  if (state::check(lens).empty()) {
    impl_->on_physics([camera, lens](RequestScope& scope) { scope.set_lens(camera, lens); });
  } else {
    impl_->physics.count_refused_command();
  }
}
void Simulation::set_beam(state::ObjectId light, const state::Beam& beam) {
  if (state::check(beam).empty()) {
    impl_->on_physics([light, beam](RequestScope& scope) { scope.set_beam(light, beam); });
  } else {
    impl_->physics.count_refused_command();
  }
}

std::unique_ptr<state::StepTicket> Simulation::step(unsigned n, std::vector<state::AddressedCommand> commands,
                                                    bool keep_frame) {
  auto reader = keep_frame ? make_reader() : nullptr;
  const bool crowded = keep_frame && reader == nullptr;
  const auto result = std::make_shared<StepResult>(std::move(reader));
  auto ticket = std::make_unique<StepTicket>(result);
  const auto refuse = [&](const char* why) {
    state::Outcome outcome;
    outcome.message = std::string("no step was run: ") + why;
    result->finish(std::move(outcome));
    return std::move(ticket);
  };
  if (crowded) return refuse("too many readers of the simulation at once");
  const std::int64_t received_ns = base::steady_ns();
  StepRequest::Commands bound;
  bound.reserve(commands.size());
  for (state::AddressedCommand& addressed : commands) {
    auto port = impl_->work.commands().bind(addressed.object, state::Source::step_service);
    // Stepping without it would be another simulation than the one asked for.
    if (port == nullptr) return refuse("a commanded object is gone or takes no commands");
    bound.emplace_back(std::move(port), std::move(addressed.command));
  }
  impl_->physics.submit(std::make_unique<StepRequest>(n, std::move(bound), received_ns, result));
  return ticket;
}

void Simulation::set_parent(state::ObjectId object, const std::string& parent, state::Completion done) {
  impl_->on_loader([this, object, parent] { return impl_->work.set_parent(object, parent); }, std::move(done));
}
void Simulation::load(state::LoadRequest request, state::Completion done) {
  impl_->on_loader([this, request = std::move(request)] { return impl_->work.load_model(request); }, std::move(done));
}
void Simulation::unload(const std::string& model, state::Completion done) {
  impl_->on_loader([this, model] { return impl_->work.unload(model); }, std::move(done));
}
void Simulation::remove(const std::string& object, state::Completion done) {
  impl_->on_loader([this, object] { return impl_->work.remove(object); }, std::move(done));
}
void Simulation::save(state::SaveModelRequest request, state::Completion done) {
  impl_->on_loader(
      [this, request = std::move(request)] {
        // A frame that already shows the last change, which this thread has made: it comes with the next turn.
        constexpr std::chrono::milliseconds kPatience{100};
        constexpr int kTries = 20;
        const auto reader = request.current_pose ? make_reader() : nullptr;
        const state::Frame* now = reader == nullptr ? nullptr : reader->latest();
        for (int i = 0; now != nullptr && now->structure != impl_->work.structure() && i < kTries; ++i) {
          reader->wait_newer(now->sequence, kPatience);
          now = reader->latest();
        }
        return impl_->work.save(request, now);
      },
      std::move(done));
}

void Simulation::snapshot(const std::string& name, const std::string& path, state::Completion done) {
  impl_->on_loader([this, name, path] { return impl_->work.take_snapshot(name, path); }, std::move(done));
}
void Simulation::restore(const std::string& name, const std::string& path, state::Completion done) {
  impl_->on_loader([this, name, path] { return impl_->work.restore_snapshot(name, path); }, std::move(done));
}
void Simulation::forget(const std::string& name, state::Completion done) {
  impl_->on_loader([this, name] { return impl_->work.forget_snapshot(name); }, std::move(done));
}
std::vector<std::string> Simulation::snapshots() { return impl_->work.snapshots().names(); }

std::unique_ptr<state::PickPort> Simulation::make_pick_port() {
  const int slot = impl_->picks.take();
  return slot < 0 ? nullptr : std::make_unique<Impl::Pointer>(*impl_, slot);
}

std::unique_ptr<state::EffectorPort> Simulation::hold(state::ObjectId body, state::Source source) {
  return impl_->effectors.hold(*impl_->work.structure(), body, source);
}

state::Outcome Simulation::load_and_wait(state::LoadRequest request) {
  std::promise<state::Outcome> promise;
  load(std::move(request), [&promise](const state::Outcome& outcome) { promise.set_value(outcome); });
  return promise.get_future().get();
}

}  // namespace ambf::runtime
