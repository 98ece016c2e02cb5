#include "runtime/detail/world_setup.h"

#include "physics/world.h"

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
  out.pooled_pairs = options.pooled_pairs;
  out.preparation_thread = !options.fixed_step;
  return out;
}

// Under a real-time priority a machine that cannot keep up would never run anything else on that core.
constexpr std::int64_t kRestWhenBehindNs = 50'000;

// No clock wakes a thread more often than this: fixed steps that are asked for at a higher rate run as fast as they go.
constexpr double kFastestPacedHz = 20'000.0;

}  // namespace

TimeConfig time_config(const SimulationOptions& options, const scene::World& world) {
  TimeConfig out;
  const bool paced = options.physics_rate_hz <= kFastestPacedHz;
  out.mode = !options.fixed_step ? TimeMode::real_time : paced ? TimeMode::fixed_step : TimeMode::free_running;
  out.frequency_hz = options.physics_rate_hz;
  if (options.fixed_step) out.speed = options.speed_factor;
  if (world.max_iterations_given) out.max_steps_per_iteration = static_cast<int>(world.max_iterations);
  if (!options.fixed_step) out.rest_when_behind_ns = kRestWhenBehindNs;
  return out;
}

const char* solver_name(Solver solver) {
  switch (solver) {
    case Solver::direct: return "direct";
    case Solver::sequential_impulse: return "si";
    case Solver::mlcp: return "mlcp";
  }
  return "";
}

model::CatalogueOptions catalogue_options(const SimulationOptions& options, const scene::World& world) {
  model::CatalogueOptions out;
  out.world_namespace = world.name_space;
  out.namespace_prefix = options.name_prefix;
  out.step_s = TimeKeeper(time_config(options, world)).step_s();
  out.frames = base::frames_for(options.readers);
  return out;
}

std::unique_ptr<model::LiveWorld> make_live_world(const SimulationOptions& options, const scene::World& world,
                                                  model::CommandTable& commands) {
  const double step_s = TimeKeeper(time_config(options, world)).step_s();
  return std::make_unique<model::LiveWorld>(std::make_unique<physics::World>(physics_options(options, world, step_s)),
                                            commands);
}

}  // namespace ambf::runtime
