// World files (ADF 3).
#include "adf/detail/bind.h"
#include "adf/detail/files.h"
#include "adf/detail/open_file.h"
#include "adf/detail/view_parser.h"
#include "scene/lookup.h"

namespace ambf::adf {

namespace {

void parse_environment(const Fields& fields, const FileContext& file, scene::World& world) {
  const std::string environment = fields.text("environment");
  if (environment.empty()) return;
  const std::string path = resolve(file.folder, environment);
  if (file.options.look_for_files && find_file({path}).empty()) {
    file.report.error(fields.mark("environment"), "environment", "no such file: " + shown_path(path),
                      "the walled ground takes its place");
    return;
  }
  world.environment_file = path;
}

void report_two_enclosures(const Fields& fields, Report& report) {
  if (!fields.has("enclosure") || !fields.has("enclosure size")) return;
  report.warning(fields.mark("enclosure size"), "enclosure size", "says the same as `enclosure`", "`enclosure` counts");
}

void parse_skybox(const Fields& fields, const FileContext& file, scene::World& world) {
  if (!fields.has("skybox")) return;
  const Fields map = fields.map("skybox");
  scene::Skybox skybox{resolve(file.folder, map.text("path")),
                       map.text("right"),
                       map.text("left"),
                       map.text("top"),
                       map.text("bottom"),
                       map.text("front"),
                       map.text("back"),
                       parse_shaders(map, "shaders", file)};
  if (file.options.look_for_files) {
    for (const char* face : {"right", "left", "top", "bottom", "front", "back"}) {
      const std::string path = resolve(skybox.path, map.text(face));
      if (!find_file({path}).empty()) continue;
      file.report.warning(map.mark(face), std::string("skybox/") + face, "no such file: " + shown_path(path),
                          "there is no sky box");
      return;
    }
  }
  world.skybox = std::move(skybox);
}

}  // namespace

WorldResult parse_world(const std::string& text, const std::string& path, const Options& options) {
  Report report(path);
  const auto document = open_document(text, scene::group::kWorld, report);
  if (!document) return {std::nullopt, report.take()};
  Header header(document->root());
  const Fields& fields = header.fields();
  const FileContext file{report, options, folder_of(path), scene::join_namespace({}, fields.text("namespace")), {}, {}};
  auto world = read<scene::World>(fields.value(), scene::group::kWorld, options.defaults);
  world.file = path;
  world.name_space = file.name_space;
  parse_environment(fields, file, world);
  report_two_enclosures(fields, report);
  world.max_iterations_given = fields.has("max iterations");
  world.shaders = parse_shaders(fields, "shaders", file);
  parse_skybox(fields, file, world);
  NameBook light_names, camera_names;
  for (const Block& block : header.blocks("lights", scene::group::kLight, report)) {
    report.set_block(block.identifier);
    if (auto light = parse_light(block, file, light_names)) world.lights.push_back(std::move(*light));
  }
  for (const Block& block : header.blocks("cameras", scene::group::kCamera, report)) {
    report.set_block(block.identifier);
    if (auto camera = parse_camera(block, file, camera_names)) world.cameras.push_back(std::move(*camera));
  }
  return {std::move(world), report.take(), std::make_shared<const std::string>(text)};
}

WorldResult load_world(const std::string& path, const Options& options) {
  const FileText file = read_text(path);
  if (!file.text) return {std::nullopt, {unreadable(path, file.problem)}};
  return parse_world(*file.text, path, options);
}

}  // namespace ambf::adf
