#include "adf/check.h"

#include <algorithm>
#include <vector>

#include "adf/crtk/motion.h"
#include "adf/crtk_arms.h"
#include "adf/detail/files.h"
#include "adf/report.h"
#include "scene/chain.h"
#include "scene/lookup.h"

namespace ambf::adf {

namespace {

void append(base::Diagnostics& all, base::Diagnostics more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

Mark mark_of(const scene::Identity& identity) { return {identity.where.line, identity.where.column}; }

std::string listed(const std::vector<std::string>& names, const std::vector<std::size_t>& which) {
  constexpr std::size_t kShown = 5;
  std::string text;
  for (std::size_t i = 0; i < which.size() && i < kShown; ++i) text += (i ? ", " : "") + in_quotes(names[which[i]]);
  return text + (which.size() > kShown ? ", ..." : "");
}

// Whether it exists, perhaps under several names; loading reports which.
bool is_here(const std::string& wanted, const std::vector<std::string>& names, const scene::Identity& identity) {
  const scene::Lookup found = scene::find_joint_body(names, {}, wanted, identity.name_space, "");
  return found.index || !found.candidates.empty();
}

// False when it must come from another file.
bool check_joint_body(const scene::Joint& joint, const char* key, const std::string& wanted,
                      const std::vector<std::string>& bodies, Report& report) {
  const scene::Lookup found = scene::find_joint_body(bodies, {}, wanted, joint.identity.name_space, "");
  if (found.index) return true;
  const Mark at = mark_of(joint.identity);
  if (!found.candidates.empty()) {
    report.error(at, key, in_quotes(wanted) + " may mean several bodies: " + listed(bodies, found.candidates),
                 "write the whole name");
    return false;
  }
  const std::string near = report.nearest(wanted, bodies);
  report.warning(at, key, "no body of this file is called " + in_quotes(wanted),
                 near.empty() ? "it must come from another file"
                              : "did you mean " + in_quotes(near) + "? Else it must come from another file");
  return false;
}

base::Diagnostics check_loading(scene::Model model, const DryLoad& dry_load) {
  base::Diagnostics found = take_out_orphans(model);
  if (dry_load) append(found, dry_load(model));
  return found;
}

base::Diagnostics check_model(const std::string& text, const std::string& path, const DryLoad& dry_load) {
  ModelResult result = parse_model(text, path);
  result.document.reset();  // of a large file, a third of the memory that loading takes
  if (result.model) append(result.diagnostics, check_loading(std::move(*result.model), dry_load));
  return std::move(result.diagnostics);
}

base::Diagnostics check_world(const std::string& text, const std::string& path, const DryLoad& dry_load) {
  WorldResult result = parse_world(text, path);
  if (result.world) {
    scene::Model views;
    views.file = path;
    views.cameras = result.world->cameras;
    views.lights = result.world->lights;
    append(result.diagnostics, check_loading(std::move(views), dry_load));
  }
  if (result.world && !result.world->environment_file.empty()) {
    const std::string& environment = result.world->environment_file;
    const FileText file = read_text(environment);
    if (file.text) append(result.diagnostics, check_model(*file.text, environment, dry_load));
  }
  return std::move(result.diagnostics);
}

base::Diagnostics check_launch(const std::string& text, const std::string& path, const DryLoad& dry_load) {
  LaunchResult result = parse_launch(text, path);
  if (!result.launch) return std::move(result.diagnostics);
  const scene::Launch& launch = *result.launch;
  std::vector<std::string> worlds = launch.world_files;
  if (!launch.world_file.empty()) worlds.push_back(launch.world_file);
  std::sort(worlds.begin(), worlds.end());
  worlds.erase(std::unique(worlds.begin(), worlds.end()), worlds.end());
  for (const std::string& world : worlds) {
    const FileText file = read_text(world);
    append(result.diagnostics, file.text ? check_world(*file.text, world, dry_load) : load_world(world).diagnostics);
  }
  if (!launch.color_file.empty()) append(result.diagnostics, load_colors(launch.color_file).diagnostics);
  if (!launch.input_devices_file.empty()) {
    append(result.diagnostics, load_input_devices(launch.input_devices_file).diagnostics);
  }
  Report report(path);
  const Document document(text);
  const Value models = document.root().find("multibody configs").value_or(Value());
  for (std::size_t i = 0; i < launch.model_files.size(); ++i) {
    if (launch.model_files[i].empty() || !find_file({launch.model_files[i]}).empty()) continue;
    const std::string place = std::to_string(i);
    report.warning(models.item(i).mark(), "multibody configs[" + place + "]",
                   "no such file: " + shown_path(launch.model_files[i]), "-l " + place + " would fail");
  }
  append(result.diagnostics, report.take());
  return std::move(result.diagnostics);
}

base::Diagnostics check_crtk_arms(const std::string& text, const std::string& path,
                                  const std::vector<scene::Model>& models) {
  CrtkArmsResult result = parse_crtk_arms(text, path);
  for (const scene::Model& model : models) {
    std::vector<std::string> bodies;
    for (const scene::Body& body : model.bodies) bodies.push_back(body.identity.name_space + body.identity.identifier);
    for (const CrtkArm& arm : result.arms) {
      const auto base = scene::find_identifier(bodies, arm.base).index;
      if (!base) continue;
      const auto problem = check_motion(arm, scene::mechanism_joints(model), *base);
      if (problem) result.diagnostics.push_back(*problem);
    }
  }
  return std::move(result.diagnostics);
}

}  // namespace

namespace {

// Looking for the bodies of this many joints would take longer than a check may.
bool too_many_pairs(const scene::Model& model) {
  constexpr std::size_t kMost = 20'000'000;  // some seconds
  const std::size_t lookers = model.joints.size() + model.cameras.size() + model.lights.size();
  return lookers * (model.bodies.size() + model.cameras.size() + model.lights.size()) > kMost;
}

}  // namespace

base::Diagnostics take_out_orphans(scene::Model& model) {
  Report report(model.file);
  if (too_many_pairs(model)) {
    report.information({}, "joints", "too many joints and bodies to look for the joints' bodies here", "loading does");
    model.joints.clear();
    model.cameras.clear();
    model.lights.clear();
    return report.take();
  }
  std::vector<std::string> bodies;
  const auto name = [](const auto& block) { return block.identity.name_space + block.identity.identifier; };
  for (const scene::Body& body : model.bodies) bodies.push_back(name(body));
  std::erase_if(model.joints, [&](const scene::Joint& joint) {
    report.set_block(joint.identity.identifier);
    const bool parent = check_joint_body(joint, "parent", joint.parent, bodies, report);
    const bool child = check_joint_body(joint, "child", joint.child, bodies, report);
    return !parent || !child;
  });
  // Whatever hangs on another object hangs on any kind of it.
  std::vector<std::string>& objects = bodies;
  for (const scene::Camera& camera : model.cameras) objects.push_back(name(camera));
  for (const scene::Light& light : model.lights) objects.push_back(name(light));
  for (const scene::KindBlock& block : model.blocks) objects.push_back(name(block));
  const auto check_view = [&](const scene::Identity& identity, std::string& parent) {
    if (parent.empty() || is_here(parent, objects, identity)) return;
    report.set_block(identity.identifier);
    const std::string near = report.nearest(parent, objects);
    report.information(mark_of(identity), "parent", "no object of this file is called " + in_quotes(parent),
                       near.empty() ? "it must come from another file"
                                    : "did you mean " + in_quotes(near) + "? Else it must come from another file");
    parent.clear();
  };
  for (scene::Camera& camera : model.cameras) check_view(camera.identity, camera.parent);
  for (scene::Light& light : model.lights) check_view(light.identity, light.parent);
  return report.take();
}

base::Diagnostics check_file(const std::string& path, const DryLoad& dry_load,
                             const std::vector<scene::Model>& models) {
  const FileText file = read_text(path);
  if (!file.text) return load_model(path).diagnostics;
  switch (kind_of(*file.text)) {
    case FileKind::launch: return check_launch(*file.text, path, dry_load);
    case FileKind::world: return check_world(*file.text, path, dry_load);
    case FileKind::colors: return parse_colors(*file.text, path).diagnostics;
    case FileKind::input_devices: return parse_input_devices(*file.text, path).diagnostics;
    case FileKind::crtk_arms: return check_crtk_arms(*file.text, path, models);
    case FileKind::model: break;
  }
  return check_model(*file.text, path, dry_load);
}

}  // namespace ambf::adf
