#include "runtime/detail/loader_work.h"

#include <filesystem>

#include "adf/adf.h"
#include "model/saved_state.h"
#include "runtime/detail/enclosure.h"
#include "runtime/detail/requests.h"
#include "runtime/detail/world_setup.h"
#include "scene/device_model.h"

namespace ambf::runtime {

using Kind = inputs::SceneChangeRecord::Kind;

namespace {

inputs::SceneChangeRecord change_of(Kind kind, const std::string& name = {}) {
  inputs::SceneChangeRecord change;
  change.kind = kind;
  change.name = name;
  return change;
}

std::string absolute(const std::string& path) { return path.empty() ? path : std::filesystem::absolute(path).string(); }

std::string summary(const std::string& what, const base::Diagnostics& diagnostics) {
  std::size_t errors = 0, warnings = 0;
  for (const base::Diagnostic& d : diagnostics) {
    errors += d.severity == base::Severity::error;
    warnings += d.severity == base::Severity::warning;
  }
  if (errors + warnings == 0) return what;
  return what + " (" + std::to_string(errors) + " errors, " + std::to_string(warnings) + " warnings)";
}

// Bullet's solvers know two bodies a row, and what ties two joints acts on up to four.
void report_free_followers(const scene::Model& model, Solver solver, base::Diagnostics& diagnostics) {
  if (solver == Solver::direct) return;
  for (const scene::Joint& joint : model.joints) {
    if (joint.mimic.joint.empty()) continue;
    const scene::Identity& at = joint.identity;
    diagnostics.push_back({base::Severity::warning, model.file, at.where.line, at.where.column, at.identifier, "mimic",
                           "joint \"" + at.name + "\" does not follow \"" + joint.mimic.joint +
                               "\": this world's solver (" + solver_name(solver) +
                               ") has no row that ties two joints; it moves freely",
                           "run with --solver direct, or without `solver` in the world file"});
  }
}

}  // namespace

LoaderWork::LoaderWork(const SimulationOptions& options, const scene::World& world, scene::ColorTable colors,
                       base::Log& log, Submit submit, inputs::Recorder* recorder,
                       std::shared_ptr<mesh::MeshCache> meshes)
    : log_(log),
      options_(options),
      world_(world),
      colors_(std::move(colors)),
      step_s_(TimeKeeper(time_config(options, world)).step_s()),
      solver_(options.solver),
      submit_(std::move(submit)),
      recorder_(recorder),
      meshes_(meshes != nullptr ? std::move(meshes) : std::make_shared<mesh::MeshCache>()),
      catalogue_(catalogue_options(options, world), commands_, *meshes_),
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
  auto request = std::make_unique<SwapRequest>(changes_, std::move(prepared));
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

void LoaderWork::count_change(inputs::SceneChangeRecord&& change) {
  ++changes_;
  if (recorder_ != nullptr) recorder_->add(change);
}

state::Outcome LoaderWork::load_world(const scene::World& world) {
  count_change(change_of(Kind::world));
  state::Outcome outcome = apply(catalogue_.prepare_world(world), {}, "world loaded");
  if (!world.environment_file.empty()) {
    state::LoadRequest environment;
    environment.path = world.environment_file;
    if (parse_and_load(environment, true).success) return outcome;
    log_.warning("the environment is refused: the walled ground takes its place");
  }
  model::LoadOptions load_options;
  load_options.environment = true;
  apply(catalogue_.prepare_load(make_enclosure(world.enclosure), load_options), {}, "enclosure made");
  return outcome;
}

state::Outcome LoaderWork::load_model(const state::LoadRequest& request) {
  inputs::SceneChangeRecord change = change_of(Kind::load);
  change.path = absolute(request.path);
  change.text = request.text;
  change.prefix = request.name_prefix;
  change.T_world_model = request.T_world_model;
  change.check_only = request.check_only;
  change.free_base = request.free_base;
  change.merge_fixed = request.merge_fixed;
  if (request.of_device) {
    change.of_device = true;
    change.device = request.of_device->device;
    change.root_link = request.of_device->root_link;
    change.T_world_root = request.of_device->T_world_root;
  }
  count_change(std::move(change));
  return parse_and_load(request, false);
}

state::Outcome LoaderWork::parse_and_load(const state::LoadRequest& request, bool environment) {
  adf::Options options;
  options.colors = &colors_;
  options.urdf = {request.free_base, request.merge_fixed, {}};
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
  model::LoadOptions load_options{request.name_prefix, request.T_world_model, environment,
                                  std::move(parsed.conflict_numbers)};
  if (request.of_device) {
    const state::DeviceModel& device = *request.of_device;
    const auto T_world_root = scene::make_device_model(*parsed.model, device.device, device.root_link);
    if (T_world_root && device.T_world_root)
      load_options.T_world_model = *device.T_world_root * math::inverse(*T_world_root);
  }
  if (request.check_only) {
    const base::Diagnostics more = catalogue_.check_load(*parsed.model, load_options);
    report_free_followers(*parsed.model, solver_, parsed.diagnostics);
    parsed.diagnostics.insert(parsed.diagnostics.end(), more.begin(), more.end());
    state::Outcome outcome;
    outcome.success = !base::has_errors(parsed.diagnostics);
    outcome.message = summary("checked '" + request.path + "'", parsed.diagnostics);
    outcome.diagnostics = std::move(parsed.diagnostics);
    return outcome;
  }
  return load(*parsed.model, std::move(parsed.diagnostics), load_options, parsed.text, request.of_device.has_value(),
              request.not_saved);
}

state::Outcome LoaderWork::load(const scene::Model& model, base::Diagnostics diagnostics,
                                const model::LoadOptions& options, std::shared_ptr<const std::string> text,
                                bool of_device, bool not_saved) {
  report_free_followers(model, solver_, diagnostics);
  model::Prepared prepared = catalogue_.prepare_load(model, options);
  const std::string name = prepared.model;
  state::Outcome outcome = apply(std::move(prepared), std::move(diagnostics), "loaded '" + name + "'");
  const bool has_text = text != nullptr;
  const LoadedFrom loaded{options.name_prefix, options.T_world_model, of_device, not_saved};
  if (outcome.success && !texts_.keep(name, std::move(text), loaded) && has_text)
    log_.info("the text of '%s' is not kept: those of all models exceed %zu MB", name.c_str(), kMaxKeptTextBytes >> 20);
  return outcome;
}

state::Outcome LoaderWork::unload(const std::string& model) {
  count_change(change_of(Kind::unload, model));
  state::Outcome outcome = apply(catalogue_.prepare_unload(model), {}, "unloaded '" + model + "'");
  if (outcome.success) texts_.forget(model);
  meshes_->trim();
  return outcome;
}

state::Outcome LoaderWork::remove(const std::string& object) {
  count_change(change_of(Kind::remove, object));
  return apply(catalogue_.prepare_remove(object), {}, "removed '" + object + "'");
}

state::Outcome LoaderWork::set_parent(state::ObjectId object, const std::string& parent) {
  inputs::SceneChangeRecord change = change_of(Kind::set_parent, parent);
  change.object = object;
  count_change(std::move(change));
  return apply(catalogue_.prepare_set_parent(object, parent), {},
               parent.empty() ? "it hangs in the world" : "it hangs on '" + parent + "'");
}

state::Outcome LoaderWork::reset_parents() {
  count_change(change_of(Kind::reset_parents));
  model::Prepared parents = catalogue_.prepare_parents_as_loaded();
  return parents.success ? apply(std::move(parents), {}, "all hang as they were loaded") : state::Outcome{};
}

state::Outcome LoaderWork::take_snapshot(const std::string& name, const std::string& path) {
  state::Outcome outcome;
  outcome.message = check_state_path(path);
  if (!outcome.message.empty()) return outcome;  // no change: a replay has no path
  count_change(change_of(Kind::snapshot, name));
  outcome.message = snapshots_.refusal(name);
  if (!outcome.message.empty()) return outcome;
  SaveRequest::Saved saved = save_state();
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

SaveRequest::Saved LoaderWork::save_state() {
  auto request = std::make_unique<SaveRequest>(changes_);
  auto future = request->result();
  submit_(std::move(request));
  return future.get();
}

state::Outcome LoaderWork::save_start(const std::vector<std::uint8_t>& expected) {
  ++changes_;
  SaveRequest::Saved saved = save_state();
  state::Outcome outcome;
  outcome.message = saved.error;
  if (outcome.message.empty() && recorder_ == nullptr && saved.bytes != expected) {
    outcome.message = "the scene is another one than that of the recording: its files have changed since";
  }
  outcome.success = outcome.message.empty();
  if (recorder_ == nullptr) return outcome;
  inputs::SceneChangeRecord change = change_of(Kind::start_state);
  change.bytes = std::move(saved.bytes);
  recorder_->add(change);
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
  return restore(name, bytes);
}

state::Outcome LoaderWork::restore(const std::string& name, const std::vector<std::uint8_t>& bytes) {
  inputs::SceneChangeRecord change = change_of(Kind::restore, name);
  change.bytes = bytes;
  count_change(std::move(change));
  state::Outcome outcome;
  // Only this thread changes the structure: what fits it now fits it when the physics thread gets it.
  model::SavedState saved;
  outcome.message = model::decode(bytes, *catalogue_.structure(), step_s_, saved);
  if (!outcome.message.empty()) return outcome;
  model::Prepared parents;
  if (const auto changes = model::parent_changes(saved, *catalogue_.structure()); !changes.empty())
    parents = catalogue_.prepare_parents(changes);
  const bool hung = parents.success;
  auto request = std::make_unique<RestoreRequest>(changes_, std::move(saved), std::move(parents));
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
  count_change(change_of(Kind::forget, name));
  state::Outcome outcome;
  outcome.success = snapshots_.forget(name);
  outcome.message =
      outcome.success ? "snapshot '" + name + "' forgotten" : "there is no snapshot '" + shown_name(name) + "'";
  return outcome;
}

// Files that were written or read stand for nothing here: what was restored is in the recording.
state::Outcome LoaderWork::repeat(const inputs::SceneChangeRecord& change, const scene::World& world) {
  switch (change.kind) {
    case Kind::world: return load_world(world);
    case Kind::load: {
      state::LoadRequest request{change.path, change.text, change.prefix, change.T_world_model, change.check_only};
      if (change.of_device)
        request.of_device = state::DeviceModel{change.device, change.root_link, change.T_world_root};
      request.free_base = change.free_base;
      request.merge_fixed = change.merge_fixed;
      return load_model(request);
    }
    case Kind::unload: return unload(change.name);
    case Kind::remove: return remove(change.name);
    case Kind::set_parent: return set_parent(change.object, change.name);
    case Kind::reset_parents: return reset_parents();
    case Kind::snapshot: return take_snapshot(change.name, {});
    case Kind::restore: return restore(change.name, change.bytes);
    case Kind::forget: return forget_snapshot(change.name);
    case Kind::start_state: return save_start(change.bytes);
    case Kind::count: break;
  }
  return stopped();
}

}  // namespace ambf::runtime
