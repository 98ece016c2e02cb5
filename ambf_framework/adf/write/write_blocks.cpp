#include "adf/detail/write_blocks.h"

#include "adf/detail/text_edit.h"
#include "scene/actuator.h"
#include "scene/block_kinds.h"
#include "scene/ghost.h"
#include "scene/sensor.h"
#include "scene/soft_body.h"
#include "scene/task.h"
#include "scene/vehicle.h"

namespace ambf::adf {

namespace {

using scene::Key;
using Text = std::optional<std::string>;

// No key of another's table has this name in what is written here, so that names are enough.
bool is(const Key& key, std::string_view name) { return key.name == name; }

WrittenKeys rows_of(const scene::Group& group, const void* object) {
  return written_keys(group, object, nullptr, [](const Key&) { return Text(); });
}

std::string words_of(const scene::RayPlacement& placement) {
  std::vector<std::string> words;
  if (placement.faces) words.emplace_back("faces");
  if (placement.edges) words.emplace_back("edges");
  if (placement.vertices) words.emplace_back("vertices");
  return words == std::vector<std::string>{"faces"} ? "" : flow_list(words);
}

std::string wrap_of(const scene::RayWrap& wrap) {
  if (wrap.onto_files.empty()) return {};
  return flow(WrittenKeys{{"onto", as_scalar(wrap.onto_files.front())}, {"offset", flow(wrap.offset_m)}});
}

WrittenKeys keys_of(const scene::Sensor& sensor) {
  return written_keys(scene::group::kSensor, &sensor, nullptr, [&](const Key& key) -> Text {
    if (is(key, "location")) return sensor.T_parent_sensor == math::Pose{} ? "" : flow(sensor.T_parent_sensor);
    if (is(key, "array")) {
      std::vector<std::string> rays;
      for (const scene::SensorRayBlock& ray : sensor.array)
        rays.push_back(flow(WrittenKeys{{"offset", flow(ray.offset)}, {"direction", flow(ray.direction)}}));
      return rays.empty() ? "" : flow_list(rays);
    }
    if (is(key, "mesh")) return sensor.mesh_files.empty() ? "" : as_scalar(sensor.mesh_files.front());
    if (is(key, "placement")) return sensor.mesh_files.empty() ? "" : words_of(sensor.placement);
    if (is(key, "wrap")) return wrap_of(sensor.wrap);
    if (is(key, "range noise")) {
      if (!sensor.range_noise.on) return "";
      const state::DepthNoise& noise = sensor.range_noise;
      return flow(
          WrittenKeys{{"mean", flow(noise.mean)}, {"std_dev", flow(noise.std_dev)}, {"bias", flow(noise.bias)}});
    }
    return std::nullopt;
  });
}

WrittenKeys keys_of(const scene::Actuator& actuator) {
  return written_keys(*scene::kind::kActuator.group, &actuator, nullptr, [&](const Key& key) -> Text {
    if (is(key, "edge") || is(key, "arc")) {
      std::vector<std::string> places;
      for (const math::Vec3& place : is(key, "arc") ? actuator.arc : actuator.edge) places.push_back(flow(place));
      return places.empty() ? "" : flow_list(places);
    }
    if (!is(key, "trigger")) return std::nullopt;
    if (actuator.trigger == state::Trigger::command) return "";
    if (actuator.trigger == state::Trigger::sensor) return "sensor";
    if (actuator.trigger == state::Trigger::contact) return "contact";
    return flow(WrittenKeys{{"jaw", as_scalar(actuator.jaw)}, {"below", flow(actuator.below)}});
  });
}

// What is drawn and collides, then what the kind has besides.
template <class Object>
WrittenKeys with_looks(const Object& object, WrittenKeys more, const Lost& lost) {
  WrittenKeys keys = visual_keys(object.visual, collides(object.collision), lost);
  const auto add = [&keys](WrittenKeys&& others) {
    for (auto& key : others) keys.push_back(std::move(key));
  };
  add(collision_keys(object.collision));
  if (object.visual.material) add(material_keys(*object.visual.material, lost));
  add(std::move(more));
  return keys;
}

std::string region_of(const scene::TissueRegion& region) {
  return flow(written_keys(scene::group::kTissueRegion, &region, nullptr, [&](const Key& key) -> Text {
    if (is(key, "vertices")) return region.vertices.empty() ? "" : flow(region.vertices);
    return std::nullopt;
  }));
}

std::string regions_of(const std::vector<scene::TissueRegion>& all) {
  std::vector<std::string> regions;
  for (const scene::TissueRegion& region : all) regions.push_back(region_of(region));
  return regions.empty() ? "" : flow_list(regions);
}

std::string tissue_of(const scene::Tissue& tissue) {
  WrittenKeys keys = written_keys(scene::group::kTissue, &tissue, nullptr, [&](const Key& key) -> Text {
    if (is(key, "kind")) return first_word(key, static_cast<int>(tissue.kind));  // so that the map is never empty
    if (is(key, "points")) {
      std::vector<std::string> points;
      for (const math::Vec3& point : tissue.points) points.push_back(flow(point));
      return points.empty() ? "" : flow_list(points);
    }
    if (!is(key, "regions")) return std::nullopt;
    return regions_of(tissue.regions);
  });
  return flow(keys);
}

WrittenKeys keys_of(const scene::SoftBody& soft) {
  return written_keys(scene::group::kSoftBody, &soft, nullptr, [&](const Key& key) -> Text {
    if (is(key, "tissue")) return soft.is_tissue ? tissue_of(soft.tissue) : "";
    if (is(key, "regions")) return regions_of(soft.config.regions);
    if (is(key, "fixed nodes")) return soft.config.fixed_nodes.empty() ? "" : flow(soft.config.fixed_nodes);
    return std::nullopt;
  });
}

// The file that was found for a wheel's mesh; the name in the block leads there from the old file alone.
std::string mesh_of(const scene::Wheel& wheel, const std::vector<scene::Body>& bodies) {
  for (const scene::Body& body : bodies)
    if (body.identity.identifier == wheel.body && !body.visual.mesh_file.empty()) return body.visual.mesh_file;
  return wheel.mesh;
}

std::string wheel_of(const scene::Wheel& wheel, const std::vector<scene::Body>& bodies) {
  return flow(written_keys(scene::group::kWheel, &wheel, nullptr, [&](const Key& key) -> Text {
    if (is(key, "body") && !wheel.mesh.empty()) return "";  // it is made of the mesh
    if (is(key, "mesh")) return wheel.mesh.empty() ? "" : as_scalar(mesh_of(wheel, bodies));
    return std::nullopt;
  }));
}

WrittenKeys keys_of(const scene::Vehicle& vehicle, const std::vector<scene::Body>& bodies) {
  return written_keys(*scene::kind::kVehicle.group, &vehicle, nullptr, [&](const Key& key) -> Text {
    if (!is(key, "wheels")) return std::nullopt;
    std::vector<std::string> wheels;
    for (const scene::Wheel& wheel : vehicle.wheels) wheels.push_back(wheel_of(wheel, bodies));
    return flow_list(wheels);
  });
}

std::string goal_of(const scene::TaskGoal& goal) {
  return flow(written_keys(scene::group::kTaskGoal, &goal, nullptr, [&](const Key& key) -> Text {
    if (is(key, "pieces") && !goal.piece.empty()) return "";
    if (is(key, "position tolerance")) return goal.tolerance_m ? flow(*goal.tolerance_m) : "";
    if (is(key, "axis")) return goal.axis ? flow(*goal.axis) : "";
    return std::nullopt;
  }));
}

WrittenKeys keys_of(const scene::Task& task) {
  return written_keys(*scene::kind::kTask.group, &task, nullptr, [&](const Key& key) -> Text {
    if (!is(key, "goals")) return std::nullopt;
    std::vector<std::string> goals;
    for (const scene::TaskGoal& goal : task.goals) goals.push_back(goal_of(goal));
    return flow_list(goals);
  });
}

}  // namespace

WrittenKeys block_keys(const scene::KindBlock& block, const std::vector<scene::Body>& bodies, const Lost& lost) {
  if (block.kind == &scene::kind::kSensor) return keys_of(block.as<scene::Sensor>());
  if (block.kind == &scene::kind::kActuator) return keys_of(block.as<scene::Actuator>());
  if (block.kind == &scene::kind::kVehicle) return keys_of(block.as<scene::Vehicle>(), bodies);
  if (block.kind == &scene::kind::kTask) return keys_of(block.as<scene::Task>());
  if (block.kind == &scene::kind::kGhostObject) {
    const auto& ghost = block.as<scene::Ghost>();
    return with_looks(ghost, rows_of(scene::group::kGhostObject, &ghost), lost);
  }
  if (block.kind == &scene::kind::kSoftBody) {
    const auto& soft = block.as<scene::SoftBody>();
    return with_looks(soft, keys_of(soft), lost);
  }
  return rows_of(*block.kind->group, block.description.get());
}

const scene::Body* body_of_surface(const scene::KindBlock& block, const std::vector<scene::Body>& bodies) {
  if (block.kind != &scene::kind::kSensor) return nullptr;
  for (const scene::Body& body : bodies)
    if (block.identity.identifier == body.identity.identifier + " resistive surface" &&
        block.as<scene::Sensor>().parent == body.identity.identifier)
      return &body;
  return nullptr;
}

// All of them: its defaults are other ones than a sensor's.
std::string surface_keys(const scene::KindBlock& block) {
  const auto& sensor = block.as<scene::Sensor>();
  const scene::ResistiveFriction& f = sensor.friction;
  const Key& variable = *scene::find_key(scene::group::kSensorFriction, "variable");
  WrittenKeys keys;
  const auto add = [&keys](const char* name, const std::string& value) {
    if (!value.empty()) keys.emplace_back(name, value);
  };
  add("mesh", sensor.mesh_files.empty() ? "" : as_scalar(sensor.mesh_files.front()));
  add("placement", words_of(sensor.placement));
  add("wrap", wrap_of(sensor.wrap));
  add("range", flow(sensor.range_m));
  add("depth", flow(sensor.depth_m));
  add("contact area", flow(sensor.contact_area_m));
  add("friction", flow(WrittenKeys{{"static", flow(f.stick)},
                                   {"damping", flow(f.damping)},
                                   {"dynamic", flow(f.slide)},
                                   {"variable", first_word(variable, static_cast<int>(f.scale))}}));
  add("contact stiffness", flow(sensor.contact_stiffness));
  add("contact damping", flow(sensor.contact_damping));
  add("visible", sensor.visible ? "true" : "false");
  add("visible size", flow(sensor.visible_size_m));
  return flow(keys);
}

std::vector<std::string> drawn_wheels(const scene::KindBlock& block) {
  if (block.kind != &scene::kind::kVehicle) return {};
  std::vector<std::string> bodies;
  for (const scene::Wheel& wheel : block.as<scene::Vehicle>().wheels)
    if (!wheel.mesh.empty()) bodies.push_back(wheel.body);
  return bodies;
}

}  // namespace ambf::adf
