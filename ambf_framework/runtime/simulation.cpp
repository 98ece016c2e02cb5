#include "runtime/simulation.h"

#include <atomic>
#include <future>
#include <mutex>

#include "adf/adf.h"
#include "base/clock.h"
#include "mesh/cache.h"
#include "model/catalogue.h"
#include "model/command_table.h"
#include "model/live_world.h"
#include "model/saved_state.h"
#include "physics/world.h"
#include "runtime/enclosure.h"
#include "runtime/loader.h"
#include "runtime/physics_thread.h"
#include "runtime/requests.h"
#include "runtime/snapshots.h"
#include "runtime/step_request.h"

namespace ambf::runtime {

namespace {

physics::WorldOptions physics_options(const SimulationOptions& options, const scene::World& world, double step_s) {
  physics::WorldOptions out;
  out.gravity = world.gravity;
  out.step = step_s;
  out.solver = options.solver == Solver::direct               ? physics::SolverKind::direct
               : options.solver == Solver::sequential_impulse ? physics::SolverKind::si
                                                              : physics::SolverKind::mlcp;
  out.iterations = static_cast<int>(options.solver_iterations);
  out.friction_directions = options.friction_directions;
  out.sleeping = options.sleeping;
  return out;
}

// Under a real-time priority a machine that cannot keep up would never run anything else on that core.
constexpr std::int64_t kRestWhenBehindNs = 50'000;

// No clock wakes a thread more often than this: fixed steps that are asked for at a higher rate run as fast as they go.
constexpr double kFastestPacedHz = 20'000.0;

TimeConfig time_config(const SimulationOptions& options, const scene::World& world) {
  TimeConfig out;
  const bool paced = options.physics_rate_hz <= kFastestPacedHz;
  out.mode = !options.fixed_step ? TimeMode::real_time : paced ? TimeMode::fixed_step : TimeMode::free_running;
  out.frequency_hz = options.physics_rate_hz;
  if (options.fixed_step) out.speed = options.speed_factor;
  if (world.max_iterations_given) out.max_steps_per_turn = static_cast<int>(world.max_iterations);
  if (!options.fixed_step) out.rest_when_behind_ns = kRestWhenBehindNs;
  return out;
}

model::CatalogueOptions catalogue_options(const SimulationOptions& options, const scene::World& world) {
  model::CatalogueOptions out;
  out.world_namespace = world.name_space;
  out.namespace_prefix = options.name_prefix;
  out.step_s = TimeKeeper(time_config(options, world)).step_s();
  return out;
}

state::Outcome stopped() {
  state::Outcome outcome;
  outcome.message = "the simulation is stopping";
  return outcome;
}

std::string summary(const std::string& what, const base::Diagnostics& diagnostics) {
  std::size_t errors = 0, warnings = 0;
  for (const base::Diagnostic& d : diagnostics) {
    errors += d.severity == base::Severity::error;
    warnings += d.severity == base::Severity::warning;
  }
  if (errors + warnings == 0) return what;
  return what + " (" + std::to_string(errors) + " errors, " + std::to_string(warnings) + " warnings)";
}

}  // namespace

struct Simulation::Impl {
  Impl(const SimulationOptions& options, const scene::World& world, scene::ColorTable colors_in, base::Log& log_in)
      : log(log_in),
        colors(std::move(colors_in)),
        gravity(world.gravity),
        step_s(TimeKeeper(time_config(options, world)).step_s()),
        catalogue(catalogue_options(options, world), commands, meshes),
        physics(options, time_config(options, world),
                std::make_unique<model::LiveWorld>(
                    std::make_unique<physics::World>(physics_options(options, world, step_s)), commands),
                log),
        picks(physics.pick_table()) {}

  ~Impl() {
    // Requesters first: the loader may wait for the physics thread, which answers all it has when it stops.
    stopping = true;
    physics.stop();
    loader.stop();
  }

  // The catalogue's newest structure is in force now. Loader thread.
  void publish_structure() {
    const std::lock_guard lock(structure_mutex);
    structure = catalogue.structure();
  }

  // Hands a prepared change to the physics thread and waits until it is in force. Loader thread.
  state::Outcome apply(model::Prepared prepared, base::Diagnostics diagnostics, const std::string& done_text) {
    state::Outcome outcome;
    diagnostics.insert(diagnostics.end(), prepared.diagnostics.begin(), prepared.diagnostics.end());
    for (const base::Diagnostic& diagnostic : diagnostics) log.report(diagnostic);
    outcome.model = prepared.model;
    if (!prepared.success) {
      outcome.message = summary("nothing was changed", diagnostics);
      outcome.diagnostics = std::move(diagnostics);
      return outcome;
    }
    auto request = std::make_unique<SwapRequest>(std::move(prepared));
    auto future = request->result();
    physics.submit(std::move(request));
    const SwapRequest::Result result = future.get();  // frees what was replaced at the end of this scope
    if (!result.applied) return stopped();
    publish_structure();
    outcome.success = true;
    outcome.sim_step = result.sim_step;
    outcome.sim_time = result.sim_time;
    outcome.physics_cpu_s = result.physics_cpu_s;
    outcome.message = summary(done_text, diagnostics);
    outcome.diagnostics = std::move(diagnostics);
    return outcome;
  }

  state::Outcome load_world(const scene::World& world) {
    state::Outcome outcome = apply(catalogue.prepare_world(world), {}, "world loaded");
    if (!world.environment_file.empty()) {
      state::LoadRequest environment;
      environment.path = world.environment_file;
      if (load_model(environment).success) return outcome;
      log.warning("the environment is refused: the walled ground takes its place");
    }
    apply(catalogue.prepare_load(make_enclosure(world.enclosure)), {}, "enclosure made");
    return outcome;
  }

  state::Outcome load_model(const state::LoadRequest& request) {
    adf::Options options;
    options.colors = &colors;
    adf::ModelResult parsed = request.text.empty() ? adf::load_model(request.path, options)
                                                   : adf::parse_model(request.text, request.path, options);
    if (!parsed.model) {
      state::Outcome outcome;
      for (const base::Diagnostic& diagnostic : parsed.diagnostics) log.report(diagnostic);
      outcome.message = summary("'" + request.path + "' was refused", parsed.diagnostics);
      outcome.diagnostics = std::move(parsed.diagnostics);
      return outcome;
    }
    if (parsed.model->name.empty()) parsed.model->name = "text";  // what Unload and List call it
    if (request.check_only) {
      state::Outcome outcome;
      outcome.success = !base::has_errors(parsed.diagnostics);
      outcome.message = summary("checked '" + request.path + "'", parsed.diagnostics);
      outcome.diagnostics = std::move(parsed.diagnostics);
      return outcome;
    }
    model::LoadOptions load_options;
    load_options.name_prefix = request.name_prefix;
    load_options.T_world_model = request.T_world_model;
    model::Prepared prepared = catalogue.prepare_load(*parsed.model, load_options);
    const std::string name = prepared.model;
    return apply(std::move(prepared), std::move(parsed.diagnostics), "loaded '" + name + "'");
  }

  state::Outcome take_snapshot(const std::string& name, const std::string& path) {
    auto request = std::make_unique<SaveRequest>();
    auto future = request->result();
    physics.submit(std::move(request));
    SaveRequest::Saved saved = future.get();
    state::Outcome outcome;
    if (model::SavedState checked; saved.error.empty())  // nobody shall keep what no restore would take
      saved.error = model::decode(saved.bytes, *catalogue.structure(), step_s, checked);
    if (!saved.error.empty()) {
      outcome.message = saved.error;
      return outcome;
    }
    outcome.sim_step = saved.sim_step;
    outcome.sim_time = saved.sim_time;
    outcome.message = path.empty() ? std::string() : write_state_file(path, saved.bytes);
    outcome.success = outcome.message.empty();
    outcome.bytes = saved.bytes.size();
    outcome.model = snapshots.keep(name, std::move(saved.bytes));
    if (outcome.success) outcome.message = "snapshot '" + outcome.model + "' taken";
    return outcome;
  }

  state::Outcome restore_snapshot(const std::string& name, const std::string& path) {
    state::Outcome outcome;
    std::vector<std::uint8_t> bytes;
    if (!path.empty()) {
      outcome.message = read_state_file(path, bytes);
      if (!outcome.message.empty()) return outcome;
    } else if (const auto* kept = snapshots.find(name)) {
      bytes = *kept;
    } else {
      outcome.message = "there is no snapshot '" + name + "'";
      return outcome;
    }
    // Only this thread changes the structure: what fits it now fits it when the physics thread gets it.
    model::SavedState saved;
    outcome.message = model::decode(bytes, *catalogue.structure(), step_s, saved);
    if (!outcome.message.empty()) return outcome;
    model::Prepared parents;
    if (const auto changes = model::parent_changes(saved, *catalogue.structure()); !changes.empty())
      parents = catalogue.prepare_parents(changes);
    const bool hung = parents.success;
    auto request = std::make_unique<RestoreRequest>(std::move(saved), std::move(parents));
    auto future = request->result();
    physics.submit(std::move(request));
    const RestoreRequest::Restored restored = future.get();  // frees what was replaced at the end of this scope
    outcome.success = restored.error.empty();
    if (outcome.success && hung) publish_structure();
    outcome.message = outcome.success ? "restored" : restored.error;
    outcome.sim_step = restored.sim_step;
    outcome.sim_time = restored.sim_time;
    outcome.model = name;
    return outcome;
  }

  // Runs `work` on the loader thread and passes its outcome on.
  template <class Work>
  void on_loader(Work work, state::Completion done) {
    loader.post([this, work = std::move(work), done = std::move(done)](bool run) {
      const state::Outcome outcome = run && !stopping ? work() : stopped();
      if (done) done(outcome);
    });
  }

  // Refuses, counts and reports what is not.
  bool is_finite(const char* what, const math::Vec3& value) {
    if (math::is_finite(value)) return true;
    physics.count_refused_command();
    log.warning("%s refused: it is not finite", what);
    return false;
  }

  template <class Action>
  void on_physics(Action action) {
    physics.submit(make_action(std::move(action)));
  }

  // The end of one pointer's slot that others see.
  class Pointer final : public state::PickPort {
   public:
    Pointer(Impl& impl, int slot) : impl_(impl), slot_(impl.picks[slot]), number_(slot) {}
    ~Pointer() override { impl_.picks.give_back(number_); }
    std::uint32_t id() const override { return static_cast<std::uint32_t>(number_); }
    void pick(const math::Vec3& from_world, const math::Vec3& to_world, PickRequest::Done done) override {
      release();
      ++slot_.presses;
      if (!impl_.is_finite("picking ray", from_world) || !impl_.is_finite("picking ray", to_world)) {
        if (done) done(false, {});
        return;
      }
      impl_.physics.submit(
          std::make_unique<PickRequest>(number_, slot_.presses, from_world, to_world, std::move(done)));
    }
    void drag(const math::Vec3& target_world) override {
      if (!impl_.is_finite("dragging target", target_world)) return;
      slot_.target.post({slot_.presses, target_world}, base::steady_ns());
    }
    void release() override { slot_.ended.store(slot_.presses, std::memory_order_release); }

   private:
    Impl& impl_;
    model::PickSlot& slot_;
    const int number_;
  };

  template <class Action>
  void on_physics_answered(Action action, state::Completion done) {
    physics.submit(std::make_unique<AnsweredRequest<Action>>(std::move(action), std::move(done)));
  }

  // Answers at once, and counts, when there is something to complain of.
  bool refuses(std::string why, const state::Completion& done) {
    if (why.empty()) return false;
    physics.count_refused_command();
    state::Outcome outcome;
    outcome.message = std::move(why);
    if (done) done(outcome);
    return true;
  }

  base::Log& log;
  const scene::ColorTable colors;
  const math::Vec3 gravity;  // of the world file: what a reset goes back to
  const double step_s;
  mesh::MeshCache meshes;
  model::CommandTable commands;
  model::Catalogue catalogue;  // loader thread
  Snapshots snapshots;
  std::mutex structure_mutex;
  std::shared_ptr<const state::Structure> structure;  // guarded
  std::atomic<bool> stopping{false};
  PhysicsThread physics;
  model::PickTable& picks;  // of the world that `physics` owns
  Loader loader;
};

Simulation::Simulation(const SimulationOptions& options, const scene::World& world, scene::ColorTable colors,
                       base::Log& log)
    : impl_(std::make_unique<Impl>(options, world, std::move(colors), log)) {
  impl_->structure = impl_->catalogue.structure();
  std::promise<void> loaded;
  impl_->on_loader([this, &world] { return impl_->load_world(world); },
                   [&loaded](const state::Outcome&) { loaded.set_value(); });
  loaded.get_future().wait();
}

Simulation::~Simulation() = default;

void Simulation::begin() { impl_->physics.begin(); }

std::unique_ptr<state::FrameReader> Simulation::make_reader() {
  return PoolFrameReader::make(impl_->physics.frames(), impl_->physics.published());
}

std::shared_ptr<const state::Structure> Simulation::structure() {
  const std::lock_guard lock(impl_->structure_mutex);
  return impl_->structure;
}

std::unique_ptr<state::CommandPort> Simulation::bind(state::ObjectId object, state::Source source) {
  return impl_->commands.bind(object, source);
}

void Simulation::post_world(const state::WorldCommand& command) { impl_->physics.post_world(command); }
void Simulation::world_command_expired() {
  impl_->on_physics([](Turn& turn) { turn.world_command_silent(); });
}
void Simulation::count_refused_command() { impl_->physics.count_refused_command(); }
void Simulation::report_graphics_rate(double hz) { impl_->physics.report_graphics_rate(hz); }

void Simulation::set_paused(bool paused) {
  impl_->on_physics([paused](Turn& turn) { turn.set_paused(paused); });
}
void Simulation::step_paused(unsigned steps) {
  impl_->on_physics([steps](Turn& turn) { turn.add_manual_steps(steps); });
}
void Simulation::reset_world() {
  impl_->on_physics([gravity = impl_->gravity](Turn& turn) {
    turn.world().set_gravity(gravity);
    turn.reset_world();
  });
  // Parents are structure, and that is the loader's.
  impl_->on_loader(
      [this] {
        model::Prepared parents = impl_->catalogue.prepare_parents_as_loaded();
        return parents.success ? impl_->apply(std::move(parents), {}, "all hang as they were loaded")
                               : state::Outcome{};
      },
      {});
}
void Simulation::reset_bodies() {
  impl_->on_physics([](Turn& turn) { turn.reset_bodies(); });
}
void Simulation::reset_bodies(std::vector<state::ObjectId> bodies) {
  impl_->on_physics([bodies = std::move(bodies)](Turn& turn) { turn.reset_bodies(bodies); });
}
void Simulation::set_speed(double factor) {
  constexpr double kSlowest = 1e-3, kFastest = 1e3;
  if (!(factor >= kSlowest && factor <= kFastest)) {
    impl_->physics.count_refused_command();
    impl_->log.warning("speed refused: it must lie between %g and %g", kSlowest, kFastest);
    return;
  }
  impl_->on_physics([factor](Turn& turn) { turn.set_speed(factor); });
}

void Simulation::set_parameter(state::ObjectId object, state::Parameter parameter, const math::Vec3& value,
                               state::Completion done) {
  if (impl_->refuses(state::check(parameter, value), done)) return;
  impl_->on_physics_answered(
      [object, parameter, value](Turn& turn, state::Outcome& outcome) {
        const std::optional<math::Vec3> now = turn.world().set_parameter(object, parameter, value);
        outcome.success = now.has_value();
        if (!now) {
          outcome.message = "the object is gone or has no such parameter";
        } else if (state::info_of(parameter).per_axis ? !(*now == value) : now->x != value.x) {
          outcome.message = "cut to what is stable";
        }
      },
      std::move(done));
}

void Simulation::push(state::ObjectId body, const state::Push& push, state::Completion done) {
  if (impl_->refuses(state::check(push), done)) return;
  impl_->on_physics_answered(
      [body, push](Turn& turn, state::Outcome& outcome) {
        outcome.success = turn.world().push(body, push);
        if (!outcome.success) outcome.message = "the body is gone or does not move";
      },
      std::move(done));
}

void Simulation::set_gravity(const math::Vec3& gravity_world) {
  if (!impl_->is_finite("gravity", gravity_world)) return;
  impl_->on_physics([gravity_world](Turn& turn) { turn.world().set_gravity(gravity_world); });
}

void Simulation::set_lens(state::ObjectId camera, const state::Lens& lens) {
  if (state::check(lens).empty()) {
    impl_->on_physics([camera, lens](Turn& turn) { turn.world().set_lens(camera, lens); });
  } else {
    impl_->physics.count_refused_command();
  }
}
void Simulation::set_beam(state::ObjectId light, const state::Beam& beam) {
  if (state::check(beam).empty()) {
    impl_->on_physics([light, beam](Turn& turn) { turn.world().set_beam(light, beam); });
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
  StepRequest::Commands bound;
  bound.reserve(commands.size());
  for (state::AddressedCommand& addressed : commands) {
    auto port = impl_->commands.bind(addressed.object, state::Source::step_service);
    // Stepping without it would be another simulation than the one asked for.
    if (port == nullptr) return refuse("a commanded object is gone or takes no commands");
    bound.emplace_back(std::move(port), std::move(addressed.command));
  }
  impl_->physics.submit(std::make_unique<StepRequest>(n, std::move(bound), result));
  return ticket;
}

void Simulation::set_parent(state::ObjectId object, const std::string& parent, state::Completion done) {
  impl_->on_loader(
      [this, object, parent] {
        return impl_->apply(impl_->catalogue.prepare_set_parent(object, parent), {},
                            parent.empty() ? "it hangs in the world" : "it hangs on '" + parent + "'");
      },
      std::move(done));
}
void Simulation::load(state::LoadRequest request, state::Completion done) {
  impl_->on_loader([this, request = std::move(request)] { return impl_->load_model(request); }, std::move(done));
}
void Simulation::unload(const std::string& model, state::Completion done) {
  impl_->on_loader(
      [this, model] {
        state::Outcome outcome = impl_->apply(impl_->catalogue.prepare_unload(model), {}, "unloaded '" + model + "'");
        impl_->meshes.trim();
        return outcome;
      },
      std::move(done));
}
void Simulation::remove(const std::string& object, state::Completion done) {
  impl_->on_loader(
      [this, object] { return impl_->apply(impl_->catalogue.prepare_remove(object), {}, "removed '" + object + "'"); },
      std::move(done));
}

void Simulation::snapshot(const std::string& name, const std::string& path, state::Completion done) {
  impl_->on_loader([this, name, path] { return impl_->take_snapshot(name, path); }, std::move(done));
}
void Simulation::restore(const std::string& name, const std::string& path, state::Completion done) {
  impl_->on_loader([this, name, path] { return impl_->restore_snapshot(name, path); }, std::move(done));
}
std::vector<std::string> Simulation::snapshots() { return impl_->snapshots.names(); }

std::unique_ptr<state::PickPort> Simulation::make_pick_port() {
  const int slot = impl_->picks.take();
  return slot < 0 ? nullptr : std::make_unique<Impl::Pointer>(*impl_, slot);
}

state::Outcome Simulation::load_and_wait(state::LoadRequest request) {
  std::promise<state::Outcome> promise;
  load(std::move(request), [&promise](const state::Outcome& outcome) { promise.set_value(outcome); });
  return promise.get_future().get();
}

}  // namespace ambf::runtime
