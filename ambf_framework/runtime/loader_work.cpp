#include "runtime/detail/loader_work.h"

#include "adf/adf.h"
#include "model/saved_state.h"
#include "runtime/detail/enclosure.h"
#include "runtime/detail/requests.h"
#include "runtime/detail/world_setup.h"

namespace ambf::runtime {

namespace {

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

LoaderWork::LoaderWork(const SimulationOptions& options, const scene::World& world, scene::ColorTable colors,
                       base::Log& log, Submit submit)
    : log_(log),
      colors_(std::move(colors)),
      step_s_(TimeKeeper(time_config(options, world)).step_s()),
      submit_(std::move(submit)),
      catalogue_(catalogue_options(options, world), commands_, meshes_),
      structure_(catalogue_.structure()) {}

std::shared_ptr<const state::Structure> LoaderWork::structure() const {
  const std::lock_guard lock(structure_mutex_);
  return structure_;
}

void LoaderWork::publish_structure() {
  const std::lock_guard lock(structure_mutex_);
  structure_ = catalogue_.structure();
}

state::Outcome LoaderWork::stopped() {
  state::Outcome outcome;
  outcome.message = "the simulation is stopping";
  return outcome;
}

state::Outcome LoaderWork::apply(model::Prepared prepared, base::Diagnostics diagnostics,
                                 const std::string& done_text) {
  state::Outcome outcome;
  diagnostics.insert(diagnostics.end(), prepared.diagnostics.begin(), prepared.diagnostics.end());
  for (const base::Diagnostic& diagnostic : diagnostics) log_.report(diagnostic);
  outcome.model = prepared.model;
  if (!prepared.success) {
    outcome.message = summary("nothing was changed", diagnostics);
    outcome.diagnostics = std::move(diagnostics);
    return outcome;
  }
  auto request = std::make_unique<SwapRequest>(std::move(prepared));
  auto future = request->result();
  submit_(std::move(request));
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

state::Outcome LoaderWork::load_world(const scene::World& world) {
  state::Outcome outcome = apply(catalogue_.prepare_world(world), {}, "world loaded");
  if (!world.environment_file.empty()) {
    state::LoadRequest environment;
    environment.path = world.environment_file;
    if (load_model(environment, true).success) return outcome;
    log_.warning("the environment is refused: the walled ground takes its place");
  }
  model::LoadOptions load_options;
  load_options.environment = true;
  apply(catalogue_.prepare_load(make_enclosure(world.enclosure), load_options), {}, "enclosure made");
  return outcome;
}

state::Outcome LoaderWork::load_model(const state::LoadRequest& request, bool environment) {
  adf::Options options;
  options.colors = &colors_;
  adf::ModelResult parsed = request.text.empty() ? adf::load_model(request.path, options)
                                                 : adf::parse_model(request.text, request.path, options);
  if (!parsed.model) {
    state::Outcome outcome;
    for (const base::Diagnostic& diagnostic : parsed.diagnostics) log_.report(diagnostic);
    outcome.message = summary("'" + request.path + "' was refused", parsed.diagnostics);
    outcome.diagnostics = std::move(parsed.diagnostics);
    return outcome;
  }
  if (parsed.model->name.empty()) parsed.model->name = "text";  // what Unload and List call it
  model::LoadOptions load_options;
  load_options.name_prefix = request.name_prefix;
  load_options.T_world_model = request.T_world_model;
  load_options.environment = environment;
  if (request.check_only) {
    const base::Diagnostics more = catalogue_.check_load(*parsed.model, load_options);
    parsed.diagnostics.insert(parsed.diagnostics.end(), more.begin(), more.end());
    state::Outcome outcome;
    outcome.success = !base::has_errors(parsed.diagnostics);
    outcome.message = summary("checked '" + request.path + "'", parsed.diagnostics);
    outcome.diagnostics = std::move(parsed.diagnostics);
    return outcome;
  }
  return load(*parsed.model, std::move(parsed.diagnostics), load_options);
}

state::Outcome LoaderWork::load(const scene::Model& model, base::Diagnostics diagnostics,
                                const model::LoadOptions& options) {
  model::Prepared prepared = catalogue_.prepare_load(model, options);
  const std::string name = prepared.model;
  return apply(std::move(prepared), std::move(diagnostics), "loaded '" + name + "'");
}

state::Outcome LoaderWork::unload(const std::string& model) {
  state::Outcome outcome = apply(catalogue_.prepare_unload(model), {}, "unloaded '" + model + "'");
  meshes_.trim();
  return outcome;
}

state::Outcome LoaderWork::remove(const std::string& object) {
  return apply(catalogue_.prepare_remove(object), {}, "removed '" + object + "'");
}

state::Outcome LoaderWork::set_parent(state::ObjectId object, const std::string& parent) {
  return apply(catalogue_.prepare_set_parent(object, parent), {},
               parent.empty() ? "it hangs in the world" : "it hangs on '" + parent + "'");
}

state::Outcome LoaderWork::reset_parents() {
  model::Prepared parents = catalogue_.prepare_parents_as_loaded();
  return parents.success ? apply(std::move(parents), {}, "all hang as they were loaded") : state::Outcome{};
}

state::Outcome LoaderWork::take_snapshot(const std::string& name, const std::string& path) {
  state::Outcome outcome;
  outcome.message = snapshots_.refusal(name);
  if (outcome.message.empty()) outcome.message = check_state_path(path);
  if (!outcome.message.empty()) return outcome;
  auto request = std::make_unique<SaveRequest>();
  auto future = request->result();
  submit_(std::move(request));
  SaveRequest::Saved saved = future.get();
  if (model::SavedState checked; saved.error.empty())  // nobody shall keep what no restore would take
    saved.error = model::decode(saved.bytes, *catalogue_.structure(), step_s_, checked);
  if (!saved.error.empty()) {
    outcome.message = saved.error;
    return outcome;
  }
  outcome.sim_step = saved.sim_step;
  outcome.sim_time = saved.sim_time;
  outcome.message = path.empty() ? std::string() : write_state_file(path, saved.bytes);
  outcome.success = outcome.message.empty();
  if (!outcome.success) return outcome;
  outcome.bytes = saved.bytes.size();
  outcome.model = snapshots_.keep(name, std::move(saved.bytes));
  outcome.message = "snapshot '" + outcome.model + "' taken";
  return outcome;
}

state::Outcome LoaderWork::restore_snapshot(const std::string& name, const std::string& path) {
  state::Outcome outcome;
  std::vector<std::uint8_t> bytes;
  if (!path.empty()) {
    outcome.message = check_state_path(path);
    if (outcome.message.empty()) outcome.message = read_state_file(path, model::check_head, bytes);
    if (!outcome.message.empty()) return outcome;
  } else if (const auto* kept = snapshots_.find(name)) {
    bytes = *kept;
  } else {
    outcome.message = "there is no snapshot '" + shown_name(name) + "'";
    return outcome;
  }
  // Only this thread changes the structure: what fits it now fits it when the physics thread gets it.
  model::SavedState saved;
  outcome.message = model::decode(bytes, *catalogue_.structure(), step_s_, saved);
  if (!outcome.message.empty()) return outcome;
  model::Prepared parents;
  if (const auto changes = model::parent_changes(saved, *catalogue_.structure()); !changes.empty())
    parents = catalogue_.prepare_parents(changes);
  const bool hung = parents.success;
  auto request = std::make_unique<RestoreRequest>(std::move(saved), std::move(parents));
  auto future = request->result();
  submit_(std::move(request));
  const RestoreRequest::Restored restored = future.get();  // frees what was replaced at the end of this scope
  outcome.success = restored.error.empty();
  if (outcome.success && hung) publish_structure();
  outcome.message = outcome.success ? "restored" : restored.error;
  outcome.sim_step = restored.sim_step;
  outcome.sim_time = restored.sim_time;
  outcome.model = name;
  return outcome;
}

state::Outcome LoaderWork::forget_snapshot(const std::string& name) {
  state::Outcome outcome;
  outcome.success = snapshots_.forget(name);
  outcome.message =
      outcome.success ? "snapshot '" + name + "' forgotten" : "there is no snapshot '" + shown_name(name) + "'";
  return outcome;
}

}  // namespace ambf::runtime
