// A loaded model as a file (LoaderWork::save).
#include <filesystem>

#include "runtime/detail/loader_work.h"
#include "runtime/detail/saving.h"

namespace ambf::runtime {

namespace {

namespace fs = std::filesystem;

const state::ModelInfo* find_model(const state::Structure& structure, const std::string& name) {
  for (const state::ModelInfo& model : structure.models)
    if (model.name == name) return &model;
  return nullptr;
}

std::string names_of_models(const state::Structure& structure) {
  std::string names;
  for (const state::ModelInfo& model : structure.models)
    if (model.id != state::kWorldModel) names += (names.empty() ? "loaded: " : ", ") + model.name;
  return names.empty() ? "none is loaded" : names;
}

// A path that ends so is a folder, for a bundle.
bool is_folder(const std::string& path) { return path.ends_with('/'); }

}  // namespace

state::Outcome LoaderWork::save(const state::SaveModelRequest& request, const state::Frame* now) {
  state::Outcome outcome;
  outcome.message = check_state_path(request.path);
  if (outcome.message.empty() && request.current_pose &&
      (now == nullptr || now->structure->version != catalogue_.structure()->version))
    outcome.message = "no state of the simulation could be read: too many readers at once";
  if (!outcome.message.empty()) return outcome;
  return request.model.empty() ? save_scene(request, now) : save_model(request, now);
}

state::Outcome LoaderWork::save_model(const state::SaveModelRequest& request, const state::Frame* now) {
  state::Outcome outcome;
  const auto refuse = [&outcome](const std::string& why) {
    outcome.message = why;
    return outcome;
  };
  const state::Structure& structure = *catalogue_.structure();
  const state::ModelInfo* model = find_model(structure, request.model);
  if (model == nullptr || model->id == state::kWorldModel)
    return refuse("there is no model '" + shown_name(request.model) + "' to save; " + names_of_models(structure));
  const KeptText* kept = texts_.find(model->name);
  const scene::Model* left = catalogue_.description(model->id);
  const bool bundle = is_folder(request.path);
  const std::string path = bundle                 ? request.path + adf_name_of(model->file, model->name)
                           : request.path.empty() ? model->file
                                                  : request.path;
  SavedFrom from = saved_from(kept, *left, model->file);
  if (base::has_errors(from.diagnostics)) {
    outcome.diagnostics = std::move(from.diagnostics);
    return refuse("'" + model->name + "' was not read from text that is still kept, and has what is not written");
  }
  if (path.empty()) return refuse("'" + model->name + "' was read from text and has no file; give a path");
  if (is_same_file(path, model->file)) {
    if (std::string why = why_not_over_its_own(path, from.text, kept == nullptr ? nullptr : kept->written.get());
        !why.empty())
      return refuse(why);
  }

  adf::SaveOrder order{from.text, from.file, path, left, {}, bundle};
  if (request.current_pose) order.present = present_of(catalogue_, model->id, *now);
  adf::Options options;
  options.colors = &colors_;
  adf::SavedModel saved = adf::save_model(order, options);
  if (const std::string kinds = request.current_pose ? kept_as_read(*left, *now) : ""; !kinds.empty()) {
    saved.diagnostics.push_back({base::Severity::information, path, 0, 0, "", "", kinds + " written as they were read",
                                 "bodies, cameras, lights and live parameters are saved as they are now"});
  }
  for (const base::Diagnostic& diagnostic : saved.diagnostics) log_.report(diagnostic);
  outcome.diagnostics = std::move(saved.diagnostics);
  if (!saved.text) return refuse("'" + model->name + "' was not saved");
  const auto if_exists = request.overwrite ? base::IfExists::replace : base::IfExists::refuse;
  if (bundle) {
    std::error_code problem;
    fs::create_directories(request.path, problem);
    if (problem) return refuse("cannot make the folder '" + request.path + "': " + problem.message());
    // Known before anything is copied; the file comes last, so that it is never there without its meshes.
    if (!request.overwrite && fs::exists(path, problem)) return refuse("cannot write '" + path + "': it exists");
    for (const adf::Copy& copy : saved.copies)
      if (std::string why = copy_mesh(copy, if_exists); !why.empty()) return refuse(why);
  }
  outcome.message = base::write_whole_file(path, *saved.text, if_exists);
  outcome.success = outcome.message.empty();
  if (!outcome.success) return outcome;
  if (is_same_file(path, model->file))
    texts_.has_written(model->name, std::make_shared<const std::string>(*saved.text));
  outcome.model = path;
  outcome.bytes = saved.text->size();
  outcome.message = "'" + model->name + "' saved as '" + path + "'";
  return outcome;
}

}  // namespace ambf::runtime
