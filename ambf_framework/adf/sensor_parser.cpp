#include "adf/detail/sensor_parser.h"

#include "adf/detail/bind.h"
#include "adf/detail/files.h"
#include "scene/sensor.h"

namespace ambf::adf {

namespace {

bool check_direction(const Fields& ray, const math::Vec3& direction, const std::string& path, Report& report) {
  if (math::norm(direction) > 1e-9) return true;
  report.error(ray.mark("direction"), path + "direction", "expected a direction, found the zero vector",
               "a ray needs one");
  return false;
}

bool parse_array(const Fields& fields, scene::Sensor& sensor, Report& report) {
  for (const Fields& ray : fields.maps("array")) {
    const std::string path = "array[" + std::to_string(sensor.array.size()) + "]/";
    sensor.array.push_back({ray.vector("offset", {}), ray.vector("direction", {})});
    if (!check_direction(ray, sensor.array.back().direction, path, report)) return false;
  }
  if (!sensor.array.empty()) return true;
  report.error(fields.mark("array"), "array", "expected a list of rays, found none", "give `offset` and `direction`");
  return false;
}

bool parse_parametric(const Fields& fields, scene::Sensor& sensor, Report& report) {
  if (sensor.parametric.resolution >= 2) return true;
  const Fields fan = fields.map("parametric");
  report.error(fan.mark("resolution"), "parametric/resolution",
               "expected 2 or more, found " + std::to_string(sensor.parametric.resolution),
               "the fan has the square of it in rays");
  return false;
}

// Without a known word: on faces.
scene::RayPlacement parse_placement(const Fields& fields, Report& report) {
  scene::RayPlacement placement{.faces = false};
  for (const std::string& word : fields.texts("placement")) {
    if (word == "faces") {
      placement.faces = true;
    } else if (word == "edges") {
      placement.edges = true;
    } else if (word == "vertices") {
      placement.vertices = true;
    } else {
      report.warning(fields.mark("placement"), "placement",
                     "expected faces, edges or vertices, found " + in_quotes(word), "it is left out");
    }
  }
  if (!placement.edges && !placement.vertices) placement.faces = true;
  return placement;
}

// Only the first of these places that has a file; false, and an error, when none has.
bool find_mesh(const Fields& fields, const char* key, const std::string& what, std::vector<std::string>& places,
               const FileContext& file) {
  if (!file.options.look_for_files) return true;
  const std::string found = find_file(places);
  if (!found.empty()) {
    places = {found};
    return true;
  }
  std::string list;
  for (const std::string& place : places) list += (list.empty() ? "" : ", ") + shown_path(place);
  file.report.error(fields.mark(key == std::string("mesh") ? "mesh" : "onto"), key,
                    what + " not found; looked at: " + list, "without it the sensor has no rays");
  return false;
}

// `places` of a mesh name. The mesh that is wrapped onto is found as the mesh of rays is.
template <class Places>
bool find_ray_mesh(const Fields& fields, const std::string& mesh, const std::string& visual_mesh, Places&& places,
                   scene::Sensor& sensor, const FileContext& file) {
  if (sensor.depth_m >= sensor.range_m) {
    file.report.warning(fields.mark("depth"), "depth",
                        "expected less than `range`; the rays end before they reach the surface",
                        "they begin `depth` below it and are `range` long");
  }
  sensor.placement = parse_placement(fields, file.report);
  sensor.mesh_files = places(mesh);
  if (!find_mesh(fields, "mesh", "mesh of rays", sensor.mesh_files, file)) return false;
  if (!fields.has("wrap")) return true;
  const Fields wrap = fields.map("wrap");
  const std::string onto = wrap.text("onto", visual_mesh);
  if (onto.empty()) {
    file.report.error(fields.mark("wrap"), "wrap/onto", "missing; the mesh of rays is wrapped onto nothing",
                      "name the mesh whose surface it shall follow");
    return false;
  }
  sensor.wrap.onto_files = places(onto);
  return find_mesh(wrap, "wrap/onto", "mesh to wrap onto", sensor.wrap.onto_files, file);
}

// Beside the file, else below the header's path.
std::vector<std::string> places_of_mesh(const std::string& mesh, const FileContext& file) {
  std::vector<std::string> places{resolve(file.folder, mesh)};
  if (!is_absolute(mesh) && !file.high_path.empty())
    places.push_back(resolve(resolve(file.folder, file.high_path), mesh));
  return places;
}

// Where a body's visual mesh may be: below its own path, else that below the header's; without one below the header's.
std::vector<std::string> places_on_body(const Fields& body, const std::string& mesh, const FileContext& file) {
  const std::string own = body.text("high resolution path");
  const std::string header_folder = resolve(file.folder, file.high_path);
  if (own.empty()) return {resolve(header_folder, mesh)};
  return {resolve(resolve(file.folder, own), mesh), resolve(resolve(header_folder, own), mesh)};
}

// Of the older syntax: `location` is a bare vector, both are in the parent's frame.
bool parse_single_ray(const Fields& fields, scene::Sensor& sensor, Report& report) {
  sensor.array = {{fields.vector("location", {}), fields.vector("direction", {})}};
  if (!fields.has("visible size")) sensor.visible_size_m = sensor.range_m / 8.0;
  return check_direction(fields, sensor.array.back().direction, {}, report);
}

// Of several ways to give rays, the first in this order counts.
bool parse_rays(const Fields& fields, scene::Sensor& sensor, const FileContext& file) {
  std::string_view used;
  for (const std::string_view key : {"array", "mesh", "parametric", "direction"}) {
    if (!fields.has(key)) continue;
    if (used.empty()) {
      used = key;
    } else {
      file.report.warning(fields.mark(key), std::string(key), "not used: `" + std::string(used) + "` counts",
                          "leave one of them out");
    }
  }
  if (fields.has("wrap") && used != "mesh")
    file.report.warning(fields.mark("wrap"), "wrap", "not used: only a `mesh` of rays is wrapped",
                        "give a `mesh`, or leave it out");
  if (used == "array") return parse_array(fields, sensor, file.report);
  if (used == "mesh") {
    const auto places = [&](const std::string& mesh) { return places_of_mesh(mesh, file); };
    return find_ray_mesh(fields, fields.text("mesh"), {}, places, sensor, file);
  }
  if (used == "parametric") return parse_parametric(fields, sensor, file.report);
  if (used == "direction") return parse_single_ray(fields, sensor, file.report);
  file.report.error(fields.mark(), "array", "missing; the sensor has no rays", "give `array`, `mesh` or `parametric`");
  return false;
}

bool casts_rays(state::SensorType type) {
  return type == state::SensorType::proximity || type == state::SensorType::resistance ||
         type == state::SensorType::range;
}

}  // namespace

std::optional<scene::KindBlock> parse_sensor(const Block& block, const FileContext& file, NameBook& names) {
  const Fields& fields = block.fields;
  auto sensor = std::make_shared<scene::Sensor>(
      read<scene::Sensor>(fields.value(), scene::group::kSensor, file.options.defaults));
  const bool is_pose = !fields.map("location").has("x");
  if (is_pose || !fields.has("direction")) {
    sensor->T_parent_sensor =
        is_pose ? fields.pose("location").value_or(math::Pose{}) : math::Pose{fields.vector("location", {}), {}};
  }
  sensor->range_noise.on = fields.has("range noise");
  if (casts_rays(sensor->type) && !parse_rays(fields, *sensor, file)) return std::nullopt;
  if (sensor->type == state::SensorType::force_torque && sensor->joint.empty()) {
    file.report.error(block.where, "joint", "missing; the sensor measures none", "name a joint of this file");
    return std::nullopt;
  }
  if (sensor->success_when != state::SuccessWhen::never && !casts_rays(sensor->type)) {
    file.report.warning(fields.mark("success when"), "success when", "never: only sensors with rays are judged",
                        "give a sensor of type Proximity, Range or Resistance the task");
    sensor->success_when = state::SuccessWhen::never;
  }
  if (sensor->success_when == state::SuccessWhen::matched && sensor->matching_key.empty()) {
    file.report.warning(fields.mark("success when"), "success when", "never: there is no `matching key`",
                        "give the key of the sensor that it shall match");
  }
  return scene::KindBlock{&scene::kind::kSensor, parse_identity(block, file, names), std::move(sensor)};
}

std::optional<scene::KindBlock> parse_resistive_surface(const Block& body_block, const scene::Body& body,
                                                        const FileContext& file) {
  const Fields surface = body_block.fields.map("resistive surface"), friction = surface.map("friction");
  auto sensor = std::make_shared<scene::Sensor>();
  sensor->type = state::SensorType::resistance;
  sensor->parent = body.identity.identifier;
  sensor->range_m = surface.number("range", 0.1);
  sensor->depth_m = surface.number("depth", 0.0);
  sensor->contact_area_m = surface.number("contact area", 0.001);
  sensor->contact_stiffness = surface.number("contact stiffness", 0.0);
  sensor->contact_damping = surface.number("contact damping", 0.0);
  sensor->visible = surface.flag("visible", false);
  sensor->visible_size_m = surface.number("visible size", sensor->range_m / 5.0);
  sensor->friction.stick = friction.number("static", 1.0);
  sensor->friction.damping = friction.number("damping", 1.0);
  sensor->friction.slide = friction.number("dynamic", 0.1);
  sensor->friction.scale = read_choice<scene::FrictionScale>(friction, scene::group::kSensorFriction, "variable")
                               .value_or(scene::FrictionScale::none);
  sensor->mesh_scale = body.scale;
  const std::string mesh = surface.text("mesh", body_block.fields.text("mesh"));
  if (mesh.empty()) {
    file.report.error(surface.mark(), "resistive surface", "expected a mesh, here or of the body, found none",
                      "there is one ray for each triangle");
    return std::nullopt;
  }
  sensor->wrap.offset_m = surface.map("wrap").number("offset", 0.0);
  const auto places = [&](const std::string& name) { return places_on_body(body_block.fields, name, file); };
  if (!find_ray_mesh(surface, mesh, body_block.fields.text("mesh"), places, *sensor, file)) return std::nullopt;
  scene::Identity identity = body.identity;
  identity.identifier += " resistive surface";
  identity.name += "_resistive_surface";
  return scene::KindBlock{&scene::kind::kSensor, std::move(identity), std::move(sensor)};
}

}  // namespace ambf::adf
