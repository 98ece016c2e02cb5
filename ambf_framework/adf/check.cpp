#include "adf/check.h"

#include <algorithm>
#include <set>
#include <vector>

#include "adf/files.h"
#include "adf/report.h"
#include "scene/keys.h"
#include "scene/lookup.h"

namespace ambf::adf {

namespace {

void append(base::Diagnostics& all, base::Diagnostics more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

bool is_color(const Value& value) { return value.is_map() && value.find("r") && value.find("g") && value.find("b"); }

Mark mark_of(const scene::Identity& identity) { return {identity.where.line, identity.where.column}; }

std::string listed(const std::vector<std::string>& names, const std::vector<std::size_t>& which) {
  constexpr std::size_t kShown = 5;
  std::string text;
  for (std::size_t i = 0; i < which.size() && i < kShown; ++i) text += (i ? ", " : "") + quoted(names[which[i]]);
  return text + (which.size() > kShown ? ", ..." : "");
}

void check_joint_body(const scene::Joint& joint, const char* key, const std::string& wanted,
                      const std::vector<std::string>& bodies, Report& report) {
  const scene::Lookup found = scene::find_joint_body(bodies, {}, wanted, joint.identity.name_space, "");
  if (found.index) return;
  const Mark at = mark_of(joint.identity);
  if (!found.candidates.empty()) {
    report.error(at, key, quoted(wanted) + " may mean several bodies: " + listed(bodies, found.candidates),
                 "write the whole name");
    return;
  }
  const std::string near = report.nearest(wanted, bodies);
  report.warning(at, key, "no body of this file is called " + quoted(wanted),
                 near.empty() ? "it must come from another file"
                              : "did you mean " + quoted(near) + "? Else it must come from another file");
}

void probe(const std::string& path, const char* key, const scene::Identity& identity, const MeshProbe& mesh_probe,
           std::set<std::string>& probed, Report& report) {
  if (path.empty() || !probed.insert(path).second) return;
  const std::string problem = mesh_probe(path);
  if (!problem.empty()) report.error(mark_of(identity), key, shown_path(path) + ": " + problem, "the mesh is left out");
}

base::Diagnostics check_meshes(const scene::Model& model, const MeshProbe& mesh_probe) {
  Report report(model.file);
  if (!mesh_probe) return {};
  std::set<std::string> probed;
  for (const scene::Body& body : model.bodies) {
    report.set_block(body.identity.identifier);
    probe(body.visual.mesh_file, "mesh", body.identity, mesh_probe, probed, report);
    probe(body.collision.mesh_file, "collision mesh", body.identity, mesh_probe, probed, report);
  }
  return report.take();
}

base::Diagnostics check_model(const std::string& text, const std::string& path, const MeshProbe& mesh_probe) {
  ModelResult result = parse_model(text, path);
  if (result.model) {
    append(result.diagnostics, check_parents(*result.model));
    append(result.diagnostics, check_gains(*result.model));
    append(result.diagnostics, check_meshes(*result.model, mesh_probe));
  }
  return std::move(result.diagnostics);
}

base::Diagnostics check_world(const std::string& text, const std::string& path, const MeshProbe& mesh_probe) {
  WorldResult result = parse_world(text, path);
  if (result.world && !result.world->environment_file.empty()) {
    const std::string& environment = result.world->environment_file;
    const FileText file = read_text(environment);
    if (file.text) append(result.diagnostics, check_model(*file.text, environment, mesh_probe));
  }
  return std::move(result.diagnostics);
}

base::Diagnostics check_launch(const std::string& text, const std::string& path, const MeshProbe& mesh_probe) {
  LaunchResult result = parse_launch(text, path);
  if (!result.launch) return std::move(result.diagnostics);
  const scene::Launch& launch = *result.launch;
  std::vector<std::string> worlds = launch.world_files;
  if (!launch.world_file.empty()) worlds.push_back(launch.world_file);
  std::sort(worlds.begin(), worlds.end());
  worlds.erase(std::unique(worlds.begin(), worlds.end()), worlds.end());
  for (const std::string& world : worlds) {
    const FileText file = read_text(world);
    append(result.diagnostics, file.text ? check_world(*file.text, world, mesh_probe) : load_world(world).diagnostics);
  }
  if (!launch.color_file.empty()) append(result.diagnostics, load_colors(launch.color_file).diagnostics);
  if (!launch.input_devices_file.empty()) append(result.diagnostics, load_input_devices(launch.input_devices_file));
  Report report(path);
  const Document document(text);
  const Value models = document.root().find("multibody configs").value_or(Value());
  for (std::size_t i = 0; i < launch.model_files.size(); ++i) {
    if (!find_file({launch.model_files[i]}).empty()) continue;
    const std::string place = std::to_string(i);
    report.warning(models.item(i).mark(), "multibody configs[" + place + "]",
                   "no such file: " + shown_path(launch.model_files[i]), "-l " + place + " would fail");
  }
  append(result.diagnostics, report.take());
  return std::move(result.diagnostics);
}

}  // namespace

FileKind kind_of(const std::string& text) {
  const Document document(text);
  const Value root = document.root();
  if (!root.is_map()) return FileKind::model;
  bool all_colors = root.size() > 0, views = false, world = false;
  for (std::size_t i = 0; i < root.size(); ++i) {
    const auto [name, value] = root.entry(i);
    if (!name.is_scalar()) continue;
    const std::string& key = name.text();
    if (key == "multibody configs" || key == "world config") return FileKind::launch;
    if (key == "input devices") return FileKind::input_devices;
    const bool in_model = scene::find_key(scene::Group::model, key) != nullptr;
    const bool in_world = scene::find_key(scene::Group::world, key) != nullptr;
    if (in_model && !in_world) return FileKind::model;
    world |= in_world && !in_model;
    views |= key == "lights" || key == "cameras";
    all_colors &= is_color(value);
  }
  if (all_colors) return FileKind::colors;
  return world || views ? FileKind::world : FileKind::model;
}

bool too_many_pairs(const scene::Model& model) {
  constexpr std::size_t kMost = 20'000'000;  // some seconds
  const std::size_t lookers = model.joints.size() + model.cameras.size() + model.lights.size();
  return lookers * model.bodies.size() > kMost;
}

base::Diagnostics check_parents(const scene::Model& model) {
  Report report(model.file);
  std::vector<std::string> bodies;
  for (const scene::Body& body : model.bodies) bodies.push_back(body.identity.name_space + body.identity.identifier);
  if (too_many_pairs(model)) {
    report.information({}, "joints", "too many joints and bodies to look for the joints' bodies here", "loading does");
    return report.take();
  }
  for (const scene::Joint& joint : model.joints) {
    report.set_block(joint.identity.identifier);
    check_joint_body(joint, "parent", joint.parent, bodies, report);
    check_joint_body(joint, "child", joint.child, bodies, report);
  }
  const auto check_view = [&](const scene::Identity& identity, const std::string& parent) {
    if (parent.empty() || scene::find_identifier(bodies, parent).index) return;
    report.set_block(identity.identifier);
    report.information(mark_of(identity), "parent", "no body of this file is called " + quoted(parent),
                       "it must come from another file");
  };
  for (const scene::Camera& camera : model.cameras) check_view(camera.identity, camera.parent);
  for (const scene::Light& light : model.lights) check_view(light.identity, light.parent);
  return report.take();
}

base::Diagnostics check_file(const std::string& path, const MeshProbe& mesh_probe) {
  const FileText file = read_text(path);
  if (!file.text) return load_model(path).diagnostics;
  switch (kind_of(*file.text)) {
    case FileKind::launch: return check_launch(*file.text, path, mesh_probe);
    case FileKind::world: return check_world(*file.text, path, mesh_probe);
    case FileKind::colors: return parse_colors(*file.text, path).diagnostics;
    case FileKind::input_devices: return parse_input_devices(*file.text, path);
    case FileKind::model: break;
  }
  return check_model(*file.text, path, mesh_probe);
}

}  // namespace ambf::adf
