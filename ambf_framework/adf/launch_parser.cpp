// Launch and colour files (ADF 2, 9).
#include "adf/detail/files.h"
#include "adf/detail/key_check.h"
#include "adf/detail/open_file.h"
#include "adf/detail/scalars.h"

namespace ambf::adf {

LaunchResult parse_launch(const std::string& text, const std::string& path) {
  Report report(path);
  const auto document = open_document(text, scene::group::kLaunch, report);
  if (!document) return {std::nullopt, report.take()};
  const Fields fields(document->root());
  const std::string folder = folder_of(path);
  scene::Launch launch;
  launch.file = path;
  const auto file_at = [&](const char* key, const char* instead) {
    const std::string file = fields.text(key);
    if (file.empty()) {
      report.information(fields.mark(), key, std::string("missing; ") + instead);
      return std::string();
    }
    return resolve(folder, file);
  };
  launch.world_file = file_at("world config", "a default world is used");
  launch.color_file = file_at("color config", "there are no colour names");
  launch.input_devices_file = file_at("input devices config", "there are no input devices");
  if (!fields.has("multibody configs"))
    report.information(fields.mark(), "multibody configs", "missing; -l has nothing to choose from");
  // Every entry keeps its place, because -l counts them.
  for (const std::string& file : fields.texts("multibody configs"))
    launch.model_files.push_back(file.empty() ? file : resolve(folder, file));
  for (const std::string& file : fields.texts("world configs")) launch.world_files.push_back(resolve(folder, file));
  if (!launch.world_files.empty() && launch.world_files.size() != launch.model_files.size()) {
    report.error(fields.mark(), "world configs",
                 "expected " + std::to_string(launch.model_files.size()) +
                     " entries, one for each of `multibody configs`, found " +
                     std::to_string(launch.world_files.size()),
                 "the file is refused");
    return {std::nullopt, report.take()};
  }
  std::vector<Placement> placements;
  for (const Fields& placed : fields.maps("multibody placements"))
    placements.push_back({placed.text("name prefix"), placed.pose("location").value_or(math::Pose{})});
  if (!placements.empty() && placements.size() != launch.model_files.size()) {
    report.error(fields.mark(), "multibody placements",
                 "expected " + std::to_string(launch.model_files.size()) +
                     " entries, one for each of `multibody configs`, found " + std::to_string(placements.size()),
                 "the file is refused");
    return {std::nullopt, report.take()};
  }
  return {std::move(launch), report.take(), std::move(placements)};
}

LaunchResult load_launch(const std::string& path) {
  const FileText file = read_text(path);
  if (!file.text) return {std::nullopt, {unreadable(path, file.problem)}};
  return parse_launch(*file.text, path);
}

ColorsResult parse_colors(const std::string& text, const std::string& path) {
  Report report(path);
  const Document document(text);
  if (document.error()) {
    report.error(document.error()->mark, {}, document.error()->message, document.error()->hint);
    return {std::nullopt, report.take()};
  }
  const Value root = document.root();
  if (!root.is_map()) {
    report.error(root.mark(), {}, "expected a map of colours, found " + describe(root), "the file is refused");
    return {std::nullopt, report.take()};
  }
  constexpr double kFull = 255.0;
  scene::ColorTable colors;
  for (std::size_t i = 0; i < root.size(); ++i) {
    const auto [name, value] = root.entry(i);
    if (!name.is_scalar() || !value.is_map()) {
      report.warning(name.mark(), name.is_scalar() ? printable(name.text()) : "",
                     "expected a colour {r, g, b, a}, found " + describe(value), "it is left out");
      continue;
    }
    const std::string key = printable(name.text());
    if (!KeyCheck{report}.map(value, scene::group::kColorRgba, key + "/")) continue;
    const Fields fields(value);
    scene::NamedColor color{fields.number("r", 0.0) / kFull, fields.number("g", 0.0) / kFull,
                            fields.number("b", 0.0) / kFull, fields.number("a", kFull) / kFull};
    if (color.r > 1.0 || color.g > 1.0 || color.b > 1.0 || color.a > 1.0) {
      report.error(value.mark(), key, "expected 0 to 255 for each part", "the colour is left out");
      continue;
    }
    if (!colors.emplace(name.text(), color).second)
      report.warning(name.mark(), key, "given twice; the first one counts", "remove one of them");
  }
  return {std::move(colors), report.take()};
}

ColorsResult load_colors(const std::string& path) {
  const FileText file = read_text(path);
  if (!file.text) {
    base::Diagnostic diagnostic = unreadable(path, file.problem);
    diagnostic.severity = base::Severity::warning;
    diagnostic.hint = "there are no colour names";
    return {scene::ColorTable{}, {std::move(diagnostic)}};
  }
  return parse_colors(*file.text, path);
}

}  // namespace ambf::adf
