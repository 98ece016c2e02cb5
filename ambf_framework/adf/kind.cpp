#include "adf/kind.h"

#include "adf/urdf_import.h"
#include "scene/keys.h"

namespace ambf::adf {

namespace {

bool is_color(const Value& value) { return value.is_map() && value.find("r") && value.find("g") && value.find("b"); }

bool only_in_world(const std::string& key) {
  return scene::find_key(scene::group::kWorld, key) && !scene::find_key(scene::group::kModel, key);
}

// The mark of the first key that only this kind has.
template <class Predicate>
Mark mark_of_first(const Value& root, Predicate matches) {
  for (std::size_t i = 0; i < root.size(); ++i) {
    const auto [name, value] = root.entry(i);
    if (name.is_scalar() && matches(name.text())) return name.mark();
  }
  return {};
}

}  // namespace

FileKind kind_of(const Value& root) {
  if (!root.is_map()) return FileKind::model;
  bool all_colors = root.size() > 0, views = false, world = false;
  for (std::size_t i = 0; i < root.size(); ++i) {
    const auto [name, value] = root.entry(i);
    if (!name.is_scalar()) continue;
    const std::string& key = name.text();
    if (key == "multibody configs" || key == "world config" || key == "world configs") return FileKind::launch;
    if (key == "crtk arms") return FileKind::crtk_arms;
    if (key == "input devices") return FileKind::input_devices;
    if (scene::find_key(scene::group::kModel, key) && !scene::find_key(scene::group::kWorld, key))
      return FileKind::model;
    world |= only_in_world(key);
    views |= key == "lights" || key == "cameras";
    all_colors &= is_color(value);
  }
  if (all_colors) return FileKind::colors;
  return world || views ? FileKind::world : FileKind::model;
}

FileKind kind_of(const std::string& text) { return is_urdf(text) ? FileKind::model : kind_of(Document(text).root()); }

bool may_be_model(const Value& root, Report& report) {
  const auto refuse = [&](Mark at, const std::string& kind, const std::string& hint) {
    report.error(at, {}, "this is " + kind + ", no model", hint);
    return false;
  };
  switch (kind_of(root)) {
    case FileKind::model: return true;
    case FileKind::launch:
      return refuse(
          mark_of_first(root,
                        [](const std::string& key) { return key.ends_with(" configs") || key == "world config"; }),
          "a launch file", "start with --launch_file " + shown_path(report.file()));
    case FileKind::world: {
      const Mark at = mark_of_first(root, only_in_world);
      if (at.line == 0) return true;
      return refuse(at, "a world file", "name it as `world config` of a launch file");
    }
    case FileKind::colors: return refuse(root.mark(), "a colour file", "name it as `color config` of a launch file");
    case FileKind::input_devices:
      return refuse(root.mark(), "an input devices file", "name it as `input devices config` of a launch file");
    case FileKind::crtk_arms:
      return refuse(root.mark(), "a description of CRTK arms", "start with --crtk " + shown_path(report.file()));
  }
  return true;
}

}  // namespace ambf::adf
