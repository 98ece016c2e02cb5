// A loaded model as a file (LoaderWork::save_model). Loader thread.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "adf/save.h"
#include "adf/urdf_import.h"
#include "base/whole_file.h"
#include "mesh/loader.h"
#include "runtime/detail/loader_work.h"
#include "scene/block_kinds.h"
#include "state/kinds.h"

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

// Empty for what cannot be the text that was kept.
std::string content_of(const std::string& path) {
  std::error_code problem;
  if (!fs::is_regular_file(path, problem) || fs::file_size(path, problem) > kMaxKeptTextBytes || problem) return {};
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// Empty, or why the file that a model was read from must not be replaced by what is made of the text that was read.
std::string why_not_over_its_own(const std::string& path, const std::string& text) {
  const std::string there = content_of(path);
  if (there == text) return {};
  if (adf::is_urdf(there)) return "'" + path + "' is URDF and is not replaced by ADF; give another path";
  return "'" + path + "' has changed since it was loaded; save it under another name";
}

bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code problem;
  return !b.empty() && fs::equivalent(a, b, problem) && !problem;
}

// What has a place of its own, but is written as it was read.
std::string kept_kinds(const scene::Model& model) {
  std::string kinds;
  const auto add = [&kinds](std::size_t count, const std::string& name) {
    if (count > 0) kinds += (kinds.empty() ? "" : ", ") + std::to_string(count) + " " + name;
  };
  add(model.cameras.size(), "camera(s)");
  add(model.lights.size(), "light(s)");
  std::map<std::string, std::size_t> others;
  for (const scene::KindBlock& block : model.blocks) ++others[std::string(block.kind->group->title)];
  for (const auto& [name, count] : others) add(count, name + "(s)");
  return kinds;
}

// A path that ends so is a folder, for a bundle.
bool is_folder(const std::string& path) { return path.ends_with('/'); }

// Of a model's name, the name of its file in a bundle.
std::string file_in_bundle(const state::ModelInfo& model) {
  std::string name = fs::path(model.file.empty() ? model.name : model.file).stem().string();
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '/' || static_cast<unsigned char>(c) < 0x20; }, '_');
  return (name.empty() || name == "." || name == ".." ? "model" : name) + ".yaml";
}

std::string copy_file(const std::string& from, const std::string& to, base::IfExists if_exists) {
  std::error_code problem;
  if (fs::equivalent(from, to, problem)) return {};
  const std::uintmax_t size = fs::file_size(from, problem);
  if (problem || size > mesh::LoadOptions{}.max_file_bytes)
    return "cannot copy '" + from + "': " + (problem ? problem.message() : "larger than what is read as a mesh");
  std::ifstream stream(from, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(stream), {});
  if (!stream || bytes.size() != size) return "cannot copy '" + from + "': reading it failed";
  if (fs::is_regular_file(to, problem) && fs::file_size(to, problem) == size) {
    std::ifstream there(to, std::ios::binary);
    if (std::string(std::istreambuf_iterator<char>(there), {}) == bytes) return {};  // of a bundle with this one
  }
  fs::create_directories(fs::path(to).parent_path(), problem);
  if (problem) return "cannot make the folder of '" + to + "': " + problem.message();
  return base::write_whole_file(to, bytes, if_exists);
}

// Copies a mesh with what it refers to (material libraries, textures, buffers), which goes to the same place from it,
// or beside it where that would leave the bundle. Empty, or why not.
std::string copy_mesh(const adf::Copy& copy, base::IfExists if_exists) {
  if (std::string why = copy_file(copy.from, copy.to, if_exists); !why.empty()) return why;
  const fs::path home = fs::path(copy.from).parent_path(), there = fs::path(copy.to).parent_path();
  for (const std::string& file : mesh::load(copy.from).depends_on) {
    std::error_code problem;
    if (!fs::is_regular_file(file, problem)) continue;
    const fs::path relative = fs::path(file).lexically_normal().lexically_relative(home.lexically_normal());
    const bool within = !relative.empty() && *relative.begin() != "..";
    const fs::path to = there / (within ? relative : fs::path(file).filename());
    if (std::string why = copy_file(file, to.string(), if_exists); !why.empty()) return why;
  }
  return {};
}

}  // namespace

state::Outcome LoaderWork::save_model(const state::SaveModelRequest& request, const state::Frame* now) const {
  state::Outcome outcome;
  const auto refuse = [&outcome](const std::string& why) {
    outcome.message = why;
    return outcome;
  };
  const state::Structure& structure = *catalogue_.structure();
  const state::ModelInfo* model = find_model(structure, request.model);
  if (model == nullptr || model->id == state::kWorldModel)
    return refuse("there is no model '" + shown_name(request.model) + "' to save; " + names_of_models(structure));
  if (std::string why = check_state_path(request.path); !why.empty()) return refuse(why);
  const KeptTexts::Text text = texts_.find(model->name);
  if (text == nullptr) return refuse("'" + model->name + "' was not read from text that is still kept");
  const scene::Model* present = catalogue_.description(model->id);
  const bool bundle = is_folder(request.path);
  const std::string path = bundle                 ? request.path + file_in_bundle(*model)
                           : request.path.empty() ? model->file
                                                  : request.path;
  if (path.empty()) return refuse("'" + model->name + "' was read from text and has no file; give a path");
  if (is_same_file(path, model->file)) {
    if (std::string why = why_not_over_its_own(path, *text); !why.empty()) return refuse(why);
  }

  adf::SaveOrder order{*text, model->file, path, present, {}, bundle};
  if (request.current_pose) {
    if (now == nullptr || now->structure->version != structure.version)
      return refuse("no state of the simulation could be read: too many readers at once");
    for (const model::Catalogue::Made& made : catalogue_.made_from(model->id)) {
      const state::ObjectInfo& object = structure.objects[made.object];
      if (state::info_of(object.kind).has_mass)
        order.places.push_back({made.block, now->bodies[object.slot].T_world_body});
    }
  }
  adf::Options options;
  options.colors = &colors_;
  adf::SavedModel saved = adf::save_model(order, options);
  if (const std::string kinds = kept_kinds(*present); request.current_pose && !kinds.empty()) {
    saved.diagnostics.push_back({base::Severity::information, path, 0, 0, "", "", kinds + " written as they were read",
                                 "only bodies are saved where they are now"});
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
  outcome.model = path;
  outcome.bytes = saved.text->size();
  outcome.message = "'" + model->name + "' saved as '" + path + "'";
  return outcome;
}

}  // namespace ambf::runtime
