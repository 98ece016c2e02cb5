// The whole scene as a folder that starts it again (LoaderWork::save). Everything is written beside its place first, so
// that a full disk leaves what was there.
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "runtime/detail/loader_work.h"
#include "runtime/detail/saving.h"
#include "runtime/detail/world_setup.h"
#include "scene/keys.h"
#include "scene/lookup.h"

namespace ambf::runtime {

namespace {

namespace fs = std::filesystem;

fs::path whole(const std::string& path) { return fs::absolute(path).lexically_normal(); }

// As it leads from the folder; absolute where nothing leads there.
std::string seen_from(const fs::path& folder, const std::string& file) {
  const fs::path way = whole(file).lexically_relative(folder);
  return way.empty() ? whole(file).string() : "./" + way.string();
}

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// Files for a folder, written into a hidden one in it and moved when all are there.
class Stage {
 public:
  explicit Stage(fs::path folder) : folder_(std::move(folder)), stage_(folder_ / ".saving") {
    std::error_code problem;
    stage_ += "-" + std::to_string(::getpid());
    is_new_ = !fs::exists(folder_, problem);
    fs::create_directories(stage_, problem);
    if (problem) problem_ = "cannot make the folder '" + stage_.string() + "': " + problem.message();
  }
  ~Stage() {
    std::error_code ignored;
    fs::remove_all(stage_, ignored);
    if (is_new_) fs::remove(folder_, ignored);  // where nothing came of it, and it is empty
  }
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  const std::string& problem() const { return problem_; }

  // Where a file of the folder lies until all are there.
  std::string place_of(const std::string& path) const {
    return (stage_ / whole(path).lexically_relative(folder_)).string();
  }
  // Empty, or why not.
  std::string write(const std::string& path, const std::string& text) const {
    const std::string place = place_of(path);
    std::error_code problem;
    fs::create_directories(fs::path(place).parent_path(), problem);
    return problem ? "cannot make the folder of '" + path + "': " + problem.message()
                   : base::write_whole_file(place, text, base::IfExists::replace);
  }

  // Moves all files to their places; `last` comes last. Empty, or why nothing was moved.
  std::string finish(const std::string& last, bool overwrite) const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(stage_))
      if (entry.is_regular_file()) files.push_back(entry.path().lexically_relative(stage_));
    std::sort(files.begin(), files.end());
    std::stable_partition(files.begin(), files.end(), [&](const fs::path& file) { return file != last; });
    std::error_code problem;
    for (const fs::path& file : files) {
      const fs::path target = folder_ / file;
      if (!fs::exists(fs::symlink_status(target))) continue;
      const std::string name = "cannot write '" + target.string() + "': ";
      if (!fs::is_regular_file(target, problem)) return name + "it is there, and not an ordinary file";
      if (bytes_of(target) == bytes_of(stage_ / file)) continue;
      if (!overwrite) return name + "it exists; choose another folder, or overwrite";
      if (::access(target.c_str(), W_OK) != 0) return name + "no permission";
    }
    for (const fs::path& file : files) {
      fs::create_directories((folder_ / file).parent_path(), problem);
      if (!problem) fs::rename(stage_ / file, folder_ / file, problem);
      if (problem) return "cannot write '" + (folder_ / file).string() + "': " + problem.message();
    }
    return {};
  }

 private:
  fs::path folder_, stage_;
  bool is_new_ = false;
  std::string problem_;
};

// Names of files in models/, so that models are called as they are when they are loaded in this order.
class FileNames {
 public:
  explicit FileNames(const state::Structure& structure) {
    for (const state::ModelInfo& model : structure.models)
      if (model.id == state::kWorldModel) models_.push_back(model.name);
  }
  void take(const std::string& model) { models_.push_back(model); }

  std::string file_of(const state::ModelInfo& model) {
    const std::string name = adf_name_of(model.file, model.name);
    const std::string called = name + scene::conflict_number(models_, name);
    // One that has another number, because of models that are gone, is named so by its file.
    const bool in_order = called == model.name || model.name.rfind(name, 0) != 0;
    const std::string file = in_order ? name : model.name;
    models_.push_back(in_order ? called : model.name);
    for (int folder = 1;; ++folder) {
      const std::string path = folder == 1 ? file : std::to_string(folder) + "/" + file;
      if (files_.insert(path).second) return path;
    }
  }

 private:
  std::vector<std::string> models_;
  std::set<std::string> files_;
};

// What starts a simulation as this one was started.
std::string command_of(const SimulationOptions& options, const scene::World& world, const std::string& launch,
                       std::size_t models) {
  std::string command = "ambf_simulator --launch_file " + launch;
  for (std::size_t i = 0; i < models; ++i) command += (i == 0 ? " -l " : ",") + std::to_string(i);
  if (!options.name_prefix.empty()) command += " --ns " + options.name_prefix;
  const std::string solver = solver_name(options.solver);
  if (solver != (world.solver.empty() ? "direct" : world.solver)) command += " --solver " + solver;
  const SimulationOptions usual;
  if (options.physics_rate_hz != usual.physics_rate_hz) command += " -p " + scene::text_of(options.physics_rate_hz);
  if (options.fixed_step) command += " -t true";
  if (options.speed_factor != usual.speed_factor) command += " -s " + scene::text_of(options.speed_factor);
  return command;
}

// The input devices file and the models that its devices bring, for a bundle. Empty, or why not.
std::string bundle_devices(const std::string& from, const std::string& to, const Stage& stage,
                           base::Diagnostics& diagnostics) {
  const auto report = [&](base::Diagnostics found) {
    for (base::Diagnostic& diagnostic : found) diagnostics.push_back(std::move(diagnostic));
  };
  const std::string refused = "the input devices file '" + from + "' cannot be saved";
  adf::SavedDevices saved = adf::save_input_devices(bytes_of(from), from, to);
  report(std::move(saved.diagnostics));
  if (!saved.text) return refused;
  for (const adf::Copy& model : saved.models) {
    std::error_code problem;
    if (!fs::is_regular_file(model.from, problem)) {
      diagnostics.push_back({base::Severity::warning, from, 0, 0, "", "simulated multibody",
                             "the model '" + model.from + "' is nowhere: the bundle is without it",
                             "put it where the file says, and save again"});
      continue;
    }
    adf::SavedModel file = adf::save_model({bytes_of(model.from), model.from, model.to, nullptr, {}, true});
    report(std::move(file.diagnostics));
    if (!file.text) return refused;
    for (adf::Copy copy : file.copies) {
      copy.to = stage.place_of(copy.to);
      if (std::string why = copy_mesh(copy, base::IfExists::replace); !why.empty()) return why;
    }
    if (std::string why = stage.write(model.to, *file.text); !why.empty()) return why;
  }
  return stage.write(to, *saved.text);
}

}  // namespace

state::Outcome LoaderWork::save_scene(const state::SaveModelRequest& request, const state::Frame* now) {
  state::Outcome outcome;
  const auto refuse = [&outcome](const std::string& why) {
    outcome.message = why;
    return outcome;
  };
  if (request.path.empty()) return refuse("a scene is saved in a folder; give its path");
  const bool bundle = request.path.ends_with('/');
  const fs::path folder = whole(bundle ? request.path.substr(0, request.path.size() - 1) : request.path);
  const state::Structure& structure = *catalogue_.structure();
  const auto say = [&](base::Severity severity, const std::string& message, const std::string& hint) {
    outcome.diagnostics.push_back({severity, folder.string(), 0, 0, "", "", message, hint});
  };
  const auto report = [&](base::Diagnostics found) {
    for (base::Diagnostic& diagnostic : found) outcome.diagnostics.push_back(std::move(diagnostic));
  };

  // What stays away: devices and parts of the program bring their own models, and a walled ground has no file.
  std::set<state::ModelId> of_devices, of_parts;
  for (const state::ModelInfo& model : structure.models) {
    const KeptText* kept = texts_.find(model.name);
    if (kept != nullptr && kept->loaded.of_device) of_devices.insert(model.id);
    if (kept != nullptr && kept->loaded.not_saved) of_parts.insert(model.id);
  }
  if (!of_devices.empty())
    say(base::Severity::information, "models of input devices are not in it",
        "they come with their devices: start with -i");
  if (!of_parts.empty())
    say(base::Severity::information, "what options as --crtk load is not in it", "start with the same options");
  std::set<state::ModelId> left_out = of_devices;
  left_out.insert(of_parts.begin(), of_parts.end());

  Stage stage(folder);
  if (!stage.problem().empty()) return refuse(stage.problem());
  const auto numbers = catalogue_.numbers_to_keep(left_out);
  adf::Options options;
  options.colors = &colors_;
  FileNames names(structure);
  std::vector<std::string> files;
  std::vector<adf::Placement> placements;
  std::vector<std::pair<std::string, std::shared_ptr<const std::string>>> over_own;  // by model
  std::string environment, kept_kinds;
  scene::Model all_blocks;  // of other kinds, of all models
  for (const state::ModelInfo& model : structure.models) {
    const KeptText* kept = texts_.find(model.name);
    if (model.id == state::kWorldModel || left_out.contains(model.id)) continue;
    const bool has_text = kept != nullptr && kept->text != nullptr;
    if (!has_text && model.environment) {  // a walled ground: `enclosure` of the world file
      names.take(model.name);
      continue;
    }
    const LoadedFrom loaded = kept == nullptr ? LoadedFrom{} : kept->loaded;
    const scene::Model& left = *catalogue_.description(model.id);
    SavedFrom from = saved_from(kept, left, model.file);
    const bool written = !base::has_errors(from.diagnostics);
    report(std::move(from.diagnostics));
    if (!written) return refuse("'" + model.name + "' was not read from text, and has what is not written");
    const std::string file = "./models/" + names.file_of(model);
    const std::string path = (folder / file).lexically_normal().string();
    if (is_same_file(path, model.file)) {
      if (std::string why = why_not_over_its_own(path, from.text, kept == nullptr ? nullptr : kept->written.get());
          !why.empty())
        return refuse(why);
    }
    adf::SaveOrder order{from.text, from.file, path, &left, {}, bundle};
    if (request.current_pose) {
      order.present = present_of(catalogue_, model.id, *now, loaded.T_world_model);
      all_blocks.blocks.insert(all_blocks.blocks.end(), left.blocks.begin(), left.blocks.end());
    }
    if (const auto found = numbers.find(model.id); found != numbers.end()) order.conflict_numbers = found->second;
    adf::SavedModel saved = adf::save_model(order, options);
    report(std::move(saved.diagnostics));
    if (!saved.text) return refuse("'" + model.name + "' cannot be saved");
    for (adf::Copy copy : saved.copies) {
      copy.to = stage.place_of(copy.to);
      if (std::string why = copy_mesh(copy, base::IfExists::replace); !why.empty()) return refuse(why);
    }
    if (std::string why = stage.write(path, *saved.text); !why.empty()) return refuse(why);
    outcome.bytes += saved.text->size();
    if (is_same_file(path, model.file))
      over_own.emplace_back(model.name, std::make_shared<const std::string>(*saved.text));
    if (model.environment) {
      environment = file;
    } else {
      files.push_back(file);
      placements.push_back({loaded.name_prefix, loaded.T_world_model});
    }
  }
  if (environment.empty() && !world_.environment_file.empty()) {
    environment = seen_from(folder, world_.environment_file);
    say(base::Severity::information, "the environment was unloaded; it is there again when the scene starts",
        "take `environment` out of world.yaml");
  }

  const std::string world_path = (folder / "world.yaml").string();
  const std::string before = options_.files.world_text == nullptr ? std::string() : *options_.files.world_text;
  if (is_same_file(world_path, world_.file)) {
    if (std::string why = why_not_over_its_own(world_path, before, world_written_.get()); !why.empty())
      return refuse(why);
  }
  adf::SaveWorldOrder world;
  world.text = before;
  world.from = before.empty() ? world_path : world_.file;
  world.to = world_path;
  world.world = &world_;
  world.environment = environment;
  if (request.current_pose) {
    world.views = catalogue_.description(state::kWorldModel);
    world.present = present_of(catalogue_, state::kWorldModel, *now);
    if (!(now->gravity_world == structure.gravity_world)) world.gravity = now->gravity_world;
    kept_kinds = kept_as_read(all_blocks, *now);
  }
  adf::SavedModel world_saved = adf::save_world(world, options);
  report(std::move(world_saved.diagnostics));
  if (!world_saved.text) return refuse("the world cannot be saved");
  if (std::string why = stage.write(world_path, *world_saved.text); !why.empty()) return refuse(why);

  std::string colors = options_.files.colors;
  if (bundle && !colors.empty()) {
    if (std::string why = stage.write((folder / "colors.yaml").string(), bytes_of(colors)); !why.empty())
      return refuse(why);
    colors = "./colors.yaml";
  } else if (!colors.empty()) {
    colors = seen_from(folder, colors);
  }
  std::string devices = options_.files.input_devices;
  if (bundle && !devices.empty()) {
    base::Diagnostics found;
    const std::string why = bundle_devices(devices, (folder / "input_devices.yaml").string(), stage, found);
    report(std::move(found));
    if (!why.empty()) return refuse(why);
    devices = "./input_devices.yaml";
  } else if (!devices.empty()) {
    devices = seen_from(folder, devices);
  }
  const std::string launch_path = (folder / "launch.yaml").string();
  const std::string launch = adf::write_launch("./world.yaml", colors, devices, files, placements);
  if (std::string why = stage.write(launch_path, launch); !why.empty()) return refuse(why);
  if (!kept_kinds.empty())
    say(base::Severity::information, kept_kinds + " written as they were read",
        "bodies, cameras, lights and live parameters are saved as they are now; snapshots keep all");
  for (const base::Diagnostic& diagnostic : outcome.diagnostics) log_.report(diagnostic);
  if (std::string why = stage.finish("launch.yaml", request.overwrite); !why.empty()) return refuse(why);

  for (auto& [model, text] : over_own) texts_.has_written(model, std::move(text));
  if (is_same_file(world_path, world_.file))
    world_written_ = std::make_shared<const std::string>(std::move(*world_saved.text));
  outcome.success = true;
  outcome.model = launch_path;
  outcome.message = "the scene is saved; it starts with: " + command_of(options_, world_, launch_path, files.size());
  return outcome;
}

}  // namespace ambf::runtime
